"""The engine: robots, movable obstacles and time, without a node.

>>> import numpy as np
>>> from rosmini.sim.models import BURGER
>>> from rosmini.sim.world import World
>>> engine = Engine(World("empty"), lambda name: np.random.default_rng(0), noise=0.0)
>>> robot = engine.add("burger", BURGER, (0.0, 0.0, 0.0))
>>> engine.command("burger", 0.2, 0.0)
>>> engine.advance(1.1)
>>> round(robot.pose[0], 9)
0.2

Bodies without contacts move in closed form; contacts are resolved on a fixed time grid. Queries and scans do not affect
the simulation, and a restored state continues with identical results: see `rosmini.sim.engine.stepper`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.sensors.lidar import scan as measure
from rosmini.sim.shapes import Part, reach_of
from rosmini.sim.world import Obstacle, World, WorldError

from .bodies import AT_REST, Surface, Velocity
from .contacts import Touch
from .cross_sections import obstacle_part, robot_parts
from .ground import Ground
from .instant import to_ns
from .laser_view import LaserView
from .odometry import RealWheels
from .population import Population
from .robot import Robot, make_robot
from .stepper import VIEW, Stepper
from .sweep import Sweeps
from .trails import Leg

Floats = NDArray[np.float64]

FOOTPRINT_SCALE = 0.999
"""Factor by which a footprint shrinks when searching for a free place: 0.1 mm on each side of a Burger."""


class RobotGone(RosminiError):
    """No robot or obstacle of this name is in the world, or it has been removed."""


@dataclass(frozen=True)
class RobotState:
    """A robot's name, its model, and its `state`, as returned by `Robot.state`."""

    name: str
    model: RobotModel
    state: dict[str, Any]


@dataclass(frozen=True)
class EngineState:
    """The state of an engine: see `rosmini.sim.engine.Engine.state`."""

    now_ns: int
    """The time [ns] since the engine began."""
    now: float
    """The same [s]."""
    world: World
    noise: float
    surface: Surface
    slips_ns: int
    """Time of the next change of the wheels' slip [ns]."""
    robots: tuple[RobotState, ...]
    things: dict[str, tuple[Any, ...]]
    """Poses and velocities of the obstacles that can be pushed or put elsewhere."""
    movers: dict[str, tuple[int, float, bool, int]]
    """For each mover: time of its last start or stop [ns], its clock then [s], whether it waits, and its pace."""
    forces: tuple[float, list[tuple[str, str, float]]]
    """Time until which they apply [ns], and for each pair of bodies the force between them [N]."""
    trails: dict[str, tuple[Leg, ...]]
    """Recent poses of all bodies."""


