"""Checks of the exercises in the chapter Simulation and Stage."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.core.geometry.poses import arc
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.sim.geometry.raycast import raycast

if TYPE_CHECKING:
    from rosmini.sim.stage import StageRobot, StageWorld


# ---- count_hits: what was hit ----


def _scan(ranges: list[float], low: float, high: float) -> Any:
    scan = LaserScan()
    scan.ranges = np.array(ranges, dtype=np.float32)
    scan.range_min, scan.range_max = low, high
    scan.angle_min, scan.angle_increment = -0.5, 0.1
    return scan


_SCANS = (
    ("of Stage, two of whose beams hit nothing", [5.0, 1.0, 2.5, 5.0], 0.0, 5.0, 2),
    ("of a TurtleBot3, with inf, -inf and 0.0", [math.inf, 1.0, -math.inf, 0.0, 3.4, 0.12], 0.12, 3.5, 3),
    ("with a range below range_min", [0.05, 0.5], 0.12, 3.5, 1),
    ("of Stage that contains 0.0, which is not a measurement", [0.0, 4.9, 5.0], 0.0, 5.0, 1),
    ("that hit nothing at all", [5.0, 5.0], 0.0, 5.0, 0),
)


@exercise("count_hits", praise="One test works for Stage, for REP 117, and for drivers that report 0.0.")
def count_hits(answer: Any) -> None:
    """The number of beams of a scan with a valid measurement."""
    for what, ranges, low, high, right in _SCANS:
        found = answer(_scan(ranges, low, high))
        if isinstance(found, bool) or not isinstance(found, int | np.integer):
            raise Wrong(f"It returned a {type(found).__name__}, not a whole number.", "return a number")
        expect(
            found == right,
            f"For a scan {what}, it counted {found}, not {right}: ranges {ranges}, range_min {low}, range_max {high}.",
            "count ranges of at least range_min, above 0 and below range_max",
        )


# ---- mole_world: a world file ----


def _loaded(text: str) -> StageWorld:
    from rosmini.sim.stage import StageError, load

    with TemporaryDirectory() as folder:
        path = Path(folder) / "mole.world"
        path.write_text(text, encoding="utf-8")
        try:
            return load(path)
        except StageError as error:
            raise Wrong(
                f"Stage cannot read it: {str(error).replace(folder, '').lstrip('/')}",
                "the number after the file name is the line number",
            ) from error


@exercise("mole_world", praise="Stage loads the world, and the mole is in front of its wall.")
def mole_world(answer: Any) -> None:
    """A Stage world with an omnidirectional robot and a wall."""
    expect_type(answer, str, "mole_world is", "a string")
    world = _loaded(answer)
    expect(
        len(world.robots) == 1,
        f"It contains {len(world.robots)} robots, not one.",
        "a model that drives is of type position",
    )
    _examine_robot(world.robots[0])
    _examine_wall(world)


def _examine_robot(robot: StageRobot) -> None:
    expect(robot.name == "mole", f"The robot is called {robot.name}, not mole.", 'write name "mole"')
    expect(robot.drive == "omni", f'Its drive is "{robot.drive}".', 'use drive "omni" for any direction')
    x, y, heading = robot.pose
    expect(
        math.dist((x, y), (1, 2)) < 0.01 and abs(math.remainder(heading - math.pi / 2, 2 * math.pi)) < 0.01,
        f"It starts at x {x:.2f} m, y {y:.2f} m with a heading of {math.degrees(heading):.0f} degrees.",
        "a pose is x, y, z and heading in degrees; 90 points along y",
    )
    expect(
        np.allclose(robot.size, (0.5, 0.5, 0.3), atol=0.001),
        f"Its size is {' x '.join(f'{part:g}' for part in robot.size)} m.",
        "the size is length, width and height",
    )
    expect(
        len(robot.lasers) == 1,
        f"It has {len(robot.lasers)} lasers, not one.",
        "put one ranger with a sensor into the robot",
    )
    laser = robot.lasers[0]
    expect(laser.samples == 91, f"Its laser has {laser.samples} beams, not 91.", "set samples")
    expect(
        abs(laser.fov - math.pi / 2) < 0.001,
        f"Its laser covers {math.degrees(laser.fov):.0f} degrees, not 90.",
        "set fov",
    )
    expect(abs(laser.range_max - 4) < 0.001, f"Its laser reaches {laser.range_max:g} m, not 4.", "use range [0 4]")
    expect(
        0.1 <= laser.height <= 0.2,
        f"Its laser is {laser.height:.2f} m above the ground, not between 0.1 and 0.2 m.",
        "a model inside another one is placed on top of it; a negative z lowers it",
    )


def _examine_wall(world: StageWorld) -> None:
    things = {thing.name: thing for thing in world.world.obstacles}
    expect("wall" in things, "There is no model called wall.", 'add model( name "wall" ... )')
    wall = things["wall"]
    expect(wall.fixed, "The wall can be pushed.", "remove gripper_return")
    expect(not wall.passable, "The mole can drive through the wall.", "remove obstacle_return")
    expect(
        abs(wall.height - 0.6) < 0.001,
        f"The wall is {wall.height:g} m high, not 0.6 m.",
        "the height is the third number of size",
    )
    segments, discs = world.world.segments, world.world.discs
    ahead = float(raycast(segments, discs, 1.0, 2.0, math.pi / 2, 0.1, 1, 10.0)[0])
    expect(
        abs(ahead - 1.5) < 0.005,
        "There is nothing in front of the mole."
        if math.isinf(ahead)
        else f"The obstacle in front of the mole is {ahead:.2f} m from its centre, not 1.50 m.",
        "the pose of the wall is that of its centre; subtract half of its thickness",
    )


# ---- world_velocity: a velocity of the world ----


@exercise("world_velocity", praise="The robot goes where it is asked to, whatever its heading.")
def world_velocity(answer: Any) -> None:
    """The Twist with which an omnidirectional robot has a given velocity in the world's frame."""
    for vx, vy, degrees in ((0.3, 0.0, 0), (0.3, 0.0, 90), (0.0, 0.4, 30), (-0.2, 0.1, 200)):
        a = math.radians(degrees)
        command = answer(vx, vy, a)
        expect(
            getattr(command, "_type", "") == "geometry_msgs/Twist",
            f"It returned a {type(command).__name__}, not a Twist.",
            "make a Twist(), set linear.x and linear.y, and return it",
        )
        v, aside = command.linear.x, command.linear.y
        gone = (math.cos(a) * v - math.sin(a) * aside, math.sin(a) * v + math.cos(a) * aside)
        expect(
            math.dist(gone, (vx, vy)) < 1e-6,
            f"Asked for ({vx}, {vy}) m/s, the robot with a heading of {degrees} degrees goes "
            f"({gone[0]:z.2f}, {gone[1]:z.2f}) m/s.",
            "draw the two axes of the robot, and project the velocity on each",
        )
        expect(abs(command.angular.z) < 1e-9, "Your robot turns.", "leave angular.z at 0")


