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
asked for. Only where a robot touches something, or an obstacle slides, time is cut into steps of `STEP`, which are the same whoever asks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError, nearest
from rosmini.geometry.poses import Pose

from . import lidar
from .drive import limited, rim_speeds
from .models import RobotModel
from .odometry import SLIP_PERIOD, RealWheels
from .robot import Robot
from .world import Cylinder, Obstacle, World, WorldError, edges

if TYPE_CHECKING:
    from .physics import Contacts

Floats = NDArray[np.float64]

STEP = 0.005
"""How long one step of the physics is [s]."""

SAFE = 1e-4
"""From so near [m] on, a robot is looked at step by step."""

PLAY = 0.999
"""By this factor a footprint is smaller when it is asked whether there is room for it: 0.1 mm on each side of a Burger."""

EPSILON = 1e-9
"""Times that differ by less [s] are the same."""


class RobotGone(RosminiError):
    """A robot was asked for that is not, or no longer, in the world."""


class Engine:
    """A world with robots in it. Times are seconds since the engine was made.

    `rng(name)` returns the random generator for what is called `name`; with `noise` 0 the robots are those of the book, without errors, and
    between 0 and 1, or above, the errors are scaled.
    """

    def __init__(
        self, world: World, rng: Callable[[str], np.random.Generator], *, noise: float = 1.0
    ) -> None:
        self.world = world
        self.noise = noise
        self.now = 0.0
        self.robots: dict[str, Robot] = {}
        self._rng = rng
        self._slips = SLIP_PERIOD
        self._next_change = SLIP_PERIOD
        self._contacts: Contacts | None = None
        self._moving = False
        self._scenery: dict[float, tuple[Floats, Floats]] = {}

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

        Raises `WorldError`, which names what stands there, and `RosminiError` if there is a robot of this name.
        """
        if name in self.robots:
            msg = f"there is a robot {name!r} in the world {self.world.name!r} already; give the other one another name"
            raise RosminiError(msg)
        where = self._start(model) if pose is None else self._free(model, pose)
        robot = Robot(name, model, where, RealWheels(model, self._rng(f"{name}/wheels"), self.noise))
        self.robots[name] = robot
        self.contacts.add(name, model, where)
        self._look_again()
        return robot

    def remove(self, name: str) -> None:
        """Take a robot out of the world. Raises `RobotGone`."""
        self.robot(name)
        del self.robots[name]
        self.contacts.remove(name)
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
        """Lift a robot and put it down elsewhere, at rest; its odometry does not notice. Raises `WorldError` and `RobotGone`."""
        robot = self.robot(name)
        robot.pose = self._free(robot.model, pose, name)
        robot.left = robot.right = robot.left_target = robot.right_target = 0.0
        robot.expires = math.inf
        robot.touching = False
        self.contacts.move(name, robot.pose)
        self._look_again()

    def reset(self) -> None:
        """Put every robot and every obstacle back to where it began, with encoders at zero."""
        self.contacts.reset()
        for robot in self.robots.values():
            robot.stop()
            robot.pose = robot.start
            self.contacts.move(robot.name, robot.pose)
        self._look_again()

    def command(self, name: str, v: float, w: float, timeout: float = 0.0) -> None:
        """Tell a robot's wheels how to turn: v [m/s] ahead and w [rad/s] to the left, cut to what it can do.

        After `timeout` seconds without another command the robot stops; 0: never. Raises `RosminiError` for what is no finite number.
        """
        robot = self.robot(name)
        if not (math.isfinite(v) and math.isfinite(w)):
            msg = f"the robot {name!r} cannot go {v} m/s and {w} rad/s: both have to be finite"
            raise RosminiError(msg)
        model = robot.model
        v, w = limited(v, w, model.max_linear, model.max_angular)
        robot.left_target, robot.right_target = rim_speeds(v, w, model.wheel_separation)
        robot.expires = self.now + timeout if timeout else math.inf
        self._next_change = min([self._slips, *(robot.expires for robot in self.robots.values())])

    def _free(self, model: RobotModel, pose: Pose, name: str = "") -> Pose:
        if not all(math.isfinite(part) for part in pose):
            msg = f"a robot cannot be placed at {pose}: x, y and heading have to be finite numbers"
            raise WorldError(msg)
        hindrance = self._hindrance(model, pose, name)
        if hindrance is not None:
            x, y, theta = pose
            free = self.world.free_place(pose, model.footprint)
            hint = "" if free is None else f". There is room at ({free[0]:.2f}, {free[1]:.2f})"
            msg = (
                f"no robot can be placed at ({x:.2f}, {y:.2f}) with heading {theta:.2f} in the world {self.world.name!r}: "
                f"{hindrance} is in its way{hint}"
            )
            raise WorldError(msg)
        return (float(pose[0]), float(pose[1]), float(pose[2]))

    def _hindrance(self, model: RobotModel, pose: Pose, name: str = "") -> str | None:
        """Return what stands at `pose`, in words; None if a robot has room there."""
        self._tell_places()
        corners = np.array(model.footprint)
        middle = corners.mean(axis=0)
        within = middle + (corners - middle) * PLAY  # where a robot only touches, it may stand
        return self.world.blocked(pose, within) or self.contacts.hindrance(model, pose, name)

    def _start(self, model: RobotModel) -> Pose:
        for start in self.world.starts:
            if self._hindrance(model, start) is None:
                return start
        return self._free(model, self.world.starts[0])

    # -- time ----------------------------------------------------------------------------------------------------

    def advance(self, until: float) -> None:
        """Let time go on until then; what is over stays as it is."""
        while until - self.now > EPSILON:
            if until < self._next_change:
                self._go(until)
            else:
                self._go(self._next_change)
                self._changes()

    def _changes(self) -> None:
        """Let happen what is due now: commands that are too old, and the slip of the next second."""
        for robot in self.robots.values():
            if robot.expires - self.now <= EPSILON:
                robot.left_target = robot.right_target = 0.0
                robot.expires = math.inf
        if self._slips - self.now <= EPSILON:
            self._slips += SLIP_PERIOD
            for robot in self.robots.values():
                robot.wheels.slip()
        self._next_change = min([self._slips, *(robot.expires for robot in self.robots.values())])

    def _go(self, until: float) -> None:
        """Let time go on while nobody's mind changes."""
        if not self._moving:
            stuck = False
            rolled = []
            dt = until - self.now
            for robot in self.robots.values():
                before = robot.wheel_state()
                pose, moved = robot.roll(dt)
                rolled.append((robot, before, pose, moved))
                stuck = stuck or (moved > robot.room and moved > self._look(robot))
            if not stuck:
                for robot, _, pose, moved in rolled:
                    robot.settle()
                    robot.pose = pose
                    robot.room -= moved
                    robot.touching = False
                self.now = until
                return
            for robot, before, _, _ in rolled:
                robot.set_wheel_state(before)
        while until - self.now > EPSILON:
            grid = (math.floor(self.now / STEP + 1e-6) + 1) * STEP
            self._step(min(grid, until))

    def _step(self, until: float) -> None:
        """Let time go on by a step, with an eye on what touches."""
        dt = until - self.now
        ways, free = {}, not self._moving
        for robot in self.robots.values():
            if not robot.touching:
                robot.note()
            pose, moved = robot.roll(dt)
            robot.settle()
            ways[robot.name] = (robot.pose, pose)
            robot.room -= moved
            free = free and (robot.room > 0 or moved == 0)
        self.now = until
        if free:
            for name, (_, pose) in ways.items():
                self.robots[name].pose = pose
                self.robots[name].touching = False
            return
        self._tell_places()
        for name, (pose, touching) in self.contacts.step(ways, dt).items():
            self.robots[name].carried(pose, dt, touching=touching)
        moving = self.contacts.moving
        for robot in self.robots.values():
            if not robot.touching and not moving:
                self._look(robot)
        self._moving = moving

    # -- what is near --------------------------------------------------------------------------------------------

    def _look_again(self) -> None:
        """Forget how much room the robots have."""
        for robot in self.robots.values():
            robot.room = 0.0

    def _look(self, robot: Robot) -> float:
        """Measure, and return, how far a robot can move without touching anything."""
        self._tell_places()
        robot.room = self.contacts.room(robot.name) - SAFE
        return robot.room

    def _tell_places(self) -> None:
        """Tell the bodies where the robots are that have moved by themselves, and how fast these go."""
        for robot in self.robots.values():
            if not robot.touching:
                v, w = robot.seen
                theta = robot.pose[2]
                self.contacts.move(robot.name, robot.pose, (v * math.cos(theta), v * math.sin(theta), w))

    def _solid(self, height: float) -> tuple[Floats, Floats]:
        """The fixed segments (n, 4) and discs (m, 3) that are at least so high [m]."""
        if height not in self._scenery:
            world = self.world
            segments, discs = _parts([o for o in world.obstacles if not o.movable and o.height >= height])
            if world.wall_height >= height:
                segments = np.vstack([world.walls.reshape(-1, 4), segments])
            self._scenery[height] = (segments, discs)
        return self._scenery[height]

    def scenery(self, name: str) -> tuple[Floats, Floats]:
        """What the laser of this robot can see: segments (n, 4) and discs (m, 3), other robots among them, in the frame map."""
        robot = self.robot(name)
        height = robot.model.laser.mount[2]
        segments, discs = self._solid(height)
        movable = [o for o in self.contacts.obstacles() if o.height >= height]
        if movable:
            more_segments, more_discs = _parts(movable)
            segments, discs = np.vstack([segments, more_segments]), np.vstack([discs, more_discs])
        others = [_as_disc(other) for other in self.robots.values() if other is not robot]
        if others:
            discs = np.vstack([discs, others])
        return segments, discs

    def scan(self, name: str, noise: Floats | None = None) -> Floats:
        """The ranges (beams,) [m] that a robot's laser measures now; see `rosmini.sim.lidar.scan`."""
        robot = self.robot(name)
        return lidar.scan(robot.model.laser, robot.pose, *self.scenery(name), noise)

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The movable obstacles where they are now."""
        return self.contacts.obstacles()

    def peek(self, name: str, when: float) -> Pose:
        """Where a robot will be then, soon, without letting time go on: a look changes nothing of what happens.

        If something may be in its way until then, the answer is where it is now. Raises `RobotGone`.
        """
        robot = self.robot(name)
        if when <= self.now or when > self._next_change or self._moving:
            return robot.pose
        kept = robot.wheel_state()
        pose, moved = robot.roll(when - self.now)
        robot.set_wheel_state(kept)
        return pose if moved <= robot.room else robot.pose


def _as_disc(robot: Robot) -> tuple[float, float, float]:
    x, y, theta = robot.pose
    ahead = robot.model.laser.mount[0]
    return (x + ahead * math.cos(theta), y + ahead * math.sin(theta), robot.model.body_radius)


def _parts(obstacles: list[Obstacle]) -> tuple[Floats, Floats]:
    """The sides (n, 4) and the discs (m, 3) of obstacles where they stand."""
    sides = [edges(o.outline()) for o in obstacles if not isinstance(o.shape, Cylinder)]
    discs = [(*o.pose[:2], o.shape.radius) for o in obstacles if isinstance(o.shape, Cylinder)]
    return np.vstack([np.empty((0, 4)), *sides]), np.array(discs, dtype=float).reshape(-1, 3)
