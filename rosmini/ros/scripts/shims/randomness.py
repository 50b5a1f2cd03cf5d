"""Random numbers of one script: its own ``random`` and its own legacy generator of numpy.

In simulated time they start from the script's seed, so a script that never calls ``seed`` behaves the same each run;
in wall-clock time from the operating system, as usual.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import ModuleType

    from rosmini.ros.scripts.context import ScriptContext


def seed_copy(context: ScriptContext, module: ModuleType) -> None:
    """Make a private ``random`` repeatable in simulated time, including unseeded ``Random()`` objects."""
    if not context.scheduler.simulated:
        return
    random: Any = module
    seeds = random.Random(f"{context.seed}/seeds")
    plain_seed = random.Random.seed

    def seed(self: Any, a: Any = None, version: int = 2) -> None:
        """Seed as usual; without a value, use the script's seed instead of the operating system."""
        plain_seed(self, seeds.getrandbits(64) if a is None else a, version)

    random.Random.seed = seed
    random._inst.seed(f"{context.seed}")  # noqa: SLF001
    random.seed = random._inst.seed  # noqa: SLF001


class NumpyRandom:
    """Swaps the functions of ``numpy.random`` (``seed``, ``rand``, ``normal``, ...) for those of a script's generator.

    In numpy they are bound methods of one ``RandomState``; here each script has its own.
    """

    def __init__(self, context: ScriptContext) -> None:
        from numpy import random

        seed = None
        if context.scheduler.simulated:
            seed = list(f"script {context.seed}".encode())
        self._namespace = vars(random)
        self._inner = vars(sys.modules["numpy.random.mtrand"])
        state = random.RandomState(seed)
        names = [name for name in dir(state) if not name.startswith("_") and callable(self._namespace.get(name))]
        self._own: dict[str, Any] = {name: getattr(state, name) for name in names}
        self._own.update(
            {name: state.random_sample for name in ("ranf", "sample", "random") if name in self._namespace}
        )
        if seed is not None:
            streams = random.SeedSequence(seed)
            make = random.default_rng

            def default_rng(seed: Any = None) -> Any:
                return make(streams.spawn(1)[0] if seed is None else seed)

            self._own["default_rng"] = default_rng
        self._inner_own = {"_rand": state}
        self._host = {name: self._namespace[name] for name in self._own}
        self._inner_host = {name: self._inner[name] for name in self._inner_own}

    def enter(self) -> None:
        """Install the script's functions."""
        self._namespace.update(self._own)
        self._inner.update(self._inner_own)

    def leave(self) -> None:
        """Restore the host's functions."""
        self._namespace.update(self._host)
        self._inner.update(self._inner_host)
