"""Position models of a Stage file, with the lasers that they carry.

Height of a ranger: with `stack_children` (the default) a child model stands on top of its parent, so a laser with
`pose [0.05 0 0 0]` on a robot 0.25 m high is 0.26 m above the ground (half of the sensor's own 2 cm is added),
above robots of the same kind. So they do not see each other, in Stage as well; give the
laser a negative z to change it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from rosmini.sim.models import MAX_BEAMS

from .errors import Place, StageError
from .parse import Entity
from .things import Pose4, Thing, moved
from .values import Reader, Units

Bounds = tuple[float, float]
Drive = Literal["diff", "omni"]

QUARTER = math.pi / 2

BASE = ("wheelbase", "velocity", "acceleration_bounds", "odom")
"""Properties without an effect: robots reach the velocity of a command at once, and are at rest initially."""
SENSOR_SIZE = (0.02, 0.02, 0.02)


@dataclass(frozen=True)
class StageLaser:
    """A ranger: one fan of equally spaced rays, the first and the last on the borders of its field of view."""

    pose: Pose4
    """Relative to the robot's pose; the rays start at `height` above the ground [m]."""
    height: float
    range_min: float
    range_max: float
    fov: float
    """[rad]"""
    samples: int
    noise: tuple[float, float]
    """Standard deviation of a range [m], and the maximum of an additional relative error."""
    place: Place


@dataclass(frozen=True)
class StageRobot:
    """A position model of a Stage file."""

    number: int
    """0 for the first one of the file."""
    name: str
    named: bool
    """True if the file gives it this name."""
    pose: tuple[float, float, float]
    """Its start in the world's frame."""
    size: tuple[float, float, float]
    drive: Drive
    velocity_bounds: tuple[Bounds, Bounds, Bounds]
    """Minimum and maximum speed ahead, to the left [m/s], and of turning [rad/s]."""
    localization: Literal["gps", "odom"]
    localization_origin: tuple[float, float, float]
    """The pose in the world at which its odometry is 0."""
    odom_error: tuple[float | None, float | None, float | None]
    """The relative errors ahead, to the left and in turns; None: not in the file, so it is drawn."""
    mass: float
    body: tuple[Thing, ...]
    """All models with a body: the base, and those it carries."""
    lasers: tuple[StageLaser, ...]
    place: Place


def robot(thing: Thing, number: int, units: Units) -> StageRobot:
    """Return the robot of a position model. Raises `StageError` for too many beams."""
    reader = thing.reader
    lasers: list[StageLaser] = []
    body: list[Thing] = []
    for each in thing.family():
        if each.kind == "position" and each is not thing:
            what = "the position {} is on another one: it is part of that robot here, and does not drive by itself"
            units.note(each.place, what, each.name, left_out="a position on another one")
        if each.kind == "ranger" and not any(each is child for child in thing.children):
            units.note(each.place, "{} is not directly on a position: stageros does not find it", each.name)
        elif each.kind == "ranger":
            lasers += _laser(each, thing, units)
        if each.body is not None:
            body.append(each)
    x, y, _, a = thing.at
    origin = reader.several("localization_origin", "llla", thing.at)
    bounds = _bounds(reader)
    drive = reader.text("drive", "diff", ("diff", "omni"))
    localization = reader.text("localization", "gps", ("gps", "odom"))
    return StageRobot(
        number=number,
        name=thing.name,
        named=thing.named,
        pose=(x, y, a),
        size=thing.size,
        drive=drive,  # type: ignore[arg-type]  # one of the choices
        velocity_bounds=bounds,
        localization=localization,  # type: ignore[arg-type]
        localization_origin=(origin[0], origin[1], origin[3]),
        odom_error=_odom_error(reader),
        mass=thing.mass or 1.0,
        body=tuple(body),
        lasers=tuple(lasers),
        place=thing.place,
    )


def _odom_error(reader: Reader) -> tuple[float | None, float | None, float | None]:
    """Return the odometry errors in a file. Stage treats the one of turns as an angle, in degrees as usual."""
    found = reader.find("odom_error")
    if found is None:
        return (None, None, None)
    ahead, left, _, turn = reader.several("odom_error", "fffa", (0.0, 0.0, 0.0, 0.0))
    said = len(found.values)
    return (ahead, left if said > 1 else None, turn if said > 3 else None)


