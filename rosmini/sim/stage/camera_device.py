"""Stage's camera: publishes `image`, `depth` and `camera_info` while one of the first two has a subscriber.

It faces the heading of its pose, turned to the right by the pan and down by the tilt of its `pantilt`. (Stage
4.3 draws the picture as if the pose had no heading, but publishes the heading on `/tf`; here both
agree.) Its pixels need not be square, because the two fields of view are independent.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import compose
from rosmini.sim.devices.camera import CameraDevice, has_subscriber, image_message, info_message
from rosmini.sim.devices.sensor import Outlet
from rosmini.sim.host import Host, Stamp
from rosmini.sim.models import CameraModel
from rosmini.sim.sensors.raster import Eye, Lens
from rosmini.sim.sensors.rendering import axes_of, capture

from .robot_names import Names
from .robots import StageCamera

MILLIMETRES = 1000


class StageCameraDevice(CameraDevice):
    """A camera on a robot, published once per step.

    `canonical` depths are 32FC1, in metres, with -inf below the minimum of `range` and inf above the maximum
    (REP 118); otherwise they are 16UC1, in millimetres, with 0 for both.
    """

    def __init__(
        self,
        host: Host,
        robot: str,
        camera: StageCamera,
        names: Names,
        number: int | None,
        *,
        rate: float,
        canonical: bool,
    ) -> None:
        name = "camera" if number is None else f"camera_{number}"
        x, y, _, _ = camera.pose
        self.frame = names.frame("camera", number)
        model = CameraModel(
            name=name,
            mount=(x, y, camera.elevation),
            width=camera.width,
            height=camera.height,
            horizontal_fov=camera.fov[0],
            near=camera.near,
            far=camera.far,
            rate=rate,
            frame=self.frame,
        )
        super().__init__(host, robot, model, image=None, info=None)
        self.stage_camera = camera
        self.canonical = canonical
        self.lens = lens(camera)
        encoding = ("32FC1", 4) if canonical else ("16UC1", 2)

        def outlet(topic: str, message: Any, *varying: str) -> Outlet:
            return Outlet(host.node, names.topic(topic, number), message, varying)

        self._image = outlet("image", image_message(model, self.frame, "rgba8", 4), "data")
        self._depth = outlet("depth", image_message(model, self.frame, *encoding), "data")
        self._info = outlet("camera_info", self._numbers(info_message(model, self.frame, 0.0)))

    def _numbers(self, info: Any) -> Any:
        lens = self.lens
        info.D = [0.0] * 4
        info.K = [lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0]
        info.P = [lens.fx, 0.0, lens.cx, 0.0, 0.0, lens.fy, lens.cy, 0.0, 0.0, 0.0, 1.0, 0.0]
        return info

    def wanted(self) -> bool:
        """Return True if the images or depths have a subscriber; camera_info alone is not published."""
        return has_subscriber(self._image) or has_subscriber(self._depth)

    def eye(self) -> Eye:
        """Return its current position and orientation."""
        camera = self.stage_camera
        x, y, heading = compose(self.robot.pose, (camera.pose[0], camera.pose[1], camera.pose[3]))
        return Eye(np.array([x, y, camera.elevation]), axes_of(heading - camera.pan, camera.tilt), self.lens)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Render and publish an image."""
        self.warn()
        image, depths = capture(self.eye(), self.robot.pose, self._scene())
        opaque = np.full((*image.shape[:2], 1), 255, dtype=np.uint8)
        self.publish_pixels(stamp, np.concatenate([image, opaque], axis=2), self._measured(depths))
        if self._info is not None and self._info.num_connections():
            self._info.publish(stamp)

    def _measured(self, depths: NDArray[np.float32]) -> NDArray[Any]:
        near, far = self.stage_camera.near, self.stage_camera.far
        if self.canonical:
            told = np.where(depths <= near, -np.inf, np.where(depths >= far, np.inf, depths))
            return told.astype("<f4")
        within = (depths > near) & (depths < far)
        return np.where(within, np.minimum(np.where(within, depths, 0) * MILLIMETRES, 65535), 0).astype("<u2")

    def rotation(self) -> tuple[float, float, float, float]:
        """Return the quaternion of its optical frame (x right, y down, z ahead: REP 103) relative to base_link."""
        return optical(self.stage_camera.pose[3] - self.stage_camera.pan, self.stage_camera.tilt)


def lens(camera: StageCamera) -> Lens:
    """Return the projection of a camera: stageros's values, with the image centre at (width / 2, height / 2)."""
    fx, fy = (
        size / (2 * math.tan(fov / 2)) for size, fov in zip((camera.width, camera.height), camera.fov, strict=True)
    )
    return Lens(camera.width, camera.height, fx, fy, camera.width / 2, camera.height / 2, camera.near, camera.far)


def optical(yaw: float, pitch: float) -> tuple[float, float, float, float]:
    """Return the quaternion x, y, z, w of a camera's optical frame, turned left by `yaw`, then down by `pitch` [rad].

    >>> [round(part, 3) for part in optical(0.0, 0.0)]
    [-0.5, 0.5, -0.5, 0.5]
    """
    # rotation about z by yaw - 90 degrees, and then about the new x by -90 degrees less the pitch
    half, tilt = (yaw - math.pi / 2) / 2, (-math.pi / 2 - pitch) / 2
    c, s, ct, st = math.cos(half), math.sin(half), math.cos(tilt), math.sin(tilt)
    return (c * st, s * st, s * ct, c * ct)
