"""The compiled loops of navigation: each is compiled on first use, or before a robot drives in real time.

Each is plain Python in its module, and runs uncompiled without numba. There are few, because every new user pays for
compiling them once; afterwards numba caches them.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib import import_module
from pkgutil import walk_packages
from typing import Any

from rosmini.core.geometry.machine_code import machine_code
from rosmini.core.graph import Node
from rosmini.core.graph.threads import in_thread
from rosmini.core.tf.kernel import compiled_walk

Kernel = Callable[..., Any]

KERNELS: list[Callable[[], Kernel]] = []
"""The functions that return the kernels of all modules imported so far."""


def kernel(loop: Kernel, *helpers: Kernel) -> Callable[[Callable[[Any], Any]], Callable[[], Kernel]]:
    """Register a loop, which calls `helpers`; the decorated function receives numba and returns the loop's signature.

    The decorator replaces it by a function that returns the compiled loop, or the plain one if numba is not installed.
    """

    def register(signature: Callable[[Any], Any]) -> Callable[[], Kernel]:
        @cache
        def compiled() -> Kernel:
            try:
                return machine_code(loop, signature, helpers)
            except ImportError:
                return loop

        KERNELS.append(compiled)
        return compiled

    return register


def compile_imported() -> None:
    """Compile the kernels of all modules imported so far, and tf's, or load them from numba's cache."""
    with suppress(ImportError):
        compiled_walk()
    for compiled in KERNELS:
        compiled()


def prepare(node: Node) -> None:
    """Compile the kernels that a node may need before its graph runs in real time.

    If it already does, the calling lane waits for the compiler, and the other lanes continue. Simulated time waits for
    the compiler anyway, so there each kernel is compiled on first use.
    """
    graph = node.graph
    if graph.runs_in_real_time:
        in_thread(graph.scheduler, compile_imported, hold=False)
    else:
        graph.before_live(compile_imported)


def compile_all() -> int:
    """Compile every kernel of navigation, or load it from numba's cache; return their number."""
    package = import_module("rosmini.navigation")
    for module in walk_packages(package.__path__, "rosmini.navigation."):
        import_module(module.name)
    compile_imported()
    return len(KERNELS)
