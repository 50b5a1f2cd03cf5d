"""Reduce the number of cells of maps without a visible difference."""

from __future__ import annotations

import math

import numpy as np

from .primitives import Pixels

MAX_SIDE = 640
"""Maximum number of cells per side of a drawing: a page shows no more."""


def thinned(cells: Pixels, scheme: str) -> tuple[Pixels, int]:
    """Return a map (h, w) with at most `MAX_SIDE` cells a side, and the number of cells per side that each combines.

    Of several cells, the most occupied one is used, so that walls are preserved; unknown is used last.
    """
    factor = math.ceil(max(cells.shape) / MAX_SIDE)
    if factor <= 1:
        return cells, 1
    # -1 must not override known cells; as a signed byte it is the minimum
    order = cells if scheme == "raw" else cells.view(np.int8)
    least = order.min() if scheme == "raw" else np.int8(-128)
    height, width = (-(-side // factor) * factor for side in cells.shape)
    padded = np.full((height, width), least, dtype=order.dtype)
    padded[: cells.shape[0], : cells.shape[1]] = order
    best = padded.reshape(height // factor, factor, width // factor, factor).max(axis=(1, 3))
    return best.view(np.uint8), factor
