"""Worlds by name: those that rosmini brings, and those that are traced from a ROS map."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from rosmini.errors import nearest
from rosmini.sim.world import World, WorldError

from . import floor, indoor
from .traced import world_from_map

__all__ = ["names", "world", "world_from_map"]

SCHEME = "package://"


def _floor() -> World:
    return world_from_map(floor.maps_dir() / "floor.yaml", title=floor.TITLE, starts=floor.STARTS)


_MAKERS: Mapping[str, Callable[[], World]] = MappingProxyType(
    {"arena": indoor.arena, "empty": indoor.empty, "floor": _floor, "room": indoor.room}
)


def names() -> list[str]:
    """The names of the worlds that rosmini brings, sorted."""
    return sorted(_MAKERS)


def world(name: str | os.PathLike[str]) -> World:
    """The world of this name, or the one that a ROS map shows: the path or the `package://` address of its YAML file.

    A path is seen from the working directory. Raises `WorldError` for a name that is none, with the nearest, `MapError` for what is no map, and
    `UnknownPackage` or `RosminiError` for an address that leads nowhere.
    """
    if not isinstance(name, (str, os.PathLike)):
        raise WorldError(
            f"a world has a name ({', '.join(names())}) or is the path of a map's YAML file; {name!r} is neither"
        )
    text = os.fspath(name)
    if text in _MAKERS:
        return _MAKERS[text]()
    if text.startswith(SCHEME):
        from rosmini.packages import PackageIndex

        return world_from_map(PackageIndex().resolve(text))
    if isinstance(name, os.PathLike) or Path(text).suffix or os.sep in text or "/" in text:
        return world_from_map(text)
    hint = nearest(text, _MAKERS)
    raise WorldError(
        f"there is no world {text!r}{': ' + hint if hint else ''}; there are {', '.join(names())}, and any map by the "
        "path of its YAML file"
    )
