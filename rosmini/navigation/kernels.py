"""The compiled loops of navigation: each is compiled on first use, or all at once before tests run in parallel.

Each is plain Python in its module, and runs uncompiled without numba. There are few, because every new user pays for
compiling them once; afterwards numba caches them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pkgutil import walk_packages
from typing import Any

from rosmini.core.geometry.machine_code import machine_code

Kernel = Callable[..., Any]

KERNELS: list[Callable[[], Kernel]] = []
"""The functions that return the kernels of all modules imported so far."""


def kernel(loop: Kernel, *helpers: Kernel) -> Callable[[Callable[[Any], Any]], Callable[[], Kernel]]:
    """Register a loop, which calls `helpers`; the decorated function receives numba and returns the loop's signature.

    The name then refers to a function that returns the compiled loop, or the plain one if numba is not installed.
    """

    def register(signature: Callable[[Any], Any]) -> Callable[[], Kernel]:
        @cache
        def compiled() -> Kernel:
            try:
                import numba
            except ImportError:
                return loop
            return machine_code(loop, signature(numba), helpers)

        KERNELS.append(compiled)
        return compiled

    return register


def compile_all() -> int:
    """Compile every kernel of navigation, or load it from numba's cache; return their number."""
    package = import_module("rosmini.navigation")
    for module in walk_packages(package.__path__, "rosmini.navigation."):
        import_module(module.name)
    for compiled in KERNELS:
        compiled()
    return len(KERNELS)
