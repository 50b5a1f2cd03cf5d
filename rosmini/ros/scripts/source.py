"""Reads a script: from a file to code, or to an error that says what the file is instead."""

from __future__ import annotations

import ast
import linecache
import re
from dataclasses import dataclass
from pathlib import Path
from types import CodeType

from rosmini.core.errors import ScriptError, nearest

from .ticks import with_ticks

_BINARY = {
    b"\x7fELF": "a compiled program (ELF)",
    b"MZ": "a compiled program for Windows",
    b"\xcf\xfa\xed\xfe": "a compiled program for macOS",
    b"\xca\xfe\xba\xbe": "a compiled program for macOS or a Java class",
    b"#ROSBAG": "a bag; `rosbag play` replays it",
    b"PK\x03\x04": "a zip archive",
    b"\x89PNG": "a picture",
}

_SUFFIX = {
    ".bag": "a bag; `rosbag play` replays it",
    ".bash": "a shell script",
    ".c": "a C source file",
    ".cc": "a C++ source file",
    ".cpp": "a C++ source file",
    ".cxx": "a C++ source file",
    ".h": "a C or C++ header",
    ".hpp": "a C++ header",
    ".ipynb": "a notebook; open it in JupyterLab",
    ".launch": "a launch file: it names the nodes to start and is not a node itself",
    ".msg": "a message definition",
    ".sh": "a shell script",
    ".srv": "a service definition",
    ".urdf": "a robot model",
    ".world": "a world for the simulator",
    ".xacro": "a robot model",
    ".xml": "an XML file",
    ".yaml": "a parameter file",
    ".yml": "a parameter file",
}

_PYTHON_2 = (
    (re.compile(r"^\s*print\s+[^\s=(.\[]|^\s*print\s*>>"), "`print` is a function in Python 3: print(...)"),
    (re.compile(r"^\s*except\s+[\w.]+\s*,\s*\w+\s*:"), "write `except Error as name:`"),
    (re.compile(r"^\s*except\s*\(.*\)\s*,\s*\w+\s*:"), "write `except (A, B) as name:`"),
    (re.compile(r"^\s*raise\s+[\w.]+\s*,"), "write `raise Error(message)`"),
    (re.compile(r"^\s*exec\s+[\"'\w]"), "`exec` is a function in Python 3: exec(...)"),
    (re.compile(r"<>"), "`<>` is written `!=`"),
    (re.compile(r"`[^`]+`"), "backquotes are written repr(...)"),
    (re.compile(r"(?<![\w.])0[0-7]+(?![\w.])"), "octal numbers are written 0o..."),
    (re.compile(r"(?<![\w.])\d+[lL]\b"), "long integers have no L any more"),
    (re.compile(r"\bur[\"']"), "ur'' is written r''"),
    (re.compile(r"^\s*def\s+\w+\s*\(.*\([^)]*\).*\)\s*:|lambda\s*\("), "a parameter cannot be a tuple"),
)

_MIXED_TABS = "Python 3 does not mix tabs and spaces in an indentation"


@dataclass(frozen=True)
class Source:
    """A script or a module beside it: its path, and its code with ticks."""

    filename: str
    code: CodeType
    doc: str | None


def read_script(path: str | Path) -> Source:
    """Read and compile the script at ``path``.

    The encoding is the declared one (PEP 263); a byte order mark and a ``#!`` line are allowed.

    Raises:
        ScriptError: it is missing, a folder, or not Python 3; the message says which.

    """
    return compile_script(_read(Path(path)), str(Path(path).absolute()))


def compile_script(data: bytes, filename: str) -> Source:
    """Compile the bytes of a script whose path is, or is said to be, ``filename``.

    Raises:
        ScriptError: the bytes are not Python 3.

    """
    try:
        tree = ast.parse(data, filename)
        doc = ast.get_docstring(tree, clean=False)
        code = compile(with_ticks(tree), filename, "exec", dont_inherit=True)
    except (SyntaxError, ValueError, UnicodeError, RecursionError) as error:
        raise ScriptError(_why_not_python(data, filename, error)) from error
    return Source(filename, code, doc)


