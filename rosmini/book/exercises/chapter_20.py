"""What is right in the exercises of chapter 20, Simulation and Stage."""

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


# ---- 20.1: what was hit ----


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
    ("of Stage with a 0.0 in it, which is no measurement", [0.0, 4.9, 5.0], 0.0, 5.0, 1),
    ("that hit nothing at all", [5.0, 5.0], 0.0, 5.0, 0),
)


@exercise("20.1", praise="One test that does for Stage, for REP 117, and for drivers that say 0.0.")
def count_hits(answer: Any) -> None:
    """How many beams of a scan hit something that could be measured."""
    for what, ranges, low, high, right in _SCANS:
        found = answer(_scan(ranges, low, high))
        if isinstance(found, bool) or not isinstance(found, int | np.integer):
            raise Wrong(
                f"It returned a {type(found).__name__}, not a whole number.", "return how many they are"
            )
        expect(
            found == right,
            f"For a scan {what}, it counted {found}, not {right}: ranges {ranges}, range_min {low}, range_max {high}.",
            "from range_min on, more than 0, and less than range_max",
        )


# ---- 20.2: a world file ----


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
                "the number after the file is that of the line",
            ) from error


@exercise("20.2", praise="Stage reads it, and the mole stands before its wall.")
def mole_world(answer: Any) -> None:
    """A Stage world of a robot that goes in any direction, and a wall."""
    expect_type(answer, str, "mole_world is", "a text")
    world = _loaded(answer)
    expect(
        len(world.robots) == 1,
        f"There are {len(world.robots)} robots in it, not one.",
        "what drives is a position",
    )
    _examine_robot(world.robots[0])
    _examine_wall(world)


def _examine_robot(robot: StageRobot) -> None:
    expect(robot.name == "mole", f"The robot is called {robot.name}, not mole.", 'name "mole"')
    expect(robot.drive == "omni", f'Its drive is "{robot.drive}".', 'in any direction: "omni"')
    x, y, heading = robot.pose
    expect(
        math.dist((x, y), (1, 2)) < 0.01 and abs(math.remainder(heading - math.pi / 2, 2 * math.pi)) < 0.01,
        f"It starts at x {x:.2f} m, y {y:.2f} m and looks to {math.degrees(heading):.0f} degrees.",
        "x, y, z, heading; along y is 90 degrees, and a world file counts in degrees",
    )
    expect(
        np.allclose(robot.size, (0.5, 0.5, 0.3), atol=0.001),
        f"Its size is {' x '.join(f'{part:g}' for part in robot.size)} m.",
        "length, width, height",
    )
    expect(len(robot.lasers) == 1, f"It has {len(robot.lasers)} lasers, not one.", "a ranger with a sensor")
    laser = robot.lasers[0]
    expect(laser.samples == 91, f"Its laser has {laser.samples} beams, not 91.", "samples")
    expect(
        abs(laser.fov - math.pi / 2) < 0.001,
        f"Its laser looks over {math.degrees(laser.fov):.0f} degrees, not 90.",
        "fov",
    )
    expect(
        abs(laser.range_max - 4) < 0.001, f"Its laser reaches {laser.range_max:g} m, not 4.", "range [0 4]"
    )
    expect(
        0.1 <= laser.height <= 0.2,
        f"Its laser looks out {laser.height:.2f} m above the ground.",
        "what stands on a model stands on top of it; a negative z lets it down",
    )


def _examine_wall(world: StageWorld) -> None:
    things = {thing.name: thing for thing in world.world.obstacles}
    expect("wall" in things, "There is no model called wall.", 'model( name "wall" ... )')
    wall = things["wall"]
    expect(wall.fixed, "The wall can be pushed.", "leave gripper_return out")
    expect(not wall.passable, "The mole can drive through the wall.", "leave obstacle_return out")
    expect(abs(wall.height - 0.6) < 0.001, f"The wall is {wall.height:g} m high.", "the third number of size")
    segments, discs = world.world.segments, world.world.discs
    ahead = float(raycast(segments, discs, 1.0, 2.0, math.pi / 2, 0.1, 1, 10.0)[0])
    expect(
        abs(ahead - 1.5) < 0.005,
        "Nothing stands ahead of the mole."
        if math.isinf(ahead)
        else f"What stands ahead of the mole is {ahead:.2f} m from its middle, not 1.50 m.",
        "the pose of the wall is its middle; half of its thickness is nearer",
    )


# ---- 20.3: a velocity of the world ----


@exercise("20.3", praise="It goes north, whatever it looks at.")
def world_velocity(answer: Any) -> None:
    """The Twist for a velocity along the axes of the world, of a robot that goes in any direction."""
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
            f"Asked for ({vx}, {vy}) m/s, the robot that looks to {degrees} degrees goes "
            f"({gone[0]:z.2f}, {gone[1]:z.2f}) m/s.",
            "draw the two axes of the robot, and how much of the velocity lies along each",
        )
        expect(abs(command.angular.z) < 1e-9, "Your robot turns.", "leave angular.z at 0")


# ---- 20.4: Stage's odometry ----


def _belief(v: float, w: float, seconds: float, e_x: float, e_a: float) -> tuple[float, float, float]:
    x, y, heading = arc((0.0, 0.0, 0.0), (1 + e_x) * v, (1 + e_a) * w, seconds)
    return float(x), float(y), float(heading)


@exercise("20.4", praise="An arc, or a straight line: what Stage's robot believes, without driving it.")
def belief(answer: Any) -> None:
    """Where a robot of Stage with errors believes to be after one command."""
    cases = ((0.5, 0.5, 2.0, 0.1, 0.0), (0.5, 0.5, 2.0, 0.0, -0.1), (0.3, -0.4, 20.0, -0.05, 0.08))
    for given in (*cases, (0.4, 0.0, 5.0, 0.1, 0.2), (0.0, 1.0, 3.0, 0.1, 0.2)):
        found = answer(*given)
        right = _belief(*given)
        expect(
            isinstance(found, tuple | list | np.ndarray) and len(found) == 3,
            f"It returned {found!r}, not x, y and heading.",
            "return x, y, heading",
        )
        wrong = [
            name
            for name, a, b in zip(("x", "y", "heading"), found, right, strict=True)
            if not abs(a - b) < 1e-6
        ]
        expect(
            not wrong,
            f"For v {given[0]}, w {given[1]}, {given[2]:.0f} s, e_x {given[3]} and e_a {given[4]}, this is wrong: "
            f"{' and '.join(wrong)}.",
            "an arc of radius v / w, both with their errors; straight on if w is 0",
        )
