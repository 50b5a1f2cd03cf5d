"""``os.environ`` of one script: changes are the script's own, and child processes that it starts see them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

_Environ: Any = type(os.environ)


class ScriptEnviron(_Environ):  # type: ignore[misc]  # the class of os.environ has no public name
    """A copy of the host's ``os.environ`` that remembers what was changed."""

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
        """Let the script find the package that it is in, as after sourcing its workspace: ``ROS_PACKAGE_PATH``."""
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
        """Make the process's environment what the host has, where the script changed it."""
        for key in self._changed:
            if key in self._host:
                self._host[key] = self._host[key]
            else:
                os.unsetenv(key)
        self._changed.clear()


def folders_of_the_users() -> list[str]:
    """Return the folders of ``PYTHONPATH`` that hold a user's own modules, and no installed libraries."""
    given = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    return [item for item in given if item and Path(item).name not in ("site-packages", "dist-packages")]
