"""Locations of models and meshes: `model://`, `file://` and `package://` addresses, and paths.

Models are searched for as in Gazebo: in the folders of GAZEBO_MODEL_PATH, in `~/.gazebo/models`, and in the folders
that ROS packages export as `gazebo_model_path`; also among rosmini's own models. Nothing is downloaded.
(http://classic.gazebosim.org/tutorials?tut=components)
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path

from rosmini.core import files
from rosmini.core.errors import RosminiError, nearest, shown
from rosmini.core.markup import Element, parse_file
from rosmini.core.packages import PackageIndex, assets_dir

from .errors import MissingError, SdfError

MODEL_PATH = "GAZEBO_MODEL_PATH"
RESOURCE_PATH = "GAZEBO_RESOURCE_PATH"


def read_file(path: str | os.PathLike[str]) -> Element:
    """Return the root of an XML file, as lenient as TinyXML. Raises `SdfError`."""
    return parse_file(path, SdfError, late_declaration=True)


class Resources:
    """Resolves addresses in SDF files; `folders` are searched first."""

    def __init__(self, folders: Iterable[str | os.PathLike[str]] = ()) -> None:
        self.folders = [Path(folder) for folder in folders]
        self._packages = PackageIndex()
        self._parsed: dict[Path, tuple[Element, int]] = {}
        self._files: dict[tuple[str, str], Path] = {}

    @cached_property
    def model_folders(self) -> list[Path]:
        """The folders that are searched for models, in order; those exported by packages come last."""
        return [
            *self.folders,
            *_listed(MODEL_PATH),
            Path.home() / ".gazebo" / "models",
            assets_dir() / "ros" / "turtlebot3_gazebo" / "models",
        ]

    def model_file(self, uri: str, asked: Element) -> Path:
        """Return the SDF file of the model at an address. Raises `MissingError` at `asked`, with searched folders."""
        key = (uri, asked.path)
        if key not in self._files:
            place = self.find(uri, asked)
            self._files[key] = place if files.is_file(place) else _described(place, asked)
        return self._files[key]

    def parsed(self, path: Path) -> tuple[Element, int]:
        """Return the root of an SDF file, which is read once, and its number of elements. Raises `SdfError`."""
        if path not in self._parsed:
            root = read_file(path)
            self._parsed[path] = root, sum(1 for _ in root.walk())
        return self._parsed[path]

    def find(self, uri: str, asked: Element) -> Path:
        """Return the file or folder at an address. Raises `MissingError` at `asked` if missing, else `SdfError`."""
        if not uri.strip():
            raise asked.error(
                f"<{asked.tag}> is empty; an address is model://NAME, package://PACKAGE/PATH, file://PATH or a path"
            )
        scheme, mark, rest = uri.strip().partition("://")
        if not mark:
            return _there(_beside(asked) / uri.strip(), uri, asked)
        if scheme in ("http", "https") and "/models/" in rest:  # on Gazebo's model server; its ground and sun are here
            name = rest.partition("/models/")[2].replace("%20", " ").replace(" ", "_").lower()
            here = assets_dir() / "ros" / "turtlebot3_gazebo" / "models" / name
            if name and here.is_dir():
                return here
        if scheme == "model":
            return self._model(rest.strip("/"), uri, asked)
        if scheme == "package":
            try:
                return self._packages.resolve(uri.strip())
            except RosminiError as error:
                raise _missing(asked, str(error)) from error
        if scheme == "file":
            try:
                path = Path(files.path_of(uri.strip()))
            except OSError as error:
                raise asked.error(f"{uri!r} is not the address of a file") from error
            for folder in [] if path.is_absolute() else [_beside(asked), *_listed(RESOURCE_PATH)]:
                if files.exists(folder / path):
                    return folder / path
            return _there(path, uri, asked)
        kinds = "model://NAME, package://PACKAGE/PATH, file://PATH or a path"
        if scheme in ("http", "https"):
            raise _missing(asked, f"{uri!r} cannot be read: rosmini fetches nothing; write {kinds}")
        raise asked.error(f"{uri!r} cannot be read: an address is {kinds}")

    def _model(self, rest: str, uri: str, asked: Element) -> Path:
        name = rest.partition("/")[0]
        if not name or ".." in Path(rest).parts:
            raise asked.error(f"{uri!r} names no model; write model://NAME")
        for folder in self._all_folders():
            if files.exists(folder / name):
                return _there(folder / rest, uri, asked)
        folders = list(dict.fromkeys(folder for folder in self._all_folders() if folder.is_dir()))
        names = {each for folder in folders for each in files.names_in(folder)}
        searched = ", ".join(map(str, folders))
        hint = nearest(name, names)
        raise _missing(
            asked,
            f"there is no model {shown(name)}{'; ' + hint if hint else ''}; searched: {searched}; put its folder on "
            f"{MODEL_PATH}",
        )

    def _all_folders(self) -> Iterator[Path]:
        yield from self.model_folders
        yield from self._exported

    @cached_property
    def _exported(self) -> list[Path]:
        """Folders that packages export (`<export><gazebo_ros gazebo_model_path="${prefix}/models"/></export>`)."""
        found = []
        for package in self._packages.names():
            folder = self._packages.path(package)
            try:
                if b"gazebo_model_path" not in files.read(folder / "package.xml"):
                    continue
                manifest = parse_file(folder / "package.xml", SdfError)
            except (OSError, SdfError):  # a faulty package does not concern a world
                continue
            for tag in manifest.walk():
                paths = tag.get("gazebo_model_path").split(":")  # a manifest is the same on all systems
                found += [Path(path.replace("${prefix}", str(folder))) for path in paths if path]
        return found


def _beside(asked: Element) -> Path:
    return Path(asked.path).parent


def _listed(variable: str) -> list[Path]:
    return [Path(part) for part in os.environ.get(variable, "").split(os.pathsep) if part]


def _missing(asked: Element, message: str) -> SdfError:
    return MissingError(message, asked.path, asked.line)


def _there(path: Path, uri: str, asked: Element) -> Path:
    if files.exists(path):
        return path
    hint = nearest(path.name, files.names_in(path.parent))
    raise _missing(asked, f"{shown(uri)} is not there: no file or folder {path}{'; ' + hint if hint else ''}")


def _described(folder: Path, asked: Element) -> Path:
    """Return the SDF file of the newest version named in a model folder's `model.config`."""
    config = folder / "model.config"
    if not config.is_file():
        if (folder / "model.sdf").is_file():
            return folder / "model.sdf"
        raise _missing(asked, f"{folder} is not a model: it has no model.config")
    named = [(_version(tag), tag) for tag in read_file(config).all("sdf") if tag.text]
    if not named:
        raise SdfError("no <sdf> says which file describes the model", str(config), 1)
    tag = max(named, key=lambda pair: pair[0])[1]
    return _there(folder / tag.text, tag.text, tag)


def _version(tag: Element) -> tuple[int, ...]:
    parts = tag.get("version", "0").split(".")
    return tuple(int(part) if part.isdigit() else 0 for part in parts)
