"""Loads a Stage world file as a world with robots.

Supported are include, define, units, `resolution`, `interval_sim`, `speedup`, `paused`, `quit_time`, and
the models `model`, `position` and `ranger` with blocks, bitmaps and boundaries.
Models with `gripper_return 1` can be pushed; lasers see models with `obstacle_return 0`, and robots drive through them.
The file is read as leniently as by Stage. `StageWorld.notes` lists everything that is left out or read differently,
with file and line; an error in Stage is a `StageError` here, also with file and line.
"""

from __future__ import annotations

import os
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rosmini.core.files import exists, is_file
from rosmini.core.geometry.polygons import sides_of
from rosmini.core.packages import PackageIndex
from rosmini.sim.shapes import Compound
from rosmini.sim.world import Obstacle, World, WorldError

from .blocks import Block
from .errors import Place, StageError
from .parse import Parsed, parse_file
from .robots import BASE, StageRobot, robot
from .solids import Solid, filled, placed, solid
from .things import MASS, UNUSED, Maker, Thing
from .tokens import expanded
from .values import Reader, units_of

SCHEME = "package://"
DEFAULT_RESOLUTION = 0.02
DEFAULT_INTERVAL = 0.1
"""Duration of a simulation step [s]."""

MAX_ROBOTS = 1000

WORLD = ("name", "resolution", "interval_sim", "speedup", "paused", "quit_time", "unit_length", "unit_angle")
IGNORED = ("interval_real", "show_clock", "show_clock_interval", "threads", "gui_disable", "gui_interval", "test")
KNOWN = {
    "model": (),
    "position": (*BASE, "drive", "localization", "localization_origin", "odom_error", "velocity_bounds"),
    "ranger": ("samples", "fov", "range"),
}


@dataclass(frozen=True)
class StageWorld:
    """A world file: the world without its robots, the robots, and the settings of time."""

    name: str
    path: Path
    world: World
    robots: tuple[StageRobot, ...]
    interval: float
    """Duration of a step [s]; all topics are published once per step."""
    speedup: float
    """Simulated seconds per second."""
    paused: bool
    """True if Stage's window starts paused; stageros here has no window and runs."""
    quit_time: float
    """Time at which the simulation ends [s]; 0: never."""
    resolution: float
    """Resolution of Stage's raytracing [m]; here rays are exact."""
    notes: tuple[str, ...]
    """Everything that is left out or read unexpectedly, each with file and line."""
    left_out: dict[str, int]
    """Short descriptions of what is left out, with their counts."""


def load(path: str | os.PathLike[str]) -> StageWorld:
    """Read a Stage world file: a path or a `package://` address. Raises `StageError`, with file and line."""
    text = os.fspath(path)
    file = Path(PackageIndex().resolve(text)) if text.startswith(SCHEME) else expanded(text)
    if not is_file(file):
        raise StageError(Place(file, 1), "there is no such file" if not exists(file) else "this is no file")
    return _World(parse_file(file)).make()


