"""What a camera on a robot sees: images, depths and points, rendered only while somebody listens."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.graph import Publisher
from rosmini.msgs import message_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.messages import Headed
from rosmini.sim.models import CameraModel
from rosmini.sim.sensors.camera import camera_info, camera_noise, capture
from rosmini.sim.sensors.scene import Scene, parts_of

from .names import order

if TYPE_CHECKING:
    from rosmini.sim.engine.robot import Robot
    from rosmini.sim.world import World

Image = NDArray[np.uint8]
Depths = NDArray[np.float32]


DEAR = 20e6
"""From so many pixels a second of the world's time on, drawing them is dear: with numba this number takes about a second, with numpy alone two or more."""


class CameraDevice(Device):
    """`sensor_msgs/Image` and `sensor_msgs/CameraInfo` of a camera on a robot; and, if it measures that, depths and points.

    Args:
        host: where it happens.
        robot: the engine's name of the robot.
        camera: which camera, and where it sits.
        image: the topic of the images (rgb8); None: there are none.
        info: the topic of the camera's numbers; None: they are not told.
        depth: the topic of the depths (32FC1, metres, inf beyond reach: REP 117 and 118); None: they are not told.
        depth_info: the topic of the numbers that belong to the depths.
        points: the topic of the coloured points (`sensor_msgs/PointCloud2`, x, y, z in the optical frame, rgb); None: they are not told.
        frame: what the header says: the optical frame; without it what the camera's model says.
        rate: how often; without it as often as the camera's model says [Hz].
        noise: scales the noise of the camera's model; 0: none.
        baseline: how far it sits to the right of a first camera [m]: Gazebo's `hackBaseline`.
        name: the device's; without it robot/ and the camera's name.

    """

    order = order("camera")
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
        self._warned = False
        frame = frame or camera.frame
        self._image = image_message(camera, frame, "rgb8", 3)
        self._depth = image_message(camera, frame, "32FC1", 4)
        self._info = info_message(camera, frame, baseline)
        self._points = points_message(camera, frame)
        node = host.node

        def publisher(topic: str | None, message: Headed) -> Publisher | None:
            return None if topic is None else node.publisher(topic, type(message.message), queue_size=2)

        self._to_image, self._to_info = publisher(image, self._image), publisher(info, self._info)
        self._to_depth, self._to_depth_info = publisher(depth, self._depth), publisher(depth_info, self._info)
        self._to_points = publisher(points, self._points)
        every = (self._to_image, self._to_info, self._to_depth, self._to_depth_info, self._to_points)
        self._publishers = tuple(one for one in every if one is not None)

    def wanted(self) -> bool:
        """Tell whether anybody listens to anything."""
        return any(publisher.num_connections() for publisher in self._publishers)

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Look, and tell those who listen. Each image has noise of its own, whether those before it were wanted or not."""
        for to in (self._to_info, self._to_depth_info):
            if heard(to):
                self._info.stamp(*stamp)
                to.publish(self._info.message)  # type: ignore[union-attr]
        if not (heard(self._to_image) or heard(self._to_depth) or heard(self._to_points)):
            return
        self.warn()
        image, depths = self.look(number)
        for to, told, data in ((self._to_image, self._image, image), (self._to_depth, self._depth, depths)):
            if to is not None and heard(to):
                told.message.data = data.tobytes()
                told.stamp(*stamp)
                to.publish(told.message)
        if self._to_points is not None and heard(self._to_points):
            self._points.message.data = cloud(self.camera, image, depths).tobytes()
            self._points.stamp(*stamp)
            self._to_points.publish(self._points.message)

    def warn(self) -> None:
        """Warn, once, if what is to be drawn costs more time than a second in each second of the world."""
        width, height = self.camera.width, self.camera.height
        pixels = width * height * self.rate
        if self._warned or pixels < DEAR:
            return
        self._warned = True
        self.host.node.logwarn(
            f"the camera {self.name}, whose images somebody hears, draws {width} x {height} pixels {self.rate:g} times a second: {pixels / 1e6:.0f} million pixels for "
            f"each second of the world, where {DEAR / 1e6:.0f} million take a computer about a second (with numba; without it two or more). Give it a smaller "
            f"width and height, a lower rate (for example {DEAR / pixels * self.rate:.2g} Hz), or end the subscriptions that nobody needs"
        )

    def look(self, number: int = 0) -> tuple[Image, Depths]:
        """The image (h, w, 3), red, green and blue, and the depths (h, w) [m] that it sees now, with the noise of image `number`."""
        noise = None
        if self.camera.noise and self._noise:
            noise = camera_noise(self.camera, self.host.rng(f"{self.name}/{number}"), self._noise)
        return capture(self.camera, self.robot.pose, self._scene(), noise=noise)

    def _scene(self) -> Scene:
        """All that there is to see now; what is fixed is kept, as long as the world is the same."""
        engine = self.host.engine
        world = engine.world
        fixed = [obstacle for obstacle in world.obstacles if obstacle.fixed]
        if self._fixed is None or self._fixed[0] is not world:
            walls = Scene.walls(world.walls, world.wall_height, solid=world.solid)
            self._fixed = (world, walls + Scene.of(parts_of(fixed)))
        names = {obstacle.name for obstacle in fixed}
        others = [part for part in engine.visible(self.robot.name) if part.name not in names]
        return self._fixed[1] + Scene.of(others) if others else self._fixed[1]

    def close(self) -> None:
        """End the topics."""
        for publisher in self._publishers:
            publisher.unregister()


def heard(publisher: Publisher | None) -> bool:
    """Tell whether there is such a topic and somebody listens."""
    return publisher is not None and publisher.num_connections() > 0


def image_message(camera: CameraModel, frame: str, encoding: str, size: int) -> Headed:
    """An empty image with pixels of `size` bytes."""
    told = Headed("sensor_msgs/Image", frame)
    message = told.message
    message.height, message.width = camera.height, camera.width
    message.encoding, message.step = encoding, size * camera.width
    return told


def info_message(camera: CameraModel, frame: str, baseline: float) -> Headed:
    """The camera's numbers: no distortion."""
    told = Headed("sensor_msgs/CameraInfo", frame)
    message, info = told.message, camera_info(camera, baseline)
    message.height, message.width = info.height, info.width
    message.distortion_model = "plumb_bob"
    message.D = [0.0] * 5
    message.K, message.P = list(info.K), list(info.P)
    message.R = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    return told


POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("rgb", "<u4")])
"""One point of a cloud; its colour as 0x00rrggbb, which others read as a float32."""


def points_message(camera: CameraModel, frame: str) -> Headed:
    """An empty cloud, a point for each pixel."""
    told = Headed("sensor_msgs/PointCloud2", frame)
    message = told.message
    field = message_class("sensor_msgs/PointField")
    message.fields = [
        field(name=name, offset=4 * i, datatype=field.FLOAT32, count=1)
        for i, name in enumerate(POINT.names or ())
    ]
    message.height, message.width = camera.height, camera.width
    message.point_step = POINT.itemsize
    message.row_step = POINT.itemsize * camera.width
    return told


def cloud(camera: CameraModel, image: Image, depths: Depths) -> NDArray[Any]:
    """The points (h, w) of type `POINT` that the pixels show, in the optical frame; nan where nothing is within reach."""
    k = camera_info(camera).K
    height, width = depths.shape
    u, v = np.arange(width), np.arange(height)[:, None]
    found = np.empty(depths.shape, dtype=POINT)
    z = np.where(np.isfinite(depths), depths, np.nan)
    found["x"], found["y"], found["z"] = (u - k[2]) / k[0] * z, (v - k[5]) / k[4] * z, z
    red, green, blue = (image[..., i].astype(np.uint32) for i in range(3))
    found["rgb"] = (red << 16) | (green << 8) | blue
    return found
