"""Everything that is and moves in an engine at one moment: plain data, which may be copied, pickled, and brought back."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from rosmini.geometry.poses import Pose
from rosmini.sim.models import RobotModel
from rosmini.sim.world import World

from .movers import Mover
from .trails import Leg

if TYPE_CHECKING:
    from .engine import Engine
    from .physics import RoverMemory, Surface


@dataclass(frozen=True)
class RobotState:
    """A robot: its model, its place, its wheels, and the generator of their slips."""

    name: str
    model: RobotModel
    state: dict[str, Any]


@dataclass(frozen=True)
class EngineState:
    """An engine: see `rosmini.sim.engine.Engine.state`."""

    now: float
    world: World
    noise: float
    step: float
    surface: Surface
    slips: float
    """When the wheels' slip changes next [s]."""
    moving: bool
    """Whether something that was pushed still moves."""
    robots: tuple[RobotState, ...]
    things: dict[str, tuple[Pose, tuple[float, float, float]]]
    """What is not fixed: where it is, and how fast it moves."""
    movers: dict[str, tuple[float, Pose, float, bool]]
    """What moves by itself: its clock, its place, its room, and whether it waits."""
    bodies: dict[str, RoverMemory]
    """What the bodies of robots have that may touch something."""
    trails: dict[str, tuple[Leg, ...]]
    """Where all were lately."""


def taken(engine: Engine) -> EngineState:
    """The state of an engine; see `rosmini.sim.engine.Engine.state`."""
    if engine.contacts.pruned:
        _rebuild(engine)
    things, bodies = engine.contacts.things(), engine.contacts.memory()
    engine.contacts.renew(things, {name: each.pose for name, each in engine.robots.items()}, bodies)
    return EngineState(
        now=engine.now,
        world=engine.world,
        noise=engine.noise,
        step=engine.step,
        surface=engine.contacts.surface,
        slips=engine.clockwork.slips,
        moving=engine.clockwork.moving,
        robots=tuple(RobotState(each.name, each.model, each.state()) for each in engine.robots.values()),
        things=things,
        movers={name: mover.state() for name, mover in engine.movers.items()},
        bodies=bodies,
        trails=engine.trails.state(),
    )


def bring_back(engine: Engine, state: EngineState) -> None:
    """Let an engine be as it was; see `rosmini.sim.engine.Engine.restore`."""
    there = {(each.name, each.model) for each in engine.robots.values()}
    same = there == {(each.name, each.model) for each in state.robots} and state.world is engine.world
    engine.now, engine.world, engine.noise, engine.step = state.now, state.world, state.noise, state.step
    old = dict(engine.robots)
    engine.robots.clear()
    for each in state.robots:
        robot = old.get(each.name)
        if robot is None or robot.model != each.model:
            robot = engine.make_robot(each.name, each.model, (0.0, 0.0, 0.0))
        robot.restore(each.state)
        engine.robots[each.name] = robot
    engine.clockwork.look_again()  # it forgets all room, which comes back below
    if not same or engine.contacts.pruned:
        _rebuild(engine)
    engine.tune(**asdict(state.surface))
    engine.contacts.renew(
        state.things, {name: each.pose for name, each in engine.robots.items()}, state.bodies
    )
    for each in state.robots:
        engine.robots[each.name].room = each.state["room"]
        engine.robots[each.name].clear = each.state["clear"]
    for name, mover in state.movers.items():
        engine.movers[name].restore(mover)
    engine.clockwork.slips, engine.clockwork.moving = state.slips, state.moving
    engine.clockwork.plan()
    engine.trails.restore(state.trails)
    engine.sights.forget(engine.world)
    engine.changed += 1


def _rebuild(engine: Engine) -> None:
    """Make all bodies anew, the fixed ones too."""
    things, surface = engine.contacts.things(), engine.contacts.surface
    engine.forget_bodies()
    engine.tune(**asdict(surface))
    engine.movers = {
        obstacle.name: engine.movers.get(obstacle.name) or Mover(obstacle, obstacle.motion)
        for obstacle in engine.world.obstacles
        if obstacle.motion is not None
    }
    for each in engine.robots.values():
        engine.embody(each)
    for name in engine.contacts.things().keys() & things.keys():
        engine.contacts.place(name, *things[name])
