"""Which triangles of a mesh are visible, and in which order to paint them, which distances alone cannot tell.

They are rasterised, as on a graphics card (the z-buffer: E. Catmull, "A subdivision algorithm for computer display of
curved surfaces", 1974). What is nearest at no pixel is left out; of two on one pixel the farther is painted first.
"""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.rounding import snap

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def painting_order(corners: Floats, width: int, height: int) -> list[int]:
    """The triangles that one sees, by their places, in the order in which they are painted.

    `corners` (n, 3, 3): the place of each corner in the picture [px], and its distance ahead of the camera [m].
    """
    triangle, pixel, nearness = _rasterise(corners, width, height)
    if not len(triangle):
        return []
    order = np.lexsort((triangle, nearness, pixel))
    triangle, pixel = triangle[order], pixel[order]
    last = np.append(pixel[1:] != pixel[:-1], True)
    seen = np.unique(triangle[last])
    kept = np.isin(triangle, seen)
    triangle, pixel = triangle[kept], pixel[kept]
    shared = (pixel[1:] == pixel[:-1]) & (triangle[1:] != triangle[:-1])
    pairs, count = np.unique(
        np.column_stack([triangle[:-1][shared], triangle[1:][shared]]), axis=0, return_counts=True
    )
    far = snap(corners[:, :, 2].max(axis=1), 1e-6)
    return _sorted(seen.tolist(), pairs.tolist(), count.tolist(), far.tolist())


def _rasterise(corners: Floats, width: int, height: int) -> tuple[Ints, Ints, Floats]:
    """For every pixel whose middle a triangle covers: the triangle, the pixel, and 1 / its distance there."""
    at = snap(corners[:, :, :2], 0.01)
    near = 1 / snap(corners[:, :, 2], 1e-6)
    low = np.maximum(np.ceil(at.min(axis=1) - 0.5), 0).astype(np.int64)
    high = np.minimum(np.floor(at.max(axis=1) - 0.5), [width - 1, height - 1]).astype(np.int64)
    found: list[tuple[Ints, Ints, Floats]] = []
    for i in range(len(corners)):
        (x0, y0), (x1, y1) = low[i], high[i]
        if x0 > x1 or y0 > y1:
            continue
        (ax, ay), (bx, by), (cx, cy) = at[i]
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if area == 0:
            continue
        x, y = np.meshgrid(np.arange(x0, x1 + 1), np.arange(y0, y1 + 1))
        px, py = x.ravel() + 0.5, y.ravel() + 0.5
        u = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area
        v = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area
        w = 1 - u - v
        inside = (u >= 0) & (v >= 0) & (w >= 0)
        depth = u * near[i, 0] + v * near[i, 1] + w * near[i, 2]
        pixels = (y.ravel() * width + x.ravel())[inside]
        found.append((np.full(len(pixels), i), pixels, depth[inside]))
    if not found:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), np.empty(0)
    parts = zip(*found, strict=True)
    triangle, pixel, nearness = (np.concatenate(part) for part in parts)
    return triangle, pixel, nearness


def _sorted(seen: list[int], pairs: list[tuple[int, int]], counts: list[int], far: list[float]) -> list[int]:
    """Every pair's first before its second; what stands in a circle, the farthest first."""
    votes = {(a, b): count for (a, b), count in zip(pairs, counts, strict=True)}
    after: dict[int, list[int]] = {i: [] for i in seen}
    waiting = dict.fromkeys(seen, 0)
    for (a, b), count in votes.items():
        # Where two cut through one another, or touch, what most pixels say counts.
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
