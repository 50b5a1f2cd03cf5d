"""Lasers: libgazebo_ros_laser.so, libgazebo_ros_gpu_laser.so and libgazebo_ros_ray_sensor.so."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from rosmini.core.markup import Element
from rosmini.sim.devices.laser import Laser
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.model import Sensor
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import SensorPlugin
from rosmini.sim.models import LidarModel
from rosmini.sim.sdf.parts import number
from rosmini.sim.sdf.poses import matrix, upright

from .drives import rate_of
from .ros_names import RosNames

LEVEL = 1e-3
"""A laser tilted by no more than this counts as level [rad]."""

STEEP = 0.1
"""A laser tilted by no more than this is simulated as a level one [rad]."""


@dataclass(frozen=True, kw_only=True)
class LaserTags(Tags):
    """The tags of libgazebo_ros_laser.so."""

    ignored: ClassVar[tuple[str, ...]] = ("gaussianNoise", "hokuyoMinIntensity", "updateRate")

    topic: str = tag("topicName", "/world", "where the scans are published")
    frame: str = tag("frameName", "/world", "the frame of their messages")


class LaserPlugin(
    SensorPlugin, filename=("libgazebo_ros_laser.so", "libgazebo_ros_gpu_laser.so", "libgazebo_ros_ray_sensor.so")
):
    """Publishes a ray sensor's scans as `sensor_msgs/LaserScan`."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Advertise its topic. Raises `MarkupError` if the sensor is not a ray sensor."""
        tags = LaserTags.read(sdf, self.world.node.logwarn)
        lidar = lidar_of(sensor)
        tilt = tilt_of(sensor)
        if tilt > LEVEL:
            what = f"the laser {sensor.device_name!r} is tilted by {math.degrees(tilt):.1f} degrees"
            self.world.node.logwarn(f"{what}: it measures in a level plane here")
        names = RosNames(sensor.model, sdf)
        self.device = self.add(
            Laser(
                self.world.host,
                sensor.model.name,
                lidar,
                topic=names.topic(tags.topic),
                frame=names.frame(tags.frame),
                noise=self.world.noise,
                name=sensor.device_name,
            )
        )


def tilt_of(sensor: Sensor) -> float:
    """Return the angle between the plane of a laser and the ground [rad], whichever side is up."""
    return math.acos(min(1.0, abs(float(matrix(sensor.mount)[2, 2]))))


def lidar_of(sensor: Sensor) -> LidarModel:
    """Return the laser that a sensor's `<ray>` describes, with its noise.

    An upside-down laser scans in the opposite direction. Raises `MarkupError`, and `GazeboError` for one that is tilted
    too much for a flat world.
    """
    ray = sensor.element.find("ray") or sensor.element.find("lidar")
    if ray is None:
        raise sensor.element.error(
            f"the sensor {sensor.name!r} is of type {sensor.type!r} and has no <ray>: it is not a laser"
        )
    mount, tilt = sensor.mount, tilt_of(sensor)
    if tilt > STEEP:
        raise GazeboError(
            f"the laser {sensor.device_name!r} is tilted by {math.degrees(tilt):.0f} degrees, and more than "
            f"{math.degrees(STEEP):.0f} are not simulated"
        )
    turn = matrix(mount)
    hangs = bool(turn[2, 2] < 0)
    yaw = mount[5] if upright(mount, LEVEL) else math.atan2(turn[1, 0], turn[0, 0])
    horizontal = ray.need("scan").need("horizontal")
    samples = int(number(horizontal, "samples", 640)) * max(1, int(number(horizontal, "resolution", 1)))
    vertical = int(number(ray, "scan/vertical/samples", 1))
    if vertical > 1:
        raise horizontal.error(f"a laser of {vertical} layers is not simulated; <vertical> has one sample here")
    first, last = number(horizontal, "min_angle", 0.0), number(horizontal, "max_angle", 0.0)
    if samples == 1:  # a single ray looks ahead whatever the angles are, as in Gazebo
        first = last = 0.0
    noise = ray.find("noise")
    if hangs:
        first, last = -first, -last
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
        yaw=yaw,
        upside_down=hangs,
    )
