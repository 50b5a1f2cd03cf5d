"""Scripts of a package: checks that they can run, and the wrappers in ``devel`` that run them."""

from __future__ import annotations

import ast
import os
import shlex
import warnings
from collections.abc import Iterator
from pathlib import Path

from rosmini.core import files
from rosmini.core.errors import nearest

from .findings import Finding, warning
from .project import Project

FOLDERS = ("scripts", "nodes")
MAX_BYTES = 4_000_000
"""Maximum size of a script [bytes]."""

WRAPPER = """#!/usr/bin/env python3
# Made by rosmini's catkin_make: runs the script in the source space, so that a changed script needs no build.
path = {path!r}
with open(path, encoding="utf-8") as file:
    code = compile(file.read(), path, "exec")
__file__ = path
exec(code)
"""


def check_scripts(project: Project) -> Iterator[Finding]:
    """Yield the reasons why installed scripts, or those in ``scripts`` or ``nodes``, cannot run."""
    listed: dict[Path, int | None] = {}
    for word in (*(word for word, _ in project.scripts), *project.programs):
        path = project.folder / word.text
        if not files.is_file(path):
            hint = nearest(path.name, files.names_in(path.parent)) or "make it, or take the line out"
            yield Finding(f"there is no file {word.text}; {hint}", project.path, word.line)
        elif not path.resolve().is_relative_to(project.folder.resolve()):
            yield Finding(f"{word.text} is outside the package", project.path, word.line)
        else:
            listed[path] = word.line
    for folder in FOLDERS:
        for name in files.names_in(project.folder / folder):
            path = project.folder / folder / name
            if name.endswith(".py") and name != "__init__.py" and files.is_file(path):
                listed.setdefault(path, None)
    for path in sorted(listed):
        yield from check_script(path)


def check_script(path: Path) -> Iterator[Finding]:
    """Yield the reasons why a script cannot run."""
    try:
        data = files.read(path, MAX_BYTES)
    except OSError as error:
        yield Finding(f"cannot be read: {error.strerror}", path)
        return
    first = data.partition(b"\n")[0]
    if first.startswith(b"#!"):
        yield from _check_first_line(first, path)
    elif data.startswith(b"\xef\xbb\xbf#!"):
        yield Finding(
            "a byte order mark is before #!, so the system does not know how to run it; save as UTF-8", path, 1
        )
    elif path.suffix == ".py" or not data.startswith(b"\x7fELF"):
        yield warning("the first line does not say how to run it; it should be #!/usr/bin/env python3", path, 1)
    if os.name != "nt" and not os.access(path, os.X_OK):
        yield warning(f"may not be run, and rosrun will not find it: chmod +x {shlex.quote(str(path))}", path)
    if path.suffix == ".py" or b"python" in first:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                ast.parse(data.lstrip(b"\xef\xbb\xbf"), str(path))
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            line = error.lineno if isinstance(error, SyntaxError) else None
            reason = error.msg if isinstance(error, SyntaxError) else str(error)
            yield warning(f"this is not Python 3: {reason}", path, line or 1)


def _check_first_line(first: bytes, path: Path) -> Iterator[Finding]:
    if first.endswith(b"\r"):
        message = "the lines end as on Windows (CRLF), so the system looks for a program whose name ends in a CR"
        yield Finding(f"{message}; convert the file: sed -i 's/\\r$//' {path}", path, 1)
        return
    words = first[2:].decode(errors="replace").split()
    program = words[1] if len(words) > 1 and Path(words[0]).name == "env" else words[0] if words else ""
    base = Path(program).name
    if path.suffix == ".py" and not base.startswith("python"):
        message = f"a Python script is run by {program or 'nothing'!r}; the first line should be #!/usr/bin/env python3"
        yield Finding(message, path, 1)
    elif base.startswith("python2"):
        yield warning("this asks for Python 2, which ROS Noetic does not use; write #!/usr/bin/env python3", path, 1)


def wrapper(path: Path) -> str:
    """Return the text of the file in ``devel`` that runs a script."""
    return WRAPPER.format(path=str(path))
