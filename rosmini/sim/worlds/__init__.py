"""Worlds by name: those that rosmini brings, and those that are traced from a ROS map."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from rosmini.errors import nearest
from rosmini.sim.world import World, WorldError

from . import indoor

__all__ = ["names", "world"]

_MAKERS: Mapping[str, Callable[[], World]] = MappingProxyType(
    {"arena": indoor.arena, "empty": indoor.empty, "room": indoor.room}
)


def names() -> list[str]:
    """The names of the worlds that rosmini brings, sorted."""
    return sorted(_MAKERS)


def world(name: str) -> World:
    """The world of this name.

    Raises `WorldError` with the names there are.
    """
    if name in _MAKERS:
        return _MAKERS[name]()
    hint = nearest(name, _MAKERS)
    raise WorldError(
        f"there is no world {name!r}{': ' + hint if hint else ''}; there are {', '.join(names())}"
    )
