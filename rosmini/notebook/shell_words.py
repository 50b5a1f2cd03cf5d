"""The shell commands of a notebook's terminal: ``cd``, ``ls``, ``cat``, ``mkdir`` ...

Each is a function that takes the terminal, options, words and input text, and returns its output.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rosmini.core import files
from rosmini.core.errors import RosminiError, UsageError

from .prompt import Prompt
from .waiting import wait

WIDTH = 80
"""Line width of `ls` [characters]."""


@dataclass(frozen=True)
class Given:
    """The arguments of a word: options (letters), other words, and the input text."""

    name: str
    options: str
    words: Sequence[str]
    text: str | None


Act = Callable[[Prompt, Given], str]


@dataclass(frozen=True)
class Word:
    """A word: its function, its options, and its least number of other words."""

    act: Act
    options: str = ""
    at_least: int = 0


WORDS: dict[str, Word] = {}
"""All words by name."""


def word(name: str, *, options: str = "", at_least: int = 0) -> Callable[[Act], Act]:
    """Register the decorated function."""

    def add(act: Act) -> Act:
        WORDS[name] = Word(act, options, at_least)
        return act

    return add


def run(terminal: Prompt, name: str, words: Sequence[str], text: str | None) -> str:
    """Run a word and return its output. Raises ``UsageError`` for an unknown option."""
    known = WORDS[name]
    letters, others = "", list(words)
    while known.options and others and re.fullmatch(r"-[A-Za-z0-9]+", others[0]):
        letters += others.pop(0)[1:]
    if odd := [letter for letter in letters if letter not in known.options]:
        has = " ".join(f"-{letter}" for letter in known.options)
        raise UsageError(f"there is no option -{odd[0]} here; there is {has}")
    if len(others) < known.at_least:
        raise UsageError("missing operand")
    return known.act(terminal, Given(name, letters, others, text))


def _lines(lines: Sequence[str]) -> str:
    return "".join(f"{line}\n" for line in lines)


def _missing(path: str) -> RosminiError:
    return RosminiError(f"{path}: No such file or directory")


def _there(terminal: Prompt, given: Given) -> Iterator[tuple[str, Path]]:
    """Yield the words and their paths. Raises ``RosminiError`` for a path that does not exist."""
    for each in given.words:
        path = terminal.path(each)
        if not path.exists():
            raise _missing(each)
        yield each, path


def _text(terminal: Prompt, given: Given) -> str:
    """Return the text of the given files, or the input text if there are none."""
    if not given.words:
        if given.text is None:
            raise UsageError("there is no keyboard here; name a file")
        return given.text
    texts = []
    for each, path in _there(terminal, given):
        if path.is_dir():
            raise RosminiError(f"{each}: Is a directory")
        texts.append(files.read(path).decode("utf-8", "replace"))
    return "".join(texts)


# -- working folder --------------------------------------------------------------------------------------------------


@word("cd")
def cd(terminal: Prompt, given: Given) -> str:
    """Go to a folder."""
    name = given.words[0] if given.words else "~"
    path = terminal.previous if name == "-" else terminal.path(name)
    if not path.exists():
        raise _missing(name)
    if not path.is_dir():
        raise RosminiError(f"{name}: Not a directory")
    terminal.go(path)
    return ""


@word("pwd")
def pwd(terminal: Prompt, _given: Given) -> str:
    """Print the working folder."""
    return f"{terminal.folder}\n"


@word("ls", options="a1lF")
def ls(terminal: Prompt, given: Given) -> str:
    """List folders in alphabetical order, with -l the kind of each name and its run bits."""
    parts = []
    named = Given(given.name, given.options, given.words or ["."], None)
    for each, path in _there(terminal, named):
        names = files.names_in(path) if path.is_dir() else [each]
        shown = [name for name in names if "a" in given.options or not name.startswith(".") or path.is_file()]
        text = _listed(path if path.is_dir() else path.parent, shown, given.options)
        parts.append(f"{each}:\n{text}" if len(named.words) > 1 and path.is_dir() else text)
    return "\n".join(parts) if len(parts) > 1 and any(":" in part for part in parts) else "".join(parts)


def _listed(folder: Path, names: Sequence[str], options: str) -> str:
    """Return the listing of names."""
    if "l" in options:
        return _lines([f"{_mode(folder / name)} {name}" for name in names])
    if "F" in options:
        names = [name + _mark(folder / name) for name in names]
    row = "  ".join(names)
    return _lines(names if "1" in options or len(row) > WIDTH else [row] if names else [])


def _mode(path: Path) -> str:
    kind, bits = ("d", 0o111) if path.is_dir() else ("-", path.stat().st_mode & 0o100)
    return f"{kind}rw{'x' if bits else '-'}r-{'x' if bits else '-'}r-{'x' if bits else '-'}"


def _mark(path: Path) -> str:
    return "/" if path.is_dir() else "*" if path.stat().st_mode & 0o100 else ""


@word("tree", options="ad")
def tree(terminal: Prompt, given: Given) -> str:
    """Draw a folder and its subfolders; with -d only folders."""
    named = Given("tree", given.options, given.words or ["."], None)
    lines: list[str] = []
    counts = [0, 0]
    for each, path in _there(terminal, named):
        lines += [each, *_branches(path, given.options, counts)]
    folders, others = counts
    total = f"{folders} director{'y' if folders == 1 else 'ies'}"
    if "d" not in given.options:
        total += f", {others} file{'' if others == 1 else 's'}"
    return _lines([*lines, "", total])


def _branches(folder: Path, options: str, counts: list[int]) -> Iterator[str]:
    names = [name for name in files.names_in(folder) if "a" in options or not name.startswith(".")]
    if "d" in options:
        names = [name for name in names if (folder / name).is_dir()]
    for name in names:
        path, last = folder / name, name == names[-1]
        counts[0 if path.is_dir() else 1] += 1
        yield f"{'└── ' if last else '├── '}{name}"
        if path.is_dir() and not path.is_symlink():
            yield from (f"{'    ' if last else '│   '}{line}" for line in _branches(path, options, counts))


# -- files -----------------------------------------------------------------------------------------------------------


@word("mkdir", options="p", at_least=1)
def mkdir(terminal: Prompt, given: Given) -> str:
    """Make folders."""
    for each in given.words:
        path = terminal.path(each, writes=True)
        if path.exists() and not ("p" in given.options and path.is_dir()):
            raise RosminiError(f"cannot create directory '{each}': File exists")
        if not path.parent.is_dir() and "p" not in given.options:
            raise RosminiError(
                f"cannot create directory '{each}': No such file or directory; mkdir -p makes both folders"
            )
        path.mkdir(parents=True, exist_ok=True)
    return ""


@word("touch", at_least=1)
def touch(terminal: Prompt, given: Given) -> str:
    """Make empty files."""
    for each in given.words:
        path = terminal.path(each, writes=True)
        if not path.parent.is_dir():
            raise _missing(each)
        path.touch()
    return ""


@word("chmod", at_least=2)
def chmod(terminal: Prompt, given: Given) -> str:
    """Set (+x) or clear (-x) the run bit of files. Does nothing on Windows, which has no run bit."""
    mode = re.fullmatch(r"[ugoa]*([+-])x|0?755|0?644", given.words[0])
    if mode is None:
        raise UsageError(f"{given.words[0]}: use +x, u+x, a+x, -x, 755 or 644")
    allows = mode[1] == "+" or given.words[0].endswith("755")
    for _, path in _there(terminal, Given("chmod", "", given.words[1:], None)):
        own = terminal.path(str(path), writes=True)
        bits = own.stat().st_mode
        own.chmod(bits | 0o111 if allows else bits & ~0o111)
    return ""


@word("cp", options="r", at_least=2)
def cp(terminal: Prompt, given: Given) -> str:
    """Copy files, and with -r also folders."""
    for path, target in _targets(terminal, given):
        if path.is_dir():
            if "r" not in given.options:
                raise RosminiError(f"{path.name} is a folder; cp -r copies it")
            shutil.copytree(path, target, dirs_exist_ok=True)
        else:
            shutil.copy(path, target)
    return ""


@word("mv", at_least=2)
def mv(terminal: Prompt, given: Given) -> str:
    """Move or rename files and folders."""
    for path, target in _targets(terminal, given):
        terminal.path(str(path), writes=True)
        shutil.move(path, target)
    return ""


def _targets(terminal: Prompt, given: Given) -> list[tuple[Path, Path]]:
    """Return pairs of source and target. Raises ``RosminiError`` if a folder would go into itself."""
    *names, last = given.words
    goal = terminal.path(last, writes=True)
    if not goal.parent.is_dir() or (len(names) > 1 and not goal.is_dir()):
        raise RosminiError(f"target '{last}': No such directory")
    found = [path for _, path in _there(terminal, Given(given.name, "", names, None))]
    pairs = [(path, goal / path.name if goal.is_dir() else goal) for path in found]
    for path, target in pairs:
        if target.is_relative_to(path):
            raise RosminiError(f"{path.name} cannot go into itself")
    return pairs


@word("rm", options="rf", at_least=1)
def rm(terminal: Prompt, given: Given) -> str:
    """Remove files, and with -r also folders; the home folder itself is only emptied."""
    for each in given.words:
        path = terminal.path(each, writes=True)
        if not path.exists() and not path.is_symlink():
            if "f" not in given.options:
                raise RosminiError(f"cannot remove '{each}': No such file or directory")
        elif path.is_dir() and not path.is_symlink():
            if "r" not in given.options:
                raise RosminiError(f"cannot remove '{each}': Is a directory; rm -r removes it and its contents")
            terminal.remove(path)
        else:
            path.unlink()
    return ""


# -- texts -----------------------------------------------------------------------------------------------------------


@word("cat")
def cat(terminal: Prompt, given: Given) -> str:
    """Show files."""
    return _text(terminal, given)


@word("echo", options="en")
def echo(_terminal: Prompt, given: Given) -> str:
    """Print text."""
    text = " ".join(given.words)
    if "e" in given.options:
        text = text.replace("\\n", "\n").replace("\\t", "\t")
    return text if "n" in given.options else f"{text}\n"


@word("grep", options="invE", at_least=1)
def grep(terminal: Prompt, given: Given) -> str:
    """Show the lines that match a pattern."""
    try:
        pattern = re.compile(given.words[0], re.IGNORECASE if "i" in given.options else 0)
    except re.error as error:
        raise UsageError(f"{given.words[0]}: {error}") from error
    lines = _text(terminal, Given("grep", "", given.words[1:], given.text)).splitlines()
    found = [(at, line) for at, line in enumerate(lines, 1) if bool(pattern.search(line)) != ("v" in given.options)]
    return _lines([f"{at}:{line}" if "n" in given.options else line for at, line in found])


@word("head", options="n0123456789")
def head(terminal: Prompt, given: Given) -> str:
    """Show the first lines: 10, or the number after -n."""
    count, named = _count(given)
    return _lines(_text(terminal, named).splitlines()[:count])


@word("tail", options="n0123456789")
def tail(terminal: Prompt, given: Given) -> str:
    """Show the last lines: 10, or the number after -n."""
    count, named = _count(given)
    return _lines(_text(terminal, named).splitlines()[-count:] if count else [])


def _count(given: Given) -> tuple[int, Given]:
    """Return the number of lines, and the other arguments."""
    digits, words = given.options.replace("n", ""), list(given.words)
    if "n" in given.options and not digits and words:
        digits = words.pop(0)
    if digits and not digits.isdecimal():
        raise UsageError(f"{digits}: invalid number of lines")
    return int(digits or 10), Given(given.name, "", words, given.text)


@word("sort", options="r")
def sort(terminal: Prompt, given: Given) -> str:
    """Sort lines alphabetically, with -r in reverse."""
    return _lines(sorted(_text(terminal, given).splitlines(), reverse="r" in given.options))


@word("wc", options="l")
def wc(terminal: Prompt, given: Given) -> str:
    """Count lines."""
    return f"{len(_text(terminal, given).splitlines())}\n"


# -- the environment -------------------------------------------------------------------------------------------------


@word("export", at_least=1)
def export(terminal: Prompt, given: Given) -> str:
    """Set variables of the environment."""
    for each in given.words:
        name, equals, value = each.partition("=")
        if not name.isidentifier():
            raise UsageError(f"`{each}': not a valid identifier; it is NAME=VALUE, without spaces")
        if equals:
            terminal.export(name, value)
    return ""


@word("unset", at_least=1)
def unset(terminal: Prompt, given: Given) -> str:
    """Remove variables from the environment."""
    for each in given.words:
        terminal.export(each, None)
    return ""


@word("printenv")
def printenv(terminal: Prompt, given: Given) -> str:
    """Show the environment in alphabetical order, or the given variables."""
    if given.words:
        return _lines([terminal.environment[name] for name in given.words if name in terminal.environment])
    return _lines([f"{name}={value}" for name, value in sorted(terminal.environment.items())])


@word("env")
def env(terminal: Prompt, given: Given) -> str:
    """Show the environment."""
    if given.words:
        raise UsageError("env only shows the environment here")
    return printenv(terminal, given)


@word("sleep", at_least=1)
def sleep(_terminal: Prompt, given: Given) -> str:
    """Let graph time pass."""
    try:
        seconds = float(given.words[0])
    except ValueError as error:
        raise UsageError(f"invalid time interval '{given.words[0]}'") from error
    wait(seconds)
    return ""
