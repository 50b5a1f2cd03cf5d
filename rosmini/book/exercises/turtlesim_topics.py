"""Checks of the exercises in the chapter turtlesim: topics: keys, a script and a node, run with turtles."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import Twist

AHEAD, TURN = 2.0, 2.0
"""Velocities of each key of turtle_teleop_key, which last a second [m/s, rad/s]."""
KEYS = {"A": (AHEAD, 0.0), "B": (-AHEAD, 0.0), "C": (0.0, -TURN), "D": (0.0, TURN)}
MOST_KEYS = 6
WALL = 0.05
"""Distance from an edge at which the turtle touches the wall [m]."""
EDGE = 499 / 45

# ---- corner: to the corner by keys ----


@exercise("corner", praise="Several turns add up to the one that you need.")
def corner(answer: Any) -> Any:
    """At most six keys move the turtle to the upper left corner without touching a wall."""
    expect_type(answer, str, "The keys are", "a string")
    keys = "".join(answer.split()).upper()
    wrong = sorted(set(keys) - set(KEYS))
    expect(not wrong, f"Not one of the keys: {', '.join(wrong)}.", "use A up, B down, C right, D left")
    expect(len(keys) <= MOST_KEYS, f"These are {len(keys)} keys; six are enough.")
    with TurtleTrial() as trial:
        publisher = trial.graph.node("teleop_turtle").publisher("turtle1/cmd_vel", Twist)
        trial.run(0.1)
        turtle = trial.sim.turtles["turtle1"]
        for key in keys:
            command = Twist()
            command.linear.x, command.angular.z = KEYS[key]
            publisher.publish(command)
            trial.run(1.1)
            expect(
                min(turtle.x, turtle.y, EDGE - turtle.x, EDGE - turtle.y) > WALL,
                f"After {key!r} the turtle touches the wall, at ({turtle.x:.1f}, {turtle.y:.1f}).",
            )
        expect(
            turtle.x < 2.5 and turtle.y > 8.5,
            f"The turtle ends at ({turtle.x:.1f}, {turtle.y:.1f}).",
            "the corner is six metres away, at 135 degrees",
        )
        return trial.view()


# ---- triangle: a red triangle ----

CORNERS = ((2.0, 2.0), (9.0, 2.0), (5.5, 8.0))


@exercise("triangle", praise="You drew with three jumps with the pen down, after one with the pen up.")
def triangle(answer: Script) -> Any:
    """Exactly three red lines between the corners, each 5 pixels wide."""
    with TurtleTrial() as trial:
        trial.start(answer)
        trial.run(2.0)
        state = trial.sim.state()
        metre, size = state["metre"], state["size"]
        lines = [stroke for stroke in state["strokes"] if math.dist(stroke[:2], stroke[2:4]) > 1.0]
        wanted = {frozenset(_pixel(corner, metre, size) for corner in (CORNERS[i], CORNERS[i - 1])) for i in range(3)}
        found = {frozenset(((round(x1), round(y1)), (round(x2), round(y2)))) for x1, y1, x2, y2, *_ in lines}
        said = f"There are {len(lines)} lines, not 3 between the corners."
        expect(
            len(lines) == 3 and _alike(found, wanted),
            said,
            "lift the pen, jump to a corner, lower the pen, then jump three times",
        )
        pens = {tuple(stroke[4:8]) for stroke in lines}
        expect(
            pens == {(255, 0, 0, 5)},
            f"The pens (red, green, blue, width) are {sorted(pens)}, not (255, 0, 0, 5).",
            "call pen(255, 0, 0, 5, 0)",
        )
        return trial.view()


def _pixel(place: tuple[float, float], metre: float, size: float) -> tuple[int, int]:
    return round(place[0] * metre), round(size - 1 - place[1] * metre)


def _alike(found: set[frozenset[tuple[int, int]]], wanted: set[frozenset[tuple[int, int]]]) -> bool:
    """Return whether the lines are the expected ones, within two pixels."""

    def near(one: frozenset[tuple[int, int]], other: frozenset[tuple[int, int]]) -> bool:
        return all(any(math.dist(a, b) <= 2.0 for b in other) for a in one)

    return len(found) == len(wanted) and all(any(near(one, other) for other in wanted) for one in found)


# ---- mirror: a mirror ----


@exercise("mirror", praise="With two remapped names, your mirror works for any pair of turtles.")
def mirror(answer: Script) -> Any:
    """Any turtle can mirror the movements of any other."""
    shown = None
    for first, second in (("turtle1", "turtle2"), ("turtle2", "turtle1")):
        with TurtleTrial() as trial:
            trial.spawn("turtle2", 5.544445, 5.544445)
            trial.run(0.1)
            trial.start(answer, f"pose:={first}/pose", f"cmd_vel:={second}/cmd_vel")
            driver = trial.graph.node("driver").publisher(f"{first}/cmd_vel", Twist)
            trial.run(0.5)
            command = Twist()
            command.linear.x, command.angular.z = 1.5, 1.0
            for _ in range(3):
                driver.publish(command)
                trial.run(0.5)
            trial.run(2.0)
            one, other = trial.sim.turtles[first], trial.sim.turtles[second]
            moved = math.dist((other.x, other.y), (5.544445, 5.544445))
            expect(moved > 0.5, f"{second} did not move.", "publish a Twist for each pose")
            off = math.hypot(other.x - one.x, (other.y - 5.544445) + (one.y - 5.544445))
            expect(
                off < 0.3 and abs(math.remainder(one.theta + other.theta, math.tau)) < 0.2,
                f"{first} is at ({one.x:.1f}, {one.y:.1f}), {second} at ({other.x:.1f}, {other.y:.1f}): "
                "this is not a mirror image.",
                "publish the same linear velocity, and the negative angular velocity",
            )
            shown = trial.view()
    return shown
