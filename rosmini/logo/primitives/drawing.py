"""What turtles do, and what they know."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from rosmini.logo.compiler import Primitive
from rosmini.logo.errors import BadInput, suggestion
from rosmini.logo.turtles import Colour, Pen, Turtle
from rosmini.logo.values import LogoList, Value, as_list, boolean, number, show, whole, word

from .control import turtle_name, turtles_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.logo.machine import Machine

COLOURS: dict[str, Colour] = {
    "black": (0, 0, 0), "blue": (0, 0, 255), "green": (0, 255, 0), "cyan": (0, 255, 255),
    "red": (255, 0, 0), "magenta": (255, 0, 255), "yellow": (255, 255, 0), "white": (255, 255, 255),
    "brown": (155, 96, 59), "tan": (197, 136, 18), "forest": (100, 162, 64), "aqua": (120, 187, 187),
    "salmon": (255, 149, 119), "purple": (144, 113, 208), "orange": (255, 163, 0), "grey": (183, 183, 183),
}  # fmt: skip
"""Numbers 0 to 15 in this order, as in UCBLogo; names are accepted as well."""

_WANTED = "a colour: a number from 0 to 15, a name such as red, or a list of three numbers from 0 to 100"


def _move(change: Callable[[Turtle, float], None], sign: float = 1.0) -> Callable[[Machine, Value], None]:
    def act(machine: Machine, value: Value) -> None:
        amount = sign * number(value)
        for turtle in machine.flock.active:
            machine.moved()
            change(turtle, amount)

    return act


def _each(change: Callable[[Turtle], None], moves: int = 0) -> Callable[[Machine], None]:
    def act(machine: Machine) -> None:
        for turtle in machine.flock.active:
            machine.moved(moves)
            change(turtle)

    return act


def _pen(**more: Any) -> Callable[[Machine], None]:
    return _each(lambda turtle: _set_pen(turtle, replace(turtle.pen, **more)))


def _set_pen(turtle: Turtle, pen: Pen) -> None:
    turtle.pen = pen


def _point(value: Value) -> tuple[float, float]:
    members = as_list(value, "a list of two numbers")
    if len(members) != 2:
        raise BadInput(show(value), "a list of two numbers")
    return number(members.items[0]), number(members.items[1])


def _go(machine: Machine, x: float | None, y: float | None) -> None:
    for turtle in machine.flock.active:
        machine.moved()
        pose = turtle.pose
        turtle.go(pose.x if x is None else x, pose.y if y is None else y)


def _home(turtle: Turtle) -> None:
    turtle.home()


def _show(*, visible: bool) -> Callable[[Machine], None]:
    def change(turtle: Turtle) -> None:
        turtle.visible = visible

    return _each(change)


def _clear_screen(machine: Machine) -> None:
    for turtle in machine.flock.active:
        machine.moved()
        pen = turtle.pen
        turtle.lift()
        turtle.home()
        turtle.pen = pen
    machine.flock.clean()


def _clean(machine: Machine) -> None:
    machine.flock.clean()


def _colour(value: Value) -> Colour:
    """The colour that a number, a name or a list means. Raises ``BadInput``."""
    if isinstance(value, LogoList):
        parts = [number(part, _WANTED) for part in value]
        if len(parts) != 3 or not all(0 <= part <= 100 for part in parts):
            raise BadInput(show(value), _WANTED)
        red, green, blue = (round(2.55 * part) for part in parts)
        return red, green, blue
    name = word(value).lower()
    if name in COLOURS:
        return COLOURS[name]
    if not name.isdecimal() or int(name[:3]) > 15:
        raise BadInput(show(value), _WANTED + suggestion(name, list(COLOURS)))
    return list(COLOURS.values())[int(name)]


def _set_colour(machine: Machine, value: Value) -> None:
    colour = _colour(value)
    for turtle in machine.flock.active:
        turtle.pen = replace(turtle.pen, colour=colour)


def _set_size(machine: Machine, value: Value) -> None:
    given = value.items[0] if isinstance(value, LogoList) and len(value) else value
    size = whole(given, 1, 255, "a whole number from 1 to 255")
    for turtle in machine.flock.active:
        turtle.pen = replace(turtle.pen, size=size)


def _set_background(machine: Machine, value: Value) -> None:
    machine.flock.paint(_colour(value))


def _one(machine: Machine) -> Turtle:
    return machine.flock.active[0]


def _plain(value: float) -> float:
    """Without the noise of sines: what is reported may be printed."""
    return round(value, 9) + 0.0


def _of_colour(colour: Colour) -> Value:
    names = list(COLOURS.values())
    return names.index(colour) if colour in names else LogoList(round(part / 2.55) for part in colour)


def _position(machine: Machine) -> LogoList:
    return LogoList(_plain(part) for part in _one(machine).pose[:2])


def _towards(machine: Machine, point: Value) -> float:
    x, y = _point(point)
    pose = _one(machine).pose
    return _plain(math.degrees(math.atan2(x - pose.x, y - pose.y)) % 360.0)


def _distance(machine: Machine, point: Value) -> float:
    x, y = _point(point)
    pose = _one(machine).pose
    return _plain(math.hypot(x - pose.x, y - pose.y))


def _tell(machine: Machine, names: Value) -> None:
    machine.flock.tell(turtles_of(machine, names))


def _new_turtle(machine: Machine, name: Value) -> None:
    machine.moved()
    machine.flock.add(turtle_name(name))


def _who(machine: Machine) -> Value:
    names = [turtle.name for turtle in machine.flock.active]
    return names[0] if len(names) == 1 else LogoList(names)


def _question(name: str, inputs: str, act: Callable[..., Value], text: str, *short: str) -> Primitive:
    return Primitive(name, tuple(inputs.split()), act, text, short, reports=True)


def _command(name: str, inputs: str, act: Callable[..., None], text: str, *short: str) -> Primitive:
    return Primitive(name, tuple(inputs.split()), act, text, short)


DRAWING = (
    _command(
        "forward", "distance", _move(lambda t, d: t.forward(d)), "goes straight ahead, so many steps", "fd"
    ),
    _command("back", "distance", _move(lambda t, d: t.forward(d), -1.0), "goes backwards", "bk"),
    _command("right", "degrees", _move(lambda t, a: t.right(a)), "turns clockwise", "rt"),
    _command("left", "degrees", _move(lambda t, a: t.right(a), -1.0), "turns anticlockwise", "lt"),
    _command(
        "setheading", "degrees", _move(lambda t, a: t.face(a)), "looks that way: 0 is up, 90 right", "seth"
    ),
    _command(
        "setxy", "x y", lambda m, x, y: _go(m, number(x), number(y)), "goes to a point; [0 0] is the middle"
    ),
    _command("setpos", "point", lambda m, point: _go(m, *_point(point)), "goes to a point, given as a list"),
    _command("setx", "x", lambda m, x: _go(m, number(x), None), "goes to the left or to the right"),
    _command("sety", "y", lambda m, y: _go(m, None, number(y)), "goes up or down"),
    _command("home", "", _each(_home, 1), "goes to where it began, and looks as it did then"),
    _command("penup", "", _pen(down=False), "moves without drawing from now on", "pu"),
    _command("pendown", "", _pen(down=True), "draws from now on", "pd"),
    _command("setpencolor", "colour", _set_colour, f"draws in {_WANTED}", "setpc"),
    _command("setpensize", "size", _set_size, "draws lines of this width", "setwidth"),
    _command("setbackground", "colour", _set_background, "changes the colour of the paper", "setbg"),
    _command("clearscreen", "", _clear_screen, "goes home and erases all lines", "cs"),
    _command("clean", "", _clean, "erases all lines"),
    _command("hideturtle", "", _show(visible=False), "hides the turtle in Logo's picture", "ht"),
    _command("showturtle", "", _show(visible=True), "shows it again", "st"),
    _command("tell", "turtles", _tell, "lets these turtles listen from now on: a name, a number or a list"),
    _command("newturtle", "name", _new_turtle, "makes a turtle in the middle"),
    _question("who", "", _who, "the turtles that listen"),
    _question("turtles", "", lambda m: LogoList(m.flock.known()), "all turtles"),
    _question("pos", "", _position, "where the turtle is"),
    _question("xcor", "", lambda m: _plain(_one(m).pose.x), "how far to the right of the middle it is"),
    _question("ycor", "", lambda m: _plain(_one(m).pose.y), "how far above the middle it is"),
    _question("heading", "", lambda m: _plain(_one(m).pose.heading % 360.0), "which way it looks"),
    _question("towards", "point", _towards, "the heading of a point, seen from the turtle"),
    _question("distance", "point", _distance, "how far away a point is"),
    _question("pencolor", "", lambda m: _of_colour(_one(m).pen.colour), "what it draws in", "pc"),
    _question("pensize", "", lambda m: _one(m).pen.size, "how wide its lines are"),
    _question("pendownp", "", lambda m: boolean(_one(m).pen.down), "whether it draws", "pendown?"),
    _question("shownp", "", lambda m: boolean(_one(m).visible), "whether it is shown", "shown?"),
    _question(
        "background", "", lambda m: _of_colour(m.flock.sheet.background), "the colour of the paper", "bg"
    ),
)
"""Words for turtles."""
