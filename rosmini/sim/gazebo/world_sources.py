"""Where worlds come from: SDF files, looked for as gzserver does, and rosmini's own worlds."""

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
"""What gzserver loads by default."""


def own_folder() -> Path:
    """The folder of the package gazebo_ros of rosmini's own; worlds are in `worlds/` there."""
    return assets_dir() / "ros" / "gazebo_ros"


def load_world(name: str | os.PathLike[str]) -> World | SdfWorld:
    """The world of a file, as gzserver finds it, or of one of rosmini's names ("house", or the YAML file of a ROS map).

    A relative path is looked for in the working directory, in the folders of GAZEBO_RESOURCE_PATH, and in rosmini's own
    package gazebo_ros. Raises `GazeboError` if there is none, and what the readers raise for a broken file.
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