def remember_lines(filename: str, text: str) -> None:
    """Make tracebacks show the lines of a script that is not in a file."""
    linecache.cache[filename] = (len(text), None, text.splitlines(keepends=True), filename)


def forget_lines(filename: str) -> None:
    """Undo :func:`remember_lines`."""
    linecache.cache.pop(filename, None)


def _read(path: Path) -> bytes:
    if path.is_dir():
        inside = sorted(entry.name for entry in path.iterdir() if entry.suffix == ".py")
        listed = f"; it holds {_listing(inside)}" if inside else ""
        raise ScriptError(f"{path} is a folder, not a script{listed}")
    try:
        data = path.read_bytes()
    except FileNotFoundError as error:
        raise ScriptError(_not_there(path)) from error
    except OSError as error:
        raise ScriptError(f"{path} cannot be read: {error.strerror or error}") from error
    kind = _other_kind(path, data)
    if kind is not None:
        raise ScriptError(f"{path} is {kind}; `rosmini run` runs Python scripts")
    return data


def _not_there(path: Path) -> str:
    folder = path.absolute().parent
    if not folder.is_dir():
        return f"{path} is not there: there is no folder {folder}"
    names = [entry.name for entry in folder.iterdir() if entry.is_file()]
    guess = nearest(path.name, names)
    if not guess and path.with_suffix(".py").name in names:
        guess = f"did you mean {path.with_suffix('.py').name}?"
    scripts = sorted(name for name in names if name.endswith(".py"))
    hint = guess or (f"the scripts there are {_listing(scripts)}" if scripts else "there is no script in that folder")
    return f"{path} is not there (looked in {folder}); {hint}"


def _listing(names: list[str], limit: int = 8) -> str:
    more = f" and {len(names) - limit} more" if len(names) > limit else ""
    return ", ".join(names[:limit]) + more


def _other_kind(path: Path, data: bytes) -> str | None:
    """Return the kind of a file that is not Python by its first bytes or its name; otherwise None."""
    for magic, kind in _BINARY.items():
        if data.startswith(magic):
            return kind
    first = data.split(b"\n", 1)[0]
    if first.startswith(b"#!"):
        words = first[2:].decode("latin-1").split()
        program = next((word.rpartition("/")[2] for word in words if not word.endswith("/env") and word[0] != "-"), "")
        return None if "python" in program or not program else f"a script for {program}"
    if b"\0" in data[:8192] and not data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "a binary file"
    return _SUFFIX.get(path.suffix.lower())


def _why_not_python(data: bytes, filename: str, error: Exception) -> str:
    if not isinstance(error, SyntaxError) or not error.lineno or "(unicode error)" in str(error.msg):
        # An invalid PEP 263 line, or bytes that are not in the declared encoding.
        hint = "; if it is not in UTF-8, its first line must say so, as in `# -*- coding: latin-1 -*-`"
        return f"{filename} cannot be read as Python: {getattr(error, 'msg', error)}{hint}"
    lines = data.decode("utf-8", "replace").splitlines()
    line = lines[error.lineno - 1] if 0 < error.lineno <= len(lines) else error.text or ""
    place = f"{filename}, line {error.lineno}"
    if isinstance(error, TabError):
        return f"{place}: {_MIXED_TABS} (Python 2 did)\n{_shown(line, None)}"
    for pattern, meaning in _PYTHON_2:
        if pattern.search(line):
            return f"{place}: this is Python 2, and rosmini runs Python 3; {meaning}\n{_shown(line, None)}"
    if b"<launch>" in data[:2048]:
        return f"{filename} is {_SUFFIX['.launch']}; `rosmini run` runs Python scripts"
    if re.search(rb"^\s*#\s*include\s*<", data, re.MULTILINE):
        return f"{filename} is a C or C++ source file; `rosmini run` runs Python scripts"
    return f"{place}: this is not Python: {error.msg}\n{_shown(line, error.offset)}"


def _shown(line: str, offset: int | None) -> str:
    """Return the offending line, with a caret below the position if it is known."""
    stripped = line.strip()
    shown = f"    {stripped}"
    if offset is None:
        return shown
    column = offset - 1 - (len(line) - len(line.lstrip()))
    return f"{shown}\n    {' ' * max(column, 0)}^"
