"""Plugins: classes of one interface, found by their ROS names as by pluginlib (http://wiki.ros.org/pluginlib).

>>> class Planner(Plugin):
...     def plan(self) -> str: ...
>>> class Straight(Planner, plugin="straight_planner/StraightPlanner"):
...     def plan(self) -> str:
...         return "straight on"
>>> Planner.create("straight_planner::StraightPlanner").plan()
'straight on'

A class that derives from `Plugin` itself is an interface; what derives from an interface and has a name is a plugin.
Other distributions add theirs as entry points of the group `rosmini.plugins`
(`"my_pkg/MyPlanner" = "my_pkg.planner:MyPlanner"`), which are imported when somebody asks for them.
"""

from __future__ import annotations

from contextlib import suppress
from importlib.metadata import EntryPoint, entry_points
from typing import Any, ClassVar, Self

from rosmini.core.errors import RosminiError, nearest

GROUP = "rosmini.plugins"


class PluginError(RosminiError):
    """There is no such plugin, there are two of one name, or it cannot be loaded."""


class Plugin:
    """The base of interfaces."""

    plugin_name: ClassVar[str] = ""
    """The plugin's ROS name, `package/Class`; empty for an interface."""
    _plugins: ClassVar[dict[str, type[Any]]]

    def __init_subclass__(cls, *, plugin: str = "", **rest: Any) -> None:
        super().__init_subclass__(**rest)
        if Plugin in cls.__bases__:
            cls._plugins = {}
        if not plugin:
            return
        name = _canonical(plugin)
        if not all(name.split("/")) or "/" not in name:
            raise PluginError(f"the plugin {cls.__qualname__} is called {plugin!r}: a name is package/Class")
        other = cls._plugins.get(name)
        # A cell of a notebook may define its class again.
        if other is not None and (other.__module__, other.__qualname__) != (cls.__module__, cls.__qualname__):
            raise PluginError(f"two plugins are called {name}: {_where(other)} and {_where(cls)}; rename one")
        cls.plugin_name = name
        cls._plugins[name] = cls

    @classmethod
    def named(cls, name: str) -> type[Self]:
        """The class of a plugin of this interface, by its ROS name; `package::Class` is the same as `package/Class`.

        Raises `PluginError`, which suggests similar names and lists all, if there is none.
        """
        wanted = _canonical(name)
        if wanted not in cls._plugins:
            for entry in entry_points(group=GROUP):
                if _canonical(entry.name) == wanted:
                    _load(entry)
        found = cls._plugins.get(wanted)
        if found is None or not issubclass(found, cls):
            names = cls.names()
            hint = nearest(wanted, names)
            listed = f"there are {', '.join(names)}" if names else "there is none at all"
            raise PluginError(f"there is no {cls.__name__} {name!r}; {hint + ' ' if hint else ''}{listed}")
        return found

    @classmethod
    def create(cls, name: str, *args: Any, **options: Any) -> Self:
        """A new object of the plugin with this name. Raises as `named`, and what its constructor raises."""
        return cls.named(name)(*args, **options)

    @classmethod
    def names(cls) -> list[str]:
        """The names of all plugins of this interface that can be loaded, sorted."""
        for entry in entry_points(group=GROUP):
            with suppress(PluginError):
                _load(entry)
        return sorted(name for name, found in cls._plugins.items() if issubclass(found, cls))


def _canonical(name: str) -> str:
    return name.replace("::", "/")


def _where(cls: type) -> str:
    return f"{cls.__module__}.{cls.__qualname__}"


def _load(entry: EntryPoint) -> None:
    try:
        entry.load()
    except Exception as error:
        raise PluginError(f"the plugin {entry.name} ({entry.value}) cannot be loaded: {error}") from error
