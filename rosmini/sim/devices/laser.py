"""Lasers: `sensor_msgs/LaserScan`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry import raycast
from rosmini.core.geometry.poses import Pose
from rosmini.sim.host import Host, Stamp
from rosmini.sim.models import LidarModel
from rosmini.sim.sensors.lidar import unmeasured

from .sensor import Sensor

Floats = NDArray[np.float64]


class RangeDevice(Sensor):
    """What publishes the scans of a laser, whichever simulator's it is.

    Derive from it: `sample` returns ranges and intensities.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        lidar: which laser, and where it sits.
        topic: where it is published.
        frame: the frame of the header; the one of the laser's model if not given.
        rate: how often [Hz]; as the laser's model says if not given.
        name: the device's; robot/lidar if not given.

    """

    message_type = "sensor_msgs/LaserScan"
    default_topic, label = "scan", "lidar"
    order = 50.0
    always = True
    varying = ("ranges", "intensities")
    queue_size = 5
    kept = ("_rng", "pose", "ranges", "poses", "_last")

    def __init__(
        self,
        host: Host,
        robot: str,
        lidar: LidarModel,
        *,
        topic: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        name: str | None = None,
    ) -> None:
        self.lidar = lidar
        self._scan_time = 1 / (rate or lidar.rate)
        super().__init__(
            host, robot, topic=topic, frame=frame or lidar.frame, rate=rate or lidar.rate, name=name
        )
        self.pose: Pose = self.robot.pose
        """Where the robot was when it measured last."""
        self.ranges: Floats | None = None
        """What it measured last, as it was published; None before the first time."""
        self.poses: Floats | None = None
        """Where it was at each beam of that (beams, 3), if the laser sweeps; else None."""
        self._rng = host.rng(self.name)
        self._last: tuple[Any, ...] = ()
        self.topic: str = self.outlet.publisher.topic
        """Where it is published, as a global name."""

    def describe(self, message: Any) -> None:
        """Fill in the numbers of the laser."""
        lidar = self.lidar
        message.angle_min, message.angle_max, message.angle_increment = lidar.message_angles
        message.scan_time = self._scan_time
        message.range_min, message.range_max = lidar.range_min, lidar.range_max

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Measure, note what was measured, and publish it if anybody listens."""
        found = self.sample(number)
        if found is not None:
            ranges, intensities = found
            self.ranges = ranges
            self._last = (*stamp, ranges.astype(np.float32), intensities)
            if self.outlet.heard():
                self.outlet.publisher.publish_frozen(self.outlet.make(*self._last))

    @property
    def seen_from(self) -> Floats:
        """Where the robot was at each beam of the last scan (beams, 3); (1, 3) if all were measured at once."""
        return np.array([self.pose]) if self.poses is None else self.poses

    @property
    def message(self) -> Any:
        """A copy of the last message, whether anybody heard it or not; None before the first."""
        return self.outlet.make(*self._last) if self._last else None


class Laser(RangeDevice):
    """A laser on a robot.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        lidar: which laser, and where it sits; the one of the robot's model if not given.
        topic: where it is published.
        frame: the frame of the header; the one of the laser's model if not given.
        rate: how often [Hz]; as the laser's model says if not given.
        noise: scales the noise of the laser's model; 0: none.
        rep_117: publish inf for what is too far and -inf for what is too near; else 0.0, as a real LDS-01 does.
        measures: measure even if nobody listens, so that `ranges` is up to date.
        sweep: measure one beam after the other, as a laser that spins does, each from where the robot is then; see
            `rosmini.sim.sensors.lidar`.
        name: the device's; robot/lidar if not given.

    """

    def __init__(
        self,
        host: Host,
        robot: str,
        lidar: LidarModel | None = None,
        *,
        topic: str | None = None,
        frame: str | None = None,
        rate: float | None = None,
        noise: float = 1.0,
        rep_117: bool = True,
        measures: bool = False,
        sweep: bool = False,
        name: str | None = None,
    ) -> None:
        if lidar is None:
            lidar = host.engine.robot(robot).model.laser
        self._beam_time = lidar.beam_time / ((rate or lidar.rate) / lidar.rate) if sweep else 0.0
        super().__init__(host, robot, lidar, topic=topic, frame=frame, rate=rate, name=name)
        self.measures = measures
        self._deviation = lidar.noise * noise
        self._rep_117 = rep_117
        if sweep:
            host.engine.trails.remember(1.01 * self._beam_time * lidar.beams)
        if not host.node.graph.simulated:
            raycast.expect(lidar.beams * (rate or lidar.rate))

    def describe(self, message: Any) -> None:
        """Fill in the numbers of the laser."""
        super().describe(message)
        # the stamp of a sweep is the time of the first beam in the message, which is measured last
        message.time_increment = 0.0 - self._beam_time

    def sample(self, _: int) -> tuple[Floats, tuple[()]] | None:
        """Return the ranges. Noise is drawn even if nobody listens, so that it does not depend on who does."""
        noise = None
        if self._deviation:
            noise = self._rng.standard_normal(self.lidar.beams) * self._deviation
        if not (self.measures or self.outlet.heard()):
            return None
        engine, name = self.host.engine, self.robot.name
        if self._beam_time:
            ranges, self.poses = engine.sweep(name, self._beam_time, noise, self.lidar)
        else:
            ranges = engine.scan(name, noise, self.lidar)
        self.pose = self.robot.pose
        return ranges if self._rep_117 else unmeasured(ranges), ()
