"""A robot's camera: images, depths and points, rendered only while a topic has a subscriber."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.msgs import message_class
from rosmini.sim.engine.robot import Robot
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.models import CameraModel
from rosmini.sim.sensors.rendering import Light, camera_info, camera_noise, develop, expose
from rosmini.sim.sensors.scene import Scene, parts_of
from rosmini.sim.shapes import Part
from rosmini.sim.world import World

from .sensor import Outlet

Image = NDArray[np.uint8]
Depths = NDArray[np.float32]


WARN_PIXEL_RATE = 20e6
"""Rendering load [pixels/s of simulated time] that causes a warning: it takes about two seconds or more."""


class CameraDevice(Device):
    """`sensor_msgs/Image` and `sensor_msgs/CameraInfo` of a camera on a robot.

    A depth camera also publishes depths and points.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        camera: the camera's model and mount.
        image: the topic of the images (rgb8); None: not published.
        info: the topic of the camera's calibration; None: not published.
        depth: the topic of the depths (32FC1, metres, inf beyond reach: REP 117 and 118); None: not published.
        depth_info: the topic of the calibration that belongs to the depths.
        points: the topic of the coloured points (`sensor_msgs/PointCloud2`, x, y, z in the optical frame, rgb); None:
            not published.
        frame: the optical frame, for the header; the camera model's if not given.
        rate: images per second [Hz]; the camera model's if not given.
        noise: scales the noise of the camera's model; 0: no noise.
        baseline: distance to the right of a first camera [m]: Gazebo's `hackBaseline`.
        name: the device's name; robot/ and the camera's name if not given.

    """

    order = 90.0
    always = False

    def __init__(
        self,
        host: Host,
        robot: str,
        camera: CameraModel,
        *,
        image: str | None = "image_raw",
        info: str | None = "camera_info",
        depth: str | None = None,
        depth_info: str | None = None,
        points: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        noise: float = 1.0,
        baseline: float = 0.0,
        name: str | None = None,
    ) -> None:
        super().__init__(host, name or f"{robot}/{camera.name}", rate or camera.rate)
        self.robot: Robot = host.engine.robot(robot)
        self.camera = camera
        self._noise = noise
        self._fixed: tuple[World, Scene] | None = None
        self._moving: tuple[Scene, list[Part], Scene] | None = None
        self._last: tuple[tuple[Pose, Scene], Light, Depths] | None = None
        self._rendered = -2
        """Number of the last image that was rendered."""
        self._warned = False
        frame = frame or camera.frame
        node = host.node

        def outlet(topic: str | None, message: Any, *varying: str) -> Outlet | None:
            return None if topic is None else Outlet(node, topic, message, varying, queue_size=2)

        self._image = outlet(image, image_message(camera, frame, "rgb8", 3), "data")
        self._info = outlet(info, info_message(camera, frame, baseline))
        self._depth = outlet(depth, image_message(camera, frame, "32FC1", 4), "data")
        self._depth_info = outlet(depth_info, info_message(camera, frame, baseline))
        self._points = outlet(points, points_message(camera, frame), "data")

    def outlets(self) -> tuple[Outlet, ...]:
        """Return its topics."""
        every = (self._image, self._info, self._depth, self._depth_info, self._points)
        return tuple(each for each in every if each is not None)

    def wanted(self) -> bool:
        """Return True if any of its topics has a subscriber."""
        return any(outlet.num_connections() for outlet in self.outlets())

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Render and publish to the topics that have subscribers.

        The noise depends on the image's number alone, whether or not earlier images were rendered.
        """
        for info in (self._info, self._depth_info):
            if info is not None and info.num_connections():
                info.publish(stamp)
        if not (has_subscriber(self._image) or has_subscriber(self._depth) or has_subscriber(self._points)):
            return
        if number == self._rendered + 1:  # a recorder wants single images
            self.warn()
        self._rendered = number
        image, depths = self.look(number)
        if self._points is not None and self._points.num_connections():
            self._points.publish(stamp, [cloud(self.camera, image, depths).tobytes()])
        self.publish_pixels(stamp, image, depths)

    def publish_pixels(self, stamp: Stamp, image: NDArray[Any], depths: NDArray[Any]) -> None:
        """Publish an image and depths, each if its topic has a subscriber."""
        for outlet, pixels in ((self._image, image), (self._depth, depths)):
            if outlet is not None and outlet.num_connections():
                outlet.publish(stamp, [pixels.tobytes()])

    def warn(self) -> None:
        """Warn, once, if rendering takes longer than real time."""
        width, height = self.camera.width, self.camera.height
        pixels = width * height * self.rate
        if self._warned or pixels < WARN_PIXEL_RATE:
            return
        self._warned = True
        self.host.node.logwarn(
            f"the camera {self.name}, which has subscribers, renders {width} x {height} pixels {self.rate:g} times "
            f"a second: {pixels / 1e6:.0f} million pixels for each simulated second, while "
            f"{WARN_PIXEL_RATE / 1e6:.0f} million take a computer about two seconds. Give it a smaller width and "
            f"height, a lower rate (for example {WARN_PIXEL_RATE / pixels * self.rate:.2g} Hz), or end unneeded "
            "subscriptions"
        )

    def look(self, number: int = 0) -> tuple[Image, Depths]:
        """Return the RGB image (h, w, 3) and the depths (h, w) [m] seen now, with the noise of image `number`.

        While neither the robot nor anything else moves, only the noise differs from image to image.
        """
        noise = None
        if self.camera.noise and self._noise:
            noise = camera_noise(self.camera, self.host.rng(f"{self.name}/{number}"), self._noise)
        view = (self.robot.pose, self._scene())
        if self._last is None or self._last[0] != view:
            self._last = (view, *expose(self.camera, *view))
        _, light, depths = self._last
        return develop(light, noise), depths

    def _scene(self) -> Scene:
        """Return everything visible now: the same object as before if nothing has changed."""
        engine = self.host.engine
        world = engine.world
        fixed = [obstacle for obstacle in world.obstacles if obstacle.fixed]
        if self._fixed is None or self._fixed[0] is not world:
            walls = Scene.walls(world.walls, world.wall_height, solid=world.solid)
            self._fixed = (world, walls + Scene.of(parts_of(fixed)))
        names = {obstacle.name for obstacle in fixed}
        others = [part for part in engine.visible(self.robot.name) if part.name not in names]
        fixed_scene = self._fixed[1]
        if not others:
            return fixed_scene
        if self._moving is None or self._moving[0] is not fixed_scene or self._moving[1] != others:
            self._moving = (fixed_scene, others, fixed_scene + Scene.of(others))
        return self._moving[2]

    def close(self) -> None:
        """Close the topics."""
        for outlet in self.outlets():
            outlet.close()


