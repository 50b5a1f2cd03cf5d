"""From text to lines of words and lists, and from these to tokens, as Logo does it in two steps.

A list is data until it is run, so what is in brackets is divided at spaces only: ``[:a+1]`` has one member. Where a
line or a list is run, its words are divided further, at infix operators and parentheses (`tokens`). The rules are those
of the UCBLogo manual, "Tokenization"; there are no arrays and no backslashes here.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

from .errors import LogoError
from .values import DEEPEST, LARGEST, LogoList, Value, number_in

if TYPE_CHECKING:
    from collections.abc import Iterator

Kind = Literal["value", "thing", "word", "infix", "minus", "negative", "(", ")"]
"""`minus` is one that may be binary, `negative` one that is written as a sign: after a space, and none follows."""


class Token(NamedTuple):
    """A part of an instruction: ``text`` as it was written, and the value if it is one."""

    kind: Kind
    text: str
    line: int
    value: Value = ""


@dataclass(frozen=True)
class Definition:
    """A procedure, from `to` to `end`."""

    name: str
    inputs: tuple[str, ...]
    body: tuple[LogoList, ...]
    line: int


@dataclass(frozen=True)
class Program:
    """The procedures that a text defines, and the lines to be run."""

    definitions: tuple[Definition, ...]
    lines: tuple[LogoList, ...]


_SPLIT = re.compile(
    r"(?P<skip>;[^\n]*|~[ \t]*(?:;[^\n]*)?\n|[^\S\n]+)|(?P<newline>\n)|(?P<open>\[)|(?P<close>\])"
    r"|(?P<word>(?:(?!~[ \t]*(?:;|\n))[^\s\[\];])+|.)"
)
_PARTS = re.compile(
    r'(?P<quoted>"[^()]*)|(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?(?=[()+\-*/=<>]|\Z))'
    r"|(?P<infix><=|>=|<>|[+*/=<>])|(?P<minus>-)|(?P<paren>[()])|(?P<word>[^()+\-*/=<>]+)"
)
_NAME = re.compile(r'[^\s\[\]()+\-*/=<>":;~]+')


def read(text: str, first_line: int = 1) -> Program:
    r"""Divide a program. Raises ``LogoError`` with the line of what is wrong.

    >>> program = read("to square :side\n repeat 4 [fd :side rt 90]\nend\nsquare 50")
    >>> program.definitions[0].name, program.lines
    ('square', ([square 50],))
    """
    if len(text) > LARGEST:
        raise LogoError(f"the program has more than {LARGEST} characters")
    definitions: dict[str, Definition] = {}
    lines: list[LogoList] = []
    waiting = _lines(text, first_line)
    for line in waiting:
        first = _first(line)
        if first == "end":
            raise LogoError("end without a to before it", _line_of(line))
        if first != "to":
            lines.append(line)
            continue
        made = _definition(line, waiting)
        if made.name in definitions:
            before = definitions[made.name].line
            raise LogoError(f"{made.name} is already defined, in line {before}", made.line)
        definitions[made.name] = made
    return Program(tuple(definitions.values()), tuple(lines))


def read_list(text: str) -> LogoList:
    """The words and lists of a text, whatever its lines. Raises ``LogoError``."""
    return LogoList(item for line in _lines(text, 1) for item in line)


def tokens(line: LogoList) -> list[Token]:
    """Divide the members of a line, or of a list that is run, into what an instruction is made of."""
    found: list[Token] = []
    for i, item in enumerate(line):
        at = 0 if line.lines is None else line.lines[i]
        if isinstance(item, str):
            found += _tokens_of(item, at)
        else:
            found.append(Token("value", "", at, item))
    return found


def _tokens_of(raw: str, line: int) -> Iterator[Token]:
    for part in _PARTS.finditer(raw):
        text = part[0]
        if part["quoted"] is not None:
            yield Token("value", text, line, text[1:])
        elif part["number"] is not None:
            value = number_in(text)
            if value is None:
                raise LogoError(f"{text} is too large for a number", line)
            yield Token("value", text, line, value)
        elif part["minus"] is not None:
            yield Token("negative" if part.start() == 0 and len(raw) > 1 else "minus", text, line)
        elif part["infix"] is not None:
            yield Token("infix", text, line)
        elif part["paren"] is not None:
            yield Token("(" if text == "(" else ")", text, line)
        elif text.startswith(":"):
            if not _NAME.fullmatch(text[1:]):
                raise LogoError(f"{text} is no name of a variable: after the colon comes a word", line)
            yield Token("thing", text, line, text[1:].lower())
        else:
            yield Token("word", text, line, text.lower())


class _Open(NamedTuple):
    line: int
    items: list[Value]
    lines: list[int]


def _lines(text: str, number: int) -> Iterator[LogoList]:
    """The lines of a text that hold anything. What is in brackets or parentheses goes on in the next line."""
    levels = [_Open(number, [], [])]
    parens: list[int] = []
    fresh = True
    for found in _SPLIT.finditer(text):
        if found["newline"] is not None:
            number, fresh = number + 1, True
            if len(levels) == 1 and not parens and levels[0].items:
                yield LogoList(levels[0].items, tuple(levels[0].lines))
                levels = [_Open(number, [], [])]
        elif found["open"] is not None:
            if len(levels) > DEEPEST:
                raise LogoError(f"lists are nested more than {DEEPEST} deep", number)
            levels.append(_Open(number, [], []))
        elif found["close"] is not None:
            if len(levels) == 1:
                raise LogoError("a ] without a [ before it", number)
            closed = levels.pop()
            levels[-1].items.append(LogoList(closed.items, tuple(closed.lines)))
            levels[-1].lines.append(closed.line)
        elif found["word"] is not None:
            if fresh and found[0].lower() in ("to", "end") and (len(levels) > 1 or parens):
                raise _unclosed(levels, parens, f" before {found[0]} in line {number}")
            if len(levels) == 1:
                _count(parens, found[0], number)
            levels[-1].items.append(found[0])
            levels[-1].lines.append(number)
        else:
            number += found[0].count("\n")
            continue
        fresh = found["newline"] is not None
    if len(levels) > 1 or parens:
        raise _unclosed(levels, parens, "")
    if levels[0].items:
        yield LogoList(levels[0].items, tuple(levels[0].lines))


def _count(parens: list[int], raw: str, line: int) -> None:
    for letter in raw:
        if letter == "(":
            parens.append(line)
        elif letter == ")":
            if not parens:
                raise LogoError("a ) without a ( before it", line)
            parens.pop()


def _unclosed(levels: list[_Open], parens: list[int], before: str) -> LogoError:
    bracket, line = ("[", levels[-1].line) if len(levels) > 1 else ("(", parens[-1])
    return LogoError(f"this {bracket} is never closed{before}", line)


def _definition(title: LogoList, rest: Iterator[LogoList]) -> Definition:
    line = _line_of(title)
    words = [item for item in title if isinstance(item, str)]
    if len(words) < 2:
        raise LogoError("to needs a name: to square :side", line)
    name = words[1].lower()
    if not _NAME.fullmatch(name) or number_in(name) is not None:
        raise LogoError(f"{words[1]} cannot be the name of a procedure", line)
    inputs = []
    for item in title.items[2:]:
        if not isinstance(item, str) or not item.startswith(":") or not _NAME.fullmatch(item[1:]):
            if isinstance(item, LogoList) or number_in(item) is not None:
                advice = "inputs that may be left out are not here: each input is a word such as :side"
            else:
                advice = "after the name come only inputs, such as :side; instructions begin in the next line"
            raise LogoError(f"to {words[1]}: {advice}", line)
        if item[1:].lower() in inputs:
            raise LogoError(f"to {words[1]}: the input {item} is there twice", line)
        inputs.append(item[1:].lower())
    body: list[LogoList] = []
    for each in rest:
        if _first(each) == "end":
            if len(each) > 1:
                raise LogoError("end stands in a line of its own", _line_of(each))
            return Definition(name, tuple(inputs), tuple(body), line)
        if _first(each) == "to":
            raise LogoError(f"to {words[1]} has no end before the next to, in line {_line_of(each)}", line)
        body.append(each)
    raise LogoError(f"to {words[1]} has no end: write end in a line of its own", line)


def _first(line: LogoList) -> str:
    first = line.items[0]
    return first.lower() if isinstance(first, str) else ""


def _line_of(line: LogoList) -> int:
    return line.lines[0] if line.lines else 0
