"""Where packages are: the search path, and the crawl below each folder of it."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from rosmini.core.errors import RosminiError

MANIFEST = "package.xml"
ROSBUILD_MANIFEST = "manifest.xml"
STACK_MANIFEST = "stack.xml"


def assets_dir() -> Path:
    """The folder of the packages, maps and worlds that rosmini brings: ``rosmini/_assets`` or ``<checkout>/assets``.

    Raises `RosminiError` if there is neither.
    """
    here = Path(__file__).resolve().parents[2]
    for folder in (here / "_assets", here.parent / "assets"):
        if folder.is_dir():
            return folder
    raise RosminiError(
        f"rosmini's own packages are missing: no folder _assets in {here}; install rosmini again"
    )


def address_of(path: Path) -> str:
    """Return a path as it is shown: of a file that rosmini brings ``package://NAME/PATH``, the same on any machine."""
    ours = assets_dir() / "ros"
    return f"package://{path.relative_to(ours).as_posix()}" if path.is_relative_to(ours) else str(path)


def search_paths(environ: Mapping[str, str] | None = None) -> tuple[Path, ...]:
    """Where packages are looked for: the folders of ``ROS_PACKAGE_PATH``, then rosmini's own assets."""
    value = (os.environ if environ is None else environ).get("ROS_PACKAGE_PATH", "")
    return (*(Path(part) for part in value.split(os.pathsep) if part), *own_dirs())


def own_dirs() -> tuple[Path, Path]:
    """Return the folders of the packages that rosmini brings.

    ``ros`` has what a real ROS can use, too; ``core`` the manifests of what rosmini brings as Python modules and as
    commands, so that packages which need rospy find it.
    """
    own = assets_dir()
    return own / "ros", own / "core"


def package_around(path: str | os.PathLike[str]) -> Path | None:
    """Return the folder of the package that holds a file: the nearest one above it with a ``package.xml``."""
    return next((folder for folder in Path(path).absolute().parents if (folder / MANIFEST).is_file()), None)


class Crawled(NamedTuple):
    """A folder that the crawl found, and the name of the manifest in it."""

    folder: Path
    manifest: str

    @property
    def file(self) -> Path:
        """The manifest."""
        return self.folder / self.manifest


def crawl(root: Path) -> Iterator[Crawled]:
    """The folders of all packages and stacks at or below ``root``; those nearer to it first, then by name."""
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
        except (OSError, ValueError):
            continue  # not there, or not ours to read: rospack passes over it too
        if "CATKIN_IGNORE" in content:
            continue
        manifest = next((name for name in (MANIFEST, ROSBUILD_MANIFEST) if content.get(name) is False), None)
        if manifest is not None:
            yield Crawled(folder, manifest)
            continue
        if content.get(STACK_MANIFEST) is False:
            yield Crawled(folder, STACK_MANIFEST)
        if "rospack_nosubdirs" not in content:
            waiting.extend(
                folder / name for name in sorted(content) if content[name] and not name.startswith(".")
            )
