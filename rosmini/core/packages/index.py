"""The package index: finds packages, files and executables by name."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable
from pathlib import Path

from rosmini.core import files
from rosmini.core.errors import DefinitionError, RosminiError, ScriptError, UnknownPackage, nearest

from .executables import Executable, built, built_in_nodes, files_of, has_run_bit, scripts
from .folders import MANIFEST, crawl, search_paths
from .manifest import Package, read_heading, read_package

SCHEME = "package://"
MAX_ADDRESS_LENGTH = 300
"""Maximum length of an address in an error message [characters]."""

_CPP = "that is a library for nodes in C++, which rosmini does not compile; nodes in Python need rospy"
_OTHER = "that makes messages for another language; rosmini makes those for Python"
BUILT_IN = {
    **dict.fromkeys(
        [
            "cpp_common",
            "rosconsole",
            "roscpp_serialization",
            "roscpp_traits",
            "rostime",
            "tf2",
            "xmlrpcpp",
            "rosbag_storage",
        ],
        _CPP,
    ),
    **dict.fromkeys(["gencpp", "geneus", "genlisp", "gennodejs"], _OTHER),
    "cmake_modules": "that is for CMake, which rosmini does not run; its `catkin_make` reads CMakeLists.txt itself",
    "cartographer_ros": "rosmini has no Cartographer: gmapping and hector_mapping make maps here",
    "slam_karto": "rosmini has no Karto: gmapping and hector_mapping make maps here",
    "rosclean": "that removes old log files; rosmini keeps none unless ROS_LOG_DIR says where",
    "rospack": "that is the tool: `rosmini rospack`",
}
"""Explanations for ROS packages that rosmini does not contain, by name of package."""


class PackageIndex:
    """An index of the packages below some folders (`search_paths` by default), which it searches on first use.

    An unknown name makes the index search again, so it finds a package that was just created. `refresh`
    discards the results, for example after a manifest was edited.
    """

    def __init__(self, paths: Iterable[str | os.PathLike[str]] | None = None) -> None:
        self.paths: tuple[Path, ...] = search_paths() if paths is None else tuple(Path(path) for path in paths)
        self._found: dict[str, list[Path]] | None = None
        self._metapackages: set[str] = set()
        self._broken: list[DefinitionError] = []
        self._packages: dict[str, Package] = {}

    def __contains__(self, name: object) -> bool:
        return name in self._folders()

    def refresh(self) -> None:
        """Discard the results of the search; the next query searches again."""
        self._found = None
        self._metapackages = set()
        self._broken = []
        self._packages = {}

    def names(self) -> list[str]:
        """Return the names of all packages, sorted, except those whose manifest is broken (see `problems`)."""
        return sorted(self._folders())

    def metapackages(self) -> list[str]:
        """Return the names of the metapackages (REP 127), sorted."""
        self._folders()
        return sorted(self._metapackages)

    def problems(self) -> list[DefinitionError]:
        """Return the errors of manifests whose name could not be read, in the order of the search."""
        self._folders()
        return list(self._broken)

    def path(self, name: str) -> Path:
        """Return the folder of a package. Only the name in its manifest is checked.

        Raises `UnknownPackage`, or `DefinitionError` if a folder of that name has a broken manifest.
        """
        found = self._folders().get(name)
        if found is None:
            self.refresh()
            found = self._folders().get(name)
        if found is None:
            for problem in self._broken:
                if problem.file is not None and Path(problem.file).parent.name == name:
                    raise problem
            raise UnknownPackage(self._unknown(name))
        return found[0]

    def find(self, name: str) -> Package:
        """Return the package of this name.

        Raises `UnknownPackage` with the searched folders and similar names, and `DefinitionError` with file
        and line if its ``package.xml`` is wrong.
        """
        folder = self.path(name)
        if name not in self._packages:
            self._packages[name] = read_package(folder)
        return self._packages[name]

    def resolve(self, url: str) -> Path:
        """Return the file or folder of ``package://name/path`` (http://wiki.ros.org/resource_retriever).

        Raises `UnknownPackage`, or `RosminiError` for another kind of address or a missing file.
        """
        from urllib.parse import unquote

        if not url.startswith(SCHEME):
            raise RosminiError(f"{url!r} is not an address inside a package; write package://NAME/PATH")
        name, _, rest = unquote(url[len(SCHEME) :]).partition("/")
        if not name:
            raise RosminiError(f"{url!r} names no package; write package://NAME/PATH")
        target = self.path(name) / rest
        if not files.exists(target):
            raise RosminiError(
                f"{url[:MAX_ADDRESS_LENGTH]} is not there: no {target}. {_nearest_file(target)}".rstrip()
            )
        return target

    def executables(self, package: str) -> list[str]:
        """Return the names of the executables that `find_executable` finds in a package, sorted.

        Raises `UnknownPackage` if there is neither such a package nor a built-in node of it.
        """
        built_in = built_in_nodes(package)
        if package not in self and built_in:
            return sorted(built_in)
        folder = self.path(package)
        return sorted({*built_in, *(path.name for path in (*scripts(folder), *built(package, folder)))})

    def find_executable(self, package: str, name: str) -> Executable:
        """Return the target of ``rosrun package name``: a script or program in the package, else a built-in node.

        A program has the run bit; a Python script in ``scripts/``, ``nodes/``, ``src/`` or ``bin/`` needs none.
        The first of these folders with a file of that name wins; then come the results of a build,
        in ``devel/lib/PACKAGE`` of the workspace. Raises `UnknownPackage`,
        and `ScriptError` if there is no such executable (with similar names) or it lacks the run bit.
        """
        built_in = built_in_nodes(package)
        if package in self or not built_in:
            folder = self.path(package)
            for path in scripts(folder):
                if path.name == name:
                    return Executable(package, name, path=path, has_run_bit=has_run_bit(path))
            for path in built(package, folder):
                if path.name == name:
                    return Executable(package, name, path=path)
        else:
            folder = None
        if name in built_in:
            return Executable(package, name, entry_point=built_in[name])
        raise ScriptError(self._no_executable(package, name, folder))

    # ---- internals ----

    def _folders(self) -> dict[str, list[Path]]:
        """Return the folders of each package, by name; the first one is used."""
        if self._found is None:
            found: dict[str, list[Path]] = {}
            metapackages: set[str] = set()
            broken: list[DefinitionError] = []
            for root in self.paths:
                for folder in crawl(root):
                    try:
                        name, is_metapackage = read_heading(folder / MANIFEST)
                    except DefinitionError as error:
                        broken.append(error)
                        continue
                    if is_metapackage and name not in found:
                        metapackages.add(name)
                    found.setdefault(name, []).append(folder)
            self._found, self._broken = found, broken
            self._metapackages = metapackages
        return self._found

    def _unknown(self, name: str) -> str:
        searched = "".join(f"\n  {path}{'' if path.is_dir() else '  (there is no such folder)'}" for path in self.paths)
        guess = BUILT_IN.get(name) or nearest(name, self.names())
        lines = [f"there is no package {name!r}{f'; {guess}' if guess else ''}"]
        lines.append(f"searched:{searched or ' nothing, the list of folders is empty'}")
        lines += [f"could not be read: {problem}" for problem in self._broken]
        lines.append("A package is a folder with a package.xml, below a folder of ROS_PACKAGE_PATH.")
        return "\n".join(lines)

    def _no_executable(self, package: str, name: str, folder: Path | None) -> str:
        files = [] if folder is None else [path for path in files_of(folder) if path.name == name]
        if files:
            path = shlex.quote(str(files[0]))
            return f"{package}/{name} exists but is not executable; allow it to run: chmod +x {path}"
        there = self.executables(package)
        guess = nearest(name, there)
        if not there:
            hint = "the package has no executables; put scripts into its folder scripts"
        else:
            hint = guess or f"the package has: {', '.join(there)}"
        below = f" below {folder}" if folder is not None else ""
        return f"there is no executable {name!r} in the package {package!r}{below}; {hint}"


def _nearest_file(target: Path) -> str:
    """Return a "did you mean" clause for a missing path, from the names in its deepest existing folder."""
    missing = target
    while not files.exists(missing.parent) and missing.parent != missing:
        missing = missing.parent
    return nearest(missing.name, files.names_in(missing.parent))
