"""Plugins: implementations of an interface, found by ROS names as with pluginlib (http://wiki.ros.org/pluginlib).

>>> class Planner(Plugin):
...     def plan(self) -> str: ...
>>> class Straight(Planner, plugin="straight_planner/StraightPlanner"):
...     def plan(self) -> str:
...         return "straight on"
>>> Planner.create("straight_planner::StraightPlanner").plan()
'straight on'

A direct subclass of `Plugin` is an interface; a named subclass of an interface is a plugin.
Other distributions declare theirs as entry points of the group `rosmini.plugins`
(`"my_pkg/MyPlanner" = "my_pkg.planner:MyPlanner"`), which are imported on demand. A Python package with one plugin in
each module needs one entry point for all (`"my_pkg/*" = "my_pkg.planners"`).
"""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from importlib.metadata import EntryPoint
from pkgutil import iter_modules
from typing import Any, ClassVar, Self

from rosmini.core.entry_points import entry_points
from rosmini.core.errors import RosminiError, nearest

GROUP = "rosmini.plugins"


class PluginError(RosminiError):
    """There is no such plugin, two have the same name, or it cannot be loaded."""


class Plugin:
    """Base class of interfaces. Each interface keeps a list of its plugins."""

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
        # Running a notebook cell again defines its classes again.
        if other is not None and (other.__module__, other.__qualname__) != (cls.__module__, cls.__qualname__):
            raise PluginError(f"two plugins are called {name}: {_where(other)} and {_where(cls)}; rename one")
        cls.plugin_name = name
        cls._plugins[name] = cls

    @classmethod
    def named(cls, name: str) -> type[Self]:
        """Return a plugin's class by its ROS name; `package::Class` is the same as `package/Class`.

        Raises `PluginError`, with similar names and a list of all, if there is none or if it cannot be imported.
        """
        canonical = _canonical(name)
        if canonical not in cls._plugins:
            whole_package = f"{canonical.partition('/')[0]}/*"
            for entry in entry_points(group=GROUP):
                if _canonical(entry.name) in (canonical, whole_package):
                    _load(entry)
        found = cls._plugins.get(canonical)
        if found is None or not issubclass(found, cls):
            names = cls.names()
            hint = nearest(canonical, names)
            listed = f"there are {', '.join(names)}" if names else "there is none at all"
            raise PluginError(f"there is no {cls.__name__} {name!r}; {hint + ' ' if hint else ''}{listed}")
        return found

    @classmethod
    def create(cls, name: str, *args: Any, **options: Any) -> Self:
        """Create an instance of the plugin with this name. Raises the errors of `named` and of its constructor."""
        return cls.named(name)(*args, **options)

    @classmethod
    def names(cls) -> list[str]:
        """Return the names of all plugins of this interface that can be loaded, sorted."""
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
        found = entry.load()
        for module in iter_modules(found.__path__, f"{entry.value}.") if entry.name.endswith("/*") else ():
            import_module(module.name)
    except Exception as error:
        raise PluginError(f"the plugin {entry.name} ({entry.value}) cannot be loaded: {error}") from error
