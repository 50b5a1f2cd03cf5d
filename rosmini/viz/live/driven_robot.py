"""One robot of a running simulation (simulator, stageros or gzserver), as a pad drives and shows it."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose
from rosmini.sim.devices.drive import DifferentialDrive
from rosmini.sim.engine import Engine
from rosmini.sim.engine.robot import Robot
from rosmini.sim.models import RobotModel
from rosmini.sim.shapes import Polygon
from rosmini.sim.simulation import Simulation
from rosmini.sim.world import Obstacle, World
from rosmini.viz.live.key_maps import TeleopError
from rosmini.viz.replay.canvas_data import scene_data, shapes_of
from rosmini.viz.world_pictures import colour_of, pose_text

from .teleop import Limits

Floats = NDArray[np.float64]

UNLIMITED_SPEED = 1000.0
"""A speed limit from here on counts as unlimited, as robots in Gazebo have none [m/s, rad/s]."""

TRAIL_STEP = 0.02
"""Minimum distance between two points of the trail [m]."""
TRAIL_JUMP = 0.3
"""A longer jump between two samples means that the robot was moved, so a new trail begins [m]."""
TRAIL_POINTS = 3000


class DrivenRobot:
    """A robot that subscribes to a velocity topic, chosen by its name in the engine; by default the first.

    Raises `TeleopError`, with the names of the available robots, if there is no such robot.
    """

    def __init__(self, simulation: Simulation, name: str = "") -> None:
        drives = _drives(simulation)
        if name not in drives and (name or not drives):
            hint = nearest(name, drives) or f"robots that can: {', '.join(drives) or 'none'}"
            raise TeleopError(
                f"no robot {name!r} in the world {simulation.engine.world.name!r} subscribes to velocities; {hint}"
            )
        self.simulation = simulation
        self.node = simulation.node
        self.name = name or next(iter(drives))
        self.drive = drives[self.name]
        self.topic = self.drive.commanded_by or ""
        """Global name of the topic on which the robot receives velocities."""
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
        self.trail: list[tuple[float, float]] = []
        """Sampled positions of the robot [m]."""
        self._poses: list[Pose] = []

    @staticmethod
    def names(simulation: Simulation) -> tuple[str, ...]:
        """Return the names of all robots that subscribe to velocities."""
        return tuple(_drives(simulation))

    @property
    def engine(self) -> Engine:
        """The physics engine that moves the robot."""
        return self.simulation.engine

    @property
    def world(self) -> World:
        """The world that contains the robot."""
        return self.engine.world

    @property
    def robots(self) -> dict[str, Robot]:
        """All robots in the engine, by name."""
        return self.engine.robots

    @property
    def namespace(self) -> str:
        """Namespace of the velocity topic."""
        return self.topic.rpartition("/")[0] or "/"

    @property
    def limits(self) -> Limits:
        """Speed limits of the robot; those of a Burger if it has none."""
        usual = Limits()
        linear, angular = self.model.max_linear, self.model.max_angular
        return Limits(
            linear if 0 < linear < UNLIMITED_SPEED else usual.linear,
            angular if 0 < angular < UNLIMITED_SPEED else usual.angular,
        )

    @property
    def has_laser(self) -> bool:
        """True if the robot has a laser."""
        return self._laser is not None

    @property
    def is_differential(self) -> bool:
        """True if the robot moves on two driven wheels, like the robot in a page without a kernel."""
        return self.model.drive == "differential"

    @property
    def scan_topic(self) -> str:
        """Global name of the laser's topic."""
        return str(self._laser.topic)

    @property
    def scan_poses(self) -> Floats:
        """Pose of the robot at each beam of the last scan (beams, 3); (1, 3) if all beams were measured at once."""
        poses: Floats = self._laser.seen_from
        return poses

    def truth(self, robot: str = "") -> Pose:
        """Return the true pose of this or another robot: x [m], y [m], heading [rad]. Raises `RobotGone`."""
        return self.simulation.truth(robot or self.name)

    def last_scan(self) -> Any:
        """Return the last `sensor_msgs/LaserScan`; None before the first."""
        return self.simulation.last_scan(self.name)

    def reset(self) -> None:
        """Reset everything to its initial pose."""
        self.simulation.reset()

    # -- for a page ----------------------------------------------------------------------------------------------

    def moving(self) -> list[Obstacle]:
        """Return all obstacles that can move: pushable boxes, self-moving obstacles and other robots."""
        engine = self.engine
        others = [
            Obstacle(name, Polygon(robot.model.footprint), robot.pose, robot.model.height, colour_of(i))
            for i, (name, robot) in enumerate(engine.robots.items())
            if name != self.name
        ]
        return [*engine.obstacles(), *others]

    def fixed(self) -> list[Obstacle]:
        """Return the static obstacles."""
        return [obstacle for obstacle in self.world.obstacles if obstacle.fixed]

    def scene(self) -> dict[str, Any]:
        """Return the current world with the robot, as the page's scripts expect it; pushable obstacles come last."""
        world, height = self.world, self.model.laser.mount[2]
        obstacles = (*self.fixed(), *self.moving())
        scene = scene_data(replace(world, obstacles=obstacles), self.model)
        scene["shapes"] = [self._flagged(obstacle, shape) for obstacle in obstacles for shape in shapes_of(obstacle)]
        if world.wall_height < height:
            scene["low_walls"] = True
        return scene

    def _flagged(self, obstacle: Obstacle, shape: dict[str, Any]) -> dict[str, Any]:
        """Flag a shape for the robot: `low` if its laser misses the shape, `over` if the robot fits underneath it."""
        model = self.model
        if not obstacle.bottom <= model.laser.mount[2] <= obstacle.height:
            shape["low"] = True
        if obstacle.bottom >= model.height:
            shape["over"] = True
        return shape

    def moved_shapes(self) -> list[dict[str, Any]] | None:
        """Return the shapes of the movable obstacles if any has moved since the last call; else None."""
        obstacles = self.moving()
        poses = [obstacle.pose for obstacle in obstacles]
        if poses == self._poses:
            return None
        self._poses = poses
        return [self._flagged(obstacle, shape) for obstacle in obstacles for shape in shapes_of(obstacle)]

    def sample_pose(self) -> Pose:
        """Return the robot's pose and add it to the trail. Raises the simulator's error if the robot was removed."""
        x, y, theta = self.truth()
        gone = math.dist(self.trail[-1], (x, y)) if self.trail else math.inf
        if gone > TRAIL_JUMP:
            self.trail.clear()
        if gone >= TRAIL_STEP:
            self.trail.append((x, y))
            del self.trail[:-TRAIL_POINTS]
        return (x, y, theta)

    @property
    def blocked(self) -> bool:
        """True if an obstacle blocks the robot."""
        return self.engine.robot(self.name).touching

    def describe(self) -> str:
        """Return one line with the robot's pose and what its laser sees, the same on every machine."""
        model, world = self.model, self.world
        where = f"{model.name} at {pose_text(self.truth())} in {world.name}"
        scan = self.ranges()
        if scan is None:
            return f"{where}; no scan yet"
        return f"{where}; {int(np.isfinite(scan).sum())} of {len(scan)} beams hit"

    def measure(self) -> Floats:
        """Return the ranges (beams,) [m] that the laser would measure here and now, without noise."""
        return self.engine.scan(self.name, None)

    def ranges(self) -> Floats | None:
        """Return the last scan's ranges (beams,) [m], or None before the first scan."""
        scan = self.last_scan()
        return None if scan is None else np.asarray(scan.ranges, dtype=np.float64)


def _drives(simulation: Simulation) -> dict[str, DifferentialDrive]:
    """Return the velocity-controlled drives, by robot name."""
    return {
        device.robot.name: device
        for device in simulation.host.devices
        if isinstance(device, DifferentialDrive) and device.commanded_by is not None
    }
