"""Machine code of functions that are plain Python: the one way to numba, which may be missing."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from typing import Any


def machine_code(
    function: Callable[..., Any], signature: Any, helpers: Iterable[Callable[..., Any]] = ()
) -> Callable[..., Any]:
    """Compile `function`, which calls `helpers`, for one signature of numba's types.

    From numba's cache where there is one.

    Raises `ImportError` without numba.
    """
    import numba
    from numba.extending import register_jitable

    for helper in helpers:
        register_jitable(helper)
    try:
        return numba.njit([signature], cache=True)(function)
    except Exception as error:
        # A cache that can be neither written nor read (an installation for all users, a full disk, a broken file) costs
        # a few seconds at each start and no more. What is wrong with the code itself is raised again below.
        logging.getLogger(__name__).info("numba cannot cache %s: %s", function.__name__, error)
    return numba.njit([signature])(function)
