"""IMUs: libgazebo_ros_imu.so, a plugin of a model, and libgazebo_ros_imu_sensor.so, a plugin of a sensor.

The two differ here as they do in Gazebo (gazebo_ros_imu.cpp and gazebo_ros_imu_sensor.cpp of gazebo_plugins 2.9):

- The model's plugin differentiates the velocity of its link: the acceleration at the link's origin, *without
  gravity*: 0 at rest, contrary to REP 145. A link on a fixed joint has become part of another one, so that one's
  origin is used. `<xyzOffset>` is read and never used, and an `<imu>` with noise, as in TurtleBot3's files, is
  not read at all.
- The sensor's plugin publishes the sensor's values: at its own position, in its own axes, *with gravity*, and with the
  noise of its `<imu>`. It also adds `<gaussianNoise>` to the four numbers of the orientation, which is then no
  longer a rotation.

Both report the heading in the world, apply `<gaussianNoise>` to rates and accelerations alike, state its square in all
covariances (0 without noise), and apply `<rpyOffset>` before the orientation.

One difference from Gazebo: its model plugin turns accelerations from the world's axes by the heading instead of back
by it, which gives a wrong direction unless the robot faces along x; here they are in the link's own axes, turned by
`<rpyOffset>`. Another: accelerations are instantaneous, not differences between messages.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from rosmini.core.markup import Element
from rosmini.core.tf import rigid
from rosmini.core.tf.rigid import IDENTITY, Rigid
from rosmini.msgs import service_class
from rosmini.sim.devices.imu import ImuDevice
from rosmini.sim.gazebo.model import Model, Sensor
from rosmini.sim.gazebo.plugin_tags import Tags, tag
from rosmini.sim.gazebo.plugins import ModelPlugin, SensorPlugin
from rosmini.sim.messages import diagonal
from rosmini.sim.models import ImuModel
from rosmini.sim.sdf.document import ORIGIN, Pose6
from rosmini.sim.sdf.parts import number

from .drives import rate_of
from .ros_names import RosNames


@dataclass(frozen=True, kw_only=True)
class ImuTags(Tags):
    """The tags of libgazebo_ros_imu.so."""

    ignored: ClassVar[tuple[str, ...]] = ("imu", "xyzOffset")

    topic: str = tag("topicName", "/default_imu", "where it is published")
    service: str = tag("serviceName", "/default_imu", "a service that calibrates it, which it never needs")
    body: str = tag("bodyName", meaning="the link that it sits on")
    frame: str = tag("frameName", "", "the frame of its messages; without it the link's")
    noise: float = tag("gaussianNoise", 0.0, "standard deviation of rates and accelerations")
    rate: float = tag("updateRate", 0.0, "how often; 0: in each step", unit="Hz")
    rpy: str = tag("rpyOffset", "0 0 0", "how it is turned on the link", unit="rad")


@dataclass(frozen=True, kw_only=True)
class ImuSensorTags(Tags):
    """The tags of libgazebo_ros_imu_sensor.so."""

    ignored: ClassVar[tuple[str, ...]] = ("bodyName", "xyzOffset")

    topic: str = tag("topicName", "imu_data", "where it is published")
    frame: str = tag("frameName", "", "the frame of its messages; without it the link's")
    noise: float = tag("gaussianNoise", 0.0, "standard deviation of rates and accelerations, on top of the sensor's")
    rate: float = tag("updateRateHZ", 1.0, "how often", unit="Hz")
    rpy: str = tag("rpyOffset", "0 0 0", "how the orientation that it tells is turned", unit="rad")
    from_start: bool = tag(
        "initialOrientationAsReference", False, "count the orientation from where it started, against REP 145"
    )


class GazeboImu(ImuDevice):
    """An inertial measurement unit as Gazebo's plugins simulate it.

    Args:
        model: the model that carries it.
        place: its pose relative to the engine's robot.
        unit: its noise; its mount is taken from `place`.
        offset: a rotation that comes before the orientation.
        axes: rotation of the axes of measurement relative to those of its place.
        deviation: the value of `<gaussianNoise>`, whose square is the covariance.
        noisy_orientation: also add noise to the four numbers of the orientation.
        feels_gravity: True if accelerations include gravity.
        from_start: report the orientation relative to the start, not in the world.
        options: those of `ImuDevice`.

    """

    def __init__(
        self,
        model: Model,
        place: Pose6,
        unit: ImuModel,
        *,
        offset: Rigid,
        axes: Rigid = IDENTITY,
        deviation: float,
        noisy_orientation: bool = False,
        feels_gravity: bool,
        from_start: bool = False,
        **options: Any,
    ) -> None:
        world = model.world
        unit = replace(unit, mount=place[:3], gravity=0.0)  # the world's current gravity is added in `sample`
        self._variance = (deviation * world.noise) ** 2
        super().__init__(world.host, model.name, unit, noise=world.noise, **options)
        self._world = world
        self._rng = world.host.rng(f"{self.name}/orientation")
        self._orientation_deviation = deviation * world.noise if noisy_orientation else 0.0
        self._feels_gravity = feels_gravity
        self._place = turned(place[3:])
        self._back = rigid.inverse(rigid.compose(self._place, axes))
        start = rigid.from_yaw(0.0, 0.0, self.robot.start[2]) if from_start else IDENTITY
        reference = rigid.compose(start, self._place) if from_start else IDENTITY
        self._before = rigid.compose(offset, rigid.inverse(reference))

    def describe(self, message: Any) -> None:
        """Fill in the covariances."""
        covariance = diagonal((self._variance,) * 3)
        message.orientation_covariance = covariance
        message.angular_velocity_covariance = covariance
        message.linear_acceleration_covariance = covariance

    def sample(self, number: int) -> tuple[float, ...]:
        """Return the orientation as a quaternion, the angular velocity and the acceleration."""
        *_, gx, gy, gz, ax, ay, az = super().sample(number)
        if self._feels_gravity:
            az -= self._world.physics.gravity[2]
        gyro, accel = (gx, gy, gz), (ax, ay, az)
        if self._back != IDENTITY:
            gyro, accel = (rigid.compose(self._back, rigid.rigid(each))[:3] for each in (gyro, accel))
        heading = rigid.from_yaw(0.0, 0.0, self.robot.pose[2])
        orientation = rigid.compose(rigid.compose(self._before, heading), self._place)[3:]
        if self._orientation_deviation:
            errors = (self._orientation_deviation * self._rng.standard_normal(4)).tolist()
            orientation = tuple(part + error for part, error in zip(orientation, errors, strict=True))
        return (*orientation, *gyro, *accel)


def turned(rpy: Sequence[float]) -> Rigid:
    """Return a rotation by roll, pitch and yaw [rad]."""
    return rigid.from_rpy((0.0, 0.0, 0.0), *rpy)


class ImuModelPlugin(ModelPlugin, filename="libgazebo_ros_imu.so"):
    """Publishes the motion of a link as `sensor_msgs/Imu`, without gravity."""

    needs_robot = True

    def load(self, model: Model, sdf: Element) -> None:
        """Advertise its topic and service. Raises `MarkupError` and `UnknownEntity`."""
        tags = ImuTags.read(sdf, self.world.node.logwarn)
        names = RosNames(model, sdf)
        host, inside = model.frames.get(tags.body, (tags.body, ORIGIN))
        offset = rigid.compose(turned(sdf.floats(tags.rpy, 3, "rpyOffset")), turned(inside[3:]))
        rate = rate_of(tags.rate, self.world.physics.time_step)
        self.device = self.add(
            GazeboImu(
                model,
                model.on_robot(model.link_frame(host)),
                ImuModel((0.0, 0.0, 0.0), rate, tags.noise, tags.noise, tags.frame or tags.body),
                offset=offset,
                axes=offset,
                deviation=tags.noise,
                feels_gravity=False,
                topic=names.topic(tags.topic),
                name=f"{self.name}/imu",
            )
        )
        service = self.world.node.service(names.topic(tags.service), service_class("std_srvs/Empty"), lambda _: {})
        self.at_close(lambda: service.shutdown("the model was deleted"))


class ImuSensorPlugin(SensorPlugin, filename="libgazebo_ros_imu_sensor.so"):
    """Publishes a sensor of type imu as `sensor_msgs/Imu`, with gravity."""

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Advertise its topic. Raises `MarkupError`."""
        tags = ImuSensorTags.read(sdf, self.world.node.logwarn)
        names = RosNames(sensor.model, sdf)
        if tags.from_start:
            self.world.node.logwarn(
                f"{sdf.path}:{sdf.line}: <initialOrientationAsReference> set to true, this behavior is deprecated as "
                "it does not comply with REP 145."
            )
        rate = rate_of(tags.rate, self.world.physics.time_step)
        own = sensor.element.find("imu")
        gyro, accel = (
            (0.0, 0.0) if own is None else _noise(own, kind) for kind in ("angular_velocity/z", "linear_acceleration/x")
        )
        unit = ImuModel(
            (0.0, 0.0, 0.0),
            rate,
            math.hypot(tags.noise, gyro[0]),
            math.hypot(tags.noise, accel[0]),
            tags.frame or sensor.link,
            gyro_bias=gyro[1],
            accel_bias=accel[1],
        )
        self.device = self.add(
            GazeboImu(
                sensor.model,
                sensor.mount,
                unit,
                offset=turned(sdf.floats(tags.rpy, 3, "rpyOffset")),
                deviation=tags.noise,
                noisy_orientation=True,
                feels_gravity=True,
                from_start=tags.from_start,
                topic=names.topic(tags.topic),
                name=sensor.device_name,
            )
        )


def _noise(imu: Element, way: str) -> tuple[float, float]:
    """Return the standard deviation and the mean bias in an `<imu>` for one of its quantities."""
    return number(imu, f"{way}/noise/stddev", 0.0), number(imu, f"{way}/noise/bias_mean", 0.0)
