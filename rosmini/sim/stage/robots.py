"""Positions of a Stage file, with what they carry: bases that drive, lasers and cameras.

Where a ranger sees from: with `stack_children` (the default) what is on a model stands on top of it, so a laser with
`pose [0.05 0 0 0]` on a robot 0.25 m high looks out 0.26 m above the ground (plus half of the sensor's own 2 cm),
over the heads of robots of the same kind. That they do not see each other is no error of the simulator: give the
laser a negative z.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from rosmini.sim.models import MOST_BEAMS, MOST_PIXELS

from .errors import Place, StageError
from .parse import Entity
from .things import Pose4, Thing, moved
from .values import Reader, Units

Bounds = tuple[float, float]
Drive = Literal["diff", "omni", "car"]

QUARTER = math.pi / 2

BASE = ("wheelbase", "velocity", "acceleration_bounds", "odom")
SENSOR_SIZE = (0.02, 0.02, 0.02)
CAMERA_RANGE, CAMERA_FOV, CAMERA_RESOLUTION = (0.2, 8.0), (70.0, 40.0), (32.0, 32.0)
LASER3_RANGE, LASER3_FOV, LASER3_SAMPLES = (0.0, 8.0), math.pi, 180
"""Of Stage 3's model `laser`."""


@dataclass(frozen=True)
class StageLaser:
    """A ranger: one fan of rays, equally far apart, the first and the last on the borders of its field of view."""

    pose: Pose4
    """Seen from the robot's pose; the rays come from `height` above the ground [m]."""
    height: float
    range_min: float
    range_max: float
    fov: float
    """[rad]"""
    samples: int
    noise: tuple[float, float]
    """Standard deviation of a range [m], and by which part of it at most it is wrong besides."""
    place: Place


@dataclass(frozen=True)
class StageCamera:
    """A camera, which also measures depth."""

    pose: Pose4
    """Seen from the robot's pose."""
    elevation: float
    """How high above the ground it is [m]."""
    width: int
    height: int
    fov: tuple[float, float]
    """Horizontal and vertical field of view [rad]."""
    near: float
    far: float
    pan: float
    """How far it is turned to the right of its pose [rad]: Stage's sense, against REP 103."""
    tilt: float
    """How far it looks down [rad]."""
    place: Place


@dataclass(frozen=True)
class StageRobot:
    """A position of a Stage file."""

    number: int
    """0 for the first one of the file."""
    name: str
    named: bool
    """Whether the file gives it this name."""
    pose: tuple[float, float, float]
    """Where it starts, in the world's frame."""
    size: tuple[float, float, float]
    drive: Drive
    wheelbase: float
    """Of a car [m]."""
    velocity_bounds: tuple[Bounds, Bounds, Bounds]
    """Least and largest speed ahead, to the left [m/s], and of turning [rad/s]."""
    localization: Literal["gps", "odom"]
    localization_origin: tuple[float, float, float]
    """The pose in the world where its odometry is 0."""
    odom_error: tuple[float | None, float | None, float | None]
    """The relative errors ahead, to the left and around; None: the file does not say, and it is drawn."""
    mass: float
    body: tuple[Thing, ...]
    """All that has a body: the base, and what it carries."""
    lasers: tuple[StageLaser, ...]
    cameras: tuple[StageCamera, ...]
    place: Place


