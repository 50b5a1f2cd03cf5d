"""A parser of shell lines: words, quotation marks, ``&&``, ``|``, ``>`` and heredocs.

The grammar is the part of POSIX's shell language that beginners with ROS need. Everything else (``if``,
``$(...)``, ``<``) is refused by name, never misunderstood.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rosmini.core.errors import UsageError

OPERATORS = ("&&", "||", ";", "|", ">", ">>", "&")
"""Supported operators; ``&`` only at the end of a command, where it has no effect in a cell."""

_TOKEN = re.compile(
    r"(?P<space>\s+)|(?P<comment>\#.*)|(?P<operator>&&|\|\||>>|<<-?|[12&]>&?[12]?|[|;&<>()])"
    r"|(?P<word>(?:'[^']*'|\"(?:\\.|[^\"\\])*\"|\\.|[^\s'\"\\|;&<>()])+)"
)
_PIECE = re.compile(r"'(?P<single>[^']*)'|\"(?P<double>(?:\\.|[^\"\\])*)\"|\\(?P<escaped>.)|(?P<plain>[^'\"\\]+)")
_VARIABLE = re.compile(r"\\(?P<escaped>[$\"\\`])|\$(?:\{(?P<braced>\w+)\}|(?P<name>[A-Za-z_]\w*|\?))")
_SUBSTITUTION = re.compile(r"\$\(|`")


@dataclass(frozen=True)
class Redirection:
    """The file for the output of a command, as written in the line."""

    file: str
    appends: bool


@dataclass(frozen=True)
class Command:
    """One command: its words as written, the redirection of its output, and the text that it reads."""

    words: tuple[str, ...]
    to: Redirection | None = None
    text: str | None = None
    text_is_raw: bool = False
    """True if variables in the text are not replaced, because its end marker was quoted."""


@dataclass(frozen=True)
class Pipeline:
    """Commands, each of which reads the output of the previous one, and the operator before them (empty: the first)."""

    after: str
    commands: tuple[Command, ...]


@dataclass(frozen=True)
class Line:
    """A line as typed, and its pipelines."""

    number: int
    text: str
    pipelines: tuple[Pipeline, ...]


def parse(text: str) -> list[Line]:
    """Return the lines of a cell without comments and empty lines.

    Raises ``UsageError`` with the number of the line for unsupported syntax and for text without an end.
    """
    rows = iter(enumerate(text.splitlines(), 1))
    return [line for number, row in rows if (line := _line(number, row, rows)) is not None]


def _line(number: int, row: str, rows: Iterator[tuple[int, str]]) -> Line | None:
    """Return one line, taking its continuation rows from ``rows``; None if it is empty."""
    while row.endswith("\\"):
        row = row[:-1] + next(rows, (0, ""))[1].lstrip()
    tokens = list(_tokens(number, row))
    if not tokens:
        return None
    return Line(number, row.strip(), tuple(_pipelines(number, tokens, rows)))


def _tokens(number: int, row: str) -> Iterator[tuple[str, str]]:
    """Yield the kind and the text of each word and operator."""
    at = 0
    while at < len(row):
        match = _TOKEN.match(row, at)
        if match is None:
            raise UsageError(f"line {number}: the quotation mark in `{row[at:].strip()}` is not closed")
        kind = str(match.lastgroup)
        at = match.end()
        if kind in ("word", "operator"):
            yield kind, match.group()


def _pipelines(number: int, parts: list[tuple[str, str]], rows: Iterator[tuple[int, str]]) -> Iterator[Pipeline]:
    """Yield the pipelines of a line."""
    after, words = "", list[str]()
    commands: list[Command] = []
    to: Redirection | None = None
    here: str | None = None
    todo = iter([*parts, ("operator", "\n")])
    for kind, part in todo:
        if kind == "word":
            if _SUBSTITUTION.search(part) and not part.startswith("'"):
                raise UsageError(f"line {number}: `{part}` needs a shell; write its result instead")
            words.append(part)
        elif part in (">", ">>", "<<"):
            operand = next(todo)
            if operand[0] != "word":
                raise UsageError(f"line {number}: after `{part}` a word is missing")
            if part == "<<":
                here = operand[1]
            else:
                to = Redirection(operand[1], part == ">>")
        elif part == "2>&1":  # both go to the cell
            continue
        elif part == "\n" or part in OPERATORS:
            if not words and not (part == "\n" and not commands and after in (";", "&")):
                raise UsageError(f"line {number}: there is no command before `{part.strip() or 'the end'}`")
            if words:
                text = None if here is None else _document(number, here, rows)
                commands.append(Command(tuple(words), to, text, here is not None and here[0] in "'\"\\"))
            words, to, here = [], None, None
            if part != "|" and commands:
                yield Pipeline(after, tuple(commands))
                after, commands = part, []
        else:
            raise UsageError(f"line {number}: `{part}` needs a shell, which this cell does not have")


def _document(number: int, end: str, rows: Iterator[tuple[int, str]]) -> str:
    """Return the rows up to the end marker of a heredoc."""
    wanted, found = unquoted(end), list[str]()
    for _, row in rows:
        if row == wanted:
            return "".join(f"{each}\n" for each in found)
        found.append(row)
    raise UsageError(f"line {number}: the text that begins here does not end: add a line that contains only {wanted}")


def unquoted(word: str) -> str:
    """Return a word without its quotation marks; variables are kept."""
    return expand(word, lambda name: f"${name}")


def expand(word: str, value: Callable[[str], str]) -> str:
    """Return a word without quotation marks, with each variable replaced except in single quotes."""
    parts = []
    for match in _PIECE.finditer(word):
        if match["double"] is not None:
            parts.append(expand_variables(match["double"], value))
        elif match["plain"] is not None:
            parts.append(expand_variables(match["plain"], value))
        else:
            parts.append(match["escaped"] or match["single"] or "")
    return "".join(parts)


def expand_variables(text: str, value: Callable[[str], str]) -> str:
    """Return a text with ``$NAME`` and ``${NAME}`` replaced; a backslash keeps what follows."""
    return _VARIABLE.sub(lambda match: match["escaped"] or value(match["braced"] or match["name"]), text)


def is_quoted(word: str) -> bool:
    """Return whether a word has quotation marks, so that ``*`` is not a pattern."""
    return any(mark in word for mark in "'\"\\")
