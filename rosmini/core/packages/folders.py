"""Locations of packages: the search path, and the crawl below each folder of it."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Mapping
from pathlib import Path

from rosmini.core.errors import RosminiError

MANIFEST = "package.xml"


def assets_dir() -> Path:
    """Return the folder of rosmini's packages, maps and worlds: ``rosmini/_assets`` or ``<checkout>/assets``.

    Raises `RosminiError` if neither exists.
    """
    here = Path(__file__).resolve().parents[2]
    for folder in (here / "_assets", here.parent / "assets"):
        if folder.is_dir():
            return folder
    raise RosminiError(f"rosmini's own packages are missing: no folder _assets in {here}; install rosmini again")


def address_of(path: Path) -> str:
    """Return a path for display; a file of rosmini as ``package://NAME/PATH``, which is the same on any machine."""
    ours = assets_dir() / "ros"
    return f"package://{path.relative_to(ours).as_posix()}" if path.is_relative_to(ours) else str(path)


def search_paths(environ: Mapping[str, str] | None = None) -> tuple[Path, ...]:
    """Return the folders to search for packages: those of ``ROS_PACKAGE_PATH``, then rosmini's own."""
    value = (os.environ if environ is None else environ).get("ROS_PACKAGE_PATH", "")
    return (*(Path(part) for part in value.split(os.pathsep) if part), *own_dirs())


def own_dirs() -> tuple[Path, Path]:
    """Return the two folders of rosmini's packages, ``ros`` and ``core``.

    ``ros`` contains packages that real ROS can use too. ``core`` contains manifests for rosmini's Python modules
    and commands, so that packages which depend on rospy find it.
    """
    own = assets_dir()
    return own / "ros", own / "core"


def package_around(path: str | os.PathLike[str]) -> Path | None:
    """Return the folder of the package that contains a file (the nearest with a ``package.xml``), or None."""
    return next((folder for folder in Path(path).absolute().parents if (folder / MANIFEST).is_file()), None)


def crawl(root: Path) -> Iterator[Path]:
    """Yield the folders of all packages at or below ``root``, breadth first, then by name.

    Like rospack, skip hidden folders, the inside of packages, folders with ``CATKIN_IGNORE``, and subfolders of
    folders with ``rospack_nosubdirs``.
    """
    seen: set[str] = set()  # real paths, to stop at cyclic links
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
        except (OSError, ValueError):
            continue  # missing or unreadable: rospack skips it too
        if "CATKIN_IGNORE" in content:
            continue
        if content.get(MANIFEST) is False:
            yield folder
        elif "rospack_nosubdirs" not in content:
            waiting.extend(folder / name for name in sorted(content) if content[name] and not name.startswith("."))
