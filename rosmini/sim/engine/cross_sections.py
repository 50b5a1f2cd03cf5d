"""Cross-sections of obstacles and robots at one height, for lasers mounted there.

Straight edges are segments (n, 4), round shapes discs (m, 3), as expected by `rosmini.sim.geometry.raycast`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import cos_sin
from rosmini.core.geometry.poses import Pose, compose
from rosmini.core.geometry.products import matrix_product
from rosmini.sim.models import RobotModel
from rosmini.sim.shapes import Part, Simple, Sphere, simple_parts
from rosmini.sim.world import Box, Obstacle, Polygon, edges

if TYPE_CHECKING:
    from .robot import Robot

Floats = NDArray[np.float64]
CrossSection = tuple[Floats, Floats]
"""Segments (n, 4) and discs (m, 3)."""

NOTHING: CrossSection = (np.empty((0, 4)), np.empty((0, 3)))


def cross_section(parts: Iterable[tuple[Simple, Pose]], up: float) -> CrossSection:
    """Return the cross-section of shapes at their poses, `up` [m] above their bottom."""
    segments, discs = [], []
    for shape, pose in parts:
        if isinstance(shape, (Box, Polygon)):
            segments.append(edges(shape.outline) if pose == (0.0, 0.0, 0.0) else edges(_placed(shape, pose)))
        else:
            radius = shape.cut(up) if isinstance(shape, Sphere) else shape.radius
            if radius > 0:
                discs.append((pose[0], pose[1], radius))
    return np.vstack([NOTHING[0], *segments]), np.array(discs, dtype=float).reshape(-1, 3)


def _placed(shape: Box | Polygon, pose: Pose) -> Floats:
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    turned = matrix_product(shape.outline, [[c, s], [-s, c]])
    turned += (x, y)
    return turned


def obstacle_section(obstacle: Obstacle, height: float, pose: Pose | None = None) -> CrossSection:
    """Return the cross-section of an obstacle at `height` [m] above the ground, at `pose` or its own pose.

    It is empty for an obstacle that lasers cannot see.
    """
    if not obstacle.seen_by_lasers or not obstacle.bottom <= height <= obstacle.height:
        return NOTHING
    return cross_section(
        simple_parts(obstacle.shape, obstacle.pose if pose is None else pose), height - obstacle.bottom
    )


def robot_section(model: RobotModel, height: float) -> CrossSection:
    """Return the cross-section of a robot at `height` [m] above the ground, in its own frame."""
    found = [
        cross_section(simple_parts(part.shape, part.pose), height - part.bottom)
        for part in model.solid
        if part.bottom <= height <= part.top
    ]
    return stack(found)


def stack(cuts: Sequence[CrossSection]) -> CrossSection:
    """Concatenate several cross-sections."""
    if len(cuts) == 1:
        return cuts[0]
    return (
        np.vstack([NOTHING[0], *(segments for segments, _ in cuts if len(segments))]),
        np.vstack([NOTHING[1], *(discs for _, discs in cuts if len(discs))]),
    )


def at_each_pose(template: CrossSection, poses: Floats) -> CrossSection:
    """Return a cross-section at each of the poses (k, 3): segments (k * n, 4) and discs (k * m, 3), pose by pose."""
    x, y = poses[:, :1], poses[:, 1:2]
    c, s = (each[:, None] for each in cos_sin(poses[:, 2]))
    (segments, discs), count = template, len(poses)
    sides, circles = np.empty((count, len(segments), 4)), np.empty((count, len(discs), 3))
    for table, source, columns in ((sides, segments, (0, 2)), (circles, discs, (0,))):
        for i in columns:
            table[:, :, i] = x + c * source[:, i] - s * source[:, i + 1]
            table[:, :, i + 1] = y + s * source[:, i] + c * source[:, i + 1]
    circles[:, :, 2] = discs[:, 2]
    return sides.reshape(-1, 4), circles.reshape(-1, 3)


def obstacle_part(obstacle: Obstacle, pose: Pose | None = None) -> Part:
    """Return the `Part` of the world for an obstacle, at `pose` or its own pose."""
    where = obstacle.pose if pose is None else pose
    return Part(obstacle.shape, where, obstacle.bottom, obstacle.height, obstacle.colour, obstacle.name)


def robot_parts(robot: Robot) -> list[Part]:
    """Return the parts of a robot at its current pose."""
    height = robot.model.height
    return [
        replace(
            part,
            pose=compose(robot.pose, part.pose),
            top=part.top if math.isfinite(part.top) else height,
            name=robot.name,
        )
        for part in robot.model.solid
    ]
