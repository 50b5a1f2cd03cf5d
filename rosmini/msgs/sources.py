"""Where definitions come from: the ``msg``, ``srv`` and ``action`` folders of packages."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from rosmini.errors import DefinitionError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = ["DictSource", "FolderSource", "Source"]


class Source(Protocol):
    """A collection of definition texts. ``kind`` is "msg", "srv" or "action"."""

    def packages(self) -> list[str]:
        """The names of all packages that define something, sorted."""

    def names(self, package: str, kind: str) -> list[str]:
        """The names of all definitions of one kind in a package, sorted; empty for an unknown package."""

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        """The text of a definition and the file that it is in, or None if there is none."""


class FolderSource:
    """The definition files of packages on disk; ``roots`` gives the folder of each package by name."""

    def __init__(self, roots: Callable[[], Mapping[str, Path]]) -> None:
        self._roots = roots

    def packages(self) -> list[str]:
        found = self._roots()
        return sorted(
            name for name, root in found.items() if any((root / kind).is_dir() for kind in ("msg", "srv", "action"))
        )

    def names(self, package: str, kind: str) -> list[str]:
        root = self._roots().get(package)
        folder = None if root is None else root / kind
        if folder is None or not folder.is_dir():
            return []
        return sorted(path.stem for path in folder.iterdir() if path.suffix == f".{kind}" and path.is_file())

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        # Compared with the listing because some file systems take "string.msg" for "String.msg".
        if name not in self.names(package, kind):
            return None
        path = self._roots()[package] / kind / f"{name}.{kind}"
        try:
            return path.read_text(encoding="utf-8"), str(path)
        except UnicodeDecodeError as error:
            line = error.object[: error.start].count(b"\n") + 1
            raise DefinitionError("the file is not UTF-8 text", str(path), line) from error


class DictSource:
    """Definitions held in memory: ``{"my_msgs/msg/Pair": "int32 a\\nint32 b"}``."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self._texts = {tuple(key.split("/")): text for key, text in texts.items()}

    def packages(self) -> list[str]:
        return sorted({package for package, _, _ in self._texts})

    def names(self, package: str, kind: str) -> list[str]:
        return sorted(name for owner, of_kind, name in self._texts if (owner, of_kind) == (package, kind))

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        text = self._texts.get((package, kind, name))
        return None if text is None else (text, f"{package}/{kind}/{name}.{kind}")
