"""What a view shows of a running simulation: whose world it is, what is in it, and where that is now."""

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
"""How much time the button Step lets pass [s]."""
LASERS = 12
"""So many lasers are drawn; of more one would see nothing."""


@dataclass(frozen=True)
class Body:
    """A robot, or a thing that can be elsewhere than it was."""

    name: str
    kind: str
    """robot, box (it can be pushed), or mover (it moves by itself, and cannot be taken)."""
    model: RobotModel | None = None
    obstacle: Obstacle | None = None
    axle: Pose = HERE
    """Where the engine has it, seen from its own origin."""
    colour: str = "grey"

    @property
    def takeable(self) -> bool:
        """Whether it can be dragged."""
        return self.kind != "mover"

    @property
    def what(self) -> str:
        """What it is, in words."""
        if self.model is not None:
            return f"robot {self.model.title or self.model.name}"
        return "thing that can be pushed" if self.takeable else "moves by itself"

    @property
    def reach(self) -> float:
        """How far it goes from its origin [m]."""
        if self.model is not None:
            return self.model.reach
        return 0.0 if self.obstacle is None else _reach(shapes_of(self.obstacle, HERE))

    def data(self, laser: LidarModel | None) -> dict[str, Any]:
        """What the page has to know of it: it is drawn in the engine's frame."""
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
    """Looks at a running simulation, and changes nothing in it but what it is told to drag."""

    def __init__(self, simulation: Simulation) -> None:
        self.simulation = simulation
        self.node = simulation.node
        self._lasers: dict[str, LidarModel] = {}
        self._counted = -1

    @property
    def engine(self) -> Engine:
        """The engine."""
        return self.simulation.engine

    @property
    def host(self) -> Host:
        """The time."""
        return self.simulation.host

    @property
    def gone(self) -> str | None:
        """Why there is nothing to see any more; None while there is."""
        if self.node.is_shutdown():
            return f"the simulation has ended: the node {self.node.name} was shut down"
        return None

    def bodies(self) -> list[Body]:
        """All that is in the world and need not stay where it is: robots first, in insertion order."""
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
        """The one of this name. Raises `ViewError`, with the nearest."""
        bodies = {body.name: body for body in self.bodies()}
        titled = [body for body in bodies.values() if body.model is not None and body.model.title == name]
        if name not in bodies and len(titled) == 1:  # Stage's robots have names in their file too
            return titled[0]
        if name not in bodies:
            hint = nearest(name, bodies) or f"there are: {', '.join(bodies) or 'none'}"
            raise ViewError(
                f"the world {self.engine.world.name!r} has no {name!r} that could be dragged; {hint}"
            )
        return bodies[name]

    def pose(self, body: Body) -> Pose:
        """Where it is now: x [m], y [m], heading [rad]."""
        engine = self.engine
        pose = (
            engine.peek(body.name, self.host.engine_now) if body.kind == "robot" else engine.pose(body.name)
        )
        return pose if body.axle == HERE else compose(pose, inverse(body.axle))

    def lasers(self, bodies: list[Body]) -> dict[str, LidarModel]:
        """The lasers that are drawn, by the names of their robots: of each robot the first."""
        devices = self.host.devices
        if len(devices) != self._counted:
            self._counted, self._lasers = len(devices), {}
            for device in devices:
                if isinstance(device, Laser):
                    self._lasers.setdefault(device.robot.name, device.lidar)
        found: dict[str, LidarModel] = {}
        for body in bodies:
            lidar = None if body.model is None else body.model.lidar or self._lasers.get(body.name)
            if lidar is not None and len(found) < LASERS:
                found[body.name] = lidar
        return found

    def survey(self, name: str, lidar: LidarModel) -> NDArray[np.float32]:
        """Where a robot is, and what its laser would measure there now, without noise: x, y, heading, ranges."""
        ranges = self.engine.scan(name, None, lidar=lidar)
        return np.concatenate([self.engine.robot(name).pose, ranges]).astype(np.float32)

    def still(self) -> World:
        """What stays where it is."""
        world = self.engine.world
        return replace(world, obstacles=tuple(each for each in world.obstacles if each.fixed))

    def scene(self) -> dict[str, Any]:
        """What stays where it is, for the scripts of a page."""
        data = scene_data(self.still())
        data["bounds"] = self.bounds(data["bounds"])
        return data

    def bounds(self, bounds: list[float]) -> list[float]:
        """The rectangle to be seen: that of the world, and all that is in it."""
        x0, y0, x1, y1 = bounds
        for body in self.bodies():
            (x, y, _), reach = self.pose(body), body.reach
            x0, y0, x1, y1 = min(x0, x - reach), min(y0, y - reach), max(x1, x + reach), max(y1, y + reach)
        return [round(side, 3) for side in (x0, y0, x1, y1)]

    def picture(self, title: str | None) -> Picture:
        """How it looks now."""
        bodies = self.bodies()
        robots = [(body, self.pose(body)) for body in bodies if body.model is not None]
        things = [
            replace(body.obstacle, pose=self.pose(body), motion=None)
            for body in bodies
            if body.obstacle is not None
        ]
        still = self.still()
        first = robots[0] if robots else None
        return world_picture(
            replace(still, obstacles=(*still.obstacles, *things)),
            robot=None if first is None else compose(first[1], first[0].axle),
            model=None if first is None else first[0].model,
            others=[
                Other(body.name, body.model, compose(pose, body.axle))
                for body, pose in robots[1:]
                if body.model
            ],
            name="" if first is None else first[0].name,
            title=title,
        )


def _laser(lidar: LidarModel) -> dict[str, Any]:
    """A laser as a script draws it: where it sits [m, rad], and its beams [rad, m]."""
    return {
        "x": round(lidar.mount[0], 4),
        "y": round(lidar.mount[1], 4),
        "start": lidar.angle_min + lidar.yaw,
        "step": lidar.increment,
        "beams": lidar.beams,
        "max": lidar.range_max,
    }


def _reach(shapes: list[dict[str, Any]]) -> float:
    """How far shapes go from their origin [m]."""
    far = [0.05]
    for shape in shapes:
        if shape["kind"] == "disc":
            far.append(math.hypot(shape["x"], shape["y"]) + shape["r"])
        else:
            far += [math.hypot(x, y) for x, y in shape["points"]]
    return max(far)
