"""What measures: libgazebo_ros_laser.so and libgazebo_ros_gpu_laser.so, libgazebo_ros_imu.so and libgazebo_ros_imu_sensor.so."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from rosmini.markup import Element
from rosmini.msgs import service_class
from rosmini.sim.devices import ImuDevice, Laser
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.model import Model, Sensor
from rosmini.sim.gazebo.plugins import ModelPlugin, SensorPlugin
from rosmini.sim.gazebo.tags import Tags, tag
from rosmini.sim.models import ImuModel, LidarModel
from rosmini.sim.sdf import ORIGIN, Pose6
from rosmini.sim.sdf.poses import compose, upright

from .drives import rate_of
from .names import RosNames


def number(element: Element, way: str, default: float) -> float:
    """A number on a way down, or the default. Raises `MarkupError`."""
    found = element.find(way)
    return default if found is None or not found.text else found.floats(found.text, 1)[0]


# ---- lasers ----


@dataclass(frozen=True, kw_only=True)
class LaserTags(Tags):
    """The tags of libgazebo_ros_laser.so."""

    ignored: ClassVar[tuple[str, ...]] = ("gaussianNoise", "hokuyoMinIntensity", "updateRate")

    topic: str = tag("topicName", "/world", "where the scans are published")
    frame: str = tag("frameName", "/world", "the frame that they are told in")


class LaserPlugin(
    SensorPlugin,
    filename=("libgazebo_ros_laser.so", "libgazebo_ros_gpu_laser.so", "libgazebo_ros_ray_sensor.so"),
):
    """Publishes a ray sensor's scans as `sensor_msgs/LaserScan`."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Open its topic. Raises `MarkupError` for what is no ray sensor."""
        tags = LaserTags.read(sdf, self.world.node.logwarn)
        names = RosNames(sensor.model, sdf)
        self.device = self.add(
            Laser(
                self.world.host,
                sensor.model.name,
                lidar_of(sensor),
                topic=names.topic(tags.topic),
                frame=names.frame(tags.frame),
                noise=self.world.noise,
                name=sensor.device_name,
            )
        )


def lidar_of(sensor: Sensor) -> LidarModel:
    """The laser that a sensor's `<ray>` describes, beams, range, noise and all. Raises `MarkupError` and `GazeboError`."""
    ray = sensor.element.find("ray") or sensor.element.find("lidar")
    if ray is None:
        raise sensor.element.error(
            f"the sensor {sensor.name!r} is of type {sensor.type!r} and has no <ray>: it is no laser"
        )
    mount = sensor.mount
    if not upright(mount, 1e-3):
        raise GazeboError(
            f"the laser {sensor.device_name!r} is tilted (roll {mount[3]:.3f}, pitch {mount[4]:.3f}): only level ones are simulated"
        )
    horizontal = ray.need("scan").need("horizontal")
    samples = int(number(horizontal, "samples", 640)) * max(1, int(number(horizontal, "resolution", 1)))
    vertical = int(number(ray, "scan/vertical/samples", 1))
    if vertical > 1:
        raise horizontal.error(
            f"a laser of {vertical} layers is not simulated; <vertical> has one sample here"
        )
    first, last = number(horizontal, "min_angle", 0.0), number(horizontal, "max_angle", 0.0)
    noise = ray.find("noise")
    gaussian = noise is not None and noise.word("type", "gaussian").startswith("gaussian")
    return LidarModel(
        name=sensor.name,
        mount=mount[:3],
        beams=samples,
        rate=rate_of(sensor.sdf.update_rate, sensor.model.world.physics.time_step),
        range_min=number(ray, "range/min", 0.0),
        range_max=number(ray, "range/max", math.inf),
        noise=number(ray, "noise/stddev", 0.0) if gaussian else 0.0,
        frame=sensor.link,
        angle_min=first,
        angle_max=last,
        yaw=mount[5],
    )


# ---- inertial measurement units ----


@dataclass(frozen=True, kw_only=True)
class ImuTags(Tags):
    """The tags of libgazebo_ros_imu.so."""

    ignored: ClassVar[tuple[str, ...]] = ("imu",)

    topic: str = tag("topicName", "/default_imu", "where it is published")
    service: str = tag("serviceName", "/default_imu", "a service that calibrates it, which it never needs")
    body: str = tag("bodyName", meaning="the link that it sits on")
    frame: str = tag("frameName", "", "the frame that it is told in; without it the link's")
    noise: float = tag("gaussianNoise", 0.0, "standard deviation of all it measures")
    rate: float = tag("updateRate", 0.0, "how often; 0: in each step", unit="Hz")
    xyz: str = tag("xyzOffset", "0 0 0", "where it sits on the link", unit="m")
    rpy: str = tag("rpyOffset", "0 0 0", "how it is turned there", unit="rad")


