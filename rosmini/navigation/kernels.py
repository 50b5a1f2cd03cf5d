"""The compiled loops of navigation: each is compiled on first use, or all at once before tests run in parallel.

Each is plain Python in its module, and runs uncompiled without numba. There are few, because every new user pays for
compiling them once; afterwards numba caches them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from typing import Any

KERNELS: tuple[str, ...] = (
    "rosmini.navigation.base_local_planner.map_grid:compiled_wavefront",
    "rosmini.navigation.base_local_planner.rollout:compiled_footprint_cost",
    "rosmini.navigation.base_local_planner.rollout:compiled_rollout",
    "rosmini.navigation.costmap_2d.rays:compiled_clear_rays",
    "rosmini.navigation.costmap_2d.voxels:compiled_clear_voxels",
    "rosmini.navigation.global_planner.best_first:compiled_best_first",
    "rosmini.navigation.navfn.descent:compiled_descend",
    "rosmini.navigation.navfn.wave:compiled_wave",
    "rosmini.navigation.amcl.field:compiled_scores",
    "rosmini.navigation.gmapping.maps:compiled_register",
    "rosmini.navigation.gmapping.matching:compiled_match",
    "rosmini.navigation.hector_mapping.matching:compiled_climb",
)
"""`module:function` of each function that returns a kernel: compiled, or the plain function without numba."""


@cache
def kernel(name: str) -> Callable[..., Any]:
    """Return the kernel with this entry of `KERNELS`."""
    module, _, function = name.partition(":")
    made: Callable[..., Any] = getattr(import_module(module), function)()
    return made


def compile_all() -> list[str]:
    """Compile every kernel, or load it from numba's cache; return the names."""
    for name in KERNELS:
        kernel(name)
    return list(KERNELS)
