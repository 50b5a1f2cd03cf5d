"""Reader for ``CMakeLists.txt``: commands and their arguments (https://cmake.org/cmake/help, cmake-language(7)).

Variables are followed as far as ``set`` and ``list(APPEND)`` outside of blocks set them. Commands in a block, such as
``if`` or ``foreach``, are not: whether CMake would reach them depends on more than this file. No program is run.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from rosmini.core.errors import DefinitionError, shown

MAX_FILE_LENGTH = 1_000_000
"""Maximum number of characters in a file; the largest public ones have a hundredth of it."""

MAX_VALUES_LENGTH = 1_000_000
"""Maximum number of characters in all values together: a variable can double its length with each command."""

BLOCKS = {"if": "endif", "foreach": "endforeach", "while": "endwhile", "function": "endfunction", "macro": "endmacro"}
"""Commands that open a block, with those that close it."""

_TOKEN = re.compile(
    r"""
    (?P<space>[ \t\r\n]+)
  | (?P<bracket_comment>\#\[(?P<c>=*)\[)
  | (?P<comment>\#[^\n]*)
  | (?P<bracket>\[(?P<b>=*)\[)
  | (?P<paren>[()])
  | (?P<quoted>"[^"\\]*(?:\\.[^"\\]*)*")
  | (?P<unquoted>(?:[^\s()\#"\\]|\\.)(?:[^\s()\#"\\]|\\.|"[^"\\]*(?:\\.[^"\\]*)*")*)
    """,
    re.VERBOSE | re.DOTALL,
)
_NAME = re.compile(r"[A-Za-z_]\w*\Z", re.ASCII)
_REFERENCE = re.compile(r"\$(?:ENV|CACHE)?\{([^${}]*)\}")
_SEPARATOR = re.compile(r"(?<!\\);")
_ESCAPE = re.compile(r"\\(.)", re.DOTALL)
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r"}


class CMakeError(DefinitionError):
    """A ``CMakeLists.txt`` has a syntax error at ``file``, line ``line``."""


class Word(NamedTuple):
    """An argument after evaluation, and the line where it is written."""

    text: str
    line: int


@dataclass(frozen=True)
class Argument:
    """An argument of a command as written: without quotes, but with variables and escapes not replaced."""

    text: str
    line: int
    quoted: bool = False
    """True if in quotes or brackets: such an argument is never split at semicolons."""
    raw: bool = False
    """True if in brackets: variables and escapes in it are not replaced."""


@dataclass(frozen=True)
class Command:
    """A command, its name in lower case, and its arguments; parentheses inside it are separate arguments."""

    name: str
    arguments: tuple[Argument, ...]
    line: int
    block: Command | None = None
    """The command that opens the outermost block around this one."""


@dataclass
class Variables:
    """The variables of a file, and the names of those that are read without having been set here."""

    path: Path
    values: dict[str, str]
    unknown: list[str] = field(default_factory=list)
    _length: int = 0

    def words(self, command: Command) -> list[Word]:
        """Return the arguments of a command after evaluation, and set the variable that it sets.

        Raises `CMakeError` if the values are too long.
        """
        self.unknown.clear()
        words = [word for each in command.arguments for word in self._words(each)]
        texts = [word.text for word in words]
        if command.name == "set" and texts:
            ends = [texts.index(end) for end in ("CACHE", "PARENT_SCOPE") if end in texts]
            self.values[texts[0]] = ";".join(texts[1 : min(ends, default=None)])
        elif command.name == "list" and texts[:1] == ["APPEND"] and len(texts) > 1:
            old = self.values.get(texts[1], "")
            self._spend(len(old), command.line)
            self.values[texts[1]] = ";".join([*filter(None, [old]), *texts[2:]])
        elif command.name == "project" and texts:
            self.values["PROJECT_NAME"] = texts[0]
        return words

    def _words(self, argument: Argument) -> Iterator[Word]:
        if argument.raw:
            yield Word(argument.text, argument.line)
            return
        text = argument.text
        for _ in range(20):  # innermost first: ${${NAME}_FILES}
            new = _REFERENCE.sub(self._value, text)
            if new == text:
                break
            self._spend(len(new), argument.line)
            text = new
        for part in [text] if argument.quoted else filter(None, _SEPARATOR.split(text)):
            yield Word(_ESCAPE.sub(lambda match: _ESCAPED.get(match[1], match[1]), part), argument.line)

    def _value(self, reference: re.Match[str]) -> str:
        if reference[1] not in self.values:
            self.unknown.append(reference[1])
        return self.values.get(reference[1], "")

    def _spend(self, length: int, line: int) -> None:
        self._length += length
        if self._length > MAX_VALUES_LENGTH:
            raise CMakeError(f"the variables have more than {MAX_VALUES_LENGTH} characters together", self.path, line)


def parse(text: str, path: str | Path = "CMakeLists.txt") -> Iterator[Command]:
    """Yield the commands of a file, without those that open, divide or close blocks.

    Raises `CMakeError` with the invalid line.
    """
    if len(text) > MAX_FILE_LENGTH:
        raise CMakeError(f"this has more than {MAX_FILE_LENGTH} characters: no CMakeLists.txt has", path, 1)
    blocks: list[Command] = []
    for command in _commands(text, path):
        opening = blocks[-1] if blocks else None
        if command.name in BLOCKS:
            blocks.append(command)
        elif command.name in ("elseif", "else"):
            if opening is None or opening.name != "if":
                raise CMakeError(f"{command.name}() without an if()", path, command.line)
        elif command.name in BLOCKS.values():
            if opening is None or BLOCKS[opening.name] != command.name:
                before = f"; {opening.name}() of line {opening.line} is still open" if opening else ""
                raise CMakeError(f"{command.name}() closes nothing that is open{before}", path, command.line)
            blocks.pop()
        else:
            yield Command(command.name, command.arguments, command.line, blocks[0] if blocks else None)
    if blocks:
        name, line = blocks[-1].name, blocks[-1].line
        raise CMakeError(f"{name}() is never closed; add {BLOCKS[name]}()", path, line)


def _commands(text: str, path: str | Path) -> list[Command]:
    """Return the commands of a text, in order."""
    found: list[Command] = []
    name: tuple[str, int] | None = None  # the command whose "(" is still missing, or whose arguments are being read
    depth = 0
    arguments: list[Argument] = []
    position, line = 0, 1
    if text.startswith("\ufeff"):
        position = 1
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            what = "a quotation mark that is never closed" if text[position] == '"' else shown(text[position])
            raise CMakeError(f"this is not CMake: {what}", path, line)
        kind, piece, start = match.lastgroup, match.group(), line
        content = piece
        if match["bracket"] is not None or match["bracket_comment"] is not None:
            equals = match["b"] if match["bracket"] is not None else match["c"]
            end = text.find(f"]{equals}]", match.end())
            if end < 0:
                raise CMakeError(f"{piece} is never closed; add ]{equals}]", path, line)
            content = text[match.end() : end]
            kind = "bracket" if match["bracket"] is not None else "comment"
            piece = text[position : end + len(equals) + 2]
        position += len(piece)
        line += piece.count("\n")
        if kind in ("space", "comment", "bracket_comment"):
            continue
        if name is None:
            if kind != "unquoted" or not _NAME.match(piece):
                hint = "; is a ( missing before it?" if kind != "paren" else ""
                raise CMakeError(f"a command is expected here, not {shown(piece)}{hint}", path, start)
            name = (piece.lower(), start)
        elif depth == 0:
            if piece != "(":
                raise CMakeError(f"{name[0]} is followed by {shown(piece)}, not by (", path, start)
            depth = 1
        elif piece == ")" and depth == 1:
            found.append(Command(name[0], tuple(arguments), name[1]))
            name, depth, arguments = None, 0, []
        else:
            depth += {"(": 1, ")": -1}.get(piece, 0) if kind == "paren" else 0
            arguments.append(_argument(kind or "", content, start))
    if name is not None:
        raise CMakeError(f"{name[0]}( is never closed; add )", path, name[1])
    return found


def _argument(kind: str, content: str, line: int) -> Argument:
    if kind == "bracket":
        return Argument(content.removeprefix("\n"), line, quoted=True, raw=True)
    if kind == "quoted":
        return Argument(content[1:-1].replace("\\\n", ""), line, quoted=True)
    return Argument(content, line)