def robot(thing: Thing, number: int, units: Units) -> StageRobot:
    """The robot that a position is. Raises `StageError`."""
    reader = thing.reader
    lasers, cameras, body = [], [], []
    for each in thing.family():
        if each.kind == "position" and each is not thing:
            raise StageError(
                each.place, "a position on another one is not simulated; give each a place of its own"
            )
        if each.kind in ("ranger", "laser", "camera") and not any(each is child for child in thing.children):
            units.note(each.place, "{} is not directly on a position: stageros does not find it", each.name)
        elif each.kind in ("ranger", "laser"):
            lasers.append(_laser(each, thing, units))
        elif each.kind == "camera":
            cameras.append(_camera(each, thing))
        if each.body is not None:
            body.append(each)
    x, y, _, a = thing.at
    origin = reader.several("localization_origin", "llla", thing.at)
    bounds = _bounds(reader)
    _notes(reader, units)
    wheelbase = reader.length("wheelbase", 1.0)
    if wheelbase <= 0:
        raise StageError(reader.place("wheelbase"), f"wheelbase is {wheelbase:g} m; it has to be more than 0")
    drive = reader.text("drive", "diff", ("diff", "omni", "car"))
    localization = reader.text("localization", "gps", ("gps", "odom"))
    return StageRobot(
        number=number,
        name=thing.name,
        named=thing.named,
        pose=(x, y, a),
        size=thing.size,
        drive=drive,  # type: ignore[arg-type]  # one of the choices
        wheelbase=wheelbase,
        velocity_bounds=bounds,
        localization=localization,  # type: ignore[arg-type]
        localization_origin=(origin[0], origin[1], origin[3]),
        odom_error=_odom_error(reader),
        mass=thing.mass or 1.0,
        body=tuple(body),
        lasers=tuple(lasers),
        cameras=tuple(cameras),
        place=thing.place,
    )


def _odom_error(reader: Reader) -> tuple[float | None, float | None, float | None]:
    """The odometry errors of a file. The turn's is an angle to Stage, in degrees like all angles of a file."""
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
    for name, (low, high) in zip(("ahead", "to the left", "of turning"), pairs, strict=True):
        if low > high:
            what = f"velocity_bounds: the speed {name} is from {low:g} to {high:g}; the second has to be more"
            raise StageError(reader.place("velocity_bounds"), what)
    return (pairs[0], pairs[1], pairs[2])


def _notes(reader: Reader, units: Units) -> None:
    if reader.find("acceleration_bounds") is not None:
        what = (
            "acceleration_bounds change nothing: stageros tells bases their velocity, which they have at once, as in "
            "Stage"
        )
        units.note(reader.place("acceleration_bounds"), what)
    if reader.find("odom") is not None:
        units.note(reader.place("odom"), "Stage no longer knows odom; see localization_origin")
    if reader.find("velocity") is not None:
        units.note(reader.place("velocity"), "a robot stands at first: its velocity is what cmd_vel says")
    if not reader.flag("obstacle_return", default=True):
        units.note(reader.place("obstacle_return"), "obstacle_return 0 changes nothing: robots are solid")


def _on(thing: Thing, base: Thing) -> Pose4:
    """Where a thing is, seen from the pose of its base, but its height, which is from the ground."""
    x, y, _, a = base.at
    c, s = math.cos(a), math.sin(a)
    dx, dy = thing.at[0] - x, thing.at[1] - y
    seen = (c * dx + s * dy, c * dy - s * dx, thing.at[2] - base.at[2], thing.at[3] - a)
    on_x, on_y, on_z, heading = (
        round(part, 12) + 0.0 for part in seen
    )  # without the last digits of turning there and back
    return (on_x, on_y, on_z, heading)


def _laser(thing: Thing, base: Thing, units: Units) -> StageLaser:
    if thing.kind == "laser":
        return _old_laser(thing, base, units)
    sensors = [child for child in thing.entity.children if child.kind == "sensor"]
    if not sensors:
        raise StageError(thing.place, f"the ranger {thing.name} has no sensor( ... ), so it measures nothing")
    if len(sensors) > 1:
        what = f"{{}} has {len(sensors)} sensors; stageros publishes the first alone"
        units.note(sensors[1].place, what, thing.name)
    return _sensor(sensors[0], thing, base, units)


