"""The contents of a view of a running simulation: its world, the bodies in it and their poses."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.sim.devices import Laser
from rosmini.sim.engine import Engine
from rosmini.sim.host import Host
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.simulation import Simulation
from rosmini.sim.world import Obstacle, World
from rosmini.viz.replay.canvas_data import robot_data, scene_data, shapes_of
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.world_pictures import Other, colour_of, world_picture

Floats = NDArray[np.float64]

HERE: Pose = (0.0, 0.0, 0.0)
STEP_S = 0.1
"""Time by which the button Step advances the world [s]."""
MAX_LASERS = 12
"""Maximum number of lasers drawn; more would hide the scene."""


@dataclass(frozen=True)
class Body:
    """A robot or an object that can move."""

    name: str
    kind: str
    """robot, box (can be pushed), or mover (moves by itself and cannot be dragged)."""
    model: RobotModel | None = None
    obstacle: Obstacle | None = None
    axle: Pose = HERE
    """Pose of the engine's reference point (the axle) in the frame of the body."""
    colour: str = "grey"

    @property
    def is_draggable(self) -> bool:
        """True if it can be dragged."""
        return self.kind != "mover"

    @property
    def what(self) -> str:
        """Description of the body."""
        if self.model is not None:
            return f"robot {self.model.title or self.model.name}"
        return "thing that can be pushed" if self.is_draggable else "moves by itself"

    @property
    def reach(self) -> float:
        """Distance from its origin to its farthest point [m]."""
        if self.model is not None:
            return self.model.reach
        return 0.0 if self.obstacle is None else _reach(shapes_of(self.obstacle, HERE))

    def data(self, laser: LidarModel | None) -> dict[str, Any]:
        """Return the data that the page needs of it, drawn in the engine's frame."""
        robot, shapes = None, None
        if self.model is None:
            shapes = [] if self.obstacle is None else shapes_of(self.obstacle, HERE)
        elif self.model.drive is None:
            points = np.round(self.model.footprint, 4).tolist()
            shapes = [{"kind": "polygon", "points": points, "colour": self.colour}]
        else:
            robot = robot_data(self.model)
        return {
            "name": self.name,
            "kind": self.kind,
            "what": self.what,
            "colour": self.colour,
            "robot": robot,
            "shapes": shapes,
            "reach": round(self.reach, 4),
            "axle": [round(part, 6) for part in self.axle],
            "laser": None if laser is None else _laser(laser),
        }


