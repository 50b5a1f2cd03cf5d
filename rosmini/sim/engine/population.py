"""The bodies in an engine that are not fixed, shared by the facade, the stepper and the sensors."""

from __future__ import annotations

import math

from rosmini.sim.shapes import Polygon
from rosmini.sim.world import Obstacle, World

from .bodies import Crate
from .contacts import Contacts
from .instant import Instant
from .laser_view import LaserView
from .movers import Mover
from .robot import PassiveRobot, Robot
from .trails import Trails


class Population:
    """The robots, movers and pushable obstacles of an engine, and their recent poses."""

    def __init__(self) -> None:
        self.instant = Instant()
        self.robots: dict[str, Robot] = {}
        self.movers: dict[str, Mover] = {}
        self.contacts = Contacts(self.instant)
        self.trails = Trails()
        self.laser_view = LaserView(World("void"))
        self.changed = 0
        """Number of times a body was added, removed or put elsewhere."""

    def add_robot_body(self, robot: Robot) -> None:
        """Add the body of a robot."""
        if isinstance(robot, PassiveRobot):
            model = robot.model
            mass = None if math.isinf(model.mass) else model.mass
            obstacle = Obstacle(robot.name, Polygon(model.footprint), robot.start, model.height, mass=mass)
            robot.body = crate = Crate(obstacle, self.instant, shown=False)
            self.contacts.add_crate(crate)
        else:
            self.contacts.add_robot(robot)

    def add_obstacle_body(self, obstacle: Obstacle) -> None:
        """Add the body of an obstacle."""
        if obstacle.movable:
            self.contacts.add_crate(Crate(obstacle, self.instant))
        elif obstacle.motion is not None:
            mover = self.movers[obstacle.name] = Mover(obstacle, obstacle.motion, self.instant)
            self.contacts.add_mover(mover)
            self.record_leg(mover)
        else:
            self.contacts.ground.insert(obstacle)
            self.laser_view.insert(obstacle)

    @property
    def now(self) -> float:
        """The time [s] since the engine began."""
        return self.instant.seconds

    @property
    def drivers(self) -> list[Robot]:
        """The robots with a drive."""
        return [each for each in self.robots.values() if not isinstance(each, PassiveRobot)]

    @property
    def moving(self) -> list[Robot | Mover]:
        """The robots with a drive, and the obstacles that move by themselves."""
        return [*self.drivers, *self.movers.values()]

    def record_leg(self, each: Robot | Mover) -> None:
        """Record the current leg in the trail of a robot or mover, if trails are kept."""
        if not self.trails.span:
            return
        name = each.name if isinstance(each, Robot) else each.obstacle.name
        self.trails.set_course(name, *each.leg())
