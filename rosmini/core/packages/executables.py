"""The executables of ``rosrun``: scripts and programs in a package's folder, and nodes in Python packages."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass, field
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

from rosmini.core.entry_points import entry_points
from rosmini.core.errors import ScriptError

from .folders import assets_dir

NODES_GROUP = "rosmini.nodes"
"""The entry-point group of built-in nodes; its names are ``package/executable``."""

SCRIPT_FOLDERS = ("scripts", "nodes", "src", "bin")  # in order of preference

DEVEL_MARKER = ".catkin"
"""The file that marks a devel space."""


@dataclass(frozen=True)
class Executable:
    """The target of ``rosrun package name``: either the file ``path`` or the built-in node ``entry_point``."""

    package: str
    name: str
    path: Path | None = None
    entry_point: EntryPoint | None = field(default=None, repr=False)
    has_run_bit: bool = True
    """False for a Python script that needs a ``chmod +x`` before real ROS starts it."""

    def load(self) -> Any:
        """Import and return the object of the entry point. Raises `ScriptError` for a file or a failed import."""
        if self.entry_point is None:
            raise ScriptError(f"{self.package}/{self.name} is a file ({self.path}), not a built-in node; run it")
        try:
            return self.entry_point.load()
        except (ImportError, AttributeError) as error:
            raise ScriptError(
                f"the node {self.package}/{self.name} is announced as {self.entry_point.value}, "
                f"which cannot be imported: {error}"
            ) from error


def built_in_nodes(package: str) -> dict[str, EntryPoint]:
    """Return the built-in nodes of a package by name, from all installed distributions."""
    prefix = f"{package}/"
    found = (each for each in entry_points(group=NODES_GROUP) if each.name.startswith(prefix))
    return {each.name[len(prefix) :]: each for each in sorted(found, key=lambda each: (each.name, each.value))}


def files_of(folder: Path) -> list[Path]:
    """Return the files of a package, script folders first, without hidden files and caches."""

    def rank(path: Path) -> tuple[int, tuple[str, ...]]:
        parts = path.relative_to(folder).parts
        return (SCRIPT_FOLDERS.index(parts[0]) if parts[0] in SCRIPT_FOLDERS else len(SCRIPT_FOLDERS), parts)

    found = []
    for parent, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".") and name != "__pycache__"]
        found += [Path(parent, name) for name in names if not name.startswith(".")]
    return sorted(found, key=rank)


def scripts(folder: Path) -> list[Path]:
    """Return the files of a package that ``rosrun`` can start, in order of preference.

    These are Python scripts in `SCRIPT_FOLDERS`, and files with the run bit in any folder.
    """
    return [path for path in files_of(folder) if _can_run(path, folder)]


def devel_spaces(folder: Path) -> list[Path]:
    """Return the devel spaces in ``CMAKE_PREFIX_PATH``, and that of the workspace that contains the package."""
    spaces = [Path(part) for part in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if part]
    spaces += [above.parent / "devel" for above in folder.parents if above.name == "src"]
    return [space for space in spaces if (space / DEVEL_MARKER).is_file()]


def built(package: str, folder: Path) -> list[Path]:
    """Return the executables in ``lib/PACKAGE`` of the `devel_spaces`; of several with one name, only the first."""
    found: dict[str, Path] = {}
    for space in devel_spaces(folder):
        for path in sorted((space / "lib" / package).glob("*")):
            if path.is_file() and has_run_bit(path):
                found.setdefault(path.name, path)
    return list(found.values())


def reconfigure_modules(package: str, folder: Path) -> Path | None:
    """Return the folder of the module ``PACKAGE.cfg`` built from a package's ``.cfg`` files, or None."""
    for space in devel_spaces(folder):
        found = space / "lib/python3/dist-packages" / package / "cfg"
        if (found / "__init__.py").is_file():
            return found
    return None


def _can_run(path: Path, package: Path) -> bool:
    parts = path.relative_to(package).parts
    is_script = path.suffix == ".py" and parts[0] in SCRIPT_FOLDERS and path.name != "__init__.py"
    is_module = is_script and (path.parent / "__init__.py").exists()
    if is_script and not is_module:
        return True
    if os.name == "nt":  # Windows has no run bit: look for the first two bytes of a script
        return _has_shebang(path)
    return has_run_bit(path)


def _has_shebang(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(2) == b"#!"


def has_run_bit(path: Path) -> bool:
    """Return whether the file is executable.

    On Emscripten wheels are unpacked without run bits, so scripts in rosmini's packages count as executable.
    """
    if os.access(path, os.X_OK):
        return True
    return sys.platform == "emscripten" and path.is_relative_to(assets_dir()) and _has_shebang(path)
