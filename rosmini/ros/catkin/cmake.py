"""Parser for ``CMakeLists.txt``: reads commands and blocks (https://cmake.org/cmake/help, cmake-language(7)).

Nothing is evaluated here: `rosmini.ros.catkin.evaluation` does that.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from rosmini.core.errors import DefinitionError, shown

LARGEST = 1_000_000
"""Maximum number of characters in a file; the largest public ones have a hundredth of it."""

DEEPEST = 50
"""Maximum nesting depth of blocks."""

BLOCKS = {
    "if": "endif",
    "foreach": "endforeach",
    "while": "endwhile",
    "function": "endfunction",
    "macro": "endmacro",
}
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


class CMakeError(DefinitionError):
    """A ``CMakeLists.txt`` has a syntax error at ``file``, line ``line``."""


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


@dataclass(frozen=True)
class Block:
    """A block from its opening to its closing command.

    ``parts`` are its sections: one, except for an ``if``, where each further one begins with ``elseif`` or ``else``.
    """

    parts: tuple[tuple[Command, tuple[Command | Block, ...]], ...]

    @property
    def opening(self) -> Command:
        """The command that opens the block."""
        return self.parts[0][0]


@dataclass
class _Open:
    """A block that is being parsed."""

    parts: list[tuple[Command, list[Command | Block]]] = field(default_factory=list)


def parse(text: str, path: str | Path = "CMakeLists.txt") -> tuple[Command | Block, ...]:
    """Return the commands and blocks of a file. Raises `CMakeError` with the invalid line."""
    if len(text) > LARGEST:
        raise CMakeError(f"this has more than {LARGEST} characters: no CMakeLists.txt has", path, 1)
    body: list[Command | Block] = []
    waiting: list[_Open] = []
    for command in _commands(text, path):
        here = waiting[-1].parts[-1][1] if waiting else body
        opening = waiting[-1].parts[0][0] if waiting else None
        if command.name in BLOCKS:
            if len(waiting) >= DEEPEST:
                raise CMakeError(f"more than {DEEPEST} blocks inside one another", path, command.line)
            waiting.append(_Open([(command, [])]))
        elif command.name in ("elseif", "else"):
            if opening is None or opening.name != "if":
                raise CMakeError(f"{command.name}() without an if()", path, command.line)
            waiting[-1].parts.append((command, []))
        elif command.name in BLOCKS.values():
            if opening is None or BLOCKS[opening.name] != command.name:
                before = f"; {opening.name}() of line {opening.line} is still open" if opening else ""
                raise CMakeError(f"{command.name}() closes nothing that is open{before}", path, command.line)
            closed = waiting.pop()
            block = Block(tuple((start, tuple(content)) for start, content in closed.parts))
            (waiting[-1].parts[-1][1] if waiting else body).append(block)
        else:
            here.append(command)
    if waiting:
        opening = waiting[-1].parts[0][0]
        raise CMakeError(
            f"{opening.name}() is never closed; add {BLOCKS[opening.name]}()", path, opening.line
        )
    return tuple(body)


def _commands(text: str, path: str | Path) -> list[Command]:
    """Return the commands of a text, in order."""
    found: list[Command] = []
    name: tuple[str, int] | None = (
        None  # the command whose "(" is still missing, or whose arguments are being read
    )
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
