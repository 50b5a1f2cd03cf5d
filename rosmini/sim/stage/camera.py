"""Stage's camera: `image`, `depth` and `camera_info`, as long as somebody listens to one of the first two.

It looks along the heading of its pose, turned to the right by the pan and down by the tilt of its `pantilt`. (Stage 4.3 draws the picture as if the pose had
no heading, and tells the heading on `/tf` all the same; here both are one.) Its pixels need not be square: each field of view is its own.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import compose
from rosmini.msgs import message_class
from rosmini.sim.camera import axes_of, capture
from rosmini.sim.devices import order
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import Headed
from rosmini.sim.raster import Eye, Lens

from .names import Names
from .robots import StageCamera

MILLIMETRES = 1000


class StageCameraDevice(Device):
    """A camera on a robot, published once a step.

    `canonical` depths are 32FC1, in metres, -inf for what is nearer than `range` says and inf for what is farther (REP 118); else they are 16UC1, in
    millimetres, with 0 for both.
    """

    order = order("camera")
    always = False

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
        super().__init__(host, f"{robot}/camera{'' if number is None else f'_{number}'}", rate)
        self.robot = host.engine.robot(robot)
        self.camera = camera
        self.frame = names.frame("camera", number)
        self.canonical = canonical
        self.lens = lens(camera)
        self._image = Headed("sensor_msgs/Image", self.frame)
        self._depth = Headed("sensor_msgs/Image", self.frame)
        self._info = Headed("sensor_msgs/CameraInfo", self.frame)
        self._describe()
        image = message_class("sensor_msgs/Image")
        self._to_image = host.node.publisher(names.topic("image", number), image, queue_size=10)
        self._to_depth = host.node.publisher(names.topic("depth", number), image, queue_size=10)
        info = message_class("sensor_msgs/CameraInfo")
        self._to_info = host.node.publisher(names.topic("camera_info", number), info, queue_size=10)

    def _describe(self) -> None:
        lens = self.lens
        for headed, encoding, size in (
            (self._image, "rgba8", 4),
            (self._depth, "32FC1" if self.canonical else "16UC1", 4 if self.canonical else 2),
        ):
            message: Any = headed.message
            message.height, message.width = lens.height, lens.width
            message.encoding, message.step = encoding, lens.width * size
        info: Any = self._info.message
        info.height, info.width, info.distortion_model = lens.height, lens.width, "plumb_bob"
        info.D = [0.0] * 4
        info.K = [lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0]
        info.R = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
        info.P = [lens.fx, 0.0, lens.cx, 0.0, 0.0, lens.fy, lens.cy, 0.0, 0.0, 0.0, 1.0, 0.0]

    def wanted(self) -> bool:
        """Tell whether anybody looks."""
        return self._to_image.num_connections() > 0 or self._to_depth.num_connections() > 0

    def eye(self) -> Eye:
        """Where it is now, and where it looks."""
        camera = self.camera
        x, y, heading = compose(self.robot.pose, (camera.pose[0], camera.pose[1], camera.pose[3]))
        return Eye(np.array([x, y, camera.elevation]), axes_of(heading - camera.pan, camera.tilt), self.lens)

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Take a picture."""
        image, depths = capture(self.eye(), self.robot.pose, self.host.engine.visible(self.robot.name))
        for headed in (self._image, self._depth, self._info):
            headed.stamp(*stamp)
        if self._to_image.num_connections():
            opaque = np.full((*image.shape[:2], 1), 255, dtype=np.uint8)
            self._image.message.data = np.concatenate([image, opaque], axis=2).tobytes()
            self._to_image.publish(self._image.message)
        if self._to_depth.num_connections():
            self._depth.message.data = self._measured(depths).tobytes()
            self._to_depth.publish(self._depth.message)
        self._to_info.publish(self._info.message)

    def _measured(self, depths: NDArray[np.float32]) -> NDArray[Any]:
        near, far = self.camera.near, self.camera.far
        if self.canonical:
            told = np.where(depths <= near, -np.inf, np.where(depths >= far, np.inf, depths))
            return told.astype("<f4")
        within = (depths > near) & (depths < far)
        return np.where(within, np.minimum(np.where(within, depths, 0) * MILLIMETRES, 65535), 0).astype("<u2")

    def rotation(self) -> tuple[float, float, float, float]:
        """The quaternion of its optical frame (x to the right, y down, z ahead: REP 103), seen from base_link."""
        return optical(self.camera.pose[3] - self.camera.pan, self.camera.tilt)

    def close(self) -> None:
        """End the topics."""
        for publisher in (self._to_image, self._to_depth, self._to_info):
            publisher.unregister()


def lens(camera: StageCamera) -> Lens:
    """How a camera projects: stageros's numbers, the middle of the picture in (width / 2, height / 2)."""
    fx, fy = (
        size / (2 * math.tan(fov / 2))
        for size, fov in zip((camera.width, camera.height), camera.fov, strict=True)
    )
    return Lens(
        camera.width, camera.height, fx, fy, camera.width / 2, camera.height / 2, camera.near, camera.far
    )


def optical(yaw: float, pitch: float) -> tuple[float, float, float, float]:
    """The quaternion x, y, z, w of the optical frame of a camera that is turned to the left by `yaw` and then down by `pitch` [rad].

    >>> [round(part, 3) for part in optical(0.0, 0.0)]
    [-0.5, 0.5, -0.5, 0.5]
    """
    # about z by yaw - 90 degrees, and then about the new x by -90 degrees less the pitch
    half, tilt = (yaw - math.pi / 2) / 2, (-math.pi / 2 - pitch) / 2
    c, s, ct, st = math.cos(half), math.sin(half), math.cos(tilt), math.sin(tilt)
    return (c * st, s * st, s * ct, c * ct)
