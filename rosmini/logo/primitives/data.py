"""Words, lists, names, and what is printed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.logo.compiler import Primitive
from rosmini.logo.errors import BadInput, LogoError
from rosmini.logo.values import (
    LARGEST,
    LogoList,
    Value,
    boolean,
    is_equal,
    show,
    whole,
    word,
    write,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.logo.machine import Machine


def _parts(value: Value, machine: Machine) -> tuple[Value, ...] | str:
    """The members of a list or the letters of a word. Raises ``BadInput`` if there are none."""
    parts = value.items if isinstance(value, LogoList) else word(value)
    if not parts:
        raise BadInput(show(value) or "the empty word", "a word or a list that is not empty")
    machine.steps += len(parts) // 32
    return parts


def _first(machine: Machine, value: Value) -> Value:
    return _parts(value, machine)[0]


def _last(machine: Machine, value: Value) -> Value:
    return _parts(value, machine)[-1]


def _butfirst(machine: Machine, value: Value) -> Value:
    _parts(value, machine)
    return value.without(0) if isinstance(value, LogoList) else word(value)[1:]


def _butlast(machine: Machine, value: Value) -> Value:
    _parts(value, machine)
    return value.without(-1) if isinstance(value, LogoList) else word(value)[:-1]


def _item(machine: Machine, index: Value, value: Value) -> Value:
    parts = _parts(value, machine)
    return parts[whole(index, 1, len(parts), f"a whole number from 1 to {len(parts)}") - 1]


def _pick(machine: Machine, value: Value) -> Value:
    parts = _parts(value, machine)
    return parts[int(machine.random.integers(len(parts)))]


def _count(_: Machine, value: Value) -> int:
    return len(value if isinstance(value, LogoList) else word(value))


def _word(machine: Machine, *values: Value) -> Value:
    parts = [word(value) for value in values]
    if sum(map(len, parts)) > LARGEST:
        raise LogoError(f"a word has more than {LARGEST} letters")
    return machine.made("".join(parts))


def _list(machine: Machine, *values: Value) -> Value:
    return machine.made(LogoList(values))


def _sentence(machine: Machine, *values: Value) -> Value:
    made = LogoList()
    for value in values:
        made += value if isinstance(value, LogoList) else LogoList((value,))
    return machine.made(made)


def _fput(machine: Machine, value: Value, rest: Value) -> Value:
    if isinstance(rest, LogoList):
        return machine.made(LogoList((value,)) + rest)
    return _word(machine, value, rest)


def _lput(machine: Machine, value: Value, rest: Value) -> Value:
    if isinstance(rest, LogoList):
        return machine.made(rest + LogoList((value,)))
    return _word(machine, rest, value)


def _reverse(machine: Machine, value: Value) -> Value:
    if isinstance(value, LogoList):
        return machine.made(LogoList(value.items[::-1]))
    return machine.made(word(value)[::-1])


def _memberp(machine: Machine, value: Value, of: Value) -> str:
    if isinstance(of, LogoList):
        machine.steps += of.weight
        return boolean(any(is_equal(value, item) for item in of))
    return boolean(word(value).lower() in word(of).lower())


def _emptyp(_: Machine, value: Value) -> str:
    return boolean(isinstance(value, str | LogoList) and len(value) == 0)


def _wordp(_: Machine, value: Value) -> str:
    return boolean(not isinstance(value, LogoList))


def _listp(_: Machine, value: Value) -> str:
    return boolean(isinstance(value, LogoList))


def _upper(_: Machine, value: Value) -> str:
    return word(value).upper()


def _lower(_: Machine, value: Value) -> str:
    return word(value).lower()


def _name_of(value: Value) -> str:
    return word(value, "a name").lower()


def _make(machine: Machine, name: Value, value: Value) -> None:
    machine.variables[_name_of(name)] = value


def _local(machine: Machine, *names: Value) -> None:
    for name in names:
        for each in name if isinstance(name, LogoList) else (name,):
            machine.local(_name_of(each), None)


def _localmake(machine: Machine, name: Value, value: Value) -> None:
    machine.local(_name_of(name), value)


def _thing(machine: Machine, name: Value) -> Value:
    found = machine.variables.get(_name_of(name))
    if found is None:
        raise machine.no_value(_name_of(name))
    return found


def _namep(machine: Machine, name: Value) -> str:
    return boolean(_name_of(name) in machine.variables)


def _print(machine: Machine, *values: Value) -> None:
    for value in values:
        machine.made(value)
    machine.write(" ".join(write(value) for value in values))


def _show(machine: Machine, *values: Value) -> None:
    for value in values:
        machine.made(value)
    machine.write(" ".join(show(value) for value in values))


def _type(machine: Machine, *values: Value) -> None:
    machine.typed += "".join(write(machine.made(value)) for value in values)
    if len(machine.typed) > LARGEST:
        raise LogoError(f"a line has more than {LARGEST} letters")


def _help(machine: Machine, name: Value) -> None:
    known = machine.words.primitives.get(_name_of(name))
    if known is None:
        raise BadInput(show(name), "a word that Logo knows by itself")
    short = f" (short: {', '.join(known.short)})" if known.short else ""
    machine.write(f"{known.usage}{short}: {known.help}")


def _row(name: str, inputs: str, act: Callable[..., Value], text: str, **more: object) -> Primitive:
    return Primitive(name, tuple(inputs.split()), act, text, reports=True, **more)  # type: ignore[arg-type]


DATA = (
    _row("first", "thing", _first, "the first letter of a word, or member of a list"),
    _row("last", "thing", _last, "the last letter or member"),
    _row("butfirst", "thing", _butfirst, "all but the first", short=("bf",)),
    _row("butlast", "thing", _butlast, "all but the last", short=("bl",)),
    _row("item", "index thing", _item, "the letter or member at an index, counted from 1"),
    _row("pick", "thing", _pick, "one of the letters or members, by chance"),
    _row("count", "thing", _count, "how many letters or members there are"),
    _row("word", "word word", _word, "joins words to one", least=0, most=99),
    _row("list", "thing thing", _list, "a list of its inputs", least=0, most=99),
    _row(
        "sentence",
        "thing thing",
        _sentence,
        "a list of words and of lists' members",
        short=("se",),
        least=0,
        most=99,
    ),
    _row("fput", "thing list", _fput, "the list with one member more in front"),
    _row("lput", "thing list", _lput, "the list with one member more at the end"),
    _row("reverse", "thing", _reverse, "from the last to the first"),
    _row("memberp", "thing list", _memberp, "whether it is in the list", short=("member?",)),
    _row("emptyp", "thing", _emptyp, "whether it is [] or the empty word", short=("empty?",)),
    _row("wordp", "thing", _wordp, "whether it is a word", short=("word?",)),
    _row("listp", "thing", _listp, "whether it is a list", short=("list?",)),
    _row("uppercase", "word", _upper, "the word in capitals"),
    _row("lowercase", "word", _lower, "the word in small letters"),
    Primitive("make", ("name", "thing"), _make, "lets a name stand for a thing"),
    Primitive(
        "name", ("thing", "name"), lambda m, value, name: _make(m, name, value), "make, the other way round"
    ),
    Primitive("local", ("name",), _local, "makes a name the procedure's own", most=99),
    Primitive("localmake", ("name", "thing"), _localmake, "local and make in one"),
    _row("thing", "name", _thing, 'what a name stands for: :side is short for thing "side'),
    _row("namep", "name", _namep, "whether a name stands for something", short=("name?",)),
    Primitive(
        "print",
        ("thing",),
        _print,
        "writes a line; lists without their brackets",
        short=("pr",),
        least=0,
        most=99,
    ),
    Primitive("show", ("thing",), _show, "writes a line; lists with their brackets", least=0, most=99),
    Primitive("type", ("thing",), _type, "writes without ending the line", least=0, most=99),
    Primitive("help", ("name",), _help, "writes what a word of Logo does"),
)
"""Words about words."""
