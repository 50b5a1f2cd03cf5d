"""The visible faces of a scene, and the order in which to paint them, which distances alone cannot determine.

They are rasterised, as on a graphics card (the z-buffer: E. Catmull, "A subdivision algorithm for computer display of
curved surfaces", 1974). A face that is nearest at no pixel is left out; of two on a pixel the farther is painted first.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import inside, sides_of
from rosmini.core.geometry.products import matrix_product
from rosmini.viz.rounding import snap

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class DepthBuffer:
    """The order in which to paint flat polygons, and the depth of the nearest one at each pixel.

    `outlines` are their projections (n, 2) [px], and `planes` (n, 3) their depths: a b c, where 1 / depth is
    `a x + b y + c` at the pixel (x, y) [1/m].
    """

    def __init__(self, outlines: Sequence[Floats], planes: Floats, width: int, height: int) -> None:
        self._width, self._height = width, height
        self._nearest = np.zeros(width * height)
        """1 / depth [1/m]; 0 where there is no polygon."""
        self.order: list[int] = []
        """The visible polygons, by index."""
        polygon, pixel, inverse_depth = self._rasterise(outlines, planes)
        if not len(polygon):
            return
        order = np.lexsort((polygon, inverse_depth, pixel))
        polygon, pixel = polygon[order], pixel[order]
        last = np.append(pixel[1:] != pixel[:-1], True)
        self._nearest[pixel[last]] = inverse_depth[order][last]
        seen = np.unique(polygon[last])
        kept = np.isin(polygon, seen)
        polygon, pixel = polygon[kept], pixel[kept]
        shared = pixel[1:] == pixel[:-1]
        pairs, count = np.unique(
            np.column_stack([polygon[:-1][shared], polygon[1:][shared]]), axis=0, return_counts=True
        )
        far = snap([1 / _inverse_depths(outlines[i], planes[i]).min() for i in seen], 1e-6)
        self.order = _sorted(
            seen.tolist(), pairs.tolist(), count.tolist(), dict(zip(seen.tolist(), far.tolist(), strict=True))
        )

    def hides(self, x: float, y: float, depth: float) -> bool:
        """Return True if something is in front of a point of the picture [px] that is `depth` away [m]."""
        return bool(self._nearest[int(y) * self._width + int(x)] * depth > 1)

    def _rasterise(self, outlines: Sequence[Floats], planes: Floats) -> tuple[Ints, Ints, Floats]:
        """For every pixel whose centre a polygon covers, return the polygon, the pixel, and 1 / its depth there."""
        found: list[tuple[Ints, Ints, Floats]] = [(np.empty(0, int), np.empty(0, int), np.empty(0))]
        for i, outline in enumerate(outlines):
            x0, y0 = np.maximum(np.ceil(outline.min(axis=0) - 0.5), 0).astype(int)
            x1, y1 = np.minimum(
                np.floor(outline.max(axis=0) - 0.5), (self._width - 1, self._height - 1)
            ).astype(int)
            if x0 > x1 or y0 > y1:
                continue
            x, y = (part.ravel() for part in np.meshgrid(np.arange(x0, x1 + 1), np.arange(y0, y1 + 1)))
            covered = inside(np.column_stack([x, y]) + 0.5, sides_of(outline))
            x, y = x[covered], y[covered]
            inverse_depth = _inverse_depths(np.column_stack([x, y]) + 0.5, planes[i])
            found.append((np.full(len(x), i), y * self._width + x, inverse_depth))
        polygon, pixel, inverse_depth = (np.concatenate(part) for part in zip(*found, strict=True))
        return polygon, pixel, inverse_depth


def _inverse_depths(points: Floats, plane: Floats) -> Floats:
    return snap(matrix_product(points, plane[:2]) + plane[2], 1e-7)


def _sorted(
    seen: list[int], pairs: list[tuple[int, int]], counts: list[int], far: dict[int, float]
) -> list[int]:
    """Sort so that the first of every pair comes before the second; break cycles at the farthest."""
    votes = {(a, b): count for (a, b), count in zip(pairs, counts, strict=True)}
    after: dict[int, list[int]] = {i: [] for i in seen}
    waiting = dict.fromkeys(seen, 0)
    for (a, b), count in votes.items():
        # where two faces intersect or touch, the majority of pixels decides
        if count > votes.get((b, a), 0) or (count == votes.get((b, a), 0) and a < b):
            after[a].append(b)
            waiting[b] += 1
    ready = [(-far[i], i) for i in seen if waiting[i] == 0]
    heapq.heapify(ready)
    left = {i: (-far[i], i) for i in seen}
    result: list[int] = []
    while left:
        i = heapq.heappop(ready)[1] if ready else min(left.values())[1]
        if i not in left:
            continue
        del left[i]
        result.append(i)
        for j in after[i]:
            waiting[j] -= 1
            if waiting[j] == 0 and j in left:
                heapq.heappush(ready, (-far[j], j))
    return result
