"""What decides what is done next: conditions, loops, and the ends of procedures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.logo.compiler import Code, Primitive, compile_values
from rosmini.logo.errors import BadInput, LogoError
from rosmini.logo.machine import Frame, Machine, unused
from rosmini.logo.values import LogoList, Value, as_list, number, show, truth, whole, word

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.logo.turtles import Turtle


class Loop(Frame):
    """A list that is run again and again; a value that a turn leaves is an error."""

    __slots__ = ("turn",)

    def __init__(self, code: Code) -> None:
        super().__init__(code)
        self.turn = 1

    def at_end(self, machine: Machine) -> None:
        """Begin another turn, or leave."""
        unused(machine.stack.pop())
        self.turn += 1
        if self.goes_on(machine):
            self.pc = 0
        else:
            machine.pop()
            machine.stack.append(None)

    def goes_on(self, machine: Machine) -> bool:
        """Whether there is another turn."""
        raise NotImplementedError

    def begin(self, machine: Machine) -> None:
        """Enter the loop, if there is a first turn."""
        if self.goes_on(machine):
            machine.push(self)
        else:
            self.leave(machine)
            machine.stack.append(None)


class Repeat(Loop):
    """As often as was said."""

    __slots__ = ("times",)

    def __init__(self, code: Code, times: float) -> None:
        super().__init__(code)
        self.times = times

    def goes_on(self, machine: Machine) -> bool:
        """Whether it was not often enough."""
        del machine
        return self.turn <= self.times


class For(Loop):
    """With a name that counts."""

    __slots__ = ("last", "name", "saved", "step", "value")

    def __init__(self, code: Code, name: str, span: tuple[float, float, float]) -> None:
        super().__init__(code)
        self.name = name
        first, self.last, self.step = span
        self.value = first - self.step
        self.saved: dict[str, Value | None] = {}

    def goes_on(self, machine: Machine) -> bool:
        """Count, unless that would be too far."""
        self.value += self.step
        if (self.value - self.last) * (1 if self.step >= 0 else -1) > 0:
            return False
        machine.bind(self.saved, self.name, self.value)
        return True

    def leave(self, machine: Machine) -> None:
        """Let the name stand for what it stood for."""
        machine.restore(self.saved)


class ForSpan(Frame):
    """The numbers that `for` counts between, which may be any expressions."""

    __slots__ = ("body", "count", "name")

    def __init__(self, code: Code, count: int, name: str, body: Code) -> None:
        super().__init__(code)
        self.count, self.name, self.body = count, name, body

    def at_end(self, machine: Machine) -> None:
        """Begin the loop."""
        machine.pop()
        try:
            values = [number(value) for value in machine.stack[-self.count :] if value is not None]
        except BadInput as error:
            error.name_word("for")
            raise
        del machine.stack[-self.count :]
        first, last = values[:2]
        step = values[2] if self.count == 3 else 1 if last >= first else -1
        For(self.body, self.name, (first, last, step)).begin(machine)


class While(Frame):
    """A list that is run as long as another one gives true (or false)."""

    __slots__ = ("asks", "body", "test", "wanted")

    def __init__(self, test: Code, body: Code, *, wanted: bool, asks: bool = True) -> None:
        super().__init__(test if asks else body)
        self.test, self.body, self.wanted, self.asks = test, body, wanted, asks

    def at_end(self, machine: Machine) -> None:
        """Judge the condition, or ask again."""
        value = machine.stack.pop()
        if not self.asks:
            unused(value)
        elif value is None:
            raise LogoError("the condition gives no value")
        elif truth(value) != self.wanted:
            machine.pop()
            machine.stack.append(None)
            return
        self.asks = not self.asks
        self.code, self.pc = self.test if self.asks else self.body, 0


class Ask(Frame):
    """A list that other turtles listen to."""

    __slots__ = ("before",)

    def __init__(self, code: Code, before: list[Turtle]) -> None:
        super().__init__(code)
        self.before = before

    def leave(self, machine: Machine) -> None:
        """Let those listen again that did."""
        machine.flock.active = self.before


def _block(value: Value) -> LogoList:
    return as_list(value, "a list of instructions")


def _run(machine: Machine, block: Value) -> None:
    machine.enter(block)


def _repeat(machine: Machine, times: Value, block: Value) -> None:
    count = whole(times, 0, wanted="a whole number of 0 or more")
    Repeat(machine.code_of(_block(block)), count).begin(machine)


def _forever(machine: Machine, block: Value) -> None:
    Repeat(machine.code_of(_block(block)), float("inf")).begin(machine)


def _repcount(machine: Machine) -> int:
    return next((frame.turn for frame in reversed(machine.frames) if isinstance(frame, Repeat)), -1)


def _if(machine: Machine, condition: Value, yes: Value, no: Value | None = None) -> None:
    if truth(condition):
        machine.enter(_block(yes))
    elif no is not None:
        machine.enter(_block(no))
    else:
        machine.stack.append(None)


def _while(machine: Machine, test: Value, block: Value) -> None:
    machine.push(While(machine.code_of(_block(test)), machine.code_of(_block(block)), wanted=True))


def _until(machine: Machine, test: Value, block: Value) -> None:
    machine.push(While(machine.code_of(_block(test)), machine.code_of(_block(block)), wanted=False))


def _for(machine: Machine, span: Value, block: Value) -> None:
    items = as_list(span, "a list such as [i 1 10] or [i 10 0 -2]")
    lines = items.lines
    rest = LogoList(items.items[1:], None if lines is None else lines[1:])
    code, count = compile_values(rest, machine.words)
    if not 2 <= count <= 3:
        raise BadInput(show(span), "a list such as [i 1 10] or [i 10 0 -2]")
    machine.push(ForSpan(code, count, word(items.items[0], "a name").lower(), machine.code_of(_block(block))))


def _output(machine: Machine, value: Value | None) -> None:
    if value is None:
        raise LogoError("output needs a value, and what comes next gave none")
    machine.output(value, "output")


def _stop(machine: Machine) -> None:
    machine.output(None, "stop")


def _wait(machine: Machine, ticks: Value) -> None:
    machine.pause(whole(ticks, 0, 36_000, "a whole number of sixtieths of a second, up to 36000") / 60.0)


def _ask(machine: Machine, turtles: Value, block: Value) -> None:
    code = machine.code_of(_block(block))
    found = turtles_of(machine, turtles)
    machine.push(Ask(code, machine.flock.active))
    machine.flock.active = found


def turtles_of(machine: Machine, names: Value) -> list[Turtle]:
    """The turtles that a name, a number or a list of these means; 2 is turtle2. Raises ``LogoError``."""
    members = names.items if isinstance(names, LogoList) else (names,)
    if not members:
        raise BadInput("[]", "a turtle's name, or a list of names")
    return [machine.flock.find(turtle_name(each)) for each in members]


def turtle_name(value: Value) -> str:
    """The name of a turtle that a word or a number means. Raises ``BadInput``."""
    name = word(value, "a turtle's name")
    return f"turtle{name}" if name.isdecimal() else name


def _row(name: str, inputs: str, act: Callable[..., None], text: str, **more: object) -> Primitive:
    return Primitive(name, tuple(inputs.split()), act, text, controls=True, **more)  # type: ignore[arg-type]


CONTROL = (
    _row("repeat", "number list", _repeat, "does what is in the list so many times"),
    Primitive(
        "repcount", (), _repcount, "which turn of the innermost repeat this is, from 1", ("#",), reports=True
    ),
    _row("forever", "list", _forever, "repeats until stop, output or the limit of steps"),
    _row("if", "condition list", _if, "does what is in the list if the condition is true", most=3),
    _row(
        "ifelse", "condition list list", _if, "does the first list if the condition is true, else the second"
    ),
    _row("while", "list list", _while, "does the second list as long as the first gives true"),
    _row("until", "list list", _until, "does the second list until the first gives true"),
    _row("for", "span list", _for, "counts: for [i 1 10] or for [i 10 0 -2]"),
    _row("run", "list", _run, "does what is in the list, or gives its value"),
    _row("output", "thing", _output, "ends the procedure, with this value", short=("op",)),
    _row("stop", "", _stop, "ends the procedure"),
    _row("ask", "turtles list", _ask, "lets other turtles do what is in the list"),
    Primitive("wait", ("ticks",), _wait, "waits for so many sixtieths of a second"),
)
"""Words about what comes next; `to` and `end` are read before."""