# ---- belief: Stage's odometry ----


def _belief(v: float, w: float, seconds: float, e_x: float, e_a: float) -> tuple[float, float, float]:
    x, y, heading = arc((0.0, 0.0, 0.0), (1 + e_x) * v, (1 + e_a) * w, seconds)
    return float(x), float(y), float(heading)


@exercise("belief", praise="You predicted the estimate of Stage's robot without driving it.")
def belief(answer: Any) -> None:
    """The pose that a Stage robot with odometry errors estimates after one command."""
    cases = ((0.5, 0.5, 2.0, 0.1, 0.0), (0.5, 0.5, 2.0, 0.0, -0.1), (0.3, -0.4, 20.0, -0.05, 0.08))
    for given in (*cases, (0.4, 0.0, 5.0, 0.1, 0.2), (0.0, 1.0, 3.0, 0.1, 0.2)):
        found = answer(*given)
        right = _belief(*given)
        expect(
            isinstance(found, tuple | list | np.ndarray) and len(found) == 3,
            f"It returned {found!r}, not x, y and heading.",
            "return x, y, heading",
        )
        wrong = [name for name, a, b in zip(("x", "y", "heading"), found, right, strict=True) if not abs(a - b) < 1e-6]
        expect(
            not wrong,
            f"For v {given[0]}, w {given[1]}, {given[2]:.0f} s, e_x {given[3]} and e_a {given[4]}, this is wrong: "
            f"{' and '.join(wrong)}.",
            "it is an arc of radius v / w, with the errors in both; a straight line if w is 0",
        )
