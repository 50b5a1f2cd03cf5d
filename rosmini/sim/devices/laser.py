"""Lasers: `sensor_msgs/LaserScan`."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.geometry import raycast
from rosmini.sim.host import Host, Stamp
from rosmini.sim.models import LidarModel
from rosmini.sim.sensors.lidar import unmeasured

from .sensor import Sensor

Floats = NDArray[np.float64]


class RangeDevice(Sensor):
    """Publishes the scans of a laser, for any of the simulators.

    Derive from it: `sample` returns ranges and intensities.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        lidar: the laser's model and mount.
        topic: where it is published.
        frame: the frame of the header; the laser model's if not given.
        rate: scans per second [Hz]; the laser model's if not given.
        name: the device's name; robot/lidar if not given.

    """

    message_type = "sensor_msgs/LaserScan"
    default_topic, label = "scan", "lidar"
    order = 50.0
    always = True
    varying = ("ranges", "intensities")
    queue_size = 5
    saved = ("_rng", "pose", "ranges", "poses", "_last")

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
        super().__init__(host, robot, topic=topic, frame=frame or lidar.frame, rate=rate or lidar.rate, name=name)
        self.pose: Pose = self.robot.pose
        """The robot's pose at the last scan."""
        self.ranges: Floats | None = None
        """The last ranges, as published; None before the first scan."""
        self.poses: Floats | None = None
        """The robot's pose at each beam of the last scan (beams, 3) if the laser sweeps; otherwise None."""
        self._rng = host.rng(self.name)
        self._last: tuple[Any, ...] = ()
        self.topic: str = self.outlet.publisher.topic
        """The topic of the scans, as a global name."""

    def describe(self, message: Any) -> None:
        """Fill in the laser's constants."""
        lidar = self.lidar
        message.angle_min, message.angle_max, message.angle_increment = lidar.message_angles
        message.scan_time = self._scan_time
        message.range_min, message.range_max = lidar.range_min, lidar.range_max

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Measure, keep the scan, and publish it if the topic has a subscriber."""
        found = self.sample(number)
        if found is not None:
            ranges, intensities = found
            self.ranges = ranges
            self._last = (*stamp, ranges.astype(np.float32), intensities)
            if self.outlet.num_connections():
                self.outlet.publish(self._last[:2], self._last[2:])

    @property
    def seen_from(self) -> Floats:
        """The robot's pose at each beam of the last scan (beams, 3); (1, 3) if all were measured at once."""
        return np.array([self.pose]) if self.poses is None else self.poses

    @property
    def message(self) -> Any:
        """A copy of the last message, whether or not it was published; None before the first."""
        return self.outlet.make(*self._last) if self._last else None


class Laser(RangeDevice):
    """A laser on a robot.

    Args:
        host: the simulated world.
        robot: the engine's name of the robot.
        lidar: the laser's model and mount; the robot model's if not given.
        topic: where it is published.
        frame: the frame of the header; the laser model's if not given.
        rate: scans per second [Hz]; the laser model's if not given.
        noise: scales the noise of the laser's model; 0: no noise.
        rep_117: publish inf for ranges that are too far and -inf for too near; otherwise 0.0, as a real LDS-01 does.
        measures: measure even without subscribers, so that `ranges` is up to date.
        sweep: measure one beam after another, as a spinning laser does, each from the robot's pose at its time; see
            `rosmini.sim.sensors.lidar`.
        name: the device's name; robot/lidar if not given.

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
        graph, expect = host.node.graph, partial(raycast.expect, lidar.beams * (rate or lidar.rate))
        if graph.runs_in_real_time:
            expect()
        else:
            graph.before_live(expect)

    def describe(self, message: Any) -> None:
        """Fill in the laser's constants."""
        super().describe(message)
        # the stamp of a sweep is the time of the first beam in the message, which is measured last
        message.time_increment = 0.0 - self._beam_time

    def sample(self, _: int) -> tuple[Floats, tuple[()]] | None:
        """Return the ranges. Noise is drawn even without subscribers, so that it does not depend on them."""
        noise = None
        if self._deviation:
            noise = self._rng.standard_normal(self.lidar.beams) * self._deviation
        if not (self.measures or self.outlet.num_connections()):
            return None
        engine, name = self.host.engine, self.robot.name
        if self._beam_time:
            ranges, self.poses = engine.sweep(name, self._beam_time, noise, self.lidar)
        else:
            ranges = engine.scan(name, noise, self.lidar)
        self.pose = self.robot.pose
        return ranges if self._rep_117 else unmeasured(ranges), ()
