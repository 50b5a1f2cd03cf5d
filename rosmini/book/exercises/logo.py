"""Checks of the exercises in the chapter Logo: programs, run on paper and on a robot, and a node."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, cast

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.graph import Graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.scripts import Console, ScriptHandle, ScriptSpec, rosrun
from rosmini.sim.logo import Limits, Logo
from rosmini.sim.logo.turtles import Drawing

if TYPE_CHECKING:
    from rosmini.sim.turtlesim.node import TurtleSim

LIMITS = Limits(steps=200_000, moves=5_000, depth=5_000)

PLACES = ((60, 0), (60, 80), (0, 80))


def _text(program: Any) -> str:
    """Return the program of an answer, without the line of the magic. Raises `Wrong` if it is not a string."""
    expect_type(program, str, "The program is", "a string")
    return re.sub(r"\A\s*%%logo.*", "", program)


def _words(program: Any) -> list[str]:
    """Return the words of a program, in lower case, without brackets and comments."""
    return re.sub(r";.*|[\[\]()]", " ", _text(program).lower()).split()


def _calls_itself(program: Any) -> bool:
    """Return whether a procedure of the program calls itself."""
    bodies = re.findall(r"(?:^|\s)to (\S+)(.*?)\send(?=\s|$)", " ".join(_words(program)))
    return any(name in body.split() for name, body in bodies)


def drawn(program: Any, *lines: str) -> Drawing:
    """Run a program on paper, then these lines; return the drawing. Raises `Wrong` if the program is not a string."""
    said: list[str] = []
    logo = Logo(say=said.append, limits=LIMITS)
    logo.run(_text(program))
    logo.run("clearscreen pendown")
    for line in lines:
        logo.run(line)
    return logo.drawing


def _corners(drawing: Drawing) -> list[tuple[int, int]]:
    """Return the end points of the lines, rounded to a step."""
    return [(round(line.end.x), round(line.end.y)) for line in drawing.lines]


def _is_home(drawing: Drawing) -> bool:
    (x, y, heading), *_ = drawing.turtles.values()
    return math.hypot(x, y) < 0.5 and abs(math.remainder(heading, 360)) < 0.5


# ---- polygon: all regular polygons ----


@exercise("polygon", praise="One line draws every polygon: the turns always add up to one full turn.")
def polygon(answer: Any) -> Any:
    """Polygons with three, five and eight sides, and with different lengths."""
    for sides, length in ((3, 120), (5, 60), (8, 50)):
        drawing = drawn(answer, f"polygon {sides} {length}")
        found, call = len(drawing.lines), f"polygon {sides} {length}"
        expect(found == sides, f"`{call}` drew {found} lines, not {sides}.")
        lengths = {round(math.dist(line.start[:2], line.end[:2]), 3) for line in drawing.lines}
        expect(lengths == {length}, f"The sides of `{call}` are {sorted(lengths)} steps long, not {length}.")
        expect(
            _is_home(drawing),
            f"After `{call}` the turtle has a different position or heading than at the start.",
            "all turns add up to 360 degrees",
        )
    return drawn(answer, "polygon 3 90 polygon 5 90 polygon 8 90").show()


# ---- stairs: stairs that end ----


@exercise("stairs", praise="Your procedure checks whether it is done before it draws.")
def stairs(answer: Any) -> Any:
    """Five steps, each smaller than the previous one; and no step."""
    expect(not drawn(answer, "stairs 0 40").lines, "`stairs 0 40` drew something.", "first compare, then draw")
    drawing = drawn(answer, "stairs 5 40")
    found = len(drawing.lines)
    expect(found == 10, f"`stairs 5 40` drew {found} lines, not 10.")
    x, y, wanted = 0.0, 0.0, []
    for i in range(5):
        size = 40 * 0.75**i
        wanted += [(round(x), round(y + size)), (round(x + size), round(y + size))]
        x, y = x + size, y + size
    missing = next((a for a, b in zip(wanted, _corners(drawing), strict=True) if a != b), None)
    expect(
        missing is None,
        f"There should be a corner near {missing}, but there is none.",
        "draw up first, then to the right",
    )
    expect(_calls_itself(answer), "The procedure does not call itself.", "end with stairs and one step less")
    return drawing.show()


# ---- visit: a delivery round ----


@exercise("visit", praise="The same program draws on paper and drives a robot.")
def visit(answer: Any) -> Any:
    """Two tours on paper, and the first of them on a robot."""
    line = f"visit [{' '.join(f'[{x} {y}]' for x, y in PLACES)}]"
    forbidden = sorted(set(_words(answer)) & {"setpos", "setxy", "setx", "sety"})
    expect(
        not forbidden, f"The program must not use {' and '.join(forbidden)}.", "turn towards a point, then go forward"
    )
    for places in (PLACES, ((-50, 20), (30, -70))):
        call = f"visit [{' '.join(f'[{x} {y}]' for x, y in places)}]"
        drawing = drawn(answer, call)
        corners = _corners(drawing)
        expect(corners[: len(places)] == list(places), f"`{call}` went to {corners}.", "setheading towards ?")
        expect(_is_home(drawing), f"After `{call}` the turtle is not home.", "end with home")
        for stroke in drawing.lines[:-1]:
            bearing = math.degrees(math.atan2(stroke.end.x - stroke.start.x, stroke.end.y - stroke.start.y))
            ahead = abs(math.remainder(bearing - stroke.end.heading, 360)) < 1
            expect(
                ahead, "The turtle does not face the point to which it moves.", "use setheading towards ?, then forward"
            )
    with Trial("empty") as trial:
        trial.graph.run(0.5)
        logo = Logo.on(trial.graph.node("logo"), say=lambda _: None, limits=LIMITS)
        logo.run(_text(answer))
        logo.run(line)
        x, y, _ = trial.robot.truth()
        expect(math.hypot(x, y) < 0.3, f"The robot is not home, but at ({x:.1f}, {y:.1f}).")
        return logo.drawing.show()


# ---- tiny_logo: your own turtle ----


@exercise("tiny_logo", praise="Any node can now draw by publishing two words of Logo.")
def tiny_logo(answer: Script) -> Any:
    """A node that obeys commands on a topic and survives invalid ones."""
    with Graph(strict=False) as graph:
        started = rosrun("turtlesim", "turtlesim_node", graph=graph, capture_output=True)
        sim = cast("TurtleSim", cast("Any", started).instance())
        graph.run(0.1)
        console = Console(graph.scheduler, prefix=False, capture_output=True)
        handle = ScriptHandle(
            graph, ScriptSpec(answer.name, (), source=answer.source), lambda: console, owns_console=False
        )
        handle.start()
        graph.run(0.5)
        publisher = graph.node("speaker").publisher("logo", String)
        graph.run(0.5)
        expect(publisher.num_connections() > 0, "It does not subscribe to `/logo`.")
        for command in ("forward 45", "right 90", "forward 90", "backflip", "forward far", "right 90", "forward 45"):
            publisher.publish(command)
            graph.run(0.5)
        expect(handle.poll() is None, "The script has ended.", "rospy.spin() keeps a node alive")
        said = console.captured or ""
        expect(
            "bad callback" not in said and "Error" not in said,
            "A callback failed.",
            "catch it with try ... except ValueError",
        )
        turtle = sim.frame.turtles["turtle1"]
        x, y = turtle.x - 499 / 90, turtle.y - 499 / 90
        place = f"The turtle is {x:.2f} m to the right of the centre and {y:.2f} m above it"
        expect(
            math.hypot(x - 0, y + 2) < 0.01,
            f"{place}, not 0.00 and -2.00.",
            "one metre is 45 steps; right turns clockwise",
        )
        return sim.show()
