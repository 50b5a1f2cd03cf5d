"""ROS packages: where they are, what their manifests say, which files and executables they hold.

A package is a folder with a ``package.xml`` (REP 127, REP 140, REP 149). Packages are looked for as rospack does
(http://wiki.ros.org/rospack): below each folder of ``ROS_PACKAGE_PATH`` in turn, the first package of a name wins, a
folder with ``CATKIN_IGNORE`` or ``rospack_nosubdirs`` is not entered, and neither is a package. After them come the
packages that rosmini brings, so that a workspace can overlay them.

The crawl is ours and not rospkg's, whose order depends on the file system, and which gives up altogether over one
manifest that is not XML. Manifests are read by catkin_pkg, after defusedxml has found no harm in them.
"""

from __future__ import annotations

import os
import re
import warnings
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini import files
from rosmini.errors import DefinitionError, RosminiError, ScriptError, UnknownPackage, nearest

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

NODES_GROUP = "rosmini.nodes"
"""The entry-point group of built-in nodes; a name in it is ``package/executable``."""

MANIFEST = "package.xml"
SCHEME = "package://"
LONGEST = 300
"""The largest number of characters of an address that an error shows."""
SCRIPT_FOLDERS = ("scripts", "nodes", "src", "bin")  # in the order of preference

# What `condition` attributes of a manifest (REP 149) are compared with: the ROS that rosmini is.
ROS_CONDITIONS = {"ROS_VERSION": "1", "ROS_DISTRO": "noetic", "ROS_PYTHON_VERSION": "3"}


def assets_dir() -> Path:
    """The folder of the packages, maps and worlds that rosmini brings: ``rosmini/_assets`` or ``<checkout>/assets``.

    Raises `RosminiError` if there is neither.
    """
    here = Path(__file__).resolve().parent
    for folder in (here / "_assets", here.parent / "assets"):
        if folder.is_dir():
            return folder
    raise RosminiError(
        f"rosmini's own packages are missing: no folder _assets in {here}; install rosmini again"
    )


def search_paths(environ: Mapping[str, str] | None = None) -> tuple[Path, ...]:
    """Where packages are looked for: the folders of ``ROS_PACKAGE_PATH``, then rosmini's own assets."""
    value = (os.environ if environ is None else environ).get("ROS_PACKAGE_PATH", "")
    return (*(Path(part) for part in value.split(os.pathsep) if part), assets_dir() / "ros")


def package_around(path: str | os.PathLike[str]) -> Path | None:
    """Return the folder of the package that holds a file: the nearest one above it with a ``package.xml``."""
    return next((folder for folder in Path(path).absolute().parents if (folder / MANIFEST).is_file()), None)


@dataclass(frozen=True)
class Package:
    """One ROS package, as its manifest describes it."""

    name: str
    path: Path
    version: str
    description: str
    depends: tuple[str, ...]
    """Packages needed to build or to run it, sorted; tools of the build are not among them."""
    exec_depends: tuple[str, ...]
    """Packages needed to run it, in the order in which ``rospack depends1`` prints them."""
    is_metapackage: bool


@dataclass(frozen=True)
class Executable:
    """What ``rosrun package name`` starts: either the file ``path`` or the built-in node ``entry_point``."""

    package: str
    name: str
    path: Path | None = None
    entry_point: EntryPoint | None = field(default=None, repr=False)
    has_run_bit: bool = True
    """False for a Python script that real ROS would not start before a ``chmod +x``."""

    def load(self) -> Any:
        """The object that the entry point names. Raises `ScriptError` for a file, and if the import fails."""
        if self.entry_point is None:
            raise ScriptError(
                f"{self.package}/{self.name} is a file ({self.path}), not a built-in node; run it"
            )
        try:
            return self.entry_point.load()
        except (ImportError, AttributeError) as error:
            raise ScriptError(
                f"the node {self.package}/{self.name} is announced as {self.entry_point.value}, "
                f"which cannot be imported: {error}"
            ) from error


