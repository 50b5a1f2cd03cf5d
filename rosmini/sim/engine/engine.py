"""The engine: robots, movable obstacles and time, with no node in it.

>>> import numpy as np
>>> from rosmini.sim.models import BURGER
>>> from rosmini.sim.world import World
>>> engine = Engine(World("empty"), lambda name: np.random.default_rng(0), noise=0.0)
>>> robot = engine.add("burger", BURGER, (0.0, 0.0, 0.0))
>>> engine.command("burger", 0.2, 0.0)
>>> engine.advance(1.1)
>>> round(robot.pose[0], 9)
0.2

Time goes on from event to event, not in steps: what touches nothing moves in closed form, so a pose does not depend on how often it was
asked for, but for the last digits of its numbers. Only where a robot touches something, or an obstacle slides, time is cut into steps of `STEP`; who asks
between two of them cuts one in two. So while something is pushed, a sensor of another rate may change by a millimetre or so where it gets to.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError, nearest
from rosmini.geometry.poses import Pose
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.sensors.lidar import scan as measure
from rosmini.sim.shapes import Part, Polygon
from rosmini.sim.world import Obstacle, World, WorldError

from .clockwork import EPSILON, STEP, Clockwork
from .movers import Mover
from .odometry import RealWheels
from .robot import Robot, Thing, make_robot
from .sights import Sights, parts_of, parts_of_robot
from .state import EngineState, bring_back, taken
from .sweep import Sweeps
from .trails import Trails

if TYPE_CHECKING:
    from .physics import Contacts, Surface
    from .touching import Touch

Floats = NDArray[np.float64]
Velocity = tuple[float, float, float]
"""Along x and y of the frame map [m/s], and to the left [rad/s]."""

PLAY = 0.999
"""By this factor a footprint is smaller when it is asked whether there is room for it: 0.1 mm on each side of a Burger."""

__all__ = ["EPSILON", "STEP", "Engine", "EngineState", "RobotGone"]


class RobotGone(RosminiError):
    """A robot was asked for that is not, or no longer, in the world."""


class Engine:
    """A world with robots in it. Times are seconds since the engine was made.

    `rng(name)` returns the random generator for what is called `name`; with `noise` 0 the robots are those of the book, without errors, and
    between 0 and 1, or above, the errors are scaled. Each robot has a generator of its own, so another robot changes nobody's errors.

    `world` has the obstacles that were there at the begin, and those that were put in since; where those are now that can move tells `obstacles`.
    """

    def __init__(
        self, world: World, rng: Callable[[str], np.random.Generator], *, noise: float = 1.0
    ) -> None:
        self.world = world
        self.noise = noise
        self.now = 0.0
        self.robots: dict[str, Robot] = {}
        self.movers: dict[str, Mover] = {}
        """The things that move by themselves."""
        self.step = STEP
        """How long one step of the physics is [s]."""
        self._rng = rng
        self._contacts: Contacts | None = None
        self.sights = Sights(world)
        self.trails = Trails()
        self.clockwork = Clockwork(self)
        self._sweeps = Sweeps(self)
        self.changed = 0
        """How often something came, went, or was put elsewhere."""
        for obstacle in world.obstacles:
            if obstacle.motion is not None:
                self.movers[obstacle.name] = Mover(obstacle, obstacle.motion)

    @property
    def contacts(self) -> Contacts:
        """The bodies, made when they are first needed."""
        if self._contacts is None:
            try:
                from .physics import Contacts  # it loads pymunk, which takes a moment
            except ImportError as error:
                msg = (
                    "the simulator needs pymunk, which is not installed (there is none for Windows on ARM): pip install pymunk. "
                    f"Python says: {error}"
                )
                raise RosminiError(msg) from error
            self._contacts = Contacts(self.world)
        return self._contacts

    # -- robots --------------------------------------------------------------------------------------------------

    def add(self, name: str, model: RobotModel, pose: Pose | None = None) -> Robot:
        """Put a robot into the world; without a pose at the first start that is free.

        Raises `WorldError`, which names what stands there, and `RosminiError` if there is a robot or an obstacle of this name.
        """
        self._check_name(name)
        where = self._start(model) if pose is None else self._free(model, pose)
        return self._enter(name, model, where)

    def _enter(self, name: str, model: RobotModel, pose: Pose) -> Robot:
        new = self.robots[name] = self.make_robot(name, model, pose)
        self.embody(new)
        self._look_again()
        return new

    def embody(self, new: Robot) -> None:
        """Make the body of a robot; for whoever makes the bodies."""
        name, model = new.name, new.model
        if isinstance(new, Thing):
            loose = math.isinf(model.mass)
            mass = None if loose else model.mass
            body = Obstacle(name, Polygon(model.footprint), new.pose, model.height, mass=mass)
            self.contacts.insert(body, shown=False, loose=loose)
        else:
            self.contacts.add(name, model, new.pose)

    def _check_name(self, name: str) -> None:
        if name in self.robots:
            msg = f"there is a robot {name!r} in the world {self.world.name!r} already; give the other one another name"
            raise RosminiError(msg)
        if any(name == obstacle.name for obstacle in self.world.obstacles):
            msg = f"there is an obstacle {name!r} in the world {self.world.name!r} already; give the new one another name"
            raise RosminiError(msg)

    def remove(self, name: str) -> None:
        """Take a robot out of the world, even while it moves. Raises `RobotGone`."""
        gone = self.robot(name)
        del self.robots[name]
        self.trails.forget(name)
        if isinstance(gone, Thing):
            self.contacts.take_away(name)
        else:
            self.contacts.remove(name)
        self.sights.forget_viewer(name)
        self._look_again()

    def robot(self, name: str) -> Robot:
        """Return the robot of this name. Raises `RobotGone`, with the names of those that are there."""
        if name not in self.robots:
            there = ", ".join(self.robots) or "none"
            hint = nearest(name, self.robots)
            msg = f"there is no robot {name!r} in the world {self.world.name!r} (robots: {there}). {hint}"
            raise RobotGone(msg.rstrip())
        return self.robots[name]

    def place(self, name: str, pose: Pose) -> None:
        """Lift a robot and put it down elsewhere, at rest; its wheels do not notice. Raises `WorldError` and `RobotGone`."""
        self.robot(name)
        self.put(name, pose)

    def put(self, name: str, pose: Pose, velocity: Velocity = (0.0, 0.0, 0.0)) -> None:
        """Lift a robot or an obstacle and put it down elsewhere, with a velocity in the directions of the frame map [m/s, m/s, rad/s].

        A robot is told to stop by that; it slows down as its drive can, and of a velocity to its side one with two wheels takes nothing. What cannot
        be pushed takes no velocity. Raises `WorldError` if something stands there, or for what moves by itself; `RobotGone` if there is no such thing.
        """
        if not all(math.isfinite(part) for part in (*pose, *velocity)):
            msg = f"{name!r} cannot be placed at {pose} with the velocity {velocity}: all of it has to be finite numbers"
            raise WorldError(msg)
        if name not in self.robots:
            self._put_obstacle(self.obstacle(name), pose, velocity)
        else:
            lifted = self.robots[name]
            lifted.pose = self._free(lifted.model, pose, name)
            vx, vy, w = velocity
            c, s = math.cos(pose[2]), math.sin(pose[2])
            lifted.launch((c * vx + s * vy, c * vy - s * vx, w))
            if isinstance(lifted, Thing):
                self.contacts.place(name, lifted.pose, velocity)
            else:
                self.contacts.move(name, lifted.pose)
        self.trails.forget(name)
        self.clockwork.moving = self.contacts.moving
        self._look_again()

    def _put_obstacle(self, obstacle: Obstacle, pose: Pose, velocity: Velocity) -> None:
        if obstacle.motion is not None:
            msg = f"the obstacle {obstacle.name!r} cannot be put anywhere: it moves by itself; take it away, and insert another"
            raise WorldError(msg)
        hindrance = self._hindrance_of(replace(obstacle, pose=pose))
        if hindrance is not None:
            x, y, theta = pose
            msg = f"the obstacle {obstacle.name!r} cannot be placed at ({x:.2f}, {y:.2f}) with heading {theta:.2f}: {hindrance} is in its way"
            raise WorldError(msg)
        if obstacle.movable:
            self.contacts.place(obstacle.name, pose, velocity)
        else:
            self.take_away(obstacle.name)
            self._insert(replace(obstacle, pose=pose))

    def reset(self) -> None:
        """Put every robot and every obstacle back to where it began, with encoders at zero."""
        self.trails.clear()
        self.contacts.reset()
        for mover in self.movers.values():
            mover.start()
        for each in self.robots.values():
            each.stop()
            each.pose = each.start
            if isinstance(each, Thing):
                self.contacts.place(each.name, each.pose)
            else:
                self.contacts.move(each.name, each.pose)
        self.clockwork.moving = False
        self._look_again()

    def command(self, name: str, v: float, w: float, timeout: float = 0.0, *, vy: float = 0.0) -> None:
        """Tell a robot's wheels how to turn: v [m/s] ahead, w [rad/s] to the left, and vy [m/s] to its left side, cut to what it can do.

        After `timeout` seconds without another command the robot stops; 0: never. A robot on two wheels takes no notice of vy. Raises `RosminiError`
        for what is no finite number, and for a thing without a drive.
        """
        told = self.robot(name)
        if not math.isfinite(v + w + vy):
            aside = f", {vy} m/s to its side" if vy else ""
            msg = f"the robot {name!r} cannot go {v} m/s{aside} and {w} rad/s: both have to be finite"
            raise RosminiError(msg)
        told.drive(v, vy, w)
        told.expires = self.now + timeout if timeout else math.inf
        self.clockwork.plan()

    def _free(self, model: RobotModel, pose: Pose, name: str = "") -> Pose:
        if not all(math.isfinite(part) for part in pose):
            msg = f"a robot cannot be placed at {pose}: x, y and heading have to be finite numbers"
            raise WorldError(msg)
        hindrance = self.hindrance(model, pose, name)
        if hindrance is not None:
            x, y, theta = pose
            free = self.world.free_place(
                pose, model.footprint, model.height, lambda place: self.contacts.hindrance(model, place, name)
            )
            hint = "" if free is None else f". There is room at ({free[0]:.2f}, {free[1]:.2f})"
            msg = (
                f"no robot can be placed at ({x:.2f}, {y:.2f}) with heading {theta:.2f} in the world {self.world.name!r}: "
                f"{hindrance} is in its way{hint}"
            )
            raise WorldError(msg)
        return (float(pose[0]), float(pose[1]), float(pose[2]))

    def hindrance(self, model: RobotModel, pose: Pose, name: str = "") -> str | None:
        """Return what stands at `pose`, in words; None if a robot has room there."""
        self.clockwork.tell_places()
        corners = np.array(model.footprint)
        middle = corners.mean(axis=0)
        within = middle + (corners - middle) * PLAY  # where a robot only touches, it may stand
        return self.world.blocked(pose, within, model.height) or self.contacts.hindrance(model, pose, name)

    def _start(self, model: RobotModel) -> Pose:
        for start in self.world.starts:
            if self.hindrance(model, start) is None:
                return start
        return self._free(model, self.world.starts[0])

    # -- things --------------------------------------------------------------------------------------------------

    def insert(self, obstacle: Obstacle) -> None:
        """Put an obstacle into the world while time goes on: a fixed one, one that can be pushed, or one that moves by itself.

        Raises `RosminiError` if its name is taken, and `WorldError` if a robot, or something that can move, stands there.
        """
        self._check_name(obstacle.name)
        hindrance = self._hindrance_of(obstacle)
        if hindrance is not None:
            x, y, _ = obstacle.pose
            msg = f"the obstacle {obstacle.name!r} cannot be put to ({x:.2f}, {y:.2f}): {hindrance} is in its way"
            raise WorldError(msg)
        self._insert(obstacle)

    def _hindrance_of(self, obstacle: Obstacle) -> str | None:
        self.clockwork.tell_places()
        return self.contacts.hindrance_of(obstacle, obstacle.at(0.0))

    def _insert(self, obstacle: Obstacle) -> None:
        contacts = self.contacts
        self.world = self.world.with_obstacles([obstacle])
        contacts.insert(obstacle)
        if obstacle.motion is not None:
            self.movers[obstacle.name] = Mover(obstacle, obstacle.motion)
        self.sights.forget(self.world)
        self._look_again()

    def take_away(self, name: str) -> None:
        """Take an obstacle out of the world while time goes on. Raises `RobotGone` if there is none of this name."""
        self.obstacle(name)
        self.trails.forget(name)
        self.contacts.take_away(name)
        self.movers.pop(name, None)
        self.world = replace(
            self.world, obstacles=tuple(each for each in self.world.obstacles if each.name != name)
        )
        self.sights.forget(self.world)
        self.clockwork.moving = self.contacts.moving
        self._look_again()

    def obstacle(self, name: str) -> Obstacle:
        """The obstacle of this name, as it was when it came. Raises `RobotGone`."""
        names = {obstacle.name: obstacle for obstacle in self.world.obstacles}
        if name not in names:
            hint = nearest(name, [*names, *self.robots])
            msg = f"there is nothing {name!r} in the world {self.world.name!r} that could be moved or taken away. {hint}"
            raise RobotGone(msg.rstrip())
        return names[name]

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The movable obstacles where they are now; then those that move by themselves."""
        moving = (replace(mover.obstacle, pose=mover.pose) for mover in self.movers.values())
        return (*self.contacts.obstacles(), *moving)

    def pose(self, name: str) -> Pose:
        """Where a robot or an obstacle is now. Raises `RobotGone`."""
        if name in self.robots:
            return self.robots[name].pose
        obstacle = self.obstacle(name)
        if name in self.movers:
            return self.movers[name].pose
        crate = self.contacts.crate(name)
        return obstacle.pose if crate is None else crate.pose

    def velocity(self, name: str) -> Velocity:
        """How fast a robot or an obstacle moves now, in the directions of the frame map [m/s, m/s, rad/s]. Raises `RobotGone`."""
        crate = self.contacts.crate(name)
        if crate is not None:
            return crate.velocity
        if name in self.robots:
            v, vy, w = self.robots[name].velocity
            c, s = math.cos(self.robots[name].pose[2]), math.sin(self.robots[name].pose[2])
            return (c * v - s * vy, s * v + c * vy, w)
        self.obstacle(name)
        return self.movers[name].velocity if name in self.movers else (0.0, 0.0, 0.0)

    def touching(self, name: str) -> list[Touch]:
        """What a robot, or an obstacle that can move, touches now: with what, where, and how hard. Raises `RobotGone`.

        The forces are those of the last step in which anything touched: what a thing was pushed with, or what wheels that slip push with.
        """
        from .touching import touches

        if name not in self.robots:
            obstacle = self.obstacle(name)
            if obstacle.fixed:
                msg = (
                    f"the obstacle {name!r} is fixed: ask the robots and the things that move what they touch"
                )
                raise RobotGone(msg)
        self.clockwork.tell_places()
        return touches(self.contacts, name)

    @property
    def friction(self) -> float:
        """Friction of bodies on each other."""
        return self.contacts.surface.friction

    @friction.setter
    def friction(self, value: float) -> None:
        self.tune(friction=value)

    @property
    def gravity(self) -> float:
        """What presses wheels and things to the ground [m/s2]."""
        return self.contacts.surface.gravity

    @gravity.setter
    def gravity(self, value: float) -> None:
        self.tune(gravity=value)

    @property
    def surface(self) -> Surface:
        """Everything about friction and gravity."""
        return self.contacts.surface

    def tune(self, **changes: float) -> None:
        """Let wheels grip, things drag and rub, or gravity pull otherwise: see `rosmini.sim.engine.bodies.Surface`. Raises `WorldError`."""
        for what, value in changes.items():
            if not (math.isfinite(value) and value >= 0):
                msg = f"{what} cannot be {value}; it has to be a finite number, 0 or more"
                raise WorldError(msg)
        self.contacts.tune(replace(self.contacts.surface, **changes))

    # -- time ----------------------------------------------------------------------------------------------------

    def advance(self, until: float) -> None:
        """Let time go on until then; what is over stays as it is."""
        self.clockwork.advance(until)

    def peek(self, name: str, when: float) -> Pose:
        """Where a robot will be then, soon, without letting time go on: a look changes nothing of what happens.

        If something may be in its way until then, the answer is where it is now. Raises `RobotGone`.
        """
        return self.clockwork.peek(self.robot(name), when)

    def _look_again(self) -> None:
        """Forget how much room the robots have."""
        self.changed += 1
        self.clockwork.look_again()

    def state(self) -> EngineState:
        """Everything that is and moves here: `restore` brings it back, and the same happens from then on, to the last bit.

        The physics forgets, for that, what its solver remembers of the last steps: where nothing touches, a state that is taken changes nothing.
        """
        return taken(self)

    def restore(self, state: EngineState) -> None:
        """Be as it was when the state was taken, here or in another engine of the same world. Robots that were not there go, others come back."""
        bring_back(self, state)

    def make_robot(self, name: str, model: RobotModel, pose: Pose) -> Robot:
        """A robot with wheels of its own, which is nowhere yet."""
        return make_robot(name, model, pose, RealWheels(model, self._rng(f"{name}/wheels"), self.noise))

    def forget_bodies(self) -> None:
        """Make all bodies anew when they are needed next."""
        self._contacts = None

    # -- what is seen --------------------------------------------------------------------------------------------

    def scenery(self, name: str, lidar: LidarModel | None = None) -> tuple[Floats, Floats]:
        """What the laser of this robot can see: segments (n, 4) and discs (m, 3), other robots among them, in the frame map."""
        viewer = self.robot(name)
        laser = viewer.model.laser if lidar is None else lidar
        return self.sights.of(
            laser,
            viewer,
            list(self.robots.values()),
            [crate for crate in self.contacts.crates if crate.shown],
            self.movers.values(),
            (self.now, self.changed),
        )

    def scan(self, name: str, noise: Floats | None = None, lidar: LidarModel | None = None) -> Floats:
        """The ranges (beams,) [m] that a laser on a robot measures now: its own, or another; see `rosmini.sim.sensors.lidar.scan`.

        Raises `RobotGone`, and `ModelError` if it has none and none is given.
        """
        viewer = self.robot(name)
        laser = viewer.model.laser if lidar is None else lidar
        return measure(laser, viewer.pose, *self.scenery(name, laser), noise)

    def sweep(
        self, name: str, beam_time: float, noise: Floats | None = None, lidar: LidarModel | None = None
    ) -> tuple[Floats, Floats]:
        """As `scan`, of a laser that measures its first beam now and each further one `beam_time` [s] before: the ranges, and where the robot was at each beam (beams, 3).

        See `rosmini.sim.engine.sweep`. `trails.remember` has to have been told how long that takes altogether.
        """
        viewer = self.robot(name)
        return self._sweeps.scan(viewer, viewer.model.laser if lidar is None else lidar, beam_time, noise)

    def visible(self, name: str = "") -> list[Part]:
        """All that stands in the world now, but for its thin walls: parts with their poses in the frame map, each with the name of whose it is.

        What belongs to the robot `name` is left out: no camera sees its own robot.
        """
        found = [parts_of(o) for o in self.world.obstacles if o.fixed]
        found += [parts_of(crate.obstacle, crate.pose) for crate in self.contacts.crates if crate.shown]
        found += [parts_of(mover.obstacle, mover.pose) for mover in self.movers.values()]
        return found + [
            part for each in self.robots.values() if each.name != name for part in parts_of_robot(each)
        ]
