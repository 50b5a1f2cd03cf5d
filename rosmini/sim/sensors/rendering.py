"""A camera: the image and the depths of a world whose objects are upright.

It has no distortion. A point at (X, Y, Z) in its optical frame (X to the right, Y down, Z ahead: REP 103) is seen at

    u = fx X / Z + cx,   v = fy Y / Z + cy,   fx = fy = width / (2 tan(horizontal_fov / 2)),

where whole numbers are the centres of pixels. cx = (width + 1) / 2 and cy = (height + 1) / 2 are the values in the
`sensor_msgs/CameraInfo` of gazebo_ros's camera plugin; here the image is rendered with them too, so the message is
exact.

The camera's position on a robot is in its model; it is turned by `yaw` to the left and then by `pitch` down. A pixel
shows the point at its centre. Light and ground are described in `rosmini.sim.sensors.shading`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import CameraModel

from . import raster, shading
from .raster import GROUND, Eye, Lens
from .scene import Scene

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]
Depths = NDArray[np.float32]
Light = NDArray[np.float32]
"""(3, h, w): planes of red, green and blue, 0 to 1."""
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class CameraInfo:
    """The calibration in a `sensor_msgs/CameraInfo`, row by row as in the message."""

    width: int
    height: int
    K: tuple[float, ...]
    """(9,)"""
    P: tuple[float, ...]
    """(12,)"""
    distortion_model: str = "plumb_bob"
    D: tuple[float, ...] = (0.0,) * 5
    R: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def lens_of(camera: CameraModel) -> Lens:
    """Return the projection of a camera."""
    f = camera.focal_length
    cx, cy = (camera.width + 1) / 2, (camera.height + 1) / 2
    return Lens(camera.width, camera.height, f, f, cx, cy, camera.near, camera.far)


def camera_info(camera: CameraModel, baseline: float = 0.0) -> CameraInfo:
    """Return the contents of a camera's `camera_info`.

    `baseline` [m] is its distance to the right of a first camera (Gazebo's `hackBaseline`).
    """
    lens = lens_of(camera)
    k = (lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0)
    p = (lens.fx, 0.0, lens.cx, -lens.fx * baseline, 0.0, lens.fy, lens.cy, 0.0, 0.0, 0.0, 1.0, 0.0)
    return CameraInfo(camera.width, camera.height, k, p)


def eye_of(camera: CameraModel, pose: Pose) -> Eye:
    """Return the position and orientation of the camera of a robot at `pose`."""
    x, y, theta = pose
    mx, my, mz = camera.mount
    c, s = math.cos(theta), math.sin(theta)
    position = np.array([x + c * mx - s * my, y + s * mx + c * my, mz])
    return Eye(position, axes_of(theta + camera.yaw, camera.pitch), lens_of(camera))


def axes_of(yaw: float, pitch: float) -> Floats:
    """Return right, down and ahead of a camera as rows (3, 3), turned by pitch and yaw [rad] (REP 103)."""
    (cy, sy), (cp, sp) = ((math.cos(a), math.sin(a)) for a in (yaw, pitch))
    ahead = np.array([cy * cp, sy * cp, -sp])
    left = np.array([-sy, cy, 0.0])
    up = np.array([cy * sp, sy * sp, cp])
    return np.array([-left, -up, ahead])


def expose(camera: CameraModel, pose: Pose, scene: Scene) -> tuple[Light, Depths]:
    """Return the light (3, h, w) on a camera's pixels, before noise, for `develop`, and the depths (h, w) [m].

    `pose` is that of the robot that carries the camera. Depths are along the camera's axis (REP 118). They are inf if
    nothing is within reach (REP 117); objects nearer than the camera's `near` are invisible in the image and in the
    depths, as in Gazebo.
    """
    eye = eye_of(camera, pose)
    inverse, shown = look(eye, scene)
    return shading.coloured(eye, scene, inverse, shown), _depths(inverse, eye, camera.depth_far)


def develop(light: Light, noise: Floats | None = None) -> Image:
    """Return the image (h, w, 3) of the light on the pixels, with noise (h, w)."""
    planes = light.copy() if noise is None else light + np.asarray(noise, dtype=np.float32)
    planes *= 255.0
    np.clip(planes, 0.0, 255.0, out=planes)
    planes += 0.5
    return np.ascontiguousarray(planes.astype(np.uint8).transpose(1, 2, 0))


def camera_noise(camera: CameraModel, rng: np.random.Generator, scale: float = 1.0) -> Floats | None:
    """Return the noise (h, w) of one image; None if the camera has no noise."""
    deviation = camera.noise * scale
    if not deviation:
        return None
    drawn = rng.standard_normal((camera.height, camera.width), dtype=np.float32)
    return (drawn * np.float32(deviation)).astype(np.float64)


def look(eye: Eye, scene: Scene) -> tuple[Floats, Ints]:
    """Return for each pixel the inverse depth (h, w) [1/m], 0 for the sky, and the number (h, w) of its object.

    Faces, cylinders and balls are numbered in this order; -1 is the ground or the sky.
    """
    lens, rays = eye.lens, eye.rays()
    inverse = _ground(eye, rays)
    shown = np.full((lens.height, lens.width), GROUND, dtype=np.int64)
    faces, rods, balls = scene.faces, scene.rods, scene.balls
    towards = (scene.normals * (eye.position - faces[:, 0])).sum(axis=1)
    corners = eye.seen(faces.reshape(-1, 3)).reshape(-1, 4, 3)
    plan = raster.plan(corners, (towards > 0) | scene.thin, lens)
    rod_low = np.column_stack([rods[:, 0] - rods[:, 2], rods[:, 1] - rods[:, 2], rods[:, 3]])
    rod_high = np.column_stack([rods[:, 0] + rods[:, 2], rods[:, 1] + rods[:, 2], rods[:, 4]])
    radius = balls[:, 3:]
    rod_boxes = raster.boxes_around(rod_low, rod_high, eye)
    ball_boxes = raster.boxes_around(balls[:, :3] - radius, balls[:, :3] + radius, eye)
    second, third = len(faces), len(faces) + len(rods)
    raster.draw(plan, lens, inverse, shown)
    raster.draw_rods(second, rods, rod_boxes, eye.position, rays, lens, inverse, shown)
    raster.draw_balls(third, balls, ball_boxes, eye.position, rays, lens, inverse, shown)
    return inverse, shown


def _ground(eye: Eye, rays: Floats) -> Floats:
    """Return the inverse depth (h, w) of the ground, 0 where it is not visible."""
    lens, height = eye.lens, float(eye.position[2])
    if height <= 0:
        return np.zeros((lens.height, lens.width))
    a, b, c = (-rays[2] / height).tolist()
    u, v = np.arange(lens.width, dtype=np.float64), np.arange(lens.height, dtype=np.float64)
    inverse: Floats = (a + c * v)[:, None] + b * u
    inverse[(inverse < 1e-9) | (inverse > 1 / lens.near)] = 0.0
    return inverse


def _depths(inverse: Floats, eye: Eye, far: float | None) -> Depths:
    far = eye.lens.far if far is None else min(far, eye.lens.far)
    depths = np.full(inverse.shape, np.inf, dtype=np.float32)
    return np.divide(1.0, inverse, out=depths, where=inverse * far >= 1.0 - 1e-12, casting="same_kind")