def _bounds(reader: Reader) -> tuple[Bounds, Bounds, Bounds]:
    full = (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -QUARTER, QUARTER)
    found = reader.several("velocity_bounds", "llllllaa", full)
    pairs = [(found[i], found[i + 1]) for i in (0, 2, 6)]
    ahead, left, turn = ((min(pair), max(pair)) for pair in pairs)
    return (ahead, left, turn)


def _on(thing: Thing, base: Thing) -> Pose4:
    """Return a model's pose relative to its base, except its height, which is above the ground."""
    x, y, _, a = base.at
    c, s = math.cos(a), math.sin(a)
    dx, dy = thing.at[0] - x, thing.at[1] - y
    seen = (c * dx + s * dy, c * dy - s * dx, thing.at[2] - base.at[2], thing.at[3] - a)
    on_x, on_y, on_z, heading = (round(part, 12) + 0.0 for part in seen)  # rounding removes the errors of the rotations
    return (on_x, on_y, on_z, heading)


def _laser(thing: Thing, base: Thing, units: Units) -> list[StageLaser]:
    """Return the laser that stageros publishes for a ranger; none if it measures nothing."""
    sensors = [child for child in thing.entity.children if child.kind == "sensor"]
    if not sensors:
        what = "the ranger {} has no sensor( ... ), so it measures nothing and is left out"
        units.note(thing.place, what, thing.name, left_out="a ranger without sensors")
        return []
    if len(sensors) > 1:
        what = f"{{}} has {len(sensors)} sensors; stageros publishes the first alone"
        units.note(sensors[1].place, what, thing.name)
    return _sensor(sensors[0], thing, base, units)


def _sensor(entity: Entity, thing: Thing, base: Thing, units: Units) -> list[StageLaser]:
    reader = Reader(entity, units)
    pose = reader.several("pose", "llla", (0.0, 0.0, 0.0, 0.0))
    size = reader.several("size", "lll", SENSOR_SIZE)
    low, high = reader.several("range", "ll", (0.0, 5.0))
    constant, part, _ = reader.several("noise", "lfa", (0.0, 0.0, 0.0))
    fov, samples = reader.angle("fov", 0.1), reader.whole("samples", 1)
    reader.done(("color", "color_rgba"))
    if constant < 0 or part < 0:
        units.note(reader.place("noise"), "noise is negative; 0 is used")
    on = moved(_on(thing, base), thing.origin)
    mounted = moved(on, (pose[0], pose[1], pose[2], pose[3]))
    height = base.at[2] + mounted[2] + size[2] / 2
    noise = (max(constant, 0.0), max(part, 0.0))
    return _checked(StageLaser(mounted, height, low, high, fov, samples, noise, entity.place), reader, units)


def _checked(laser: StageLaser, reader: Reader, units: Units) -> list[StageLaser]:
    """Return the laser with valid numbers; none if it measures nothing. Raises `StageError` for too many beams."""
    if laser.samples < 1 or laser.range_max <= 0:
        what = f"a ranger of {laser.samples} samples up to {laser.range_max:g} m measures nothing and is left out"
        units.note(laser.place, what, left_out="a ranger that measures nothing")
        return []
    if laser.samples > MAX_BEAMS:
        most = f"a ranger has {MAX_BEAMS} samples at most"
        raise StageError(reader.place("samples"), f"samples is {laser.samples}; {most}", most)
    if not 0 <= laser.range_min < laser.range_max:
        span = f"from {laser.range_min:g} m to {laser.range_max:g} m"
        units.note(reader.place("range"), f"a ranger measures {span}; the first is taken for 0")
        laser = replace(laser, range_min=0.0)
    if abs(laser.fov) > 2 * math.pi + 1e-9:
        what = f"fov is {math.degrees(laser.fov):g} degrees; 360 is used, the most that is possible"
        units.note(reader.place("fov"), what)
        laser = replace(laser, fov=math.copysign(2 * math.pi, laser.fov))
    return [laser]
