"""One robot of a running simulation, as a pad drives and shows it: of a simulator, of stageros or of gzserver."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose
from rosmini.sim.devices import DifferentialDrive
from rosmini.sim.engine import Engine
from rosmini.sim.engine.robot import Robot
from rosmini.sim.models import RobotModel
from rosmini.sim.shapes import Polygon
from rosmini.sim.simulation import Simulation
from rosmini.sim.world import Obstacle, World
from rosmini.viz.replay.canvas_data import scene_data, shapes_of
from rosmini.viz.world_pictures import colour_of, pose_text

from .teleop import Limits, TeleopError

Floats = NDArray[np.float64]

HIGHEST = 1000.0
"""A robot of Gazebo has no bound on its speed: from here on it is taken as none [m/s, rad/s]."""

TRAIL_STEP = 0.02
"""The least way between two points of the trail [m]."""
TRAIL_JUMP = 0.3
"""A longer way between two looks was not driven: the robot was put somewhere else, and a new trail begins [m]."""
TRAIL_POINTS = 3000


class Chosen:
    """A robot that listens to a topic of velocities, chosen by the engine's name of it; without a name the first.

    Raises `TeleopError` if there is no such robot, with the names of those that there are.
    """

    def __init__(self, simulation: Simulation, name: str = "") -> None:
        drives = _drives(simulation)
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
        self.trail: list[tuple[float, float]] = []
        """Where it was at the looks so far [m]."""
        self._poses: list[Pose] = []

    @staticmethod
    def names(simulation: Simulation) -> tuple[str, ...]:
        """All robots that listen to velocities."""
        return tuple(_drives(simulation))

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

    # -- what a page shows of it ---------------------------------------------------------------------------------

    def moving(self) -> list[Obstacle]:
        """All that need not stay where it is: what can be pushed, what moves by itself, and other robots."""
        engine = self.engine
        others = [
            Obstacle(name, Polygon(robot.model.footprint), robot.pose, robot.model.height, colour_of(i))
            for i, (name, robot) in enumerate(engine.robots.items())
            if name != self.name
        ]
        return [*engine.obstacles(), *others]

    def fixed(self) -> list[Obstacle]:
        """All that stays where it is."""
        return [obstacle for obstacle in self.world.obstacles if obstacle.fixed]

    def scene(self) -> dict[str, Any]:
        """The world as it is now, with the robot, for the scripts of a page; what can be pushed comes last."""
        world, height = self.world, self.model.laser.mount[2]
        obstacles = (*self.fixed(), *self.moving())
        scene = scene_data(replace(world, obstacles=obstacles), self.model)
        scene["shapes"] = [
            self._flagged(obstacle, shape) for obstacle in obstacles for shape in shapes_of(obstacle)
        ]
        if world.wall_height < height:
            scene["low_walls"] = True
        return scene

    def _flagged(self, obstacle: Obstacle, shape: dict[str, Any]) -> dict[str, Any]:
        """A shape for the robot: `low` if its laser looks over or under it, `over` if the robot drives under it."""
        model = self.model
        if not obstacle.bottom <= model.laser.mount[2] <= obstacle.height:
            shape["low"] = True
        if obstacle.bottom >= model.height:
            shape["over"] = True
        return shape

    def pushed(self) -> list[dict[str, Any]] | None:
        """The shapes of what need not stay where it is, if it has moved since this was asked last; else None."""
        obstacles = self.moving()
        poses = [obstacle.pose for obstacle in obstacles]
        if poses == self._poses:
            return None
        self._poses = poses
        return [self._flagged(obstacle, shape) for obstacle in obstacles for shape in shapes_of(obstacle)]

    def look(self) -> Pose:
        """Where the robot is, noted for the trail. Raises what the simulator raises when it has been removed."""
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
        """Whether something is in the robot's way."""
        return self.engine.robot(self.name).touching

    def describe(self) -> str:
        """Where the robot is and how much its laser sees, in a line that is the same on every machine."""
        model, world = self.model, self.world
        where = f"{model.name} at {pose_text(self.truth())} in {world.name}"
        scan = self.ranges()
        if scan is None:
            return f"{where}; no scan yet"
        return f"{where}; {int(np.isfinite(scan).sum())} of {len(scan)} beams hit"

    def survey(self) -> Floats:
        """What the laser would see from here at this moment, without noise: ranges (beams,) [m]."""
        return self.engine.scan(self.name, None)

    def ranges(self) -> Floats | None:
        """The last scan's ranges (beams,) [m], or None if there is none yet."""
        scan = self.last_scan()
        return None if scan is None else np.asarray(scan.ranges, dtype=np.float64)


def _drives(simulation: Simulation) -> dict[str, DifferentialDrive]:
    """What listens to velocities, by the names of its robots."""
    return {
        device.robot.name: device
        for device in simulation.host.devices
        if isinstance(device, DifferentialDrive) and device.commanded_by is not None
    }
