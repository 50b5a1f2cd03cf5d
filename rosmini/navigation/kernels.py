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

Kernel = Callable[..., Any]

KERNELS: list[Callable[[], Kernel]] = []
"""The functions decorated with `kernel` in all modules imported so far."""


def kernel(compiled: Callable[[], Kernel]) -> Callable[[], Kernel]:
    """Register a function that returns a kernel, and call it only once: compiled, or the plain loop without numba."""
    cached = cache(compiled)
    KERNELS.append(cached)
    return cached


def compile_all() -> int:
    """Compile every kernel of navigation, or load it from numba's cache; return their number."""
    package = import_module("rosmini.navigation")
    for module in walk_packages(package.__path__, "rosmini.navigation."):
        import_module(module.name)
    for compiled in KERNELS:
        compiled()
    return len(KERNELS)
