"""The working folder and the environment of a notebook's terminal."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from .places import HOME, LISTS, ROS, SHARE, Places

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

START = {"HOME": HOME, "PATH": "/usr/local/bin:/usr/bin:/bin"}
"""The environment of a new terminal, the same on every machine."""

ROS_SETUP = {
    "CMAKE_PREFIX_PATH": ROS,
    "PATH": f"{ROS}/bin",
    "PYTHONPATH": f"{ROS}/lib/python3/dist-packages",
    "ROS_DISTRO": "noetic",
    "ROS_ETC_DIR": f"{ROS}/etc/ros",
    "ROS_MASTER_URI": "http://localhost:11311",
    "ROS_PACKAGE_PATH": SHARE,
    "ROS_PYTHON_VERSION": "3",
    "ROS_ROOT": f"{SHARE}/ros",
    "ROS_VERSION": "1",
}
"""Variables that ROS's setup files set; folders are put in front of a list."""


class Prompt:
    """The working folder and the environment of a terminal; paths in the environment have the book's form."""

    def __init__(self, places: Places) -> None:
        self.places = places
        self.environment: dict[str, str] = dict(START)
        self._unset: set[str] = set()
        self._folder = self._previous = places.home

    @property
    def folder(self) -> str:
        """The working folder, in the book's form."""
        return self.places.shown(str(self._folder))

    @property
    def previous(self) -> Path:
        """The previous working folder."""
        return self._previous

    def go(self, folder: Path) -> None:
        """Change the working folder."""
        self._previous, self._folder = self._folder, folder

    def path(self, word: str, *, writes: bool = False) -> Path:
        """Return the path that a word names. Raises the errors of `Places.find`."""
        return self.places.find(word, self._folder, writes=writes)

    def words(self, pattern: str) -> list[str]:
        """Return the names that match a pattern such as ``*.py``; the pattern itself if none does."""
        folder, _, last = pattern.rpartition("/")
        if not any(mark in last for mark in "*?") or any(mark in folder for mark in "*?"):
            return [pattern]
        start = f"{folder}/" if folder else ""
        found = self.path(folder).glob(last) if folder or not pattern.startswith("/") else []
        return [start + path.name for path in sorted(found) if last[0] == "." or path.name[0] != "."] or [pattern]

    def remove(self, folder: Path) -> None:
        """Remove a folder; the home folder is only emptied."""
        is_home = folder.resolve() == self.places.home
        for each in list(folder.iterdir()) if is_home else [folder]:
            shutil.rmtree(each) if each.is_dir() and not each.is_symlink() else each.unlink()
        while not self._folder.is_dir():
            self._folder = self._folder.parent

    def export(self, name: str, value: str | None) -> None:
        """Set a variable; None removes it."""
        if value is None:
            self.environment.pop(name, None)
            self._unset.add(name)
        else:
            self.environment[name] = self.places.shown(value)

    def put_first(self, name: str, folders: str) -> None:
        """Put folders in front of a list of folders, once."""
        rest = [each for each in self.environment.get(name, "").split(":") if each and each != folders]
        self.environment[name] = ":".join([folders, *rest])

    def set_up(self, folders: Sequence[tuple[str, Path]] = ()) -> None:
        """Apply the setup file of ROS, then that of a workspace, which puts these folders in front of these lists."""
        for name, value in ROS_SETUP.items():
            if name not in (*LISTS, "PATH"):
                self.environment.setdefault(name, value)
            elif not folders or not self.environment.get(name):
                self.put_first(name, value)
        for name, folder in folders:
            self.put_first(name, self.places.shown(str(folder)))

    def real_environment(self, base: Mapping[str, str]) -> dict[str, str | None]:
        """Return the differences of this environment from ``base``; None for a variable that was unset here.

        ROS's own folders are left out of the lists: rosmini's packages are always found. Packages in ``base``
        come after those of the terminal.
        """
        found: dict[str, str | None] = dict.fromkeys(self._unset)
        found |= {
            name: self.places.real(value) for name, value in self.environment.items() if name not in (*LISTS, *START)
        }
        for name in LISTS:
            own = [each for each in self.environment.get(name, "").split(":") if each and not each.startswith(ROS)]
            real = [self.places.real(each) for each in own]
            real += [base[name]] if name == "ROS_PACKAGE_PATH" and base.get(name) else []
            found[name] = os.pathsep.join(real) or None
        return found

    @contextmanager
    def inside(self, base: Mapping[str, str]) -> Iterator[None]:
        """Give this process the folder and the environment of the terminal inside the block."""
        home = str(self.places.home)
        try:
            before = Path.cwd()
        except FileNotFoundError:  # it was removed
            before = None
        os.chdir(self._folder)
        try:
            with changed({**self.real_environment(base), "HOME": home, "USERPROFILE": home}):
                yield
        finally:
            if before is not None:
                with suppress(OSError):
                    os.chdir(before)


@contextmanager
def changed(values: Mapping[str, str | None]) -> Iterator[None]:
    """Set environment variables of this process inside the block; None unsets one."""
    before = {name: os.environ.get(name) for name in values}
    put(values)
    try:
        yield
    finally:
        put(before)


def put(values: Mapping[str, str | None]) -> None:
    """Set environment variables of this process; None removes one."""
    for name, value in values.items():
        if value is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = value
