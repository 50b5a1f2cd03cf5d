"""Loading worlds: SDF files, searched for as gzserver does, and rosmini's own worlds."""

from __future__ import annotations

import os
from pathlib import Path

from rosmini.core.errors import nearest
from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.sim import sdf, worlds
from rosmini.sim.sdf import SdfWorld
from rosmini.sim.world import World

from .errors import GazeboError

RESOURCE_PATH = "GAZEBO_RESOURCE_PATH"
EMPTY = "worlds/empty.world"
"""The default world of gzserver."""


def own_folder() -> Path:
    """Return the folder of rosmini's package gazebo_ros, which contains `worlds/`."""
    return assets_dir() / "ros" / "gazebo_ros"


def load_world(name: str | os.PathLike[str]) -> World | SdfWorld:
    """Load a world from a file that gzserver would find, or by one of rosmini's names ("house", or a map's YAML file).

    A relative path is searched for in the working directory, in the folders of GAZEBO_RESOURCE_PATH, and in rosmini's
    package gazebo_ros. Raises `GazeboError` if there is no such world, and the readers' errors for an invalid file.
    """
    text = os.fspath(name)
    if text in worlds.names():
        return worlds.world(text)
    path = PackageIndex().resolve(text) if text.startswith("package://") else _found(text)
    if worlds.kind_of(path) in ("map", "stage"):
        return worlds.world(path)
    document = sdf.load(path)
    if not document.worlds:
        command = f"rosrun gazebo_ros spawn_model -sdf -file {path} -model NAME"
        raise GazeboError(f"{path} has no <world>; a model comes into a world with `{command}`")
    return document.worlds[0]


def _found(text: str) -> Path:
    folders = [Path(), *_listed(os.environ.get(RESOURCE_PATH, "")), own_folder()]
    for folder in folders:
        path = folder / text
        if path.is_file():
            return path
    if "/" not in text and not Path(text).suffix:
        hint = nearest(text, worlds.names()) or f"there are {', '.join(worlds.names())}, and any file"
    else:
        hint = "it was looked for in " + ", ".join(str(folder.resolve()) for folder in folders)
    msg = f"there is no world {text!r}; {hint}"
    raise GazeboError(msg)


def _listed(value: str) -> list[Path]:
    return [Path(part) for part in value.split(os.pathsep) if part]
