"""Worlds by name: those that rosmini brings, and those in files: Gazebo's and Stage's worlds, and ROS maps."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from rosmini.errors import nearest
from rosmini.packages import assets_dir
from rosmini.sim.world import World, WorldError

from . import floor, house, indoor, maze, office, pillars
from .files import kind_of, world_from_file, world_from_sdf
from .random import random_world
from .rasters import to_map
from .traced import world_from_map

__all__ = [
    "kind_of",
    "names",
    "random_world",
    "source",
    "title",
    "to_map",
    "world",
    "world_from_file",
    "world_from_map",
    "world_from_sdf",
]

SCHEME = "package://"


def _floor() -> World:
    return world_from_map(floor.maps_dir() / "floor.yaml", title=floor.TITLE, starts=floor.STARTS)


_MAKERS: Mapping[str, Callable[[], World]] = MappingProxyType(
    {"arena": indoor.arena, "empty": indoor.empty, "floor": _floor, "room": indoor.room}
)

_FILES: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "house": ("turtlebot3_gazebo/worlds/turtlebot3_house.world", house.TITLE),
        "maze": ("rosmini_sim/worlds/maze.world", maze.TITLE),
        "office": ("rosmini_sim/worlds/office.world", office.TITLE),
        "pillars": ("turtlebot3_gazebo/worlds/turtlebot3_world.world", pillars.TITLE),
    }
)
"""Worlds that are SDF files: where below the packages that rosmini brings, and what they are."""


def names() -> list[str]:
    """The names of the worlds that rosmini brings, sorted."""
    return sorted((*_MAKERS, *_FILES))


def source(name: str) -> Path | None:
    """The file of a world that rosmini brings; None if it is made in Python."""
    if name == "floor":
        return floor.maps_dir() / "floor.yaml"
    return assets_dir() / "ros" / _FILES[name][0] if name in _FILES else None


def title(name: str) -> str:
    """What a world that rosmini brings is, in a few words."""
    return _FILES[name][1] if name in _FILES else _MAKERS[name]().title


def world(name: str | os.PathLike[str]) -> World:
    """The world of this name, or the one in a file, by its path or `package://` address: a Gazebo world (SDF), a Stage world, or a ROS map (YAML).

    What kind a file is, is told from what stands in it. A path is seen from the working directory. Raises `WorldError` for a name that is none,
    with the nearest; `SdfError`, `StageError` or `MapError` for a file that is none of its kind; and `UnknownPackage` or `RosminiError` for an
    address that leads nowhere.
    """
    if not isinstance(name, (str, os.PathLike)):
        raise WorldError(
            f"a world has a name ({', '.join(names())}) or is the path of a file; {name!r} is neither"
        )
    text = os.fspath(name)
    if text in _MAKERS:
        return _MAKERS[text]()
    if text in _FILES:
        path, what = _FILES[text]
        return world_from_sdf(assets_dir() / "ros" / path, name=text, title=what)
    if text.startswith(SCHEME):
        from rosmini.packages import PackageIndex

        return world_from_file(PackageIndex().resolve(text))
    if isinstance(name, os.PathLike) or Path(text).suffix or os.sep in text or "/" in text:
        return world_from_file(text)
    hint = nearest(text, names())
    raise WorldError(
        f"there is no world {text!r}{': ' + hint if hint else ''}; there are {', '.join(names())}, and any Gazebo or Stage world and "
        "any map by the path of its file"
    )
