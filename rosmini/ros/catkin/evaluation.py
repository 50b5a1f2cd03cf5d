"""Evaluation of the commands of a ``CMakeLists.txt``: variables, lists, conditions and loops.

No program is run and no file is read; only names of files in the package are looked up (``file(GLOB)``).
Functions, macros and ``while`` are skipped and reported.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from .cmake import Argument, Block, CMakeError, Command

LONGEST = 200_000
"""Maximum number of characters in a value."""

MOST = 50_000
"""Maximum number of commands followed; those in loops are counted each time."""

STEPS = 3_000_000
"""Maximum cost of all values: one for each character each time a value is read, split or stored."""

OF_A_WORD = 20
"""Cost of a word, in addition to its characters."""

OF_A_GLOB = STEPS // 100
"""Cost of a ``file(GLOB)`` pattern, which searches the package."""

_REFERENCE = re.compile(r"\$(?:(ENV|CACHE))?\{([^${}]*)\}")
_SEPARATOR = re.compile(r"(?<!\\);")
_ESCAPE = re.compile(r"\\(.)", re.DOTALL)
_FALSE = {"", "0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND"}
_TRUE = {"1", "ON", "YES", "TRUE", "Y"}


class Word(NamedTuple):
    """An argument after evaluation, and the line where it is written."""

    text: str
    line: int


@dataclass(frozen=True)
class Statement:
    """A command with its arguments evaluated."""

    name: str
    words: tuple[Word, ...]
    line: int


@dataclass
class Evaluation:
    """Evaluates the commands of one file.

    ``folder`` is the package's; ``passed_over`` collects the skipped commands with their lines.
    """

    folder: Path
    variables: dict[str, str]
    path: Path
    passed_over: list[Word] = field(default_factory=list)
    _count: int = 0
    _spent: int = 0
    _ended: bool = False
    _own: dict[str, int] = field(default_factory=dict)

    def statements(self, body: Sequence[Command | Block]) -> Iterator[Statement]:
        """Yield the commands that are reached, in order. Raises `CMakeError`."""
        for each in body:
            if self._ended:
                return
            command = each.opening if isinstance(each, Block) else each
            self._count += 1
            if self._count > MOST:
                raise self.error(
                    f"more than {MOST} commands, counting those in loops each time", command.line
                )
            if isinstance(each, Block):
                yield from self._block(each)
                continue
            if each.name == "return":
                self._ended = True
                return
            words = tuple(self._words(each.arguments))
            if each.name in self._own:
                note = f"{each.name}() of line {self._own[each.name]} is the file's own, and is not followed"
                self.passed_over.append(Word(note, each.line))
                continue
            act = _ACTIONS.get(each.name)
            if act is not None:
                act(self, [word.text for word in words], each.line)
            yield Statement(each.name, words, each.line)

    def error(self, message: str, line: int) -> CMakeError:
        """Return an error at a line."""
        return CMakeError(message, self.path, line)

    def spend(self, steps: int, line: int) -> None:
        """Add the cost of values before they are computed. Raises `CMakeError` if the limit is exceeded."""
        self._spent += steps
        if self._spent > STEPS:
            raise self.error("the values cost too much: they are too long, or loops repeat too often", line)

    # ---- blocks ----

    def _block(self, block: Block) -> Iterator[Statement]:
        opening, content = block.parts[0]
        if opening.name == "if":
            for command, part in block.parts:
                if command.name == "else" or self._holds(command):
                    yield from self.statements(part)
                    return
        elif opening.name == "foreach":
            words = [word.text for word in self._words(opening.arguments)]
            if not words:
                raise self.error("foreach() needs a variable", opening.line)
            for value in self._values(words[1:], opening.line):
                self.variables[words[0]] = value
                yield from self.statements(content)
        else:
            name = opening.arguments[0].text.lower() if opening.arguments else ""
            if opening.name == "while":
                self.passed_over.append(Word("while() is not followed", opening.line))
            elif name:
                self._own[name] = opening.line

    def _values(self, words: list[str], line: int) -> list[str]:
        """Return the values that a ``foreach`` iterates over."""
        if words[:1] == ["RANGE"]:
            try:
                numbers = [int(word) for word in words[1:4]]
                step = abs(numbers[2]) if len(numbers) > 2 else 1
                first, last = (0, numbers[0]) if len(numbers) == 1 else (numbers[0], numbers[1])
                found = range(first, last + 1, step) if first <= last else range(first, last - 1, -step)
            except (ValueError, IndexError) as error:
                raise self.error("foreach(... RANGE ...) needs whole numbers", line) from error
            if len(found) > MOST:
                raise self.error(f"a loop of more than {MOST} rounds", line)
            return [str(number) for number in found]
        if words[:1] != ["IN"]:
            return words
        values: list[str] = []
        is_list = False
        for word in words[1:]:
            if word in ("LISTS", "ITEMS"):
                is_list = word == "LISTS"
            elif is_list:
                value = self.variables.get(word, "")
                self.spend(len(value), line)
                values += [part for part in value.split(";") if part]
            else:
                values.append(word)
        return values

    # ---- values ----

    def _words(self, arguments: Sequence[Argument]) -> Iterator[Word]:
        for each in arguments:
            if each.raw:
                yield Word(each.text, each.line)
                continue
            text = self._filled_in(each.text, each.line)
            self.spend(OF_A_WORD * (1 + (0 if each.quoted else text.count(";"))), each.line)
            parts = [text] if each.quoted else [part for part in _SEPARATOR.split(text) if part]
            for part in parts:
                plain = _ESCAPE.sub(
                    lambda match: {"n": "\n", "t": "\t", "r": "\r"}.get(match[1], match[1]), part
                )
                yield Word(plain, each.line)

    def _filled_in(self, text: str, line: int) -> str:
        """Return a text with its variables replaced, innermost first."""
        for _ in range(20):
            self.spend(len(text), line)
            if "$" not in text:
                break
            new = _REFERENCE.sub(lambda match: "" if match[1] else self.variables.get(match[2], ""), text)
            if len(new) > LONGEST:
                raise self.error(f"a value of more than {LONGEST} characters", line)
            if new == text:
                break
            text = new
        return text

    # ---- conditions ----

    def _holds(self, command: Command) -> bool:
        """Return True if the condition of an ``if`` or ``elseif`` holds; False if it cannot be evaluated here."""
        tokens = list(self._words(command.arguments))
        value, rest = self._any(tokens, 0)
        if rest != len(tokens):
            raise self.error(f"{command.name}() does not understand {tokens[rest].text!r}", tokens[rest].line)
        return value

    def _any(self, tokens: list[Word], at: int, depth: int = 0) -> tuple[bool, int]:
        """Evaluate terms joined by AND and OR, which have equal precedence and go from left to right."""
        value, at = self._term(tokens, at, depth)
        while at < len(tokens) and tokens[at].text in ("AND", "OR"):
            joined = tokens[at].text
            other, at = self._term(tokens, at + 1, depth)
            value = (value and other) if joined == "AND" else (value or other)
        return value, at

    def _term(self, tokens: list[Word], at: int, depth: int) -> tuple[bool, int]:
        if depth > 50:
            raise self.error("a condition nested too deeply", tokens[0].line)
        if at >= len(tokens):
            return False, at  # an empty variable: if() without a condition does not hold
        word = tokens[at].text
        following = tokens[at + 1].text if at + 1 < len(tokens) else ""
        if word == "NOT":
            value, at = self._term(tokens, at + 1, depth + 1)
            return not value, at
        if word == "(":
            opened = tokens[at].line
            value, at = self._any(tokens, at + 1, depth + 1)
            if at >= len(tokens):
                raise self.error("a parenthesis in a condition is not closed", opened)
            return value, at + 1
        if word in _UNARY:
            return _UNARY[word](self, following), min(at + 2, len(tokens))
        if following in _BINARY:
            right = tokens[at + 2].text if at + 2 < len(tokens) else ""
            left, right = self.variables.get(word, word), self.variables.get(right, right)
            self.spend(len(left) + len(right), tokens[at].line)
            return _BINARY[following](left, right), min(at + 3, len(tokens))
        if following in _UNKNOWN:
            return False, min(at + 3, len(tokens))
        return self._truth(word), at + 1

    def _truth(self, word: str) -> bool:
        if word.upper() in _TRUE:
            return True
        if word.upper() in _FALSE or word.upper().endswith("-NOTFOUND"):
            return False
        try:
            return float(word) != 0
        except ValueError:
            value = self.variables.get(word, "").upper()
            return value not in _FALSE and not value.endswith("-NOTFOUND")


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")


def _version(text: str) -> list[int]:
    return [int(part[:18]) for part in re.findall(r"\d+", text[:200])][:8]


_UNARY: Mapping[str, Callable[[Evaluation, str], bool]] = {
    "DEFINED": lambda self, word: word in self.variables,
    "EXISTS": lambda self, word: _inside(self.folder, word) is not None,
    "IS_DIRECTORY": lambda self, word: (found := _inside(self.folder, word)) is not None and found.is_dir(),
    "IS_ABSOLUTE": lambda _, word: Path(word).is_absolute(),
    "TARGET": lambda *_: False,
    "COMMAND": lambda *_: True,
    "POLICY": lambda *_: True,
    "TEST": lambda *_: False,
}
_BINARY: Mapping[str, Callable[[str, str], bool]] = {
    "STREQUAL": lambda left, right: left == right,
    "EQUAL": lambda left, right: _number(left) == _number(right),
    "LESS": lambda left, right: _number(left) < _number(right),
    "GREATER": lambda left, right: _number(left) > _number(right),
    "VERSION_EQUAL": lambda left, right: _version(left) == _version(right),
    "VERSION_LESS": lambda left, right: _version(left) < _version(right),
    "VERSION_GREATER": lambda left, right: _version(left) > _version(right),
    "VERSION_GREATER_EQUAL": lambda left, right: _version(left) >= _version(right),
    "IN_LIST": lambda left, right: left in right.split(";"),
}
_UNKNOWN = {
    "MATCHES",
    "STRLESS",
    "STRGREATER",
    "LESS_EQUAL",
    "GREATER_EQUAL",
    "VERSION_LESS_EQUAL",
    "IS_NEWER_THAN",
}


def _inside(folder: Path, name: str) -> Path | None:
    """Return the file or folder of this name in a package, if it exists."""
    try:
        path = (folder / name).resolve()
        return path if path.is_relative_to(folder.resolve()) and path.exists() else None
    except (OSError, ValueError):
        return None


# ---- the commands that change variables ----


def _set(self: Evaluation, words: list[str], line: int) -> None:
    if not words:
        raise self.error("set() needs a variable", line)
    values = words[1:]
    for end in ("CACHE", "PARENT_SCOPE"):
        values = values[: values.index(end)] if end in values else values
    value = ";".join(values)
    if len(value) > LONGEST:
        raise self.error(f"a value of more than {LONGEST} characters", line)
    if not words[0].startswith("ENV{"):
        self.variables[words[0]] = value


def _unset(self: Evaluation, words: list[str], _line: int) -> None:
    for word in words[:1]:
        self.variables.pop(word, None)


def _option(self: Evaluation, words: list[str], _line: int) -> None:
    if words:
        self.variables.setdefault(words[0], words[2] if len(words) > 2 else "OFF")


def _project(self: Evaluation, words: list[str], _line: int) -> None:
    if words:
        self.variables.update(PROJECT_NAME=words[0], CMAKE_PROJECT_NAME=words[0])


def _list(self: Evaluation, words: list[str], line: int) -> None:
    if len(words) < 2:
        return
    how, name, *values = words
    value = self.variables.get(name, "")
    self.spend(len(value) + OF_A_WORD * value.count(";"), line)
    old = [part for part in value.split(";") if part]
    if how == "APPEND":
        _set(self, [name, *old, *values], line)
    elif how == "REMOVE_ITEM":
        removed = set(values)
        _set(self, [name, *(part for part in old if part not in removed)], line)
    elif how in ("SORT", "REMOVE_DUPLICATES"):
        _set(self, [name, *(sorted(old) if how == "SORT" else dict.fromkeys(old))], line)


def _file(self: Evaluation, words: list[str], line: int) -> None:
    """``file(GLOB variable [RELATIVE folder] patterns...)``; other uses of ``file`` read or write, and are ignored."""
    if len(words) < 2 or words[0] not in ("GLOB", "GLOB_RECURSE"):
        return
    how, name, *rest = words
    base: Path | None = None
    patterns: list[str] = []
    while rest:
        word = rest.pop(0)
        if word == "RELATIVE" and rest:
            base = self.folder / rest.pop(0)
        elif word not in ("CONFIGURE_DEPENDS", "LIST_DIRECTORIES"):
            patterns.append(word)
    found: set[str] = set()
    top = self.folder.resolve()
    for pattern in patterns:
        self.spend(OF_A_GLOB, line)
        parts = Path(pattern)
        if parts.is_absolute():
            parts = parts.relative_to(self.folder) if parts.is_relative_to(self.folder) else Path("*.none")
        if ".." in parts.parts or not parts.parts or str(parts).count("**") > 1:
            continue
        where = f"**/{parts}" if "**" not in str(parts) and how == "GLOB_RECURSE" else str(parts)
        try:
            files = [path for path in self.folder.glob(where) if path.resolve().is_relative_to(top)]
        except (ValueError, OSError, NotImplementedError, re.error):
            continue
        for path in files:
            relative = base is not None and path.is_relative_to(base)
            found.add((path.relative_to(base) if relative and base is not None else path).as_posix())
    _set(self, [name, *sorted(found)], line)


_ACTIONS: Mapping[str, Callable[[Evaluation, list[str], int], None]] = {
    "set": _set,
    "unset": _unset,
    "option": _option,
    "project": _project,
    "list": _list,
    "file": _file,
}
