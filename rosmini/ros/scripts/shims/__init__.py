"""Per-script replacements for modules that block, read the time or keep global state.

``BUILDERS`` create a module for one script; ``PRIVATE_COPIES`` are modules of the standard library that need only
use these replacements (a private ``logging`` writes to the script's streams with the script's clock and locks).
"""

from __future__ import annotations

import functools
import importlib
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.ros.scripts.context import ScriptContext

PRIVATE_COPIES = frozenset(
    {
        "_threading_local",
        "concurrent",
        "concurrent.futures",
        "concurrent.futures._base",
        "concurrent.futures.thread",
        "logging",
        "logging.config",
        "logging.handlers",
        "queue",
        "random",
        "sched",
    }
)

_BUILDERS_IN = {
    "_thread": "threads",
    "atexit": "process",
    "builtins": "process",
    "datetime": "clock",
    "importlib": "process",
    "msvcrt": "terminal",
    "os": "leaving",
    "select": "terminal",
    "signal": "process",
    "subprocess": "outside",
    "sys": "process",
    "termios": "terminal",
    "threading": "threads",
    "time": "clock",
    "tty": "terminal",
    "xmlrpc": "outside",
    "xmlrpc.client": "outside",
}


def _build(name: str, context: ScriptContext) -> ModuleType:
    maker = importlib.import_module(f"{__name__}.{_BUILDERS_IN[name]}")
    module: ModuleType = getattr(maker, f"make_{name.strip('_').replace('.', '_')}")(context)
    return module


BUILDERS: dict[str, Callable[[ScriptContext], ModuleType]] = {
    name: functools.partial(_build, name) for name in _BUILDERS_IN
}


def finish_copy(context: ScriptContext, name: str, module: ModuleType) -> None:
    """Change the parts of a private copy that its imports do not cover."""
    if name == "queue":
        # The C version blocks the whole process; the standard library also has a Python version.
        module.SimpleQueue = module._PySimpleQueue  # type: ignore[attr-defined]  # noqa: SLF001
    elif name == "random":
        from .randomness import seed_copy

        seed_copy(context, module)


def copy_of(real: ModuleType) -> ModuleType:
    """Return a new module with the contents of ``real``, to be changed."""
    module = ModuleType(real.__name__, real.__doc__)
    module.__dict__.update(vars(real))
    return module


def as_builtins(module: ModuleType, **functions: Callable[..., object]) -> None:
    """Replace C functions of ``module`` with ``functions``.

    C functions do not become methods in a class (``converter = time.localtime``), and neither must these.
    """
    for name, function in functions.items():
        if isinstance(function, FunctionType):
            function.__name__ = function.__qualname__ = name
        module.__dict__[name] = staticmethod(function)
