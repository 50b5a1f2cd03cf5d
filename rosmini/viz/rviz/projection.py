"""Projections of the scene to a picture: straight down for maps, from the side, or in perspective.

Without perspective a map stays a parallelogram, which SVG can draw. Orbiting views are shown in perspective, both in a
still picture and in three dimensions; `Perspective` also finds the object under the mouse there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from rosmini.core.geometry.products import matrix_product, norm
from rosmini.viz.rounding import snap

from .camera_images import PinHole
from .primitives import Floats, Mesh, Primitive, Text, Texture
from .rays import HIGH, Ray
from .views import Viewpoint

MARGIN = 0.05
"""Margin around the fitted content, as a share of its size."""
MIN_EXTENT = 1.0
"""Minimum size of the area that a picture shows [m]."""
HORIZON = 1000.0
"""Distance at which a pixel above the horizon is taken to meet the ground [m]."""
NOWHERE = -1e9
"""Position in the picture of points behind the eye [px]."""


@dataclass(frozen=True)
class ParallelProjection:
    """A parallel projection: `axes` (3, 3) are the directions right, up and towards the viewer in the fixed frame."""

    axes: Floats
    middle: Floats
    """The middle of the picture (2,), along right and up [m]."""
    scale: float
    """Pixels per metre."""
    width: float
    height: float

    def pixels(self, points: Floats) -> Floats:
        """Return the positions of points (n, 3) in the picture (n, 2) [px], rounded to a tenth of a pixel."""
        flat = matrix_product(points, self.axes[:2].T) - self.middle
        right, up = flat[:, 0] * self.scale, flat[:, 1] * self.scale
        return snap(np.column_stack([self.width / 2 + right, self.height / 2 - up]), 0.1)

    @property
    def ground(self) -> Floats:
        """The point (3,) of the ground in the middle of the picture."""
        return np.array(self.metres(self.width / 2, self.height / 2))

    def nearness(self, points: Floats) -> Floats:
        """Return the nearness (n,) of points (n, 3) to the viewer [m], rounded to a millimetre."""
        return snap(matrix_product(points, self.axes[2]))

    def scale_at(self, points: Floats) -> float:
        """Return the scale, which is the same everywhere."""
        del points
        return self.scale

    def towards(self, points: Floats) -> Floats:
        """Return the direction (3,), which is the same everywhere."""
        del points
        towards: Floats = self.axes[2]
        return towards

    def metres(self, x: float, y: float) -> tuple[float, float, float]:
        """Return the point of the ground z = 0 that is visible at a pixel, unless the view is level."""
        right, up = (x - self.width / 2) / self.scale, (self.height / 2 - y) / self.scale
        start = self.axes[0] * (self.middle[0] + right) + self.axes[1] * (self.middle[1] + up)
        towards = self.axes[2]
        if abs(towards[2]) < 1e-9:
            return (float(start[0]), float(start[1]), 0.0)
        found = start - towards * start[2] / towards[2]
        return (float(found[0]), float(found[1]), 0.0)

    def ray(self, x: float, y: float) -> Ray:
        """Return the line of sight through a pixel; all of them are parallel."""
        return np.array(self.metres(x, y)) + HIGH * self.axes[2], -self.axes[2]


@dataclass(frozen=True)
class Perspective:
    """The perspective of an eye or a camera."""

    eye: Floats
    axes: Floats
    """Directions (3, 3) right, up and towards the eye, in the fixed frame."""
    distance: float
    """Distance of the object that it looks at [m]."""
    focal: float
    """Focal length [px]."""
    middle: tuple[float, float]
    """Where the eye looks, in the picture [px]."""
    width: float
    height: float
    step: float = 0.0
    """Resolution to which pixels are rounded, for a picture; 0 for no rounding."""

    @classmethod
    def of(cls, viewpoint: Viewpoint, width: float, height: float, step: float = 0.0) -> Perspective:
        """Return the perspective of a view."""
        eye = viewpoint.target + viewpoint.distance * _axes(viewpoint.yaw, viewpoint.pitch)[2]
        away = eye - viewpoint.target
        x, y, z = away
        axes = _axes(math.atan2(y, x), math.atan2(z, math.hypot(x, y)))
        focal = height / 2 / math.tan(math.radians(viewpoint.field_of_view) / 2)
        return cls(eye, axes, norm(away), focal, (width / 2, height / 2), width, height, step)

    @classmethod
    def of_camera(cls, camera: PinHole, pose: Floats, scale: float) -> Perspective:
        """Return the projection of a camera at a pose (4, 4): x to the right, y down, z ahead (REP 103)."""
        eye = pose[:3, 3] + matrix_product(pose[:3, :2], np.array([camera.tx, camera.ty]))
        axes = np.array([pose[:3, 0], -pose[:3, 1], -pose[:3, 2]])
        middle = (camera.cx * scale, camera.cy * scale)
        return cls(eye, axes, 1.0, camera.fx * scale, middle, camera.width * scale, camera.height * scale, 0.1)

    def pixels(self, points: Floats) -> Floats:
        """Return the positions of points (n, 3) in the picture (n, 2) [px]; points behind the eye are far outside."""
        right, up, back = matrix_product(points - self.eye, self.axes.T).T
        away = np.where(back < 0, -back, np.inf)
        seen = np.column_stack([self.middle[0] + self.focal * right / away, self.middle[1] - self.focal * up / away])
        return np.where((back < 0)[:, None], snap(seen, self.step) if self.step else seen, NOWHERE)

    @property
    def scale(self) -> float:
        """Pixels per metre at the target."""
        return self.focal / self.distance

    def scale_at(self, points: Floats) -> float:
        """Return the number of pixels per metre at the mean distance of points (n, 3) in front of the eye."""
        away = -self.nearness(points)
        away = away[away > 0]
        return float(self.focal / away.mean()) if len(away) else self.scale

    def nearness(self, points: Floats) -> Floats:
        """Return the nearness (n,) of points (n, 3) to the eye [m], along its direction; negative in front of it."""
        return snap(matrix_product(points - self.eye, self.axes[2]))

    def towards(self, points: Floats) -> Floats:
        """Return directions (n, 3) from points to the eye."""
        return self.eye - points

    def metres(self, x: float, y: float) -> tuple[float, float, float]:
        """Return the point of the ground z = 0 that is visible at a pixel; above the horizon, a distant one."""
        eye, ahead = self.ray(x, y)
        reach = -eye[2] / ahead[2] if eye[2] * ahead[2] < 0 else math.inf
        flat = math.hypot(ahead[0], ahead[1])
        if reach * flat > HORIZON:
            reach = HORIZON / max(flat, 1e-9)
        return (float(eye[0] + reach * ahead[0]), float(eye[1] + reach * ahead[1]), 0.0)

    def ray(self, x: float, y: float) -> Ray:
        """Return the line of sight through a pixel, from the eye."""
        seen = np.array([x - self.middle[0], self.middle[1] - y, -self.focal])
        ahead = matrix_product(seen, self.axes)
        return self.eye, ahead / norm(ahead)


Projection = ParallelProjection | Perspective
"""The mapping from a scene to a picture of some size."""


def parallel_projection(
    viewpoint: Viewpoint | None, shown: Iterable[Primitive], width: float, height: float | None
) -> ParallelProjection:
    """Return the projection of a view; without a view, or if it has no width, one around everything shown."""
    yaw, pitch = (-math.pi / 2, math.pi / 2) if viewpoint is None else (viewpoint.yaw, viewpoint.pitch)
    axes = _axes(yaw, pitch)
    if viewpoint is not None and viewpoint.width > 0:
        high = 0.62 * width if height is None else height
        return ParallelProjection(
            axes, matrix_product(axes[:2], viewpoint.target), width / viewpoint.width, width, high
        )
    found = [corners(each) for each in shown]
    flat = matrix_product(np.vstack([np.empty((0, 3)), *found]), axes[:2].T)
    if not len(flat):
        flat = np.array([(-MIN_EXTENT, -MIN_EXTENT), (MIN_EXTENT, MIN_EXTENT)])
    low, high_corner = snap(flat.min(axis=0)), snap(flat.max(axis=0))
    size = np.maximum(high_corner - low, MIN_EXTENT) * (1 + 2 * MARGIN)
    tall = float(np.clip(width * size[1] / size[0], 0.4 * width, 0.85 * width)) if height is None else height
    scale = min(width / size[0], tall / size[1])
    return ParallelProjection(axes, (low + high_corner) / 2, float(scale), width, float(np.round(tall)))


def _axes(yaw: float, pitch: float) -> Floats:
    cy, sy, cp, sp = math.cos(yaw), math.sin(yaw), math.cos(pitch), math.sin(pitch)
    return np.array([(-sy, cy, 0.0), (-cy * sp, -sy * sp, cp), (cy * cp, sy * cp, sp)])


def corners(primitive: Primitive) -> Floats:
    """Return points (n, 3) that bound a primitive."""
    if isinstance(primitive, Texture):
        return primitive.corners
    if isinstance(primitive, Text):
        return primitive.position[None]
    points = primitive.placed if isinstance(primitive, Mesh) else primitive.points
    return _box_of(points) if len(points) > 1000 else points


def _box_of(points: Floats) -> Floats:
    """Return the extreme points along x, y, z and the diagonals, which bound it from every side."""
    directions = np.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)], dtype=float)
    found: Floats = points[np.argmax(matrix_product(points, directions.T), axis=0)]
    return found