class PackageIndex:
    """The packages below some folders (`search_paths` by default), found when they are first needed.

    An unknown name makes the index search again, so a package that was just created is found; `refresh`
    makes it forget what it has seen.
    """

    def __init__(self, paths: Iterable[str | os.PathLike[str]] | None = None) -> None:
        self.paths: tuple[Path, ...] = (
            search_paths() if paths is None else tuple(Path(path) for path in paths)
        )
        self._found: dict[str, Path] | None = None
        self._broken: list[DefinitionError] = []
        self._packages: dict[str, Package] = {}

    def __contains__(self, name: object) -> bool:
        return name in self._folders()

    def __repr__(self) -> str:
        return f"PackageIndex([{', '.join(repr(str(path)) for path in self.paths)}])"

    def refresh(self) -> None:
        """Forget all that was found; the next question searches again."""
        self._found = None
        self._broken = []
        self._packages = {}

    def names(self) -> list[str]:
        """The names of all packages, sorted. Broken manifests are left out, see `problems`."""
        return sorted(self._folders())

    def problems(self) -> list[DefinitionError]:
        """What is wrong with manifests that could not even be asked for a name, in the order of the search."""
        self._folders()
        return list(self._broken)

    def path(self, name: str) -> Path:
        """The folder of a package; its manifest is not read further than its name. Raises as `find` does."""
        folder = self._folders().get(name)
        if folder is None:
            self.refresh()
            folder = self._folders().get(name)
        if folder is None:
            for problem in self._broken:
                if problem.file is not None and Path(problem.file).parent.name == name:
                    raise problem
            raise UnknownPackage(self._unknown(name))
        return folder

    def find(self, name: str) -> Package:
        """The package of this name.

        Raises `UnknownPackage` with the searched folders and the nearest names, and `DefinitionError` with file
        and line if its ``package.xml`` is broken.
        """
        folder = self.path(name)
        if name not in self._packages:
            self._packages[name] = _read_package(folder)
        return self._packages[name]

    def resolve(self, url: str) -> Path:
        """The file or folder that ``package://name/path`` means (http://wiki.ros.org/resource_retriever).

        Raises `UnknownPackage`, or `RosminiError` if it is another kind of address or there is no such file.
        """
        from urllib.parse import unquote

        if not url.startswith(SCHEME):
            raise RosminiError(f"{url!r} is not an address inside a package; write package://NAME/PATH")
        name, _, rest = unquote(url[len(SCHEME) :]).partition("/")
        if not name:
            raise RosminiError(f"{url!r} names no package; write package://NAME/PATH")
        target = self.path(name) / rest
        if not files.exists(target):
            raise RosminiError(f"{url[:LONGEST]} is not there: no {target}. {_nearest_file(target)}".rstrip())
        return target

    def executables(self, package: str) -> list[str]:
        """The names of what `find_executable` finds in a package, sorted.

        Raises `UnknownPackage` if there is neither such a package nor a built-in node of it.
        """
        built_in = _entry_points(package)
        if package not in self and built_in:
            return sorted(built_in)
        return sorted({*built_in, *(path.name for path in _scripts(self.path(package)))})

    def find_executable(self, package: str, name: str) -> Executable:
        """What ``rosrun package name`` starts: a script or program in the package, else a built-in node.

        A program has the run bit; a Python script in ``scripts/``, ``nodes/``, ``src/`` or ``bin/`` needs none.
        Of several files of that name, the one in the first of these folders is taken. Raises `UnknownPackage`,
        and `ScriptError` if there is no such executable (with the nearest names) or it may not be run.
        """
        built_in = _entry_points(package)
        if package in self or not built_in:
            folder = self.path(package)
            for path in _scripts(folder):
                if path.name == name:
                    return Executable(package, name, path=path, has_run_bit=_has_run_bit(path))
        else:
            folder = None
        if name in built_in:
            return Executable(package, name, entry_point=built_in[name])
        raise ScriptError(self._no_executable(package, name, folder))

    # ---- inside ----

    def _folders(self) -> dict[str, Path]:
        """From the name of each package to its folder."""
        if self._found is None:
            found: dict[str, Path] = {}
            broken: list[DefinitionError] = []
            for root in self.paths:
                for folder in _package_folders(root):
                    try:
                        found.setdefault(_package_name(folder / MANIFEST), folder)
                    except DefinitionError as error:
                        broken.append(error)
            self._found, self._broken = found, broken
        return self._found

    def _unknown(self, name: str) -> str:
        searched = "".join(
            f"\n  {path}{'' if path.is_dir() else '  (there is no such folder)'}" for path in self.paths
        )
        guess = nearest(name, self.names())
        lines = [f"there is no package {name!r}{f'; {guess}' if guess else ''}"]
        lines.append(f"searched:{searched or ' nothing, the list of folders is empty'}")
        lines += [f"could not be read: {problem}" for problem in self._broken]
        lines.append("A package is a folder with a package.xml, below a folder of ROS_PACKAGE_PATH.")
        return "\n".join(lines)

    def _no_executable(self, package: str, name: str, folder: Path | None) -> str:
        files = [] if folder is None else [path for path in _files(folder) if path.name == name]
        if files:
            return f"{package}/{name} exists but is not executable; allow it to run: chmod +x {files[0]}"
        there = self.executables(package)
        guess = nearest(name, there)
        if not there:
            hint = "the package has no executables; scripts belong into its folder scripts"
        else:
            hint = guess or f"the package has: {', '.join(there)}"
        below = f" below {folder}" if folder is not None else ""
        return f"there is no executable {name!r} in the package {package!r}{below}; {hint}"


