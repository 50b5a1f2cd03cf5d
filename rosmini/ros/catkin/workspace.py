"""A catkin workspace: a folder with packages in ``src``, and files generated from them in ``build`` and ``devel``."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rosmini.core import files
from rosmini.core.packages import DEVEL_MARKER, MANIFEST, crawl

from .findings import CatkinError
from .project import CMAKE

TOOL = "rosmini catkin_make"
"""Content of ``.built_by``: the original tools refuse folders built by another tool, and so does ours."""

MARKER = DEVEL_MARKER
"""The file that marks a devel space; it names the source space."""


@dataclass(frozen=True)
class Workspace:
    """Folders of a workspace, all absolute."""

    base: Path
    source: Path
    build: Path
    devel: Path

    @classmethod
    def at(cls, base: Path, source: Path | None = None, build: Path | None = None) -> Workspace:
        """Return the workspace in a folder. Raises `CatkinError`, with the likely cause, if it has no source space."""
        base = Path(os.path.abspath(base))  # noqa: PTH100 (links stay as the user knows them)
        source_space = base / (source or "src")
        found = cls(base, source_space, base / (build or "build"), base / "devel")
        if source_space.is_dir() and not (base / MANIFEST).is_file():
            found._check()
            return found
        missing = "" if source_space.is_dir() else f'The specified source space "{source_space}" does not exist\n'
        raise CatkinError(missing + found._what_is_wrong())

    def _what_is_wrong(self) -> str:
        if (self.base / MANIFEST).is_file():
            above = next((each.parent for each in self.base.parents if each.name == "src"), None)
            where = f": cd {shlex.quote(str(above))}" if above else ", the folder above the src in which the package is"
            return f"{self.base} is a package; catkin_make is run in the workspace{where}"
        if self.base.name == "src" or any((each / MANIFEST).is_file() for each in self._folders()):
            parent = shlex.quote(str(self.base.parent))
            return f"{self.base} is a source space; run catkin_make in the folder above it: cd {parent}"
        above = next((each for each in self.base.parents if (each / "src").is_dir() and each != Path("/usr")), None)
        if above and ((above / "devel").is_dir() or (above / "src" / CMAKE).exists()):
            return f"the workspace is above: cd {shlex.quote(str(above))}"
        return f"a workspace has a folder src for its packages: mkdir -p {self.source}"

    def _folders(self) -> list[Path]:
        return [self.base / name for name in files.names_in(self.base)]

    def _check(self) -> None:
        """Raise an error for a folder that cannot be a workspace, or belongs to another tool."""
        if os.pathsep in str(self.base):
            raise CatkinError(
                f"the path of the workspace has a {os.pathsep!r}, which separates paths in lists: {self.base}"
            )
        if self.base.name == "src" and (self.base.parent / "devel").is_dir():
            parent = shlex.quote(str(self.base.parent))
            raise CatkinError(f"{self.base} is the source space of a workspace: cd {parent}")
        for folder in (self.build, self.devel):
            mark = folder / ".built_by"
            other = mark.read_text(encoding="utf-8", errors="replace").strip() if mark.is_file() else TOOL
            if other != TOOL:
                raise CatkinError(
                    f"{folder} was made by {other[:40]!r}, not by {TOOL}; build with that, or remove build and devel"
                )

    def packages(self) -> list[Path]:
        """Return the folders of the packages in the source space. Raises `CatkinError` if that is a package itself."""
        found = []
        for each in crawl(self.source):
            if each == self.source:
                message = f"a package in place of the source space: packages are in folders of {self.source}"
                raise CatkinError(f"{each / MANIFEST}: {message}")
            found.append(each)
        return sorted(found)

    def underlays(self, environ: Mapping[str, str]) -> list[Path]:
        """Return the other devel and install spaces in use, in search order."""
        parts = environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
        return [Path(part) for part in parts if part and Path(part) != self.devel and Path(part).is_dir()]


def package_folders(prefix: Path) -> list[Path]:
    """Return the folders with the packages of a devel or install space."""
    mark = prefix / MARKER
    if mark.is_file():
        text = files.read(mark, 100_000).decode(errors="replace")
        return [Path(part) for part in text.split(";") if part.strip()]
    return [prefix / "share"]


def python_folder(prefix: Path) -> Path:
    """Return the folder with the Python modules of a devel or install space."""
    return prefix / "lib" / "python3" / "dist-packages"
