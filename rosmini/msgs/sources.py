"""Sources of definitions: the ``msg``, ``srv`` and ``action`` folders of ROS packages."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

from rosmini.core.errors import DefinitionError
from rosmini.core.files import read
from rosmini.core.packages import PackageIndex, assets_dir, reconfigure_modules, search_paths

from .definition import MAX_TEXT

KINDS = ("msg", "srv", "action")


class Source(Protocol):
    """A collection of definition texts. ``kind`` is "msg", "srv" or "action"."""

    def packages(self) -> list[str]:
        """Return the names of all packages with definitions, sorted."""

    def has_package(self, package: str) -> bool:
        """True if this package has definitions; uses cached data, so it is fast."""

    def names(self, package: str, kind: str) -> list[str]:
        """Return the names of all definitions of one kind in a package, sorted; empty for an unknown package."""

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        """Return the text of a definition and the path of its file, or None."""


class PackageSource:
    """The definition files of the packages in an index; by default of all packages on the path.

    Without a given index, it follows changes of ``ROS_PACKAGE_PATH``.
    """

    def __init__(self, index: PackageIndex | None = None) -> None:
        self._fixed = index is not None
        self._index = PackageIndex() if index is None else index

    @property
    def index(self) -> PackageIndex:
        """The package index."""
        if not self._fixed and self._index.paths != search_paths():
            self._index = PackageIndex()
        return self._index

    def packages(self) -> list[str]:
        """See :meth:`Source.packages`."""
        return [name for name in self.index.names() if self.has_package(name)]

    def has_package(self, package: str) -> bool:
        """See :meth:`Source.has_package`."""
        return self._folder(package) is not None

    def names(self, package: str, kind: str) -> list[str]:
        """See :meth:`Source.names`."""
        return sorted(self._files(package, kind))

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        """See :meth:`Source.read`.

        Raises :class:`DefinitionError` if the file cannot be read, is too large or is not UTF-8 text.
        """
        path = self._files(package, kind).get(name)
        if path is None:
            return None
        try:
            text = read(path, MAX_TEXT).decode("utf-8")
        except OSError as error:
            raise DefinitionError(f"the file cannot be read: {error.strerror}", path) from error
        except UnicodeDecodeError as error:
            line = error.object[: error.start].count(b"\n") + 1
            raise DefinitionError("the file is not UTF-8 text", path, line) from error
        return text.replace("\r\n", "\n").replace("\r", "\n"), str(path)

    def reconfigure_folder(self, package: str) -> Path | None:
        """Return the folder in which catkin_make has made the modules of ``PACKAGE.cfg``, if it has."""
        index = self.index
        return reconfigure_modules(package, index.path(package)) if package in index else None

    def _folder(self, package: str) -> Path | None:
        """Return the folder of a package's definitions.

        If the package on the path has none (Debian's libstd-msgs-dev contains only headers), use rosmini's.
        """
        index = self.index
        if package not in index:
            return None
        found = [index.path(package)]
        found += [own / package for own in (assets_dir() / "ros",) if own in index.paths]
        return next((path for path in found if any((path / kind).is_dir() for kind in KINDS)), None)

    def _files(self, package: str, kind: str) -> dict[str, Path]:
        base = self._folder(package)
        if base is None:
            return {}
        folder = base / kind
        if not folder.is_dir():
            return {}
        return {path.stem: path for path in folder.iterdir() if path.suffix == f".{kind}" and path.is_file()}
