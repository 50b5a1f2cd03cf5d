"""Cameras and bumpers.

libgazebo_ros_camera.so, libgazebo_ros_openni_kinect.so, libgazebo_ros_depth_camera.so and libgazebo_ros_bumper.so.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from rosmini.core.markup import Element
from rosmini.sim.devices.bumper import Bumper
from rosmini.sim.devices.camera import CameraDevice
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.model import Sensor
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import SensorPlugin
from rosmini.sim.models import CameraModel
from rosmini.sim.sdf.parts import number

from .drives import rate_of
from .ros_names import RosNames

CAMERA_RATE = 30.0
"""Rate of a camera without one in its sensor or plugin [Hz]; Gazebo takes images as fast as it can render."""

LENS = (
    "distortionK1", "distortionK2", "distortionK3", "distortionT1", "distortionT2", "CxPrime", "Cx", "Cy",
    "focalLength", "autoDistortion", "borderCrop", "triggerTopicName", "viewportName",
)  # fmt: skip
"""Tags about lens distortion, which rosmini does not simulate."""


@dataclass(frozen=True, kw_only=True)
class CameraTags(Tags):
    """The tags of libgazebo_ros_camera.so."""

    ignored: ClassVar[tuple[str, ...]] = LENS

    camera: str = tag("cameraName", "", "the namespace of its topics, in that of the robot")
    image: str = tag("imageTopicName", "image_raw", "where the images are published")
    info: str = tag("cameraInfoTopicName", "camera_info", "where the camera's numbers are published")
    frame: str = tag("frameName", "/world", "the optical frame")
    rate: float = tag("updateRate", 0.0, "how often; 0: as the sensor says", unit="Hz")
    baseline: float = tag("hackBaseline", 0.0, "how far it sits to the right of a first camera", unit="m")


class CameraPlugin(SensorPlugin, filename=("libgazebo_ros_camera.so", "libgazebo_ros_camera_utils.so")):
    """Publishes a camera sensor's images and calibration."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Advertise its topics. Raises `MarkupError` if the sensor is not a camera."""
        tags = CameraTags.read(sdf, self.world.node.logwarn)
        names = RosNames(sensor.model, sdf)
        self.open(
            sensor,
            tags,
            names,
            image=_topic(names, tags.camera, tags.image),
            info=_topic(names, tags.camera, tags.info),
        )

    def open(
        self, sensor: Sensor, tags: CameraTags, names: RosNames, *, far: float | None = None, **topics: Any
    ) -> None:
        """Add the device with these topics."""
        rates = [rate for rate in (tags.rate, sensor.sdf.update_rate) if rate > 0]
        self.device = self.add(
            CameraDevice(
                self.world.host,
                sensor.model.name,
                camera_of(sensor, min(rates, default=CAMERA_RATE), far),
                frame=names.frame(tags.frame),
                noise=self.world.noise,
                baseline=tags.baseline,
                name=sensor.device_name,
                **topics,
            )
        )


@dataclass(frozen=True, kw_only=True)
class DepthCameraTags(CameraTags):
    """The tags of libgazebo_ros_openni_kinect.so and libgazebo_ros_depth_camera.so."""

    ignored: ClassVar[tuple[str, ...]] = (*LENS, "baseline", "pointCloudCutoff")

    depth: str = tag("depthImageTopicName", "depth/image_raw", "where the depths are published")
    depth_info: str = tag("depthImageCameraInfoTopicName", "depth/camera_info", "where their numbers are")
    points: str = tag("pointCloudTopicName", "points", "where the points are published")
    farthest: float = tag("pointCloudCutoffMax", 5.0, "the farthest it measures", unit="m")


class DepthCameraPlugin(CameraPlugin, filename=("libgazebo_ros_openni_kinect.so", "libgazebo_ros_depth_camera.so")):
    """Publishes a depth camera's images, depths and points."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Advertise its topics. Raises `MarkupError` if the sensor is not a camera."""
        tags = DepthCameraTags.read(sdf, self.world.node.logwarn)
        names = RosNames(sensor.model, sdf)
        self.open(
            sensor,
            tags,
            names,
            far=tags.farthest,
            image=_topic(names, tags.camera, tags.image),
            info=_topic(names, tags.camera, tags.info),
            depth=_topic(names, tags.camera, tags.depth),
            depth_info=_topic(names, tags.camera, tags.depth_info),
            points=_topic(names, tags.camera, tags.points),
        )


def _topic(names: RosNames, camera: str, topic: str) -> str:
    return names.topic(topic if topic.startswith("/") or not camera else f"{camera.rstrip('/')}/{topic}")


def camera_of(sensor: Sensor, rate: float, far: float | None = None) -> CameraModel:
    """Return the camera that a sensor's `<camera>` describes. Raises `MarkupError` and `GazeboError`."""
    camera = sensor.element.find("camera")
    if camera is None:
        raise sensor.element.error(
            f"the sensor {sensor.name!r} is of type {sensor.type!r} and has no <camera>: it is not a camera"
        )
    x, y, z, roll, pitch, yaw = sensor.mount
    if abs(roll) > 1e-3:
        raise GazeboError(
            f"the camera {sensor.device_name!r} is rolled by {roll:.3f} rad: only upright ones are simulated"
        )
    noise = camera.find("noise")
    return CameraModel(
        name=sensor.name,
        mount=(x, y, z),
        width=int(number(camera, "image/width", 320)),
        height=int(number(camera, "image/height", 240)),
        horizontal_fov=number(camera, "horizontal_fov", 1.047),
        near=number(camera, "clip/near", 0.1),
        far=number(camera, "clip/far", 100.0),
        rate=rate,
        frame=sensor.link,
        noise=number(noise, "stddev", 0.0) if noise is not None else 0.0,
        depth=far is not None,
        pitch=pitch,
        yaw=yaw,
        depth_far=far,
    )


# ---- bumpers ----


@dataclass(frozen=True, kw_only=True)
class BumperTags(Tags):
    """The tags of libgazebo_ros_bumper.so."""

    ignored: ClassVar[tuple[str, ...]] = ("updateRate",)

    topic: str = tag("bumperTopicName", "bumper_states", "where it is published")
    frame: str = tag("frameName", "world", "the frame that places and forces are told in; here it is the world's")


class BumperPlugin(SensorPlugin, filename="libgazebo_ros_bumper.so"):
    """Publishes the contacts of a contact sensor's model as `gazebo_msgs/ContactsState`."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Advertise its topic. Raises `MarkupError` if the sensor is not a contact sensor."""
        tags = BumperTags.read(sdf, self.world.node.logwarn)
        if sensor.type != "contact":
            raise sensor.element.error(
                f"the sensor {sensor.name!r} is of type {sensor.type!r}: libgazebo_ros_bumper.so needs type 'contact'"
            )
        names = RosNames(sensor.model, sdf)
        collision = sensor.element.word("contact/collision", f"{sensor.link}_collision")
        self.device = self.add(
            Bumper(
                self.world.host,
                sensor.model.name,
                topic=names.topic(tags.topic),
                frame=tags.frame.lstrip("/"),
                rate=rate_of(sensor.sdf.update_rate, self.world.physics.time_step),
                collision=f"{sensor.model.name}::{sensor.link}::{collision}",
                height=sensor.mount[2],
                name=sensor.device_name,
            )
        )
