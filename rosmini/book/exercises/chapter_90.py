"""What is right in the exercises of chapter 90, Logo: programs, tried on paper and on a robot, and a node."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, cast

from rosmini.book.checks import Script, exercise, expect
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
    """The program of an answer, without the line of the magic. Raises `Wrong` for what is no text."""
    expect(isinstance(program, str), f"An answer is a program as a text, not a {type(program).__name__}.")
    return re.sub(r"\A\s*%%logo.*", "", program)


def _words(program: Any) -> list[str]:
    """The words of a program, in lower case and without brackets and comments."""
    return re.sub(r";.*|[\[\]()]", " ", _text(program).lower()).split()


def _calls_itself(program: Any) -> bool:
    """Whether a procedure of the program has its own name in its body."""
    bodies = re.findall(r"(?:^|\s)to (\S+)(.*?)\send(?=\s|$)", " ".join(_words(program)))
    return any(name in body.split() for name, body in bodies)


def drawn(program: Any, *lines: str) -> Drawing:
    """Run a program on paper, then these lines; return what is drawn. Raises `Wrong` for what is no text."""
    said: list[str] = []
    logo = Logo(say=said.append, limits=LIMITS)
    logo.run(_text(program))
    logo.run("clearscreen pendown")
    for line in lines:
        logo.run(line)
    return logo.drawing


def _corners(drawing: Drawing) -> list[tuple[int, int]]:
    """Where lines end, rounded to a step."""
    return [(round(line.end.x), round(line.end.y)) for line in drawing.lines]


def _is_home(drawing: Drawing) -> bool:
    (x, y, heading), *_ = drawing.turtles.values()
    return math.hypot(x, y) < 0.5 and abs(math.remainder(heading, 360)) < 0.5


# ---- 90.1: all regular polygons ----


@exercise(
    "90.1", praise="One line for all of them: whatever the number of sides, the turns make one whole turn."
)
def polygon(answer: Any) -> Any:
    """Polygons of three, five and eight sides, and of another length."""
    for sides, length in ((3, 120), (5, 60), (8, 50)):
        drawing = drawn(answer, f"polygon {sides} {length}")
        found, call = len(drawing.lines), f"polygon {sides} {length}"
        expect(found == sides, f"`{call}` drew {found} lines, not {sides}.")
        lengths = {round(math.dist(line.start[:2], line.end[:2]), 3) for line in drawing.lines}
        expect(lengths == {length}, f"The sides of `{call}` are {sorted(lengths)} steps long, not {length}.")
        expect(
            _is_home(drawing),
            f"After `{call}` the turtle is not where and as it began.",
            "all turns make 360 degrees",
        )
    return drawn(answer, "polygon 3 90 polygon 5 90 polygon 8 90").show()


# ---- 90.2: stairs that end ----


@exercise("90.2", praise="It asks whether it is done before it does anything.")
def stairs(answer: Any) -> Any:
    """Five steps, each smaller than the one before; and none."""
    expect(not drawn(answer, "stairs 0 40").lines, "`stairs 0 40` drew something.", "ask first, then draw")
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
        f"A corner should be near {missing}, and is not there.",
        "up first, then to the right",
    )
    expect(_calls_itself(answer), "The procedure does not call itself.", "stairs with one step less")
    return drawing.show()


# ---- 90.3: a delivery round ----


@exercise("90.3", praise="The same program on paper and on wheels.")
def visit(answer: Any) -> Any:
    """A round on paper, another one, and the first one on a robot."""
    line = f"visit [{' '.join(f'[{x} {y}]' for x, y in PLACES)}]"
    forbidden = sorted(set(_words(answer)) & {"setpos", "setxy", "setx", "sety"})
    expect(
        not forbidden,
        f"{' and '.join(forbidden)} should not be in it.",
        "turn towards the place, then go forward",
    )
    for places in (PLACES, ((-50, 20), (30, -70))):
        call = f"visit [{' '.join(f'[{x} {y}]' for x, y in places)}]"
        drawing = drawn(answer, call)
        corners = _corners(drawing)
        expect(corners[: len(places)] == list(places), f"`{call}` went to {corners}.", "setheading towards ?")
        expect(_is_home(drawing), f"After `{call}` the turtle is not home.", "home is the last word")
        for stroke in drawing.lines[:-1]:
            bearing = math.degrees(math.atan2(stroke.end.x - stroke.start.x, stroke.end.y - stroke.start.y))
            ahead = abs(math.remainder(bearing - stroke.end.heading, 360)) < 1
            expect(ahead, "It does not look where it goes.", "setheading towards ?, then forward")
    with Trial("empty") as trial:
        trial.graph.run(0.5)
        logo = Logo.on(trial.graph.node("logo"), say=lambda _: None, limits=LIMITS)
        logo.run(_text(answer))
        logo.run(line)
        x, y, _ = trial.robot.truth()
        expect(math.hypot(x, y) < 0.3, f"The robot is not home: it stands at ({x:.1f}, {y:.1f}).")
        return logo.drawing.show()


# ---- 90.4: a turtle of your own ----


@exercise("90.4", praise="A Logo of two words, for any node that has something to say.")
def tiny_logo(answer: Script) -> Any:
    """A node that obeys commands on a topic, and lives through what it does not understand."""
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
        for command in (
            "forward 45",
            "right 90",
            "forward 90",
            "backflip",
            "forward far",
            "right 90",
            "forward 45",
        ):
            publisher.publish(command)
            graph.run(0.5)
        expect(handle.poll() is None, "It has ended.", "rospy.spin() keeps a node alive")
        said = console.captured or ""
        expect(
            "bad callback" not in said and "Error" not in said,
            "A callback failed.",
            "try ... except ValueError",
        )
        turtle = sim.frame.turtles["turtle1"]
        x, y = turtle.x - 499 / 90, turtle.y - 499 / 90
        place = f"The turtle is {x:.2f} m to the right and {y:.2f} m above the middle"
        expect(
            math.hypot(x - 0, y + 2) < 0.01,
            f"{place}, not 0.00 and -2.00.",
            "45 steps are a metre; right is clockwise",
        )
        return sim.show()
