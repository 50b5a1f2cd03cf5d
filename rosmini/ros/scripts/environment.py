"""``os.environ`` of one script: changes are private to the script and its child processes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosmini.core.graph.lanes import LaneContext

_Environ: Any = type(os.environ)


class ScriptEnviron(_Environ):  # type: ignore[misc]  # the class of os.environ has no public name
    """A copy of the host's ``os.environ`` that records changes."""

    def __init__(self) -> None:
        host: Any = os.environ
        self._host = host
        self._changed: set[str] = set()
        super().__init__(
            dict(host._data),  # noqa: SLF001 - raw values, as the class takes them
            host.encodekey,
            host.decodekey,
            host.encodevalue,
            host.decodevalue,
        )

    def add_package(self, folder: Path) -> None:
        """Add the script's own package to ``ROS_PACKAGE_PATH``, as sourcing its workspace does."""
        given = self.get("ROS_PACKAGE_PATH", "")
        if not any(folder.is_relative_to(Path(root).absolute()) for root in given.split(os.pathsep) if root):
            self["ROS_PACKAGE_PATH"] = os.pathsep.join(filter(None, (str(folder), given)))

    def __setitem__(self, key: str, value: str) -> None:
        self._changed.add(key)
        super().__setitem__(key, value)

    def __delitem__(self, key: str) -> None:
        self._changed.add(key)
        super().__delitem__(key)

    def give_back(self) -> None:
        """Restore the host's environment of the process where the script changed it."""
        for key in self._changed:
            if key in self._host:
                self._host[key] = self._host[key]
            else:
                os.unsetenv(key)
        self._changed.clear()


class OwnEnviron:
    """Context of a built-in node's lanes whose environment differs from the host's.

    ``changes`` are added or replaced variables; ``inner`` is an additional context, if any.
    """

    def __init__(self, changes: Iterable[tuple[str, str]], inner: LaneContext | None) -> None:
        self._own = ScriptEnviron()
        self._own.update(changes)
        self._inner = inner
        self._host: Any = os.environ

    def enter(self) -> None:
        """Make this environment ``os.environ``."""
        if self._inner is not None:
            self._inner.enter()
        self._host, os.environ = os.environ, self._own

    def leave(self) -> None:
        """Restore the host's environment."""
        os.environ = self._host  # noqa: B003 - another object, whose environment the process has
        if self._inner is not None:
            self._inner.leave()

    def cut_short(self) -> None:
        """Do nothing: a built-in node has no exit status to change."""

    def keeps_polling(self) -> None:
        """Do nothing: the loops of built-in nodes are not counted."""

    def finish(self) -> None:
        """Restore the process's environment at the end of the node."""
        self._own.give_back()


def folders_of_the_users() -> list[str]:
    """Return the folders of ``PYTHONPATH`` with the user's own modules, without installed libraries."""
    given = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    return [item for item in given if item and Path(item).name not in ("site-packages", "dist-packages")]