class WorldImu(ImuDevice):
    """A unit whose heading is the world's, as Gazebo's plugin tells it, and not one that counts from where it started."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._heading = 0.0

    def reset(self) -> None:
        """The world's heading stays as it is."""


class ImuModelPlugin(ModelPlugin, filename="libgazebo_ros_imu.so"):
    """Publishes how a link moves as `sensor_msgs/Imu`.

    Gazebo's own plugin knows one noise for all; here the `<imu><noise>` that TurtleBot3's files have in the same tag counts, if it is there.
    """

    needs_robot = True

    def load(self, model: Model, sdf: Element) -> None:
        """Open its topic and its service. Raises `MarkupError` and `UnknownEntity`."""
        tags = ImuTags.read(sdf, self.world.node.logwarn)
        names = RosNames(model, sdf)
        x, y, z = sdf.floats(tags.xyz, 3, "xyzOffset")
        roll, pitch, yaw = sdf.floats(tags.rpy, 3, "rpyOffset")
        mount = compose(_on_axle(model, model.link_frame(tags.body)), (x, y, z, roll, pitch, yaw))
        frame = tags.frame or tags.body
        rate = rate_of(tags.rate, self.world.physics.time_step)
        unit = ImuModel(mount[:3], rate, tags.noise, tags.noise, frame)
        own = sdf.find("imu/noise")
        if own is not None:
            unit = _noisy(unit, own, "rate", "accel")
        self.device = self.add(
            WorldImu(
                self.world.host,
                model.name,
                unit,
                topic=names.topic(tags.topic),
                noise=self.world.noise,
                name=f"{self.name}/imu",
            )
        )
        service = self.world.node.service(
            names.topic(tags.service), service_class("std_srvs/Empty"), lambda _: {}
        )
        self.at_close(lambda: service.shutdown("the model was deleted"))


@dataclass(frozen=True, kw_only=True)
class ImuSensorTags(Tags):
    """The tags of libgazebo_ros_imu_sensor.so."""

    ignored: ClassVar[tuple[str, ...]] = ("bodyName", "xyzOffset", "rpyOffset")

    topic: str = tag("topicName", "imu_data", "where it is published")
    frame: str = tag("frameName", "", "the frame that it is told in; without it the link's")
    noise: float = tag("gaussianNoise", 0.0, "standard deviation of all it measures")
    rate: float = tag("updateRateHZ", 1.0, "how often", unit="Hz")
    from_start: bool = tag("initialOrientationAsReference", True, "count the heading from where it started")


class ImuSensorPlugin(SensorPlugin, filename="libgazebo_ros_imu_sensor.so"):
    """Publishes a sensor of type imu as `sensor_msgs/Imu`."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Open its topic."""
        tags = ImuSensorTags.read(sdf, self.world.node.logwarn)
        names = RosNames(sensor.model, sdf)
        rate = rate_of(tags.rate, self.world.physics.time_step)
        unit = ImuModel(sensor.mount[:3], rate, tags.noise, tags.noise, tags.frame or sensor.link)
        own = sensor.element.find("imu")
        if own is not None:
            unit = _noisy(unit, own, "angular_velocity/z/noise", "linear_acceleration/x/noise")
        kind = ImuDevice if tags.from_start else WorldImu
        self.device = self.add(
            kind(
                self.world.host,
                sensor.model.name,
                unit,
                topic=names.topic(tags.topic),
                noise=self.world.noise,
                name=sensor.device_name,
            )
        )


def _noisy(unit: ImuModel, noise: Element, gyro: str, accel: str) -> ImuModel:
    """The unit with the noise that an element describes."""
    return replace(
        unit,
        gyro_noise=number(noise, f"{gyro}/stddev", unit.gyro_noise),
        accel_noise=number(noise, f"{accel}/stddev", unit.accel_noise),
        gyro_bias=number(noise, f"{gyro}/bias_mean", 0.0),
        accel_bias=number(noise, f"{accel}/bias_mean", 0.0),
    )


def _on_axle(model: Model, pose: Pose6) -> Pose6:
    """A pose in the model, seen from the robot of the engine."""
    if model.body is None or model.body.axle == (0.0, 0.0, 0.0):
        return pose
    from rosmini.geometry.poses import inverse

    x, y, yaw = inverse(model.body.axle)
    return compose((x, y, 0.0, 0.0, 0.0, yaw), pose) if pose != ORIGIN else (x, y, 0.0, 0.0, 0.0, yaw)