def _package_folders(root: Path) -> Iterator[Path]:
    """The folders of all packages at or below ``root``; those nearer to it first, then by name."""
    seen: set[str] = set()  # real paths, so that links in a circle come to an end
    waiting = deque([root])
    while waiting:
        folder = waiting.popleft()
        real = os.path.realpath(folder)
        if real in seen:
            continue
        seen.add(real)
        try:
            with os.scandir(folder) as entries:
                content = {entry.name: entry.is_dir() for entry in entries}
        except OSError:
            continue  # not there, or not ours to read: rospack passes over it too
        if "CATKIN_IGNORE" in content:
            continue
        if content.get(MANIFEST) is False:
            yield folder
        elif "rospack_nosubdirs" not in content:
            waiting.extend(
                folder / name for name in sorted(content) if content[name] and not name.startswith(".")
            )


def _read(manifest: Path) -> bytes:
    try:
        return files.read(manifest)
    except OSError as error:
        raise DefinitionError(f"cannot be read: {error.strerror}", manifest) from error


def _package_name(manifest: Path) -> str:
    """The name that a manifest gives. Raises `DefinitionError` if it is not XML or has no name."""
    from xml.etree.ElementTree import ParseError

    from defusedxml.common import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    text = _read(manifest)
    try:
        root = fromstring(text)
    except ParseError as error:
        line, column = error.position
        reason = str(error).partition(":")[0]
        raise DefinitionError(f"this is not XML: {reason} at column {column + 1}", manifest, line) from error
    except DefusedXmlException as error:
        line = _line_at_fault(text, "'!ENTITY'")
        raise DefinitionError("a manifest may not define entities", manifest, line) from error
    except (LookupError, ValueError) as error:
        raise DefinitionError(f"this is not XML: {error}", manifest, 1) from error
    if root.tag != "package":
        raise DefinitionError(f"a manifest begins with <package>, this one with <{root.tag}>", manifest, 1)
    name = (root.findtext("name") or "").strip()
    if not name:
        raise DefinitionError(
            "the package has no name; add <name>...</name>", manifest, _line_at_fault(text, "")
        )
    return name


