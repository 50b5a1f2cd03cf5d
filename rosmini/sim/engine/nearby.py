"""Index of fixed boxes by position."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CELL_SIZE = 2.0
"""Edge length of the grid's cells [m]; larger boxes are always tested."""


class Nearby:
    """Boxes (n, 4), each x and y of its lower and upper corner [m], in a grid by their centres."""

    def __init__(self, boxes: Floats) -> None:
        self.boxes = boxes
        small = (boxes[:, 2:] - boxes[:, :2] <= CELL_SIZE).all(axis=1)
        which = np.flatnonzero(small)
        self._large = np.flatnonzero(~small)
        middles = (boxes[which, :2] + boxes[which, 2:]) / 2
        self._origin = middles.min(axis=0) if len(which) else np.zeros(2)
        squares = np.floor((middles - self._origin) / CELL_SIZE).astype(np.int64)
        self._columns = int(squares[:, 0].max(initial=-1)) + 1
        self._rows = int(squares[:, 1].max(initial=-1)) + 1
        keys = squares[:, 1] * self._columns + squares[:, 0]
        order = np.argsort(keys, kind="stable")
        self._keys, self._which = keys[order], which[order]

    def within(self, x: float, y: float, reach: float) -> Ints:
        """Return the indices of the boxes that meet the square of half-width `reach` [m], in ascending order."""
        parts = [self._large]
        half = 0.5 + 1e-6  # a box's centre is at most half a cell from its edge, plus an allowance for rounding errors
        low = np.floor((np.array([x, y]) - self._origin - reach) / CELL_SIZE - half)
        high = np.floor((np.array([x, y]) - self._origin + reach) / CELL_SIZE + half)
        left, bottom = np.maximum(low, 0.0).tolist()
        right, top = np.minimum(high, (self._columns - 1, self._rows - 1)).tolist()
        if left <= right and bottom <= top:
            rows = np.arange(int(bottom), int(top) + 1) * self._columns
            begins = np.searchsorted(self._keys, rows + int(left), "left").tolist()
            ends = np.searchsorted(self._keys, rows + int(right), "right").tolist()
            parts += [self._which[begin:end] for begin, end in zip(begins, ends, strict=True)]
        found = np.sort(np.concatenate(parts))
        boxes = self.boxes[found]
        near: Ints = found[
            (boxes[:, 0] <= x + reach)
            & (boxes[:, 2] >= x - reach)
            & (boxes[:, 1] <= y + reach)
            & (boxes[:, 3] >= y - reach)
        ]
        return near


def boxes_around(segments: Floats) -> Floats:
    """Return the bounding boxes (n, 4) of segments (n, 4)."""
    return np.hstack([np.minimum(segments[:, :2], segments[:, 2:]), np.maximum(segments[:, :2], segments[:, 2:])])
