"""Primitives of Logo that take values and move turtles, and the state of a program that they change.

Primitives that run lists, such as `repeat`, are in `rosmini.sim.logo.interpreter`.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from typing import Any

from rosmini.core.lazy import np

from .turtles import Colour, Flock, Pose, Turtle, cosine, sine
from .values import (
    MAX_SIZE,
    BadInput,
    LogoError,
    LogoList,
    LogoStopped,
    Value,
    as_list,
    is_equal,
    number,
    number_in,
    show,
    suggestion,
    tidy,
    truth,
    weight,
    whole,
    word,
    write,
)  # fmt: skip


@dataclass(frozen=True)
class Limits:
    """Limits at which a program is stopped."""

    steps: int = 500_000
    """Maximum number of calls; handling a large value counts as several."""

    moves: int = 20_000
    """Maximum number of turtle movements."""

    depth: int = 100_000
    """Maximum number of nested evaluations; a procedure that calls itself adds about five."""

    lines: int = 2_000
    """Maximum number of printed lines; a cell shows this many lines of a node's output."""


@dataclass
class State:
    """Turtles and variables, which persist between programs, and the counts of the current program."""

    flock: Flock
    say: Callable[[str], object]
    seed: int
    limits: Limits
    variables: dict[str, Value] = field(default_factory=dict)
    steps: int = 0
    moves: int = 0
    lines: int = 0

    @cached_property
    def random(self) -> np.random.Generator:
        """The generator behind `random`."""
        return np.random.default_rng(self.seed)

    def step(self, count: int = 1) -> None:
        """Count steps. Raises ``LogoStopped``."""
        self.steps += count
        self._limit("steps", self.steps, self.limits.steps)

    def handled(self, value: Value) -> Value:
        """Count the handling of a value as steps, in proportion to its size; return it."""
        self.step(weight(value) // 8)
        return value

    def movers(self) -> list[Turtle]:
        """Return the active turtles, each of which is about to move. Raises ``LogoStopped``."""
        self.moves += len(self.flock.active)
        self._limit("movements of turtles", self.moves, self.limits.moves)
        return self.flock.active

    def print(self, text: str) -> None:
        """Print a line. Raises ``LogoStopped``."""
        self.lines += 1
        self._limit("lines", self.lines, self.limits.lines)
        self.say(text)

    def value_of(self, name: str) -> Value:
        """Return the value of a variable. Raises ``LogoError``."""
        if name not in self.variables:
            guess = suggestion(name, self.variables).replace("did you mean ", "did you mean :")
            raise LogoError(f"{name} has no value{guess}")
        return self.variables[name]

    @staticmethod
    def _limit(what: str, count: int, limit: int) -> None:
        if count > limit:
            raise LogoStopped(f"stopped after {limit} {what}: is there a loop that never ends?")


@dataclass(frozen=True)
class Primitive:
    """A predefined word of Logo.

    ``act`` takes the state and the inputs; if it ``controls``, it takes the interpreter and may return a generator.
    """

    name: str
    inputs: tuple[str, ...]
    act: Callable[..., Any]
    help: str
    short: tuple[str, ...] = ()
    gives_value: bool = False
    controls: bool = False

    @property
    def usage(self) -> str:
        """The word with its inputs: ``forward distance``."""
        return " ".join((self.name, *self.inputs))


def command(usage: str, act: Callable[..., None], text: str, *short: str) -> Primitive:
    """Return a primitive without a value."""
    name, *inputs = usage.split()
    return Primitive(name, tuple(inputs), act, text, short)


def reporter(usage: str, act: Callable[..., Value], text: str, *short: str) -> Primitive:
    """Return a primitive with a value."""
    return replace(command(usage, act, text, *short), gives_value=True)  # type: ignore[arg-type]


def control(usage: str, act: Callable[..., Any], text: str, *short: str) -> Primitive:
    """Return a primitive that runs lists or ends procedures; its value depends on those."""
    return replace(command(usage, act, text, *short), gives_value=True, controls=True)


# -- turtles -----------------------------------------------------------------------------------------------------------

COLOURS: dict[str, Colour] = {
    "black": (0, 0, 0), "blue": (0, 0, 255), "green": (0, 255, 0), "cyan": (0, 255, 255),
    "red": (255, 0, 0), "magenta": (255, 0, 255), "yellow": (255, 255, 0), "white": (255, 255, 255),
    "brown": (155, 96, 59), "tan": (197, 136, 18), "forest": (100, 162, 64), "aqua": (120, 187, 187),
    "salmon": (255, 149, 119), "purple": (144, 113, 208), "orange": (255, 163, 0), "grey": (183, 183, 183),
}  # fmt: skip
"""Colour names; as in UCBLogo their indices 0 to 15 are colours as well."""

_COLOUR = "a colour: a number from 0 to 15, a name such as red, or a list of three numbers from 0 to 100"


def _each(change: Callable[[Turtle, float], None]) -> Callable[[State, Value], None]:
    def act(state: State, value: Value) -> None:
        amount = number(value)
        for turtle in state.movers():
            change(turtle, amount)

    return act


def _go(state: State, x: Value, y: Value) -> None:
    to_x, to_y = number(x), number(y)
    for turtle in state.movers():
        turtle.move(Pose(to_x, to_y, turtle.goal.heading))


def _home(state: State) -> None:
    for turtle in state.movers():
        turtle.home()


def _clear_screen(state: State) -> None:
    for turtle in state.movers():
        pen = turtle.pen
        turtle.set_pen(replace(pen, down=False))
        turtle.home()
        turtle.set_pen(pen)
    state.flock.clean()


def _point(value: Value) -> tuple[float, float]:
    members = as_list(value, "a list of two numbers")
    if len(members) != 2:
        raise BadInput(value, "a list of two numbers")
    return number(members.items[0]), number(members.items[1])


def _colour(value: Value) -> Colour:
    """Return the colour that a number, a name or a list represents. Raises ``BadInput``."""
    if isinstance(value, LogoList):
        parts = [number(part, _COLOUR) for part in value]
        if len(parts) != 3 or not all(0 <= part <= 100 for part in parts):
            raise BadInput(value, _COLOUR)
        red, green, blue = (round(2.55 * part) for part in parts)
        return red, green, blue
    name = word(value).lower()
    if name in COLOURS:
        return COLOURS[name]
    if number_in(value) is None:
        raise BadInput(value, _COLOUR + suggestion(name, COLOURS))
    return list(COLOURS.values())[whole(value, 0, 15, _COLOUR)]


def _set_pens(state: State, **change: Any) -> None:
    for turtle in state.flock.active:
        turtle.set_pen(replace(turtle.pen, **change))


def _pose(name: str) -> Callable[[State], float]:
    return lambda state: _rounded(getattr(state.flock.active[0].pose, name))


def _rounded(value: float) -> float:
    """Remove the rounding error of sines, because programs may print the value."""
    return round(value, 9) + 0.0


def _offset(state: State, point: Value) -> tuple[float, float]:
    (x, y), pose = _point(point), state.flock.active[0].pose
    return x - pose.x, y - pose.y


def _towards(state: State, point: Value) -> float:
    return _rounded(math.degrees(math.atan2(*_offset(state, point))) % 360.0)


def turtles_named(state: State, names: Value) -> list[Turtle]:
    """Return the turtles that a name or a list of names represents. Raises ``LogoError``."""
    members = names.items if isinstance(names, LogoList) else (names,)
    if not members:
        raise BadInput(names, "a turtle's name, or a list of names")
    return [state.flock.find(word(each, "a turtle's name")) for each in members]


def _tell(state: State, names: Value) -> None:
    state.flock.active = turtles_named(state, names)


def _new_turtle(state: State, name: Value) -> None:
    state.movers()
    state.flock.add(word(name, "a turtle's name"))


# -- numbers -----------------------------------------------------------------------------------------------------------


def _calculate(function: Callable[..., float]) -> Callable[..., float]:
    return lambda _, *values: tidy(function(*map(number, values)))


def _round(value: float) -> int:
    return math.floor(abs(value) + 0.5) * (-1 if value < 0 else 1)


def _test(test: Callable[..., bool], convert: Callable[[Value], Any]) -> Callable[..., str]:
    return lambda _, *values: _boolean(test(*map(convert, values)))


def _divided(*values: Value) -> tuple[float, float]:
    a, b = map(number, values)
    if b == 0:
        raise LogoError("division by zero")
    return a, b


def _quotient(_: State, first: Value, second: Value) -> float:
    a, b = _divided(first, second)
    return a // b if isinstance(a, int) and isinstance(b, int) and a % b == 0 else tidy(a / b)


def _remainder(_: State, first: Value, second: Value) -> float:
    a, b = _divided(first, second)
    found = math.fmod(a, b)
    return int(found) if isinstance(a, int) and isinstance(b, int) else found


def _sqrt(_: State, value: Value) -> float:
    given = number(value)
    if given < 0:
        raise BadInput(value, "a number of 0 or more")
    return math.sqrt(given)


def _equal(state: State, first: Value, second: Value) -> str:
    state.step(min(weight(first), weight(second)))
    return _boolean(is_equal(first, second))


def _boolean(value: bool) -> str:
    return "true" if value else "false"


# -- words and lists ---------------------------------------------------------------------------------------------------


def _parts(state: State, value: Value) -> tuple[Value, ...] | str:
    """Return the members of a list or the letters of a word. Raises ``BadInput`` if there are none."""
    state.handled(value)
    parts = value.items if isinstance(value, LogoList) else word(value)
    if not parts:
        raise BadInput(value, "a word or a list that is not empty")
    return parts


def _part(state: State, value: Value, which: slice) -> Value:
    parts = _parts(state, value)[which]
    return parts if isinstance(parts, str) else LogoList(parts)


def _item(state: State, index: Value, value: Value) -> Value:
    parts = _parts(state, value)
    return parts[whole(index, 1, len(parts), f"a whole number from 1 to {len(parts)}") - 1]


def _count(_: State, value: Value) -> int:
    return len(value if isinstance(value, LogoList) else word(value))


def _word(state: State, first: Value, second: Value) -> Value:
    if len(word(first)) + len(word(second)) > MAX_SIZE:
        raise LogoError(f"a word has more than {MAX_SIZE} letters")
    return state.handled(word(first) + word(second))


def _list(state: State, *values: Value) -> Value:
    return state.handled(LogoList(values))


def _sentence(state: State, *values: Value) -> Value:
    parts = [value.items if isinstance(value, LogoList) else (value,) for value in values]
    return _list(state, *chain(*parts))


def _make(state: State, name: Value, value: Value) -> None:
    state.variables[word(name, "a name").lower()] = value


def _emptyp(_: State, value: Value) -> str:
    return _boolean(isinstance(value, str | LogoList) and len(value) == 0)


def _printer(form: Callable[[Value], str]) -> Callable[[State, Value], None]:
    return lambda state, value: state.print(form(state.handled(value)))


TABLE = (
    command("forward distance", _each(lambda t, by: t.forward(by)), "goes straight ahead, so many steps", "fd"),
    command("back distance", _each(lambda t, by: t.forward(-by)), "goes backwards", "bk"),
    command("right degrees", _each(lambda t, by: t.right(by)), "turns clockwise", "rt"),
    command("left degrees", _each(lambda t, by: t.right(-by)), "turns anticlockwise", "lt"),
    command("setheading degrees", _each(lambda t, by: t.face(by)), "turns to a heading: 0 is up, 90 right", "seth"),
    command("setxy x y", _go, "goes to a point; the middle is 0 0"),
    command("setpos point", lambda s, point: _go(s, *_point(point)), "goes to a point, which is a list of x and y"),
    command("home", _home, "returns to the pose at which the turtle began"),
    command("clearscreen", _clear_screen, "goes home and erases all lines", "cs"),
    command("penup", lambda s: _set_pens(s, down=False), "stops drawing lines", "pu"),
    command("pendown", lambda s: _set_pens(s, down=True), "starts drawing lines again", "pd"),
    command("setpencolor colour", lambda s, c: _set_pens(s, colour=_colour(c)), f"draws in {_COLOUR}", "setpc"),
    command("setpensize size", lambda s, n: _set_pens(s, size=whole(n, 1, 255)), "sets the width of lines, 1 to 255"),
    command("tell turtles", _tell, "makes these turtles the active ones: a name or a list of names"),
    command("newturtle name", _new_turtle, "makes a turtle in the middle"),
    reporter("pos", lambda s: LogoList(map(_rounded, s.flock.active[0].pose[:2])), "the position of the turtle"),
    reporter("xcor", _pose("x"), "the x coordinate of the turtle"),
    reporter("ycor", _pose("y"), "the y coordinate of the turtle"),
    reporter("heading", _pose("heading"), "the heading of the turtle, clockwise from up"),
    reporter("towards point", _towards, "the heading from the turtle to a point"),
    reporter("distance point", lambda s, p: _rounded(math.hypot(*_offset(s, p))), "the distance to a point"),
    reporter("sum number number", _calculate(operator.add), "adds; also written as +"),
    reporter("difference number number", _calculate(operator.sub), "subtracts; also written as -"),
    reporter("minus number", _calculate(operator.neg), "changes the sign; also written as -"),
    reporter("product number number", _calculate(operator.mul), "multiplies; also written as *"),
    reporter("quotient number number", _quotient, "divides; also written as /"),
    reporter("remainder number number", _remainder, "the remainder of a division"),
    reporter("sqrt number", _sqrt, "the square root"),
    reporter("abs number", _calculate(abs), "the absolute value"),
    reporter("int number", _calculate(math.trunc), "the number without its decimal places"),
    reporter("round number", _calculate(_round), "the nearest integer"),
    reporter("sin degrees", _calculate(sine), "the sine"),
    reporter("cos degrees", _calculate(cosine), "the cosine"),
    reporter("random number", lambda s, n: int(s.random.integers(whole(n, 1))), "a random integer from 0, below this"),
    reporter("equalp thing thing", _equal, "whether both are equal; also written as ="),
    reporter("notequalp thing thing", lambda s, a, b: _boolean(_equal(s, a, b) == "false"), "also written as <>"),
    reporter("lessp number number", _test(operator.lt, number), "also written as <"),
    reporter("greaterp number number", _test(operator.gt, number), "also written as >"),
    reporter("lessequalp number number", _test(operator.le, number), "also written as <="),
    reporter("greaterequalp number number", _test(operator.ge, number), "also written as >="),
    reporter("and truth truth", _test(operator.and_, truth), "whether both are true"),
    reporter("or truth truth", _test(operator.or_, truth), "whether one is true"),
    reporter("not truth", _test(operator.not_, truth), "the opposite"),
    reporter("first thing", lambda s, value: _parts(s, value)[0], "the first letter or member"),
    reporter("last thing", lambda s, value: _parts(s, value)[-1], "the last letter or member"),
    reporter("butfirst thing", lambda s, value: _part(s, value, slice(1, None)), "all but the first", "bf"),
    reporter("butlast thing", lambda s, value: _part(s, value, slice(-1)), "all but the last", "bl"),
    reporter("item index thing", _item, "the letter or member at an index, counted from 1"),
    reporter("count thing", _count, "the number of letters or members"),
    reporter("emptyp thing", _emptyp, "whether it is [] or an empty word", "empty?"),
    reporter("word word word", _word, "joins words"),
    reporter("list thing thing", _list, "a list of its inputs"),
    reporter("sentence thing thing", _sentence, "a list of words and of the members of lists", "se"),
    reporter("fput thing list", lambda s, new, rest: _list(s, new, *as_list(rest)), "a list with a new first member"),
    reporter("lput thing list", lambda s, new, rest: _list(s, *as_list(rest), new), "a list with a new last member"),
    command("make name thing", _make, "gives a variable a value"),
    command("print thing", _printer(write), "prints a line; lists without their brackets", "pr"),
    command("show thing", _printer(show), "prints a line; lists with their brackets"),
)  # fmt: skip
"""Primitives that take values."""
