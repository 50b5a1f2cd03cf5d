"""Worlds by name: rosmini's own, Gazebo's and Stage's world files, and ROS maps."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from rosmini.core.errors import nearest
from rosmini.core.packages import SCHEME, assets_dir
from rosmini.sim.world import Pose, World, WorldError

from . import rooms
from .files import kind_of, world_from_file, world_from_map, world_from_sdf

__all__ = ["kind_of", "names", "source", "title", "world"]

_MAKERS: Mapping[str, Callable[[], World]] = MappingProxyType(
    {"arena": rooms.arena, "empty": rooms.empty, "room": rooms.room}
)

_FILES: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "floor": ("rosmini_sim/maps/floor.yaml", "A floor of five rooms and a corridor, 12 m by 8 m"),
        "house": ("turtlebot3_gazebo/worlds/turtlebot3_house.world", "A house of seven rooms and a hall, 16 m by 10 m"),
        "maze": ("rosmini_sim/worlds/maze.world", "A maze of 10 by 8 cells"),
        "office": ("rosmini_sim/worlds/office.world", "An office floor, 20 m by 12 m, with people and doors"),
        "pillars": ("turtlebot3_gazebo/worlds/turtlebot3_world.world", "Nine pillars in a hexagonal fence"),
    }
)
"""Worlds in files made by `assets/generate`: the path in rosmini's packages, and the title."""

_FLOOR_STARTS: tuple[Pose, ...] = (
    (0.0, 0.0, 0.0),
    (1.0, 2.3, -math.pi / 2),
    (6.3, 2.4, -math.pi / 2),
    (9.2, 1.5, math.pi / 2),
    (1.4, -2.2, math.pi / 2),
    (6.0, -2.6, 0.0),
)
"""Starts on the floor, because a map cannot contain them."""


def names() -> list[str]:
    """Return the names of rosmini's worlds, sorted."""
    return sorted((*_MAKERS, *_FILES))


def source(name: str) -> Path | None:
    """Return the file of one of rosmini's worlds; None if it is made in Python."""
    return assets_dir() / "ros" / _FILES[name][0] if name in _FILES else None


def title(name: str) -> str:
    """Return a short description of one of rosmini's worlds."""
    return _FILES[name][1] if name in _FILES else _MAKERS[name]().title


def world(name: str | os.PathLike[str]) -> World:
    """Return the world of this name or file, which is given by its path or `package://` address.

    A file is a Gazebo world (SDF), a Stage world or a ROS map (YAML), depending on its content; a relative path starts
    at the working directory. Raises `WorldError` for an unknown name, with the nearest one; `SdfError`, `StageError` or
    `MapError` for an invalid file; `UnknownPackage` or `RosminiError` for an address that does not exist.
    """
    if not isinstance(name, (str, os.PathLike)):
        raise WorldError(f"a world has a name ({', '.join(names())}) or is the path of a file; {name!r} is neither")
    text = os.fspath(name)
    if text in _MAKERS:
        return _MAKERS[text]()
    if text in _FILES:
        path, what = _FILES[text]
        file = assets_dir() / "ros" / path
        if file.suffix == ".yaml":
            return world_from_map(file, title=what, starts=_FLOOR_STARTS)
        return world_from_sdf(file, name=text, title=what)
    if text.startswith(SCHEME):
        from rosmini.core.packages import PackageIndex

        return world_from_file(PackageIndex().resolve(text))
    if isinstance(name, os.PathLike) or Path(text).suffix or os.sep in text or "/" in text:
        return world_from_file(text)
    hint = nearest(text, names())
    raise WorldError(
        f"there is no world {text!r}{': ' + hint if hint else ''}; there are {', '.join(names())}, and any Gazebo or "
        "Stage world and any map by the path of its file"
    )
