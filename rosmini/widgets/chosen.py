"""One robot of a running simulation, as a pad needs it: of a simulator, of stageros or of gzserver."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import nearest
from rosmini.geometry.poses import Pose
from rosmini.sim.devices import DifferentialDrive
from rosmini.sim.engine import Engine
from rosmini.sim.engine.robot import Robot
from rosmini.sim.models import RobotModel
from rosmini.sim.simulation import Simulation
from rosmini.sim.world import World

from .teleop import Limits, TeleopError

Floats = NDArray[np.float64]

HIGHEST = 1000.0
"""A robot of Gazebo has no bound on its speed: from here on it is taken as none [m/s, rad/s]."""


class Chosen:
    """A robot that listens to a topic of velocities, chosen by the engine's name of it; without a name the first.

    Raises `TeleopError` if there is no such robot, with the names of those that there are.
    """

    def __init__(self, simulation: Simulation, name: str = "") -> None:
        drives = {
            device.robot.name: device
            for device in simulation.host.devices
            if isinstance(device, DifferentialDrive) and device.commanded_by is not None
        }
        if name not in drives and (name or not drives):
            hint = nearest(name, drives) or f"robots that can: {', '.join(drives) or 'none'}"
            raise TeleopError(
                f"no robot {name!r} in the world {simulation.engine.world.name!r} listens to velocities; {hint}"
            )
        self.simulation = simulation
        self.node = simulation.node
        self.name = name or next(iter(drives))
        self.drive = drives[self.name]
        self.topic = self.drive.commanded_by or ""
        """Where it hears velocities, as a global name."""
        robot = self.drive.robot
        self._laser: Any = None
        for device in simulation.host.devices:
            if hasattr(device, "ranges") and getattr(device, "robot", None) is robot:
                self._laser = device
                break
        model = self.drive.model
        if model.lidar is None and self._laser is not None:
            model = replace(model, lidar=self._laser.lidar)
        self.model: RobotModel = model

    @property
    def engine(self) -> Engine:
        """The engine that moves it."""
        return self.simulation.engine

    @property
    def world(self) -> World:
        """Where it is."""
        return self.engine.world

    @property
    def robots(self) -> dict[str, Robot]:
        """All robots that are there."""
        return self.engine.robots

    @property
    def namespace(self) -> str:
        """Of its topic."""
        return self.topic.rpartition("/")[0] or "/"

    @property
    def limits(self) -> Limits:
        """How fast it may be sent; where it has no bound, those of a Burger."""
        usual = Limits()
        linear, angular = self.model.max_linear, self.model.max_angular
        return Limits(
            linear if 0 < linear < HIGHEST else usual.linear,
            angular if 0 < angular < HIGHEST else usual.angular,
        )

    @property
    def sees(self) -> bool:
        """Whether it has a laser."""
        return self._laser is not None

    @property
    def simple(self) -> bool:
        """Whether it moves as the robot in a page without a kernel does: on two wheels."""
        return self.model.drive == "differential" and not self.drive.steered

    @property
    def scan_topic(self) -> str:
        """Where its laser's messages are, as a global name."""
        return str(self._laser.topic)

    @property
    def scan_pose(self) -> Pose:
        """Where it was when its laser measured last."""
        pose: Pose = self._laser.pose
        return pose

    @property
    def scan_poses(self) -> Floats:
        """Where it was at each beam of that (beams, 3); (1, 3) if all of them were measured at once."""
        poses: Floats = self._laser.seen_from
        return poses

    def truth(self, robot: str = "") -> Pose:
        """Where it, or another one, is now: x [m], y [m], heading [rad]. Raises `RobotGone`."""
        return self.simulation.truth(robot or self.name)

    def last_scan(self) -> Any:
        """The last `sensor_msgs/LaserScan`; None before the first."""
        return self.simulation.last_scan(self.name)

    def reset(self) -> None:
        """Put all back to where it began."""
        self.simulation.reset()