class _World:
    """Builds the world of a file."""

    def __init__(self, parsed: Parsed) -> None:
        self.parsed = parsed
        self.units = units_of(parsed.root)
        for place, what in parsed.notes:
            self.units.note(place, what)
        self.names: Counter[str] = Counter()
        self.walls: list[tuple[Thing, NDArray[np.float64]]] = []
        self.obstacles: list[Obstacle] = []
        self.robots: list[StageRobot] = []

    def make(self) -> StageWorld:
        parsed, units = self.parsed, self.units
        reader = Reader(parsed.root, units)
        name = reader.text("name", parsed.path.stem)
        interval = reader.number("interval_sim", DEFAULT_INTERVAL * 1e3, above=0.0) / 1e3
        speedup = self._speedup(reader)
        things = Maker(parsed, units).things()
        for thing in things:
            self._add_model(thing)
        for thing in things:
            for each in thing.family():
                each.reader.done((*UNUSED, *KNOWN[each.kind]))
        resolution = reader.length("resolution", DEFAULT_RESOLUTION)
        if resolution <= 0:
            what = f"resolution is {resolution:g}; {DEFAULT_RESOLUTION:g} is used"
            units.note(reader.place("resolution"), what)
            resolution = DEFAULT_RESOLUTION
        made = StageWorld(
            name=name,
            path=parsed.path,
            world=self._note_starts(self._world(name)),
            robots=tuple(self.robots),
            interval=interval,
            speedup=speedup,
            paused=reader.flag("paused", default=False),
            quit_time=reader.number("quit_time", 0.0, minimum=0.0),
            resolution=resolution,
            notes=(),
            left_out={},
        )
        reader.done((*WORLD, *IGNORED))
        return replace(made, notes=units.notes, left_out=dict(units.left_out))

    def _speedup(self, reader: Reader) -> float:
        speedup = reader.number("speedup", 1.0)
        if speedup > 0:
            return speedup
        what = "a speedup of 0 or less is as fast as can be in Stage's window; here it is 1"
        self.units.note(reader.place("speedup"), what)
        return 1.0

    def _add_model(self, thing: Thing) -> None:
        """Add a top-level model to the world."""
        if thing.kind == "position":
            if len(self.robots) == MAX_ROBOTS:
                raise StageError(thing.place, f"there are more than {MAX_ROBOTS} robots in this world")
            self.robots.append(robot(thing, len(self.robots), self.units))
            return
        for each in thing.family():
            if each.kind == "position":
                what = "the position {} is on a model, so it does not drive here; give it a place of its own"
                self.units.note(each.place, what, each.name, left_out="a position on a model")
            if each.kind == "ranger":
                self.units.note(each.place, "{} is on no position: stageros does not find it", each.name)
        bodies = [each for each in thing.family() if each.body is not None]
        if thing.pushable and thing.solid:
            self._add_movable(thing, bodies)
            return
        for each in bodies:
            self._add_fixed(each)

    def _add_fixed(self, thing: Thing) -> None:
        """Add a fixed model."""
        body = thing.body
        if body is None or not self._has_effect(thing):
            return
        blocks = body.blocks
        if body.traced and solid(thing, blocks[0]).bottom <= 0 and not self.walls:
            corners = [placed(thing, each) for each in blocks]
            self.walls.append((thing, np.vstack([sides_of(loop) for loop in corners])))
            blocks = ()
        else:
            blocks = self._filled(thing)
        for each in (*blocks, *body.boundary):
            self._obstacle(thing, each)

    def _add_movable(self, thing: Thing, bodies: list[Thing]) -> None:
        """Add a model that can be pushed, with all models on it."""
        blocks: list[tuple[Thing, Block]] = []
        for each in bodies:
            if each.body is not None and self._has_effect(each):
                blocks += [(each, one) for one in (*self._filled(each), *each.body.boundary)]
        if not blocks:
            return
        mass = thing.mass
        if mass <= 0:
            what = f"{{}} can be pushed, so its mass must be more than 0; {MASS:g} kg are used"
            self.units.note(thing.reader.place("mass"), what, thing.name)
            mass = MASS
        solids = [solid(owner, each) for owner, each in blocks]
        low, high = min(each.bottom for each in solids), max(each.top for each in solids)
        if high <= 0:
            self.units.note(thing.place, "{} is below the ground and is left out", thing.name)
        elif len(solids) == 1:
            self._add(thing, solids[0], mass)
        else:
            pose = (thing.at[0], thing.at[1], thing.at[3])
            parts = Compound(tuple(each.seen_from(pose) for each in solids))
            self._add(thing, Solid(parts, pose, low, high), mass)

    def _has_effect(self, thing: Thing) -> bool:
        """Return True if robots collide with the model or lasers see it; add a note otherwise."""
        if thing.solid or thing.seen >= 0:
            return True
        what = "nothing bumps into {} and no laser sees it: it is left out"
        self.units.note(thing.place, what, thing.name, left_out="a thing that nothing touches or sees")
        return False

    def _filled(self, thing: Thing) -> tuple[Block, ...]:
        """Return the outer blocks of a model's body; add a note if they had hollow parts, which are filled."""
        found, holes = filled(thing)
        if holes:
            what = f"of the bitmaps of a world one may have rooms in it; {holes} hollow parts of {{}} are filled"
            self.units.note(thing.reader.place("bitmap"), what, thing.name)
        return found

    def _obstacle(self, thing: Thing, block: Block) -> None:
        found = solid(thing, block)
        if found.top <= 0:
            self.units.note(thing.place, "{} is below the ground and is left out", thing.name)
            return
        self._add(thing, found)

    def _add(self, thing: Thing, what: Solid, mass: float | None = None) -> None:
        """Add a solid of a model to the world; without a mass it is fixed."""
        count = self.names[thing.name]
        self.names[thing.name] += 1
        name = thing.name if not count else f"{thing.name} ({count + 1})"
        try:
            found = Obstacle(
                name,
                what.shape,
                what.pose,
                height=what.top,
                bottom=what.bottom,
                colour=thing.colour,
                mass=mass,
                passable=not thing.solid,
                seen_by_lasers=thing.seen >= 0,
            )
        except WorldError as error:
            raise StageError(thing.place, str(error)) from error
        self.obstacles.append(found)

    def _note_starts(self, world: World) -> World:
        """Return the same world after adding notes for robots that start outside it."""
        for each in self.robots:
            outside = world.outside(each.pose)
            if outside:
                self.units.note(each.place, f"{{}} starts outside: {outside}", each.name)
        return world

    def _world(self, name: str) -> World:
        starts = tuple(each.pose for each in self.robots) or ((0.0, 0.0, 0.0),)
        title = f"The Stage world {name}"
        if not self.walls:
            return World(name, tuple(self.obstacles), starts=starts, title=title)
        thing, walls = self.walls[0]
        top = thing.at[2] + thing.size[2]
        return World(
            name,
            tuple(self.obstacles),
            walls=walls,
            wall_height=top,
            starts=starts,
            title=title,
            solid=True,
            passable_walls=not thing.solid,
        )