class Engine:
    """A world with robots in it. Times are in seconds since the engine was created.

    `rng(name)` returns the random generator of that name; `noise` scales the robots' errors (0: no errors).
    `world` has all obstacles at their initial poses; `obstacles` returns the movable ones at their current poses.
    """

    def __init__(self, world: World, rng: Callable[[str], np.random.Generator], *, noise: float = 1.0) -> None:
        self.noise = noise
        self._rng = rng
        self._population = Population()
        self.robots = self._population.robots
        """All robots, by name."""
        self.movers = self._population.movers
        """Obstacles that move by themselves."""
        self.contacts = self._population.contacts
        """The bodies of all robots and obstacles."""
        self.trails = self._population.trails
        """Recent poses of all bodies."""
        self._stepper = Stepper(self._population)
        self._load_world(world)
        self._sweeps = Sweeps(self._population, self.scan)
        for obstacle in world.obstacles:
            if not obstacle.fixed:
                self._population.add_obstacle_body(obstacle)
        self._stepper.invalidate_clearance()

    def _load_world(self, world: World) -> None:
        """Load a world with only its fixed obstacles."""
        self._world: World | None = world
        self._initial_world = world
        self._obstacles = {obstacle.name: obstacle for obstacle in world.obstacles}
        self._population.laser_view = LaserView(world)
        self.contacts.ground = Ground(world)
        for obstacle in world.obstacles:
            if obstacle.fixed:
                self.contacts.ground.insert(obstacle)

    @property
    def world(self) -> World:
        """The world with all obstacles that are in it now."""
        if self._world is None:
            self._world = self._initial_world.with_just(self._obstacles.values())
        return self._world

    @property
    def now(self) -> float:
        """The time [s] since the engine was created."""
        return self._population.now

    @property
    def laser_view(self) -> LaserView:
        """The cross-sections that lasers see."""
        return self._population.laser_view

    @property
    def changed(self) -> int:
        """Number of times a body was added, removed or put elsewhere."""
        return self._population.changed

    # -- robots --------------------------------------------------------------------------------------------------

    def add(self, name: str, model: RobotModel, pose: Pose | None = None) -> Robot:
        """Add a robot at `pose`, or at the first free start of the world if no pose is given.

        Raises `WorldError`, which names the obstacle in the way, and `RosminiError` if the name is taken.
        """
        self._check_name(name)
        where = self._start(model) if pose is None else self._free_pose(model, pose)
        return self._add_robot(name, model, where)

    def _add_robot(self, name: str, model: RobotModel, pose: Pose) -> Robot:
        new = self._make_robot(name, model, pose)
        self._population.record_leg(new)
        self._invalidate_near(pose, model.reach)
        return new

    def _make_robot(self, name: str, model: RobotModel, pose: Pose) -> Robot:
        wheels = RealWheels(model, self._rng(f"{name}/wheels"), self.noise)
        new = self.robots[name] = make_robot(name, model, pose, wheels, self._population.instant)
        self._population.add_robot_body(new)
        return new

    def _invalidate_near(self, pose: Pose, reach: float) -> None:
        """Invalidate the clearances near a body that was added, removed or put elsewhere."""
        self._population.changed += 1
        self._stepper.reset_clearances(self.contacts.near(pose[0], pose[1], reach + VIEW))

    def _check_name(self, name: str) -> None:
        if name in self.robots:
            kind = "a robot"
        elif name in self._obstacles:
            kind = "an obstacle"
        else:
            return
        world = self.world.name
        raise RosminiError(
            f"there is {kind} {name!r} in the world {world!r} already; give the new one a different name"
        )

    def remove(self, name: str) -> None:
        """Remove a robot, even while it moves. Raises `RobotGone`."""
        gone = self.robot(name)
        del self.robots[name]
        self.trails.forget(name)
        self.contacts.remove(name)
        self.laser_view.forget_viewer(name)
        self._invalidate_near(gone.pose, gone.model.reach)

    def robot(self, name: str) -> Robot:
        """Return the robot of this name. Raises `RobotGone`, with the names of the existing robots."""
        if name not in self.robots:
            there, hint = ", ".join(self.robots) or "none", nearest(name, self.robots)
            msg = f"there is no robot {name!r} in the world {self.world.name!r} (robots: {there}). {hint}"
            raise RobotGone(msg.rstrip())
        return self.robots[name]

    def place(self, name: str, pose: Pose) -> None:
        """Move a robot to a pose at once, where it is at rest; its encoders do not change.

        Raises `WorldError` and `RobotGone`.
        """
        self.robot(name)
        self.put(name, pose)

    def put(self, name: str, pose: Pose, velocity: Velocity = (0.0, 0.0, 0.0)) -> None:
        """Move a robot or an obstacle to a pose at once, with a velocity in the map frame [m/s, m/s, rad/s].

        The robot's command becomes zero, so it slows down as its drive allows. A robot on two wheels ignores a sideways
        velocity, a fixed obstacle any velocity. Raises `WorldError` if something is in the way or the obstacle moves by
        itself, and `RobotGone` for an unknown name.
        """
        if not all(math.isfinite(part) for part in (*pose, *velocity)):
            msg = f"{name!r} cannot be placed at {pose} with the velocity {velocity}: all numbers must be finite"
            raise WorldError(msg)
        if name not in self.robots:
            self._put_obstacle(self.obstacle(name), pose, velocity)
        else:
            robot = self.robots[name]
            where = self._free_pose(robot.model, pose, name)
            vx, vy, w = velocity
            c, s = math.cos(pose[2]), math.sin(pose[2])
            robot.launch(where, (c * vx + s * vy, c * vy - s * vx, w))
            self.trails.forget(name)
            self._population.record_leg(robot)
            if name in self.contacts.loose:
                self._put_loose(name, where, velocity)
            self._invalidate_near(where, robot.model.reach)

    def _put_loose(self, name: str, pose: Pose, velocity: Velocity = AT_REST) -> None:
        crate = self.contacts.loose[name]
        crate.put(pose, velocity if crate.obstacle.movable else AT_REST)
        self.contacts.update_cells(crate)

    def _put_obstacle(self, obstacle: Obstacle, pose: Pose, velocity: Velocity) -> None:
        if obstacle.motion is not None:
            msg = f"the obstacle {obstacle.name!r} moves by itself: take it away and insert another instead"
            raise WorldError(msg)
        obstruction = self._obstruction_of(replace(obstacle, pose=pose))
        if obstruction is not None:
            x, y, theta = pose
            where = f"({x:.2f}, {y:.2f}) with heading {theta:.2f}"
            msg = f"the obstacle {obstacle.name!r} cannot be placed at {where}: {obstruction} is in its way"
            raise WorldError(msg)
        if obstacle.movable:
            self.trails.forget(obstacle.name)
            self._put_loose(obstacle.name, pose, velocity)
            self._invalidate_near(pose, self.contacts.loose[obstacle.name].reach)
        else:
            self.remove_obstacle(obstacle.name)
            self._insert(replace(obstacle, pose=pose))

    def reset(self) -> None:
        """Return every robot and obstacle to its initial pose, with encoders at zero."""
        self.trails.clear()
        for crate in self.contacts.loose.values():
            self._put_loose(crate.obstacle.name, crate.obstacle.pose)
        for mover in self.movers.values():
            mover.start()
        for each in self.robots.values():
            each.stop(each.start)
        for moving in self._population.moving:
            self._population.record_leg(moving)
        self._population.changed += 1
        self._stepper.discard_clearances()

    def command(self, name: str, v: float, w: float, timeout: float = 0.0, *, vy: float = 0.0) -> None:
        """Command a velocity: v [m/s] ahead, w [rad/s] to the left, vy [m/s] to the left side, within its limits.

        After `timeout` seconds without another command the robot stops; 0: never. A robot on two wheels ignores vy.
        Raises `RosminiError` for a number that is not finite, and for any but a zero command to a robot without a
        drive.
        """
        robot = self.robot(name)
        if not math.isfinite(v + w + vy):
            aside = f", {vy} m/s to its side" if vy else ""
            msg = f"the robot {name!r} cannot go {v} m/s{aside} and {w} rad/s: both must be finite"
            raise RosminiError(msg)
        robot.command(v, vy, w)
        robot.expires_ns = self._population.instant.ns + to_ns(timeout) if timeout else math.inf
        self._stepper.commanded(robot)

    def _free_pose(self, model: RobotModel, pose: Pose, name: str = "") -> Pose:
        """Return `pose` as floats if the robot `name` has room there.

        Raises `WorldError`, with the nearest free position, if there is no room, and if a number is not finite.
        """
        if not all(math.isfinite(part) for part in pose):
            raise WorldError(f"a robot cannot be placed at {pose}: x, y and heading must be finite numbers")
        x, y, theta = map(float, pose)
        found = self.obstruction(model, pose, name)
        if found is not None:
            free = self.world.free_place(
                pose, model.footprint, model.height, lambda at: self.contacts.obstruction(model, at, name)
            )
            hint = "" if free is None else f". There is room at ({free[0]:.2f}, {free[1]:.2f})"
            where = f"({x:.2f}, {y:.2f}) with heading {theta:.2f} in the world {self.world.name!r}"
            raise WorldError(f"no robot can be placed at {where}: {found} is in its way{hint}")
        return x, y, theta

    def obstruction(self, model: RobotModel, pose: Pose, name: str = "") -> str | None:
        """Describe the object that occupies `pose`; None if a robot has room there."""
        corners = np.array(model.footprint)
        middle = corners.mean(axis=0)
        within = middle + (corners - middle) * FOOTPRINT_SCALE  # a robot may be placed where it only touches
        fixtures = self.contacts.ground.fixtures
        return fixtures.blocked(pose, within, model.height) or self.contacts.obstruction(model, pose, name)

    def _start(self, model: RobotModel) -> Pose:
        starts = self.world.starts
        free = (start for start in starts if self.obstruction(model, start) is None)
        return next(free, None) or self._free_pose(model, starts[0])

    # -- obstacles -----------------------------------------------------------------------------------------------

    def insert(self, obstacle: Obstacle) -> None:
        """Insert an obstacle at run time: fixed, movable, or moving by itself.

        Raises `RosminiError` if its name is taken, and `WorldError` if a robot or a body that is not fixed is in the
        way.
        """
        self._check_name(obstacle.name)
        obstruction = self._obstruction_of(obstacle)
        if obstruction is not None:
            where = "({:.2f}, {:.2f})".format(*obstacle.pose)
            raise WorldError(f"the obstacle {obstacle.name!r} cannot be moved to {where}: {obstruction} is in its way")
        self._insert(obstacle)

    def _obstruction_of(self, obstacle: Obstacle) -> str | None:
        return None if obstacle.passable else self.contacts.obstruction_of(obstacle, obstacle.at(0.0))

    def _insert(self, obstacle: Obstacle) -> None:
        self._obstacles[obstacle.name] = obstacle
        self._world = None
        self._population.add_obstacle_body(obstacle)
        self._invalidate_near(obstacle.pose, reach_of(obstacle.shape))

    def remove_obstacle(self, name: str) -> None:
        """Remove an obstacle at run time. Raises `RobotGone` for an unknown name."""
        gone, pose = self.obstacle(name), self.pose(name)
        del self._obstacles[name]
        self._world = None
        self.trails.forget(name)
        self.contacts.remove(name)
        self.movers.pop(name, None)
        self.laser_view.remove(name)
        self._invalidate_near(pose, reach_of(gone.shape))

    def obstacle(self, name: str) -> Obstacle:
        """Return the obstacle of this name as it was inserted. Raises `RobotGone`."""
        if name not in self._obstacles:
            hint, world = nearest(name, [*self._obstacles, *self.robots]), self._initial_world.name
            msg = f"there is nothing {name!r} in the world {world!r} that could be moved or taken away. {hint}"
            raise RobotGone(msg.rstrip())
        return self._obstacles[name]

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return the movable obstacles at their current poses, then those that move by themselves."""
        moving = (replace(mover.obstacle, pose=mover.pose) for mover in self.movers.values())
        return (*self.contacts.obstacles(), *moving)

    def pose(self, name: str) -> Pose:
        """Return the current pose of a robot or an obstacle. Raises `RobotGone`."""
        if name in self.robots:
            return self.robots[name].pose
        obstacle = self.obstacle(name)
        if name in self.movers:
            return self.movers[name].pose
        crate = self.contacts.loose.get(name)
        return obstacle.pose if crate is None else crate.pose

    def velocity(self, name: str) -> Velocity:
        """Return the current velocity of a robot or an obstacle in the map frame [m/s, m/s, rad/s].

        Raises `RobotGone`.
        """
        crate = self.contacts.loose.get(name)
        if crate is not None:
            return crate.velocity
        if name in self.robots:
            return self.robots[name].world_velocity()
        self.obstacle(name)
        return self.movers[name].velocity if name in self.movers else (0.0, 0.0, 0.0)

    def touching(self, name: str) -> list[Touch]:
        """Return the current contacts of a robot or a movable obstacle, with the forces. Raises `RobotGone`.

        The forces are those of the last step with a contact: of pushed obstacles, or of slipping wheels against
        an obstacle.
        """
        if name not in self.robots:
            obstacle = self.obstacle(name)
            if obstacle.fixed:
                raise RobotGone(f"the obstacle {name!r} is fixed: ask what moves what it touches")
        return self.contacts.touches(name)

    @property
    def surface(self) -> Surface:
        """Friction coefficients and gravity."""
        return self.contacts.surface

    def set_surface(self, **changes: float) -> None:
        """Change friction coefficients or gravity: see `rosmini.sim.engine.bodies.Surface`.

        Raises `WorldError` for a number that is negative or not finite.
        """
        for what, value in changes.items():
            if not (math.isfinite(value) and value >= 0):
                raise WorldError(f"{what} cannot be {value}; it must be a finite number, 0 or more")
        self.contacts.surface = replace(self.contacts.surface, **changes)

    # -- time ----------------------------------------------------------------------------------------------------

    def advance(self, until: float) -> None:
        """Advance time to `until` [s]; a time in the past has no effect."""
        ns = to_ns(until)
        if ns >= self._population.instant.ns:
            self._stepper.advance(ns)
            self._population.instant.seconds = max(self.now, until)

    def predict_pose(self, name: str, when: float) -> Pose:
        """Return a robot's pose at a time in the near future, without advancing time.

        Return its current pose if an object may be in its way by then. Raises `RobotGone`.
        """
        return self._stepper.predict_pose(self.robot(name), to_ns(when))

    def state(self) -> EngineState:
        """Return a state from which `restore` continues the simulation with identical results, to the last bit."""
        return EngineState(
            now_ns=self._population.instant.ns,
            now=self.now,
            world=self.world,
            noise=self.noise,
            surface=self.surface,
            slips_ns=self._stepper.slips_ns,
            robots=tuple(RobotState(each.name, each.model, each.state()) for each in self.robots.values()),
            things={name: crate.state() for name, crate in self.contacts.loose.items()},
            movers={name: mover.state() for name, mover in self.movers.items()},
            forces=self.contacts.forces,
            trails=self.trails.state(),
        )

    def restore(self, state: EngineState) -> None:
        """Restore a state, taken from this engine or another one.

        Robots that are not in the state are removed, missing ones are added again.
        """
        if state.world is not self.world:
            self._load_world(state.world)
        population, contacts = self._population, self.contacts
        contacts.clear()
        population.instant.ns, population.instant.seconds = state.now_ns, state.now
        self.noise, self._stepper.slips_ns = state.noise, state.slips_ns
        contacts.surface, contacts.forces = state.surface, state.forces
        self.movers.clear()
        for obstacle in self._obstacles.values():
            if not obstacle.fixed:
                self._population.add_obstacle_body(obstacle)
        for name, mover in state.movers.items():
            self.movers[name].restore(mover)
        old = dict(self.robots)
        self.robots.clear()
        for each in state.robots:
            robot = old.get(each.name)
            if robot is not None and robot.model == each.model:
                self.robots[each.name] = robot
                self._population.add_robot_body(robot)
            else:
                robot = self._make_robot(each.name, each.model, (0.0, 0.0, 0.0))
            robot.restore(each.state)
        for name, thing in state.things.items():
            contacts.loose[name].restore(thing)
            contacts.update_cells(contacts.loose[name])
        population.trails.restore(state.trails)
        population.changed += 1
        self._stepper.discard_clearances()

    # -- sensing -------------------------------------------------------------------------------------------------

    def scenery(self, name: str, lidar: LidarModel | None = None) -> tuple[Floats, Floats]:
        """Return the cross-section that a robot's laser can see, in the map frame: segments (n, 4) and discs (m, 3).

        It includes the other robots.
        """
        viewer = self.robot(name)
        return self.laser_view.of(
            lidar or viewer.model.laser,
            viewer,
            list(self.robots.values()),
            [crate for crate in self.contacts.crates if crate.shown],
            self.movers.values(),
            (self.now, self.changed),
        )

    def scan(self, name: str, noise: Floats | None = None, lidar: LidarModel | None = None) -> Floats:
        """Return the ranges (beams,) [m] that a laser on a robot measures now: its own laser, or `lidar`.

        See `rosmini.sim.sensors.lidar.scan`.

        Raises `RobotGone`, and `ModelError` if the robot has no laser and `lidar` is not given.
        """
        viewer = self.robot(name)
        laser = lidar or viewer.model.laser
        return measure(laser, viewer.pose, *self.scenery(name, laser), noise)

    def sweep(
        self, name: str, beam_time: float, noise: Floats | None = None, lidar: LidarModel | None = None
    ) -> tuple[Floats, Floats]:
        """Return the ranges of a sweeping laser, and the robot's pose at each beam (beams, 3).

        The first beam is measured now, each further one `beam_time` [s] earlier. Call `trails.remember` with the
        duration of a whole sweep beforehand. See `rosmini.sim.engine.sweep`.
        """
        viewer = self.robot(name)
        return self._sweeps.scan(viewer, viewer.model.laser if lidar is None else lidar, beam_time, noise)

    def visible(self, name: str = "") -> list[Part]:
        """Return all parts now in the world, except thin walls; each has a pose in the map frame and its owner's name.

        The parts of the robot `name` are left out, because a camera does not see its own robot.
        """
        found = [obstacle_part(o) for o in self.world.obstacles if o.fixed]
        found += [obstacle_part(crate.obstacle, crate.pose) for crate in self.contacts.crates if crate.shown]
        found += [obstacle_part(mover.obstacle, mover.pose) for mover in self.movers.values()]
        return found + [part for each in self.robots.values() if each.name != name for part in robot_parts(each)]