def has_subscriber(outlet: Outlet | None) -> bool:
    """Return True if there is such a topic and it has a subscriber."""
    return outlet is not None and outlet.num_connections() > 0


def image_message(camera: CameraModel, frame: str, encoding: str, size: int) -> Any:
    """Return an empty image with pixels of `size` bytes."""
    message = message_class("sensor_msgs/Image")(height=camera.height, width=camera.width)
    message.header.frame_id = frame
    message.encoding, message.step = encoding, size * camera.width
    return message


def info_message(camera: CameraModel, frame: str, baseline: float) -> Any:
    """Return the calibration of a camera without distortion."""
    info = camera_info(camera, baseline)
    message = message_class("sensor_msgs/CameraInfo")(height=info.height, width=info.width)
    message.header.frame_id = frame
    message.distortion_model, message.D = info.distortion_model, info.D
    message.K, message.R, message.P = info.K, info.R, info.P
    return message


POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("rgb", "<u4")])
"""One point of a cloud; its colour as 0x00rrggbb, which other programs read as a float32."""


def points_message(camera: CameraModel, frame: str) -> Any:
    """Return an empty cloud with a point for each pixel."""
    message = message_class("sensor_msgs/PointCloud2")()
    message.header.frame_id = frame
    field = message_class("sensor_msgs/PointField")
    message.fields = [
        field(name=name, offset=4 * i, datatype=field.FLOAT32, count=1) for i, name in enumerate(POINT.names or ())
    ]
    message.height, message.width = camera.height, camera.width
    message.point_step = POINT.itemsize
    message.row_step = POINT.itemsize * camera.width
    return message


def cloud(camera: CameraModel, image: Image, depths: Depths) -> NDArray[Any]:
    """Return the points (h, w) of type `POINT` that the pixels show, in the optical frame.

    A point is nan where nothing is within reach.
    """
    k = camera_info(camera).K
    height, width = depths.shape
    u, v = np.arange(width), np.arange(height)[:, None]
    found = np.empty(depths.shape, dtype=POINT)
    z = np.where(np.isfinite(depths), depths, np.nan)
    found["x"], found["y"], found["z"] = (u - k[2]) / k[0] * z, (v - k[5]) / k[4] * z, z
    red, green, blue = (image[..., i].astype(np.uint32) for i in range(3))
    found["rgb"] = (red << 16) | (green << 8) | blue
    return found