class Watch:
    """Observes a running simulation, and moves only the bodies that are dragged."""

    def __init__(self, simulation: Simulation) -> None:
        self.simulation = simulation
        self.node = simulation.node
        self._lasers: dict[str, LidarModel] = {}
        self._counted = -1

    @property
    def engine(self) -> Engine:
        """The physics engine."""
        return self.simulation.engine

    @property
    def host(self) -> Host:
        """The simulation's host, which has the time."""
        return self.simulation.host

    @property
    def gone(self) -> str | None:
        """Reason why there is nothing left to show, or None."""
        if self.node.is_shutdown():
            return f"the simulation has ended: the node {self.node.name} was shut down"
        return None

    def bodies(self) -> list[Body]:
        """Return everything in the world that can move: robots first, in insertion order."""
        axle = getattr(self.simulation, "axle", None)
        found = [
            Body(
                name,
                "robot",
                robot.model,
                axle=HERE if axle is None else axle(name),
                colour="blue" if not i else colour_of(i - 1),
            )
            for i, (name, robot) in enumerate(self.engine.robots.items())
        ]
        for obstacle in self.engine.obstacles():
            kind = "box" if obstacle.movable else "mover"
            found.append(Body(obstacle.name, kind, obstacle=obstacle, colour=obstacle.colour))
        return found

    def body(self, name: str) -> Body:
        """Return the body of this name. Raises `ViewError`, with the closest name."""
        bodies = {body.name: body for body in self.bodies()}
        titled = [body for body in bodies.values() if body.model is not None and body.model.title == name]
        if name not in bodies and len(titled) == 1:  # Stage's robots have names in their file too
            return titled[0]
        if name not in bodies:
            hint = nearest(name, bodies) or f"there are: {', '.join(bodies) or 'none'}"
            raise ViewError(
                f"the world {self.engine.world.name!r} has nothing named {name!r} that can be dragged; {hint}"
            )
        return bodies[name]

    def pose(self, body: Body) -> Pose:
        """Return its current pose: x [m], y [m], heading [rad]."""
        engine = self.engine
        pose = engine.predict_pose(body.name, self.host.engine_now) if body.kind == "robot" else engine.pose(body.name)
        return pose if body.axle == HERE else compose(pose, inverse(body.axle))

    def lasers(self, bodies: list[Body]) -> dict[str, LidarModel]:
        """Return the lasers to draw, by robot name: the first laser of each robot."""
        devices = self.host.devices
        if len(devices) != self._counted:
            self._counted, self._lasers = len(devices), {}
            for device in devices:
                if isinstance(device, Laser):
                    self._lasers.setdefault(device.robot.name, device.lidar)
        found: dict[str, LidarModel] = {}
        for body in bodies:
            lidar = None if body.model is None else body.model.lidar or self._lasers.get(body.name)
            if lidar is not None and len(found) < MAX_LASERS:
                found[body.name] = lidar
        return found

    def measure(self, name: str, lidar: LidarModel) -> NDArray[np.float32]:
        """Return a robot's pose and its laser's noise-free measurement now: x, y, heading, ranges."""
        ranges = self.engine.scan(name, None, lidar=lidar)
        return np.concatenate([self.engine.robot(name).pose, ranges]).astype(np.float32)

    def still(self) -> World:
        """The static part of the world."""
        world = self.engine.world
        return replace(world, obstacles=tuple(each for each in world.obstacles if each.fixed))

    def scene(self) -> dict[str, Any]:
        """Return the static part of the world, for a page's scripts."""
        data = scene_data(self.still())
        data["bounds"] = self.bounds(data["bounds"])
        return data

    def bounds(self, bounds: list[float]) -> list[float]:
        """Return the visible rectangle: that of the world, extended by everything in it."""
        x0, y0, x1, y1 = bounds
        for body in self.bodies():
            (x, y, _), reach = self.pose(body), body.reach
            x0, y0, x1, y1 = min(x0, x - reach), min(y0, y - reach), max(x1, x + reach), max(y1, y + reach)
        return [round(side, 3) for side in (x0, y0, x1, y1)]

    def picture(self, title: str | None) -> Picture:
        """Return a picture of the current state."""
        bodies = self.bodies()
        robots = [(body, self.pose(body)) for body in bodies if body.model is not None]
        things = [
            replace(body.obstacle, pose=self.pose(body), motion=None) for body in bodies if body.obstacle is not None
        ]
        still = self.still()
        first = robots[0] if robots else None
        return world_picture(
            replace(still, obstacles=(*still.obstacles, *things)),
            robot=None if first is None else compose(first[1], first[0].axle),
            model=None if first is None else first[0].model,
            others=[Other(body.name, body.model, compose(pose, body.axle)) for body, pose in robots[1:] if body.model],
            name="" if first is None else first[0].name,
            title=title,
        )


def _laser(lidar: LidarModel) -> dict[str, Any]:
    """Return a laser for a script: its mounting pose [m, rad], and its beams [rad, m]."""
    return {
        "x": round(lidar.mount[0], 4),
        "y": round(lidar.mount[1], 4),
        "start": lidar.angle_min + lidar.yaw,
        "step": lidar.increment,
        "beams": lidar.beams,
        "max": lidar.range_max,
    }


def _reach(shapes: list[dict[str, Any]]) -> float:
    """Return the distance from the shapes' origin to their farthest point [m]."""
    far = [0.05]
    for shape in shapes:
        if shape["kind"] == "disc":
            far.append(math.hypot(shape["x"], shape["y"]) + shape["r"])
        else:
            far += [math.hypot(x, y) for x, y in shape["points"]]
    return max(far)
