"""What is done with each member of a list, and ways out: `map`, `filter`, `foreach`, `test`, `catch` and `throw`.

A template is a list in which `?` is the member, or the name of a word that takes it: `map [? * ?] [1 2]`,
`map "sqrt [4 9]`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.logo.compiler import Code, Primitive
from rosmini.logo.errors import BadInput, LogoError
from rosmini.logo.machine import Frame, Machine
from rosmini.logo.values import LogoList, Value, as_list, show, truth, word

from .control import Loop

if TYPE_CHECKING:
    from collections.abc import Callable

TEST = " test"
"""What `test` found is kept under this name, which no program can write, so it ends with the procedure."""


class ForEach(Loop):
    """For each member of a list; `?` is the member."""

    __slots__ = ("items", "saved")

    def __init__(self, code: Code, items: tuple[Value, ...] | str) -> None:
        super().__init__(code)
        self.items = items
        self.saved: dict[str, Value | None] = {}

    def goes_on(self, machine: Machine) -> bool:
        """Take the next member."""
        if self.turn > len(self.items):
            return False
        machine.bind(self.saved, "?", self.items[self.turn - 1])
        return True

    def leave(self, machine: Machine) -> None:
        """Forget the member."""
        machine.restore(self.saved)


class Map(ForEach):
    """What a template gives for each member, or, as a filter, the members for which it gives true."""

    __slots__ = ("filters", "results")

    def __init__(self, code: Code, items: tuple[Value, ...] | str, *, filters: bool) -> None:
        super().__init__(code, items)
        self.filters = filters
        self.results: list[Value] = []

    def at_end(self, machine: Machine) -> None:
        """Keep what the template gave, and go on with the next member."""
        value = machine.stack.pop()
        name = "filter" if self.filters else "map"
        if value is None:
            raise LogoError(f"{name} needs a value for each member, and its template gave none")
        if not self.filters:
            self.results.append(machine.made(value))
        elif self._holds(value):
            self.results.append(self.items[self.turn - 1])
        self.turn += 1
        if self.goes_on(machine):
            self.pc = 0
        else:
            machine.pop()
            machine.stack.append(self.result(machine))

    @staticmethod
    def _holds(value: Value) -> bool:
        try:
            return truth(value)
        except BadInput as error:
            error.name_word("filter")
            raise

    def result(self, machine: Machine) -> Value:
        """A list of a list's members, a word of a word's letters."""
        if isinstance(self.items, str):
            return machine.made("".join(word(value) for value in self.results))
        return machine.made(LogoList(self.results))


class Catch(Frame):
    """A list that `throw` with the same tag leaves."""

    __slots__ = ("base", "tag")

    def __init__(self, code: Code, tag: str, base: int) -> None:
        super().__init__(code)
        self.tag, self.base = tag, base

    def leave(self, machine: Machine) -> None:
        """Nothing was changed; a procedure that is called last must not leave it all the same."""


def _template(machine: Machine, value: Value) -> Code:
    if not isinstance(value, LogoList):
        value = LogoList([word(value), "?"])
    return machine.code_of(value)


def _members(value: Value) -> tuple[Value, ...] | str:
    return value.items if isinstance(value, LogoList) else word(value)


def _foreach(machine: Machine, items: Value, template: Value) -> None:
    ForEach(_template(machine, template), _members(items)).begin(machine)


def _over(*, filters: bool) -> Callable[[Machine, Value, Value], None]:
    def act(machine: Machine, template: Value, items: Value) -> None:
        frame = Map(_template(machine, template), _members(items), filters=filters)
        if frame.goes_on(machine):
            machine.push(frame)
        else:
            machine.stack.append(frame.result(machine))

    return act


def _question(machine: Machine) -> Value:
    found = machine.variables.get("?")
    if found is None:
        raise LogoError("? stands for something inside foreach, map and filter only")
    return found


def _tag(value: Value) -> str:
    return word(value, "a tag, which is a word").lower()


def _catch(machine: Machine, tag: Value, block: Value) -> None:
    name = _tag(tag)
    if name == "error":
        raise LogoError("errors are not caught here: the program ends, and the message says where")
    code = machine.code_of(as_list(block, "a list of instructions"))
    machine.push(Catch(code, name, len(machine.stack)))


def _throw(machine: Machine, tag: Value, value: Value | None = None) -> None:
    name = _tag(tag)
    waiting = [frame.tag for frame in machine.frames if isinstance(frame, Catch)]
    if name not in waiting:
        there = f"there is catch {', '.join(sorted(set(waiting)))}" if waiting else "nothing catches here"
        raise LogoError(f"throw {show(name)}: no catch of this tag is waiting; {there}")
    while True:
        frame = machine.pop()
        if isinstance(frame, Catch) and frame.tag == name:
            del machine.stack[frame.base :]
            machine.stack.append(value)
            return


def _test(machine: Machine, condition: Value) -> None:
    machine.local(TEST, "true" if truth(condition) else "false")


def _if_test(wanted: str) -> Callable[[Machine, Value], None]:
    def act(machine: Machine, block: Value) -> None:
        found = machine.variables.get(TEST)
        if found is None:
            raise LogoError(f"if{wanted} needs a test before it: test :size > 10")
        if found == wanted:
            machine.enter(as_list(block, "a list of instructions"))
        else:
            machine.stack.append(None)

    return act


def _row(name: str, inputs: str, act: Callable[..., None], text: str, **more: object) -> Primitive:
    return Primitive(name, tuple(inputs.split()), act, text, controls=True, **more)  # type: ignore[arg-type]


TEMPLATES = (
    _row("foreach", "list template", _foreach, "does the template for each member of the list"),
    _row("map", "template list", _over(filters=False), "what the template gives for each member"),
    _row("filter", "template list", _over(filters=True), "the members for which the template gives true"),
    Primitive("?", (), _question, "the member, in a template", reports=True),
    Primitive("test", ("condition",), _test, "remembers whether it is true"),
    _row(
        "iftrue",
        "list",
        _if_test("true"),
        "does what is in the list if the last test was true",
        short=("ift",),
    ),
    _row("iffalse", "list", _if_test("false"), "does it if the last test was false", short=("iff",)),
    _row("catch", "tag list", _catch, "does what is in the list; throw with this tag leaves it"),
    _row("throw", "tag", _throw, "leaves the catch of this tag; (throw tag value) with a value", most=2),
)
"""Words about templates, tests and ways out."""