def _sensor(entity: Entity, thing: Thing, base: Thing, units: Units) -> StageLaser:
    reader = Reader(entity, units)
    pose = reader.several("pose", "llla", (0.0, 0.0, 0.0, 0.0))
    size = reader.several("size", "lll", SENSOR_SIZE)
    low, high = reader.several("range", "ll", (0.0, 5.0))
    constant, part, _ = reader.several("noise", "lfa", (0.0, 0.0, 0.0))
    fov, samples = reader.angle("fov", 0.1), reader.whole("samples", 1, minimum=1)
    reader.done(("color", "color_rgba"))
    _check(reader, low, high, fov, samples)
    if constant < 0 or part < 0:
        raise StageError(reader.place("noise"), "noise cannot be negative")
    on = moved(_on(thing, base), thing.origin)
    mounted = moved(on, (pose[0], pose[1], pose[2], pose[3]))
    return StageLaser(
        mounted,
        base.at[2] + mounted[2] + size[2] / 2,
        low,
        high,
        fov,
        samples,
        (constant, part),
        entity.place,
    )


def _old_laser(thing: Thing, base: Thing, units: Units) -> StageLaser:
    """A laser of Stage 3, whose files are still about."""
    reader = thing.reader
    units.note(thing.place, "Stage 4 knows no laser; it is read as a ranger with one sensor")
    low = reader.length("range_min", LASER3_RANGE[0])
    high = reader.length("range_max", LASER3_RANGE[1])
    fov = reader.angle("fov", LASER3_FOV)
    samples = reader.whole("samples", LASER3_SAMPLES, minimum=1)
    _check(reader, low, high, fov, samples)
    on = moved(_on(thing, base), thing.origin)
    height = base.at[2] + on[2] + SENSOR_SIZE[2] / 2
    return StageLaser(on, height, low, high, fov, samples, (0.0, 0.0), thing.place)


def _check(reader: Reader, low: float, high: float, fov: float, samples: int) -> None:
    name = "range" if "range" in reader.entity.properties else "range_max"
    if low < 0 or high <= low:
        span = f"from {low:g} m to {high:g} m"
        what = f"a ranger measures {span}; the first has to be 0 or more, and the second more than it"
        raise StageError(reader.place(name), what)
    if not 0 <= fov <= 2 * math.pi + 1e-9:
        raise StageError(
            reader.place("fov"), f"fov is {math.degrees(fov):g} degrees; it has to be from 0 to 360"
        )
    if samples > MOST_BEAMS:
        raise StageError(
            reader.place("samples"), f"samples is {samples}; a ranger has {MOST_BEAMS} at the most"
        )


def _camera(thing: Thing, base: Thing) -> StageCamera:
    reader = thing.reader
    width, height = reader.several("resolution", "ff", CAMERA_RESOLUTION)
    if not (width >= 1 and height >= 1 and width == int(width) and height == int(height)):
        what = f"resolution is [{width:g} {height:g}]; a picture has whole numbers of pixels"
        raise StageError(reader.place("resolution"), what)
    if width * height > MOST_PIXELS:
        what = f"resolution is [{width:g} {height:g}]; a picture has {MOST_PIXELS} pixels at the most"
        raise StageError(reader.place("resolution"), what)
    horizontal, vertical = reader.several("fov", "ff", CAMERA_FOV)  # in degrees, whatever unit_angle says
    if not (0 < horizontal < 180 and 0 < vertical < 180):
        what = f"fov is [{horizontal:g} {vertical:g}] degrees; a camera sees more than 0 and less than 180"
        raise StageError(reader.place("fov"), what)
    near, far = reader.several("range", "ll", CAMERA_RANGE)
    if not 0 < near < far:
        raise StageError(
            reader.place("range"), f"range is [{near:g} {far:g}]; it has to be more than 0, and go up"
        )
    pan, tilt = reader.several("pantilt", "ff", (0.0, 0.0))
    fov = (math.radians(horizontal), math.radians(vertical))
    pose = moved(_on(thing, base), thing.origin)
    return StageCamera(
        pose,
        base.at[2] + pose[2],
        int(width),
        int(height),
        fov,
        near,
        far,
        math.radians(pan),
        math.radians(tilt),
        thing.place,
    )
