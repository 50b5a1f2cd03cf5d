"""The colours of maps as RViz shows them, and maps with fewer cells that show the same."""

from __future__ import annotations

import math

import numpy as np

from .primitives import Pixels

MOST_SIDE = 640
"""Cells along a side of what is drawn: a page shows no more."""


def _palette() -> Pixels:
    """What `map` and `costmap` have in common: values that are not allowed, and -1, unknown."""
    colours = np.zeros((256, 4), dtype=np.uint8)
    colours[:, 3] = 255
    colours[101:128, 1] = 255
    colours[128:255, 0] = 255
    colours[128:255, 1] = 255 * np.arange(127) // 126
    colours[255, :3] = (0x70, 0x89, 0x86)
    return colours


def _map() -> Pixels:
    colours = _palette()
    colours[:101, :3] = (255 - 255 * np.arange(101) // 100)[:, None]
    return colours


def _costmap() -> Pixels:
    colours = _palette()
    colours[0] = 0
    costs = 255 * np.arange(1, 99) // 100
    colours[1:99, 0], colours[1:99, 2] = costs, 255 - costs
    colours[99, :3], colours[100, :3] = (0, 255, 255), (255, 0, 255)
    return colours


def _raw() -> Pixels:
    colours = np.full((256, 4), 255, dtype=np.uint8)
    colours[:, :3] = np.arange(256)[:, None]
    return colours


COLOUR_SCHEMES = {"map": _map(), "costmap": _costmap(), "raw": _raw()}
"""For each scheme the colours (256, 4) of the cells' values as unsigned bytes; -1 is 255."""


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
