"""The Python packages that a ``setup.py`` declares to catkin. It is read, not run."""

from __future__ import annotations

import ast
from pathlib import Path

from rosmini.core import files

from .findings import Finding, warning

MAX_BYTES = 1_000_000
"""Maximum size of a ``setup.py`` [bytes]."""

RELAY = """
from pathlib import Path

__path__.insert(0, {folder!r})
_code = Path({folder!r}, "__init__.py")
if _code.is_file():
    exec(compile(_code.read_text(encoding="utf-8"), str(_code), "exec"))
"""
"""Text of the package in ``devel``: it imports the one in the source space and adds the generated messages."""


def python_packages(folder: Path) -> tuple[dict[str, Path], list[Finding]]:
    """Return the folder of each Python package declared in a ROS package's ``setup.py``, and the problems found.

    It must be written as in the tutorials: ``packages=[...]`` and ``package_dir={...}`` with literal names.
    """
    path = folder / "setup.py"
    if not files.is_file(path):
        return {}, [Finding("catkin_python_setup() needs a setup.py, and there is none", folder / "CMakeLists.txt")]
    try:
        tree = ast.parse(files.read(path, MAX_BYTES), str(path))
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError) as error:
        line = error.lineno if isinstance(error, SyntaxError) else None
        return {}, [Finding(f"cannot be read: {error}", path, line)]
    given = {
        keyword.arg: keyword.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        for keyword in node.keywords
        if keyword.arg in ("packages", "package_dir")
    }
    if "packages" not in given:
        return {}, [warning("no packages=[...] is found here, so scripts cannot import any", path)]
    try:
        names = ast.literal_eval(given["packages"])
        folders = ast.literal_eval(given["package_dir"]) if "package_dir" in given else {}
        found = {str(name): folder / _folder_of(str(name), dict(folders)) for name in list(names)}
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
        line = given["packages"].lineno
        return {}, [warning("packages and package_dir are not names themselves, and setup.py is not run", path, line)]
    findings = []
    top = folder.resolve()
    for name, where in sorted(found.items()):
        inside = where.resolve().is_relative_to(top)
        if not name.isidentifier() or not inside or not files.is_file(where / "__init__.py"):
            message = f"the Python package {name!r} is not there: no {where / '__init__.py'}"
            findings.append(Finding(message, path, given["packages"].lineno))
    bad = {each.message.split("'")[1] for each in findings}
    return {name: where for name, where in found.items() if name not in bad}, findings


def _folder_of(name: str, folders: dict[str, str]) -> str:
    """Return the folder of a package as distutils does: its entry in ``package_dir``, or one below that of ""."""
    if name in folders:
        return folders[name]
    return str(Path(folders.get("", ""), *name.split(".")))
