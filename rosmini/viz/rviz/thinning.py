"""Maps with fewer cells that show the same."""

from __future__ import annotations

import math

import numpy as np

from .primitives import Pixels

MOST_SIDE = 640
"""Cells along a side of what is drawn: a page shows no more."""


def thinned(cells: Pixels, scheme: str) -> tuple[Pixels, int]:
    """A map (h, w) with at most `MOST_SIDE` cells a side, and how many cells each of them stands for along a side.

    Of several cells the one counts that is seen best: the most occupied, so walls stay; unknown last.
    """
    factor = math.ceil(max(cells.shape) / MOST_SIDE)
    if factor <= 1:
        return cells, 1
    # -1 must not win over what is known; as a signed byte it is least
    order = cells if scheme == "raw" else cells.view(np.int8)
    least = order.min() if scheme == "raw" else np.int8(-128)
    height, width = (-(-side // factor) * factor for side in cells.shape)
    padded = np.full((height, width), least, dtype=order.dtype)
    padded[: cells.shape[0], : cells.shape[1]] = order
    best = padded.reshape(height // factor, factor, width // factor, factor).max(axis=(1, 3))
    return best.view(np.uint8), factor
