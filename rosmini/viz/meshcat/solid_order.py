"""In which order things that stand on the ground are painted, so that the nearer ones cover the farther ones.

Of two convex outlines that do not overlap, the one on the camera's side of a line between them is the nearer one, and
one of their sides is such a line (M. Newell, R. Newell and T. Sancha, "A solution to the hidden surface problem",
1972).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.rounding import snap

Floats = NDArray[np.float64]

MANY = 200
"""Above this number of things, only their distances count."""
TOUCH = 1e-4
"""Outlines may overlap by this much [m]."""


Box = tuple[float, float, float, float]
"""From the left to the right and from the top to the bottom: x0, y0, x1, y1 [px]."""


def painting_order(
    outlines: list[Floats],
    eye: Floats,
    spans: list[tuple[float, float]] | None = None,
    boxes: list[Box] | None = None,
) -> list[int]:
    """The indices of convex outlines (n, 2), counter-clockwise, from the farthest to the nearest seen from `eye` (3,).

    `spans` are the lowest and the highest point of each [m]: of two things on the same ground the upper covers the
    lower. `boxes` are the bounding boxes of their pictures: things whose boxes do not meet do not cover one another.
    """
    away = [float(snap(np.linalg.norm(outline.mean(axis=0) - eye[:2]), 1e-6)) for outline in outlines]
    by_distance = sorted(range(len(outlines)), key=lambda i: -away[i])
    if len(outlines) > MANY and boxes is None:
        return by_distance

    def covers(i: int, j: int) -> bool:
        if boxes is not None and not _meet(boxes[i], boxes[j]):
            return False
        return _covers(outlines[i], outlines[j], eye, (spans[i], spans[j]) if spans else None)

    behind = {i: {j for j in by_distance if j != i and covers(i, j)} for i in by_distance}
    order: list[int] = []
    while len(order) < len(outlines):
        left = [i for i in by_distance if i in behind]
        # If some cover one another in a circle, the one that covers fewest goes first.
        first = min(left, key=lambda i: len(behind[i]))
        order.append(first)
        del behind[first]
        for others in behind.values():
            others.discard(first)
    return order


def _meet(a: Box, b: Box) -> bool:
    """Whether two boxes share a place."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _covers(
    near: Floats, far: Floats, eye: Floats, spans: tuple[tuple[float, float], tuple[float, float]] | None
) -> bool:
    """Whether `near` may cover a part of `far`."""
    side = _between(near, far, eye[:2])
    if side is not None:
        return not side
    other = _between(far, near, eye[:2])
    if other is not None:
        return other
    return spans is not None and TOUCH + eye[2] >= spans[0][0] >= spans[1][1] - TOUCH


def _between(own: Floats, other: Floats, eye: Floats) -> bool | None:
    """Whether the eye is with `other` at a side of `own` that has `other` beyond it; None if no side has."""
    along = np.roll(own, -1, axis=0) - own
    outwards = np.column_stack([along[:, 1], -along[:, 0]])
    outwards /= np.hypot(*outwards.T)[:, None] + 1e-12
    gaps = ((other[None, :, :] - own[:, None, :]) * outwards[:, None, :]).sum(axis=2).min(axis=1)
    widest = int(np.argmax(snap(gaps, 1e-6)))
    if gaps[widest] < -TOUCH:
        return None
    return bool(snap((eye - own[widest]) @ outwards[widest], 1e-6) > 0)
