"""Common properties of all models in a Stage file: name, pose, body, and visibility for sensors.

Defaults are those of Stage 4.3 (libstage's model.cc; https://player-stage-manual.readthedocs.io, "model").
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rosmini.sim.shapes import colour_problem

from .blocks import (
    EDGE,
    MAX_OUTLINES,
    MAX_PIXELS,
    TOO_MANY,
    Block,
    Body,
    Picture,
    block,
    frame,
    picture,
    square,
    stretched,
)
from .errors import Place, StageError
from .parse import Entity, Parsed, unknown_kind
from .tokens import find_file, searched
from .values import Reader, Units
from .x11_colours import colour, rgb, suggestion

Pose4 = tuple[float, float, float, float]
"""x, y, z [m] and heading [rad]."""

ORIGIN: Pose4 = (0.0, 0.0, 0.0, 0.0)

SIZES = {"ranger": (0.15, 0.15, 0.2), "fiducial": (0.1, 0.1, 0.1)}
SIZE = (0.4, 0.4, 1.0)
"""Size of models of other kinds [m]."""

COLOURS = {"ranger": "#000080"}
COLOUR = "red"

BODILESS = ("ranger", "fiducial")
"""Kinds without a body, unless they have blocks."""

SIMULATED = ("model", "position", "ranger")
LEFT_OUT = (
    "actuator", "blinkenlight", "blobfinder", "bumper", "camera", "fiducial", "gripper", "laser", "lightindicator",
    "loadcell", "puck", "speech", "wifi",
)  # fmt: skip
"""Kinds of Stage that are not simulated here."""

MASS = 10.0
"""Default mass of a model [kg]: the manual's number."""

UNUSED = (
    "alwayson", "blob_return", "ctrl", "debug", "event_queue", "fiducial_key", "fiducial_return", "friction",
    "give_watts", "gui_grid", "gui_move", "gui_nose", "gui_outline", "gravity_return", "joules", "joules_capacity",
    "kjoules", "kjoules_capacity", "laser_return", "map_resolution", "noblocks", "say", "take_watts",
    "trail_interval", "trail_length", "update_interval", "watts",
)  # fmt: skip
"""Properties of Stage that have no effect here."""


@dataclass
class Thing:
    """A model of the file."""

    entity: Entity
    kind: str
    name: str
    named: bool
    """True if the file gives it its name."""
    pose: Pose4
    """In the frame of its parent."""
    at: Pose4
    """In the world's frame."""
    size: tuple[float, float, float]
    origin: Pose4
    """Position of its body's centre relative to its pose."""
    body: Body | None
    colour: str
    solid: bool
    """True if it is solid."""
    seen: float
    """Its reflectance for rangers; below 0 they see through it."""
    pushable: bool
    mass: float
    reader: Reader
    children: list[Thing] = field(default_factory=list)

    @property
    def place(self) -> Place:
        """Its line in the file."""
        return self.entity.place

    def family(self) -> Iterator[Thing]:
        """Yield it and all models on it."""
        yield self
        for child in self.children:
            yield from child.family()


def moved(frame_pose: Pose4, pose: Pose4) -> Pose4:
    """Transform `pose` from a frame with the pose `frame_pose` to the world's frame."""
    x, y, z, a = frame_pose
    c, s = math.cos(a), math.sin(a)
    return (x + c * pose[0] - s * pose[1], y + s * pose[0] + c * pose[1], z + pose[2], a + pose[3])


