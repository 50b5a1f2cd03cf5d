"""What a pad shows beside its messages: the robot of a simulator, where it stands, and what its laser sees."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.shapes import Polygon
from rosmini.sim.world import Obstacle, Pose
from rosmini.viz.replay.canvas_data import scene_data, shapes_of
from rosmini.viz.world_pictures import colour_of, pose_text

from .chosen import Chosen

Floats = NDArray[np.float64]

TRAIL_STEP = 0.02
"""The least way between two points of the trail [m]."""
TRAIL_JUMP = 0.3
"""A longer way between two looks was not driven: the robot was put somewhere else, and a new trail begins [m]."""
TRAIL_POINTS = 3000


class Sight:
    """Looks at one robot of a simulation and remembers its way."""

    def __init__(self, simulator: Chosen) -> None:
        self.simulator = simulator
        self.trail: list[tuple[float, float]] = []
        self._poses: list[Pose] = []

    @property
    def rate(self) -> float:
        """Scans a second."""
        return self.simulator.model.laser.rate

    def moving(self) -> list[Obstacle]:
        """All that need not stay where it is: what can be pushed, what moves by itself, and other robots."""
        engine = self.simulator.engine
        others = [
            Obstacle(name, Polygon(robot.model.footprint), robot.pose, robot.model.height, colour_of(i))
            for i, (name, robot) in enumerate(engine.robots.items())
            if name != self.simulator.name
        ]
        return [*engine.obstacles(), *others]

    def scene(self) -> dict[str, Any]:
        """The world as it is now, with the robot, for the scripts of a page; what can be pushed comes last."""
        simulator = self.simulator
        world, height = simulator.world, simulator.model.laser.mount[2]
        fixed = [obstacle for obstacle in world.obstacles if obstacle.fixed]
        obstacles = (*fixed, *self.moving())
        scene = scene_data(replace(world, obstacles=obstacles), simulator.model)
        scene["shapes"] = [
            self._flagged(obstacle, shape) for obstacle in obstacles for shape in shapes_of(obstacle)
        ]
        if world.wall_height < height:
            scene["low_walls"] = True
        return scene

    def _flagged(self, obstacle: Obstacle, shape: dict[str, Any]) -> dict[str, Any]:
        """A shape for the robot: `low` if its laser looks over or under it, `over` if the robot drives under it."""
        model = self.simulator.model
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
        x, y, theta = self.simulator.truth()
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
        return self.simulator.engine.robot(self.simulator.name).touching

    def describe(self) -> str:
        """Where the robot is and how much its laser sees, in a line that is the same on every machine."""
        model, world = self.simulator.model, self.simulator.world
        where = f"{model.name} at {pose_text(self.simulator.truth())} in {world.name}"
        scan = self.ranges()
        if scan is None:
            return f"{where}; no scan yet"
        return f"{where}; {int(np.isfinite(scan).sum())} of {len(scan)} beams hit"

    def survey(self) -> Floats:
        """What the laser would see from here at this moment, without noise: ranges (beams,) [m]."""
        return self.simulator.engine.scan(self.simulator.name, None)

    def ranges(self) -> Floats | None:
        """The last scan's ranges (beams,) [m], or None if there is none yet."""
        scan = self.simulator.last_scan()
        return None if scan is None else np.asarray(scan.ranges, dtype=np.float64)
