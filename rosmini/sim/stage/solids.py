"""Conversion of bodies in a Stage file to rosmini's shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import area, inside, sides_of
from rosmini.core.geometry.poses import Pose, compose, inverse, transform_points
from rosmini.sim.shapes import Box, Polygon, Shape

from .blocks import MAX_OUTLINES, TOO_MANY, Block
from .errors import StageError
from .things import Pose4, Thing


def filled(thing: Thing) -> tuple[tuple[Block, ...], int]:
    """Return a body's outer blocks, whose hollow parts are filled, and the number of these. Raises `StageError`."""
    if thing.body is None or not thing.body.traced:
        return (() if thing.body is None else thing.body.blocks), 0
    if len(thing.body.blocks) > MAX_OUTLINES:
        raise StageError(thing.place, TOO_MANY, TOO_MANY)
    outer = [each for each in thing.body.blocks if area(each.outline) > 0]
    firsts = np.array([each.outline[0] for each in outer])
    alone = np.ones(len(outer), dtype=bool)
    for i, other in enumerate(outer):
        low, high = other.outline.min(axis=0), other.outline.max(axis=0)
        near = np.flatnonzero(alone & ((low <= firsts) & (firsts <= high)).all(axis=1))
        near = near[near != i]
        if len(near):
            alone[near] = ~inside(firsts[near], sides_of(other.outline))
    holes = len(thing.body.blocks) - len(outer)
    return tuple(each for each, is_alone in zip(outer, alone, strict=True) if is_alone), holes


@dataclass(frozen=True)
class Solid:
    """A block at its pose in the world."""

    shape: Shape
    pose: Pose
    bottom: float
    """Heights above the ground at which it begins and ends [m]."""
    top: float

    def seen_from(self, pose: Pose) -> tuple[Shape, Pose]:
        """Return the shape, and its pose relative to `pose`."""
        return self.shape, compose(inverse(pose), self.pose)


def placed(thing: Thing, block: Block) -> NDArray[np.float64]:
    """Return the outline of a block (n, 2) in the world's frame."""
    return np.asarray(transform_points(_flat(thing.at), transform_points(_flat(thing.origin), block.outline)))


def solid(thing: Thing, block: Block) -> Solid:
    """Return a block of a model in the world's frame; a rectangular one becomes a box."""
    ground = thing.at[2] + thing.origin[2]
    bottom, top = _rounded(ground + block.bottom), _rounded(ground + block.top)
    corners, origin = block.outline, _flat(thing.origin)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    half = np.abs(corners - middle)
    if len(corners) == 4 and np.allclose(half, half[0], rtol=0, atol=1e-9) and half[0].all():
        length, width = (2 * half[0]).tolist()
        x, y, heading = compose(_flat(thing.at), compose(origin, (float(middle[0]), float(middle[1]), 0.0)))
        return Solid(Box(_rounded(length), _rounded(width)), (_rounded(x), _rounded(y), heading), bottom, top)
    inner = np.asarray(transform_points(origin, corners)).tolist()
    return Solid(Polygon(tuple((_rounded(x), _rounded(y)) for x, y in inner)), _flat(thing.at), bottom, top)


def _flat(pose: Pose4) -> Pose:
    return (pose[0], pose[1], pose[3])


def _rounded(value: float) -> float:
    """Round a length [m] to remove the errors of stretching."""
    return round(value, 9) + 0.0
