"""Lines of a shell, read without one: words, quotation marks, ``&&``, ``|``, ``>`` and heredocs.

The grammar is the part of POSIX's shell language that the first hours with ROS need. What is beyond it (``if``,
``$(...)``, ``<``) is refused by name, never misunderstood.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rosmini.core.errors import UsageError

OPERATORS = ("&&", "||", ";", "|", ">", ">>", "&")
"""The operators that are understood; a ``&`` only at the end of a command, where it means nothing in a cell."""

_TOKEN = re.compile(
    r"(?P<space>\s+)|(?P<comment>\#.*)|(?P<operator>&&|\|\||>>|<<-?|[12&]>&?[12]?|[|;&<>()])"
    r"|(?P<word>(?:'[^']*'|\"(?:\\.|[^\"\\])*\"|\\.|[^\s'\"\\|;&<>()])+)"
)
_PIECE = re.compile(
    r"'(?P<single>[^']*)'|\"(?P<double>(?:\\.|[^\"\\])*)\"|\\(?P<escaped>.)|(?P<plain>[^'\"\\]+)"
)
_VARIABLE = re.compile(r"\\(?P<escaped>[$\"\\`])|\$(?:\{(?P<braced>\w+)\}|(?P<name>[A-Za-z_]\w*|\?))")
_SUBSTITUTION = re.compile(r"\$\(|`")


@dataclass(frozen=True)
class Redirection:
    """Where the output of a command goes: a file, as it is written in the line."""

    file: str
    appends: bool


@dataclass(frozen=True)
class Command:
    """One command: its words as they are written, where its output goes, and the text that it reads."""

    words: tuple[str, ...]
    to: Redirection | None = None
    text: str | None = None
    text_is_raw: bool = False
    """Whether variables in the text stay as they are: its end was quoted."""


@dataclass(frozen=True)
class Pipeline:
    """Commands, each of which reads what the one before writes, and the operator before them (empty: the first)."""

    after: str
    commands: tuple[Command, ...]


@dataclass(frozen=True)
class Line:
    """A line as it was typed, and what it does."""

    number: int
    text: str
    pipelines: tuple[Pipeline, ...]


def parse(text: str) -> list[Line]:
    """Return the lines of a cell; comments and empty lines are left out.

    Raises ``UsageError`` with the number of the line for what this is no shell for, and what has no end.
    """
    rows = iter(enumerate(text.splitlines(), 1))
    return [line for number, row in rows if (line := _line(number, row, rows)) is not None]


def _line(number: int, row: str, rows: Iterator[tuple[int, str]]) -> Line | None:
    """Return one line, with the rows that belong to it taken from ``rows``; None if it does nothing."""
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
            raise UsageError(f"line {number}: the quotation mark in `{row[at:].strip()}` has no partner")
        kind = str(match.lastgroup)
        at = match.end()
        if kind in ("word", "operator"):
            yield kind, match.group()


def _pipelines(
    number: int, parts: list[tuple[str, str]], rows: Iterator[tuple[int, str]]
) -> Iterator[Pipeline]:
    """Yield the pipelines of a line."""
    after, words = "", list[str]()
    commands: list[Command] = []
    to: Redirection | None = None
    here: str | None = None
    todo = iter([*parts, ("operator", "\n")])
    for kind, part in todo:
        if kind == "word":
            if _SUBSTITUTION.search(part) and not part.startswith("'"):
                raise UsageError(f"line {number}: `{part}` needs a shell; write what it stands for")
            words.append(part)
        elif part in (">", ">>", "<<"):
            operand = next(todo)
            if operand[0] != "word":
                raise UsageError(f"line {number}: after `{part}` a word is missing")
            if part == "<<":
                here = operand[1]
            else:
                to = Redirection(operand[1], part == ">>")
        elif part == "2>&1":  # both go to the cell anyway
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
            raise UsageError(f"line {number}: `{part}` is a shell's, and there is none behind this cell")


def _document(number: int, end: str, rows: Iterator[tuple[int, str]]) -> str:
    """Return the rows up to the one that ends a heredoc."""
    wanted, found = unquoted(end), list[str]()
    for _, row in rows:
        if row == wanted:
            return "".join(f"{each}\n" for each in found)
        found.append(row)
    raise UsageError(f"line {number}: the text that begins here has no end: a line with {wanted} alone")


def unquoted(word: str) -> str:
    """Return a word without its quotation marks, variables left as they are."""
    return expand(word, lambda name: f"${name}")


def expand(word: str, value: Callable[[str], str]) -> str:
    """Return what a word means: quotation marks gone, and each variable outside of single ones replaced."""
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
    """Return whether a word has quotation marks: then ``*`` in it is a star."""
    return any(mark in word for mark in "'\"\\")
