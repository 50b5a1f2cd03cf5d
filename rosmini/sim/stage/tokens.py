"""The words of a Stage world file: names, numbers, strings, brackets and parentheses, each with its file and line.

Stage's rules: `#` begins a comment, names begin with a letter (and may have indices, `point[0]`), numbers have a sign
and a decimal point but no exponent, strings are in double quotes on one line, `include "file"` is replaced with the
words of another file. An included file is searched for beside the world file (as in Stage), beside the file that
includes it, and in the folders of the environment variable STAGEPATH.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

from rosmini.core import files

from .errors import Place, StageError

Kind = Literal["word", "number", "string", "(", ")", "[", "]"]

VARIABLE = "STAGEPATH"
"""The environment variable with folders of included files, in the format of `PATH`."""

MAX_FILES = 1000
"""Maximum number of includes of a world, counting repeated ones."""

MAX_BYTES = 500_000
"""Maximum total size of all included files, counting repeated ones [bytes]."""

_TOKEN = re.compile(
    r"""(?P<space>[ \t\r\f\v]+|\#[^\n]*)
      | (?P<line>\n)
      | (?P<word>[A-Za-z](?:[\w.\-]|\[\d+\])*)
      | (?P<number>[-+.\d]+(?!\w))
      | (?P<string>"[^"\n]*")
      | (?P<mark>[()\[\]])""",
    re.VERBOSE,
)
_WRONG = re.compile(r'"[^\n]*|[^\s()\[\]"#]+|.')


class Token(NamedTuple):
    """A word with its kind and text; a string is without its quotes."""

    kind: Kind
    text: str
    place: Place


def tokens(text: str, path: Path, *, included: bool = False) -> Iterator[Token]:
    """Yield the words of the text of the file `path`, and includes as words. Raises `StageError`."""
    at, place = 0, Place(path, 1, included)
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            column = at - text.rfind("\n", 0, at)
            raise StageError(place, _complaint(text, at), f"this is not a world file from column {column} on")
        at = found.end()
        match found.lastgroup:
            case "line":
                place = Place(path, place.line + 1, included)
            case "word" | "number" as kind:
                yield Token(kind, found.group(), place)
            case "string":
                yield Token("string", found.group()[1:-1], place)
            case "mark":
                yield Token(found.group(), found.group(), place)  # type: ignore[arg-type]


def _complaint(text: str, at: int) -> str:
    found = _WRONG.match(text, at)
    piece = found.group() if found else text[at]
    if piece.startswith('"'):
        return f"the string {piece} has no end on its line"
    if re.fullmatch(r"[-+]?[\d.]+[eE][-+]?\d+", piece):
        return f"{piece} is no number for Stage, which knows no exponents: write it out with its zeros"
    if re.match(r"[-+.\d]", piece):
        return f"{piece} is no number"
    return f"nothing in a world file begins with {piece}; a string must be in double quotes"


def read(path: Path) -> Iterator[Token]:
    """Yield the words of a world file and all its includes. Raises `StageError`."""
    return _included(path, path, (), _Included())


@dataclass
class _Included:
    """The number and size of the files included so far."""

    files: int = 0
    size: int = 0


def _included(path: Path, root: Path, above: tuple[Path, ...], so_far: _Included) -> Iterator[Token]:
    so_far.files += 1
    if so_far.files > MAX_FILES:
        raise StageError(Place(path, 1), f"the world includes more than {MAX_FILES} files")
    try:
        if above:
            so_far.size += files.check(path).st_size
        if so_far.size > MAX_BYTES:
            raise StageError(Place(path, 1), f"the files that the world includes have more than {MAX_BYTES} bytes")
        text = files.read(path).decode("utf-8", errors="replace").replace("\r\n", "\n").replace("\r", "\n")
    except OSError as error:
        where = Place(path, 1)
        raise StageError(where, f"the file cannot be read: {error.strerror or error}") from error
    words = tokens(text, path, included=bool(above))
    for word in words:
        if word.kind != "word" or word.text != "include":
            yield word
            continue
        name = next(words, None)
        if name is None or name.kind != "string":
            raise StageError(word.place, 'after include comes a file in double quotes: include "robot.inc"')
        target = find_file(name.text, root, path)
        if target is None:
            missing = f"to include {searched(root, path)}"
            what = f'there is no file "{name.text}" {missing}'
            raise StageError(name.place, what, f"there is no such file {missing}")
        chain = [each.resolve() for each in (*above, path)]
        if target.resolve() in chain:
            circle = [*chain[chain.index(target.resolve()) :], target.resolve()]
            way = " -> ".join(each.name for each in circle)
            raise StageError(name.place, f'"{name.text}" includes itself: {way}', "the file includes itself")
        yield from _included(target, root, (*above, path), so_far)


def find_file(name: str, root: Path, mentioned_in: Path) -> Path | None:
    """Return the file that a world file calls `name`; None if there is none."""
    path = expanded(name)
    folders = [root.parent, mentioned_in.parent]
    found = [folder / path for folder in folders]  # an absolute path is unchanged
    found += [Path(folder) / path.name for folder in os.environ.get(VARIABLE, "").split(os.pathsep) if folder]
    return next((each for each in found if files.is_file(each)), None)


def expanded(name: str) -> Path:
    """Return a path with ``~`` expanded; that of an unknown user is unchanged."""
    try:
        return Path(name).expanduser()
    except RuntimeError:
        return Path(name)


def searched(root: Path, mentioned_in: Path) -> str:
    """Describe where `find_file` searches."""
    folders = dict.fromkeys([str(root.parent), str(mentioned_in.parent)])
    return f"in {' or '.join(folders)}, nor in what {VARIABLE} names"