class Maker:
    """Makes the models of one file."""

    def __init__(self, parsed: Parsed, units: Units) -> None:
        self.parsed = parsed
        self.units = units
        self._counts: Counter[str] = Counter()
        self._pictures: dict[Path, Picture] = {}
        self._traced: int | None = None
        """Number of outlines of the bitmaps so far, without the first, which is usually the floor plan."""

    def things(self) -> list[Thing]:
        """Return the models of the world, with their children. Raises `StageError`."""
        made = (self.thing(each, None) for each in self.parsed.root.children if each.kind != "window")
        return [thing for thing in made if thing is not None]

    def thing(self, entity: Entity, parent: Thing | None) -> Thing | None:
        """Return a model; None if nothing of it is simulated."""
        if entity.kind in LEFT_OUT:
            article = "an" if entity.kind[0] in "aeiou" else "a"
            what = f"{article} {entity.kind}"
            self.units.note(entity.place, f"{what} is not simulated and is left out", left_out=what)
            return None
        if entity.kind not in SIMULATED:
            raise unknown_kind(entity, (*SIMULATED, *LEFT_OUT, "window"), self.parsed.macros)
        thing = self._plain(entity, parent)
        for child in entity.children:
            if child.kind not in ("block", "sensor") and (made := self.thing(child, thing)) is not None:
                thing.children.append(made)
        return thing

    def _plain(self, entity: Entity, parent: Thing | None) -> Thing:
        reader = Reader(entity, self.units)
        kind = entity.kind
        pose = _pose(reader, "pose")
        at = pose
        if parent is not None:
            at = moved(parent.at, pose)
            if parent.reader.flag("stack_children", default=True):
                at = (at[0], at[1], at[2] + parent.size[2], at[3])
        reader.flag("stack_children", default=True)
        origin = _pose(reader, "origin")
        size = self._size(reader, SIZES.get(kind, SIZE))
        return Thing(
            entity=entity,
            kind=kind,
            name=reader.text("name", self._name(entity, parent)),
            named="name" in entity.properties,
            pose=pose,
            at=at,
            size=size,
            origin=origin,
            body=self._body(reader, kind, size),
            colour=self._colour(reader, COLOURS.get(kind, COLOUR)),
            solid=reader.flag("obstacle_return", default=True),
            seen=reader.number("ranger_return", 1.0),
            pushable=reader.flag("gripper_return", default=False),
            mass=reader.number("mass", MASS, minimum=0.0),
            reader=reader,
        )

    def _name(self, entity: Entity, parent: Thing | None) -> str:
        """Return Stage's default name: that of the parent, the kind, and the number of earlier ones of this kind."""
        prefix = f"{parent.name}." if parent else ""
        number = self._counts[f"{prefix}{entity.kind}"]
        self._counts[f"{prefix}{entity.kind}"] += 1
        return f"{prefix}{entity.kind}:{number}"

    def _size(self, reader: Reader, default: tuple[float, float, float]) -> tuple[float, float, float]:
        found = reader.several("size", "lll", default)
        x, y, z = (max(abs(part), EDGE) for part in found)
        if min(found) < EDGE:
            what = f"each side of a size is {EDGE:g} m or more here: {found[0]:g} {found[1]:g} {found[2]:g} becomes"
            self.units.note(reader.place("size"), f"{what} {x:g} {y:g} {z:g}")
        return (x, y, z)

    def _colour(self, reader: Reader, default: str) -> str:
        name = reader.text("color", default)
        if reader.find("color_rgba") is not None and reader.find("color") is None:
            red, green, blue, _ = reader.several("color_rgba", "ffff", (1.0, 0.0, 0.0, 1.0))
            return rgb(red, green, blue)
        if name == "random":
            self.units.note(reader.place("color"), "a random colour is grey here, the same on each run")
            return "grey"
        found = name if name.startswith("#") and not colour_problem(name) else colour(name)
        if found is None:
            hint = suggestion(name, self.units.hint)
            what = f'there is no colour "{name}" among those of X11, so it is red, as in Stage'
            self.units.note(
                reader.place("color"),
                f"{what}{'; ' + hint if hint else ''}",
                unquoted="the colour is not among those of X11, so it is red, as in Stage",
            )
            return rgb(1.0, 0.0, 0.0)
        return found

    # -- bodies --------------------------------------------------------------------------------------------------

    def _body(self, reader: Reader, kind: str, size: tuple[float, float, float]) -> Body | None:
        entity = reader.entity
        blocks = [child for child in entity.children if child.kind == "block"]
        own = tuple(found for child in blocks if (found := self._block(child)) is not None)
        bitmap = reader.text("bitmap", "")
        boundary = frame(size) if reader.flag("boundary", default=False) else ()
        if bitmap:
            shown = self._picture(bitmap, reader.place("bitmap"))
            if shown.odd and not boundary:
                self.units.note(reader.place("bitmap"), shown.odd)
            plan = stretched(shown.blocks, size, shown.box)
            if own:
                every = stretched((*plan, *own), size)
                plan, boundary = every[: len(plan)], (*boundary, *every[len(plan) :])
            if not plan:
                return Body((), boundary=boundary) if boundary else None
            return Body(plan, traced=True, boundary=boundary)
        if blocks:
            return Body(stretched(own, size), boundary=boundary) if own or boundary else None
        if kind in BODILESS or reader.flag("noblocks", default=False):
            return Body((), boundary=boundary) if boundary else None
        return Body(stretched((square(),), size), boundary=boundary)

    def _block(self, entity: Entity) -> Block | None:
        """Return a block; None if it encloses nothing."""
        reader = Reader(entity, self.units)
        count = reader.whole("points", 0, minimum=0)
        count = min(count, len(entity.properties) + 1)  # one missing point is enough for the note
        missing = [i for i in range(count) if f"point[{i}]" not in entity.properties]
        if missing:
            what = f"a block has no point[{missing[0]}]; as in Stage, [0 0] is used"
            self.units.note(reader.place("points"), what)
        points = [reader.several(f"point[{i}]", "ll", (0.0, 0.0)) for i in range(count)]
        bottom, top = reader.several("z", "ll", (0.0, 1.0))
        reader.done(("color", "color_rgba"))
        found, odd = block(np.array(points, dtype=float).reshape(-1, 2), bottom, top)
        if odd:
            self.units.note(entity.place, odd, left_out="" if found else "a block that encloses nothing")
        return found

    def _picture(self, name: str, place: Place) -> Picture:
        path = find_file(name, self.parsed.path, place.path)
        if path is None:
            where = searched(self.parsed.path, place.path)
            raise StageError(place, f'there is no bitmap "{name}" {where}', f"there is no such bitmap {where}")
        if path not in self._pictures:
            room = MAX_PIXELS - sum(each.pixels for each in self._pictures.values())
            self._pictures[path] = picture(path, place, room)
        found = self._pictures[path]
        self._traced = 0 if self._traced is None else self._traced + len(found.blocks)
        if self._traced > MAX_OUTLINES:
            raise StageError(place, TOO_MANY, TOO_MANY)
        return found


def _pose(reader: Reader, name: str) -> Pose4:
    x, y, z, a = reader.several(name, "llla", ORIGIN)
    return (x, y, z, a)