def _read_package(folder: Path) -> Package:
    """The package in ``folder``, by its manifest. Raises `DefinitionError`."""
    from catkin_pkg.package import InvalidPackage, parse_package_string

    manifest = folder / MANIFEST
    _package_name(manifest)  # that it is XML, and harmless
    data = _read(manifest)
    try:
        parsed = parse_package_string(data, str(manifest), warnings=[])
        with warnings.catch_warnings():  # catkin_pkg calls pyparsing by names that pyparsing means to drop
            warnings.simplefilter("ignore", DeprecationWarning)
            parsed.evaluate_conditions(ROS_CONDITIONS)
    except (InvalidPackage, AssertionError, ValueError) as error:
        reason = _reason(error)
        raise DefinitionError(reason, manifest, _line_at_fault(data, reason)) from error
    needed = [*parsed.build_depends, *parsed.build_export_depends, *parsed.exec_depends]
    return Package(
        name=parsed.name,
        path=folder,
        version=parsed.version,
        description=" ".join(parsed.plaintext_description.split()),
        depends=tuple(sorted({each.name for each in needed if each.evaluated_condition})),
        exec_depends=tuple(
            dict.fromkeys(each.name for each in parsed.exec_depends if each.evaluated_condition)
        ),
        is_metapackage=parsed.is_metapackage(),
    )


def _reason(error: Exception) -> str:
    """What catkin_pkg says, in one line and without its headings (our own error begins with the path)."""
    lines = [line.strip() for line in str(error).splitlines()]
    return "; ".join(line.removeprefix("- ") for line in lines if line and not line.startswith("Error(s)"))


def _line_at_fault(data: bytes, reason: str) -> int:
    """The line of a manifest that ``reason`` speaks of: that of the first tag or text it quotes, else of the root."""
    text = data.decode(errors="replace")
    quoted = re.findall(r"""(?<!\w)(["'])(.+?)\1(?!\w)""", reason)
    for words in ([f"<{word}" for _, word in quoted], [word for _, word in quoted], ["<package"]):
        for word in words:
            match = re.search(re.escape(word) + r"(?!\w)", text)
            if match is not None:
                return text.count("\n", 0, match.start()) + 1
    return 1


def _entry_points(package: str) -> dict[str, EntryPoint]:
    """The built-in nodes of a package by name, from every installed distribution."""
    from importlib.metadata import entry_points

    prefix = f"{package}/"
    found = (each for each in entry_points(group=NODES_GROUP) if each.name.startswith(prefix))
    return {
        each.name[len(prefix) :]: each for each in sorted(found, key=lambda each: (each.name, each.value))
    }


def _files(folder: Path) -> list[Path]:
    """The files of a package, those in the script folders first; hidden ones and caches are passed over."""

    def rank(path: Path) -> tuple[int, tuple[str, ...]]:
        parts = path.relative_to(folder).parts
        return (SCRIPT_FOLDERS.index(parts[0]) if parts[0] in SCRIPT_FOLDERS else len(SCRIPT_FOLDERS), parts)

    found = []
    for parent, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".") and name != "__pycache__"]
        found += [Path(parent, name) for name in names if not name.startswith(".")]
    return sorted(found, key=rank)


def _scripts(folder: Path) -> list[Path]:
    """The files of a package that can be run, in the order of preference."""
    return [path for path in _files(folder) if _can_run(path, folder)]


def _can_run(path: Path, package: Path) -> bool:
    parts = path.relative_to(package).parts
    is_script = path.suffix == ".py" and parts[0] in SCRIPT_FOLDERS and path.name != "__init__.py"
    is_module = is_script and (path.parent / "__init__.py").exists()
    if is_script and not is_module:
        return True
    if os.name == "nt":  # no run bit there: a script says so itself, in its first two bytes
        with path.open("rb") as file:
            return file.read(2) == b"#!"
    return _has_run_bit(path)


def _has_run_bit(path: Path) -> bool:
    return os.access(path, os.X_OK)


def _nearest_file(target: Path) -> str:
    """A "did you mean" for a path that is not there: from the deepest folder of it that is."""
    missing = target
    while not files.exists(missing.parent) and missing.parent != missing:
        missing = missing.parent
    return nearest(missing.name, files.names_in(missing.parent))
