"""Checks of the exercises in the chapter TurtleBot3."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import Wrong, exercise, expect, expect_number
from rosmini.core.graph import Graph
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.ros.scripts import rosrun

if TYPE_CHECKING:
    from rosmini.sim.simulator import Simulator


def _robot(graph: Graph, *parameters: str) -> Simulator:
    found: Simulator = rosrun("rosmini_sim", "simulator", "_world:=empty", *parameters, graph=graph).instance()
    return found


# ---- circle: a circle ----


def _driven(command: Any, seconds: float) -> list[tuple[float, float, float]]:
    """Return the poses after 0, 0.1 ... s of a robot without errors that receives this command ten times a second."""
    with Graph() as graph:
        sim = _robot(graph, "_noise:=0")
        cmd_vel = graph.node("driver").publisher("cmd_vel", type(command), queue_size=1)
        cmd_vel.wait_for_subscribers()
        way = [sim.truth()]
        for _ in range(round(10 * seconds)):
            cmd_vel.publish(command)
            graph.run(0.1)
            way.append(sim.truth())
    return way


@exercise(
    "circle", praise="A robot without errors drove your circles: each has the right size and ends where it started."
)
def circle(answer: Any) -> None:
    """The command for a circle to the left with a given radius and duration."""
    for radius, seconds in ((0.5, 20.0), (0.2, 10.0)):
        asked = f"For a radius of {radius} m in {seconds:.0f} s"
        command = answer(radius, seconds)
        expect(
            getattr(command, "_type", "") == "geometry_msgs/Twist",
            f"It returned a {type(command).__name__}, not a Twist.",
            "make a Twist(), set linear.x and angular.z, and return it",
        )
        v, w = command.linear.x, command.angular.z
        expect(w > 0, f"{asked} the robot does not turn to the left.", "left turns have positive angular.z")
        expect(
            v <= 0.22 and w <= 2.84,
            f"{asked} you request {v:.2f} m/s and {w:.2f} rad/s, which is more than the robot's maximum.",
            "a circle of this size needs lower speeds; angles are in radians",
        )
        way = _driven(command, seconds)
        across = max(y for _, y, _ in way)
        expect(
            abs(across / 2 - radius) < 0.02 * radius,
            f"{asked} the robot drove on a circle of radius {across / 2:.2f} m.",
            "the radius is v / w",
        )
        expect(
            math.dist(way[-1][:2], way[0][:2]) < 0.05 * radius,
            f"{asked} the robot turned by {math.degrees(way[-1][2]):.0f} degrees, not by 360.",
            "a full circle is 2 pi, and w is the part of it that the robot turns in a second",
        )


# ---- front_distance: what is in front ----


def _scan(ranges: Any, first: float = 0.0) -> Any:
    """Return a scan of a full turn whose first beam points at `first` [rad]."""
    scan = LaserScan()
    scan.ranges = np.asarray(ranges, dtype=np.float32)
    scan.angle_min, scan.angle_increment = first, 2 * math.pi / len(ranges)
    scan.angle_max = first + scan.angle_increment * (len(ranges) - 1)
    scan.range_min, scan.range_max = 0.12, 3.5
    return scan


@exercise("front_distance", praise="Your function works with any laser, because it reads the angles from the message.")
def front_distance(answer: Any) -> None:
    """The shortest valid range within an angle of straight ahead."""

    def far(**at: float) -> Any:
        ranges = np.full(360, 3.0)
        for beam, value in at.items():
            ranges[int(beam[1:])] = value
        return ranges

    wide = math.radians(30)
    shown = (
        (_scan(far(b10=0.8)), wide, 0.8, "an obstacle 10 degrees to the left", "angles in radians"),
        (
            _scan(far(b350=0.7)),
            wide,
            0.7,
            "an obstacle 10 degrees to the right",
            "beam 350 of 360 points 10 degrees to the right: the sector continues at the end of the list",
        ),
        (
            _scan(far(b45=0.5, b300=0.6)),
            wide,
            3.0,
            "obstacles 45 and 60 degrees to the side",
            "ignore beams outside the sector",
        ),
        (
            _scan(far(b20=0.9)),
            math.radians(15),
            3.0,
            "a sector of 15 degrees, and an obstacle at 20",
            "half_width limits the sector on each side",
        ),
        (_scan(far(b3=0.0, b5=1.1)), wide, 1.1, "a beam of 0.0", "0.0 is less than range_min, so it is invalid"),
        (
            _scan(far(b3=-math.inf, b355=math.nan, b7=1.2)),
            wide,
            1.2,
            "beams of -inf and nan",
            "use only ranges between range_min and range_max",
        ),
        (
            _scan(np.full(360, math.inf)),
            wide,
            math.inf,
            "a scan without a valid range",
            "return math.inf if no beam is left",
        ),
        (
            _scan(np.full(360, 6.0)),
            wide,
            math.inf,
            "a scan whose ranges are all beyond range_max",
            "a range above range_max is not a measurement",
        ),
        (
            _scan(far(b180=0.4, b0=0.3), first=-math.pi),
            wide,
            0.4,
            "a laser whose first beam points backwards",
            "the angle of beam i is angle_min + i * angle_increment",
        ),
    )  # fmt: skip
    for scan, half_width, right, what, hint in shown:
        found = expect_number(answer(scan, half_width), "distance")
        expect(
            found == right or abs(found - right) < 1e-6, f"For {what} it returned {found:.2f}, not {right:.2f}.", hint
        )


# ---- wheel_separation: how far apart are the wheels ----

NARROW, WIDE = 2, 7
"""Seeds of graphs whose robots have a wheel separation of 158.3 mm and 163.7 mm."""


@exercise(
    "wheel_separation",
    praise="With this number in its firmware, the robot would turn much more accurately than with the nominal one.",
)
def wheel_separation(answer: Any) -> None:
    """The effective wheel separation of two robots, measured while they turn on the spot."""
    for seed in (NARROW, WIDE):
        with Graph(seed=seed) as graph:
            sim = _robot(graph)
            wheels = sim.engine.robot(sim.name).wheels
            found = expect_number(answer(graph, sim), "distance")
            right = wheels.separation
        expect(
            0.1 < found < 0.25,
            f"It returned {found:.3f}, which is not a plausible wheel separation of a TurtleBot3 in metres.",
            "it is (distance of the right wheel - distance of the left wheel) / angle, with the angle in radians",
        )
        expect(
            abs(found - right) < 5e-4,
            f"One robot has a wheel separation of {1000 * right:.1f} mm, but you found {1000 * found:.1f} mm.",
            "turn several times; odometry assumes 160 mm, and the ground truth shows the real angle",
        )


# ---- safe_speed: not faster than it can see ----


@exercise(
    "safe_speed",
    praise="At full speed a TurtleBot3 needs 68 mm: 44 mm until the scan arrives, and 24 mm to brake.")  # fmt: skip
def safe_speed(answer: Any) -> None:
    """The highest speed at which a robot with delayed scans stops in time."""
    for distance, period, acceleration in (
        (0.05, 0.2, 1.0), (0.02, 0.2, 1.0), (0.03, 0.1, 1.0), (0.04, 0.2, 0.5), (0.0, 0.2, 1.0), (1.0, 0.2, 1.0),
    ):  # fmt: skip
        found = expect_number(answer(distance, period, acceleration), "speed")
        right = min(0.22, acceleration * (math.sqrt(period**2 + 2 * distance / acceleration) - period))
        case = f"{1000 * distance:.0f} mm, {period} s and {acceleration} m/s2"
        expect(
            found <= 0.22 + 1e-9,
            f"For {case} you return {found:.2f} m/s, more than a TurtleBot3 can drive.",
            "limit it with min(0.22, ...)",
        )
        needed = found * period + found * found / (2 * acceleration)
        expect(
            found <= right + 1e-6,
            f"For {case} you return {found:.3f} m/s, at which it needs {1000 * needed:.1f} mm to stop.",
            "add up v * period and v * v / (2 * acceleration)",
        )
        expect(
            found >= right - 1e-6,
            f"For {case} you return {found:.3f} m/s; it could drive faster, as it needs only {1000 * needed:.1f} mm "
            "to stop.",
            "find the speed at which both distances add up to the given one",
        )  # fmt: skip


# ---- mast: a mast ----

BURGER_URDF = "package://turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro"


def _looks(robot: Any, link: str, kind: type, **sizes: float) -> Any:
    """Expect a link to have one visual of this kind and these sizes [m]; return it."""
    from rosmini.sim.urdf import Cylinder

    word = "cylinder" if kind is Cylinder else "sphere"
    visuals = robot.links[link].visuals
    expect(len(visuals) == 1, f"{link} has {len(visuals)} visuals.", f"give it one, with a <{word}>")
    shape = visuals[0].geometry
    expect(
        isinstance(shape, kind),
        f"The visual of {link} is a {type(shape).__name__.lower()}.",
        f"its geometry is a <{word}>",
    )
    for name, right in sizes.items():
        found = getattr(shape, name)
        expect(
            abs(found - right) < 1e-6,
            f"The {word} of {link} has the {name} {found:g} m, not {right:g} m.",
            "lengths are in metres; the radius is half of the diameter",
        )
    return visuals[0]


@exercise(
    "mast", praise="The mast is there, and every program that reads the description knows the position of its ball."
)
def mast(answer: Any) -> None:
    """A piece of URDF: a mast with a ball on top, for a TurtleBot3 Burger."""
    from rosmini.sim.urdf import Cylinder, Sphere, UrdfError, load, xacro

    burger = xacro.expand(BURGER_URDF)
    for height in (0.3, 0.12):
        asked = f"For a height of {height} m"
        piece = answer(height)
        expect(
            isinstance(piece, str),
            f"{asked} it returned a {type(piece).__name__}, not a string.",
            "return the lines of XML as one string",
        )
        try:
            robot = load(burger.replace("</robot>", piece + "</robot>"), meshes=False)
        except UrdfError as error:
            raise Wrong(
                f"{asked} the description cannot be read: {error}", "compare it with a joint of the Burger"
            ) from error
        for notes in robot.left_out.values():
            raise Wrong(f"{asked} a part cannot be read: {notes[0]}", "compare it with a link of the Burger")
        for link in ("mast_link", "beacon_link"):
            expect(link in robot.links, f"There is no link {link}.", "compare the names with the task")
            kind = robot.above[link].type
            expect(
                kind == "fixed",
                f"{link} is the child of a {kind} joint.",
                "the parts do not move, so the type of the joint is fixed",
            )
        _places(robot, height, asked)
        pole = _looks(robot, "mast_link", Cylinder, radius=0.005, length=height)
        x, y, z = pole.origin.xyz
        expect(
            abs(x) < 1e-6 and abs(y) < 1e-6 and abs(z - height / 2) < 1e-6,
            f"{asked} the cylinder reaches from {z - height / 2:.3f} m to {z + height / 2:.3f} m above the foot.",
            "the origin of a cylinder is its centre: raise the visual by half of the height",
        )
        ball = _looks(robot, "beacon_link", Sphere, radius=0.015)
        expect(
            ball.origin.xyz == (0.0, 0.0, 0.0),
            "The ball is not centred on the frame beacon_link.",
            "remove the origin of its visual: the joint puts the frame at the top",
        )


def _places(robot: Any, height: float, asked: str) -> None:
    """Expect the frames of mast and ball at the right positions."""
    places = robot.transforms()
    base = places["base_link"][:3, 3]
    for link, right in (("mast_link", (-0.09, 0.0, 0.15)), ("beacon_link", (-0.09, 0.0, 0.15 + height))):
        found = places[link][:3, 3] - base
        expect(
            bool(np.allclose(found, right, atol=1e-6)),
            f"{asked} the frame {link} is at ({found[0]:.2f}, {found[1]:.2f}, {found[2]:.2f}) in base_link, "
            f"not at ({right[0]:.2f}, {right[1]:.2f}, {right[2]:.2f}).",
            "the origin of a joint is the pose of the child's frame in the parent's; x points forwards",
        )
