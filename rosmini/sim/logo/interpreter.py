"""The interpreter of Logo: it walks the expressions of a program, using generators.

A generator yields whatever it needs evaluated first, so a program's calls are in a list and not on Python's stack:
recursion may be deep, and its limit does not depend on Python's.

Names are bound dynamically, as in all Logos: a procedure sees the inputs of its callers.
"""

from __future__ import annotations

from types import GeneratorType
from typing import TYPE_CHECKING, Any, TypeAlias

from .floor import FloorFlock, robots_of
from .reader import Call, Constant, Expression, Procedure, Variable, parse, read
from .turtles import Drawing, Flock, Paper
from .turtlesim import WindowFlock, turtles_of
from .values import (
    BadInput,
    LogoError,
    LogoList,
    LogoStopped,
    Value,
    as_list,
    described,
    suggestion,
    truth,
    whole,
    word,
)  # fmt: skip
from .words import TABLE, Limits, Primitive, State, command, control, reporter, turtles_named

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable

    from rosmini.core.graph import Node

    Steps: TypeAlias = "Generator[Steps, Value | None, Value | None]"

_DEEP = "stopped: over {} calls wait for one another. Does a procedure call itself without a condition to stop?"


class Logo:
    """An interpreter of Logo, which keeps the procedures and variables of earlier programs.

    Args:
        flock: the turtles; by default one that draws on paper.
        say: called with each line that is printed.
        seed: the seed of `random`.
        limits: the limits at which a program is stopped.

    >>> logo = Logo()
    >>> logo.run("repeat 4 [forward 50 right 90]  print pos")
    0 0
    >>> len(logo.drawing.lines)
    4

    """

    def __init__(
        self,
        flock: Flock | None = None,
        *,
        say: Callable[[str], object] = print,
        seed: int = 0,
        limits: Limits | None = None,
    ) -> None:
        self.node: Node | None = None
        """Its node if it drives turtles of a graph."""
        self.procedures: dict[str, Procedure] = {}
        self.state = State(flock or Paper(), say, seed, limits or Limits())
        self._bodies: dict[str, tuple[list[Expression], Any]] = {}
        """For each procedure, its instructions, and apart from them the last one if that calls a procedure."""
        self._saved: list[dict[str, Value | None]] = []
        """For each running procedure, the values that its inputs hide."""
        self._turns: list[int] = []
        """The current turn of each running `repeat`."""

    @classmethod
    def on(cls, node: Node, *names: str, **options: Any) -> Logo:
        """Return an interpreter whose node drives turtles of turtlesim, or robots (named by their namespace).

        Without ``names`` it drives the first turtle of turtlesim, or all robots, or a turtle on paper. ``options`` are
        those of the class. Raises ``LogoError`` for an unknown name.
        """
        made = cls(_flock_on(node, list(names)), **options)
        made.node = node
        return made

    @property
    def flock(self) -> Flock:
        """The turtles."""
        return self.state.flock

    @property
    def drawing(self) -> Drawing:
        """The current drawing."""
        return Drawing.of(self.flock)

    def refresh(self) -> None:
        """Update the turtles; one on paper is replaced by turtles or robots that have been started since."""
        if self.node is not None and isinstance(self.flock, Paper):
            found = _flock_on(self.node, [])
            if not isinstance(found, Paper):
                self.state.flock = found
        self.flock.refresh()

    def run(self, program: str, first_line: int = 1) -> None:
        """Run a program; `first_line` is the number of its first line in messages.

        Raises ``LogoError``, and ``LogoStopped`` at a limit. Nothing runs if an instruction outside procedures is
        invalid.
        """
        self.refresh()
        procedures, lines = read(program, first_line)
        for made in procedures.values():
            if made.name in PRIMITIVES:
                raise LogoError(f"{made.name} is a primitive of Logo; choose another name", made.line)
        self.procedures = {**self.procedures, **procedures}
        self._bodies.clear()
        self.state.steps = self.state.moves = self.state.lines = 0
        instructions = [each for line in lines for each in self._parsed(line)]
        self._evaluate(self._sequence(instructions))

    # -- evaluation --------------------------------------------------------------------------------------------------

    def _evaluate(self, first: Steps) -> None:
        """Run a generator and all that it yields, innermost first."""
        stack = [first]
        value: Value | None = None
        error: BaseException | None = None
        limit = self.state.limits.depth
        try:
            while stack:
                try:
                    inner = stack[-1].send(value) if error is None else stack[-1].throw(error)
                except StopIteration as done:
                    stack.pop()
                    value, error = done.value, None
                except BaseException as raised:
                    stack.pop()
                    error = raised
                else:
                    value = error = None
                    if len(stack) < limit:
                        stack.append(inner)
                    else:
                        error = LogoStopped(_DEEP.format(limit))
            if error is not None:
                raise error
        finally:
            while stack:  # Ctrl-C between two generators
                stack.pop().close()

    def _parsed(self, line: LogoList) -> list[Expression]:
        """Return the expressions of a list, which are cached until procedures change."""
        if line.parsed is None or line.parsed[0] is not self.procedures:
            self.state.step(line.weight // 4)
            line.parsed = (self.procedures, parse(line, PRIMITIVES, self.procedures))
        found: list[Expression] = line.parsed[1]
        return found

    def _sequence(self, expressions: Iterable[Expression]) -> Steps:
        """Evaluate expressions, of which only the last may have a value; return that."""
        value: Value | None = None
        for each in expressions:
            _require_none(value)
            value = (yield self._call(each)) if isinstance(each, Call) else self._simple(each)
        return value

    def block(self, block: Value, **bindings: Value) -> Steps:
        """Run a list with these names bound; return its value or None."""
        expressions = self._parsed(as_list(block, "a list of instructions"))
        saved: dict[str, Value | None] = {}
        self.state.step()
        try:
            self._bind(saved, bindings)
            return (yield self._sequence(expressions))
        finally:
            self._restore(saved)

    def command(self, block: Value, **bindings: Value) -> Steps:
        """Run a list that must not have a value."""
        _require_none((yield self.block(block, **bindings)))
        return None

    def _simple(self, expression: Constant | Variable) -> Value:
        if isinstance(expression, Constant):
            return expression.value
        try:
            return self.state.value_of(expression.name)
        except LogoError as error:
            error.line = expression.line
            raise

    def _inputs(self, call: Call) -> Generator[Steps, Value | None, list[Value]]:
        values = []
        for each in call.inputs:
            value = (yield self._call(each)) if isinstance(each, Call) else self._simple(each)
            if value is None:
                raise LogoError(f"{getattr(each, 'text', '')} didn't output to {call.text}")
            values.append(value)
        return values

    def _call(self, call: Call) -> Steps:
        try:
            values = yield from self._inputs(call)
            self.state.step()
            if isinstance(call.word, Procedure):
                return (yield self._run(call.word, values))
            found = call.word.act(self if call.word.controls else self.state, *values)
            return (yield found) if isinstance(found, GeneratorType) else found
        except BadInput as error:
            message = f"{call.text} doesn't like {error.given} as input: it needs {error.wanted}"
            raise LogoError(message, call.line or None) from None
        except LogoError as error:
            error.line = error.line or call.line or None
            raise

    # -- procedures --------------------------------------------------------------------------------------------------

    def _run(self, procedure: Procedure, values: list[Value]) -> Steps:
        """Run a procedure; a call in its last instruction replaces it, so such recursion may go on forever."""
        self._saved.append({})
        is_replaced = False
        try:
            while True:
                self._bind(self._saved[-1], dict(zip(procedure.inputs, values, strict=True)))
                following = yield from self._body(procedure)
                if following is None:
                    return None
                procedure, values, is_replaced = *following, True
        except _Output as output:
            if is_replaced:
                _require_none(output.value)
            return output.value
        except LogoError as error:
            error.procedure = error.procedure or procedure.name
            raise
        finally:
            self._restore(self._saved.pop())

    def _body(self, procedure: Procedure) -> Generator[Steps, Any, tuple[Procedure, list[Value]] | None]:
        """Run the instructions of a procedure; return its last one if that calls a procedure."""
        if procedure.name not in self._bodies:
            body = [each for line in procedure.body for each in self._parsed(line)]
            has_last = bool(body) and isinstance(body[-1], Call) and isinstance(body[-1].word, Procedure)
            self._bodies[procedure.name] = (body[:-1], body[-1]) if has_last else (body, None)
        expressions, last = self._bodies[procedure.name]
        _require_none((yield self._sequence(expressions)))
        if last is None:
            return None
        self.state.step()
        return last.word, (yield from self._inputs(last))

    def _bind(self, saved: dict[str, Value | None], bindings: dict[str, Value]) -> None:
        for name, value in bindings.items():
            saved.setdefault(name, self.state.variables.get(name))
            self.state.variables[name] = value

    def _restore(self, saved: dict[str, Value | None]) -> None:
        for name, value in saved.items():
            if value is None:
                self.state.variables.pop(name, None)
            else:
                self.state.variables[name] = value

    def leave(self, value: Value | None = None) -> None:
        """Leave the current procedure. Raises ``LogoError`` outside procedures."""
        if not self._saved:
            raise LogoError("output and stop work only inside a procedure")
        raise _Output(value)

    # -- loops -------------------------------------------------------------------------------------------------------

    def repeat(self, times: float, block: Value) -> Steps:
        """Run a list this number of times."""
        self._turns.append(0)
        try:
            while self._turns[-1] < times:
                self._turns[-1] += 1
                yield self.command(block)
        finally:
            self._turns.pop()
        return None

    def turn(self) -> int:
        """Return the current turn of the innermost `repeat`, or -1."""
        return self._turns[-1] if self._turns else -1

    def while_(self, condition: Value, block: Value) -> Steps:
        """Run a list while another one gives true."""
        while True:
            value = yield self.block(condition)
            if value is None:
                raise LogoError("the condition gives no value")
            if not truth(value):
                return None
            yield self.command(block)

    def foreach(self, items: Value, block: Value) -> Steps:
        """Run a list for each member of another, with `?` as the member."""
        for each in items if isinstance(items, LogoList) else word(items):
            yield self.command(block, **{"?": each})
        return None

    def choose(self, condition: Value, yes: Value, no: Value | None = None) -> Steps | None:
        """Run one of two lists, or none."""
        block = yes if truth(condition) else no
        return None if block is None else self.block(block)

    def ask(self, names: Value, block: Value) -> Steps:
        """Run a list while these turtles are the active ones."""
        before = self.flock.active
        self.flock.active = turtles_named(self.state, names)
        try:
            return (yield self.block(block))
        finally:
            self.flock.active = before


class _Output(Exception):
    """Ends a procedure, with a value or None."""

    def __init__(self, value: Value | None) -> None:
        super().__init__()
        self.value = value


def _require_none(value: Value | None) -> None:
    if value is not None:
        raise LogoError(f"you don't say what to do with {described(value)}")


def _flock_on(node: Node, names: list[str]) -> Flock:
    turtles, robots = turtles_of(node), robots_of(node)
    if not names:
        return WindowFlock(node) if turtles else FloorFlock(node, robots) if robots else Paper()
    wanted = [name.strip("/") for name in names]
    if set(wanted) <= set(turtles):
        return WindowFlock(node, wanted)
    spaces = [f"/{name}" if name else "" for name in wanted]
    if set(spaces) <= set(robots):
        return FloorFlock(node, spaces)
    known = [*turtles, *(robot.strip("/") or "/" for robot in robots)]
    missing = next((name for name in names if (name.strip("/") or "/") not in known), names[0])
    listed = suggestion(missing, known) or (f"; there are {', '.join(known)}" if known else "")
    raise LogoError(f"there is no turtle and no robot {missing} in the graph{listed}")


def _help(state: State, name: Value) -> None:
    known = PRIMITIVES.get(word(name).lower())
    if known is None:
        raise BadInput(name, "a primitive of Logo")
    short = f" (short: {', '.join(known.short)})" if known.short else ""
    state.print(f"{known.usage}{short}: {known.help}")


def _count(times: Value) -> int:
    return whole(times, 0, wanted="a whole number of 0 or more")


CONTROL = (
    control("repeat number list", lambda logo, n, block: logo.repeat(_count(n), block), "runs a list several times"),
    control("forever list", lambda logo, block: logo.repeat(float("inf"), block), "repeats until stop or a limit"),
    control("repcount", Logo.turn, "the turn of the innermost repeat, counted from 1"),
    control("if condition list", Logo.choose, "runs the list if the condition is true"),
    control("ifelse condition list list", Logo.choose, "runs the first list if the condition is true, else the other"),
    control("while list list", Logo.while_, "runs the second list while the first gives true"),
    control("foreach list list", Logo.foreach, "runs the second list for each member of the first, which is ?"),
    control("run list", Logo.block, "runs the list; its value is that of the list"),
    control("output thing", Logo.leave, "ends the procedure with a value", "op"),
    control("stop", Logo.leave, "ends the procedure"),
    control("ask turtles list", Logo.ask, "runs the list with other turtles"),
    reporter("?", lambda state: state.value_of("?"), "the member, in a list that foreach runs"),
    command("help name", _help, "prints what a primitive does"),
)  # fmt: skip
"""Primitives that run lists or end procedures."""

PRIMITIVES: dict[str, Primitive] = {name: each for each in (*TABLE, *CONTROL) for name in (each.name, *each.short)}
"""All primitives by all their names."""
