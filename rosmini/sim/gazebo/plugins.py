"""Plugins: code of a world, a model or a sensor, found by the file name in its `<plugin>` tag.

In Gazebo a plugin is a shared library that the server loads; here it is a class that names the library it replaces.
To write one, derive from `WorldPlugin`, `ModelPlugin` or `SensorPlugin` and override `load`. Files can use it once the
class exists:

>>> class Shout(ModelPlugin, filename="libshout.so"):
...     def load(self, model, sdf):
...         print(f"I am {model.name} and I say {sdf.word('words')}")
>>> plugin_class("libshout.so") is Shout
True

See http://classic.gazebosim.org/tutorials?cat=write_plugin for plugins of Gazebo itself.
"""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from rosmini.core.errors import nearest
from rosmini.core.markup import Element
from rosmini.sim.host import Device, Host, Stamp

from .body import Body
from .errors import UnknownPlugin
from .model import GazeboWorld, Model, Sensor

PLUGIN_PATH = "GAZEBO_PLUGIN_PATH"
"""The environment variable with the folders of plugins."""

D = TypeVar("D", bound=Device)

_CLASSES: dict[str, type[Plugin]] = {}


class Plugin:
    """The base of all plugins. Derive from one of the three kinds, not from this class."""

    kind: ClassVar[str] = ""
    filenames: ClassVar[tuple[str, ...]] = ()
    """The libraries that the class replaces."""

    def __init_subclass__(cls, *, filename: str | Sequence[str] = (), **options: Any) -> None:
        super().__init_subclass__(**options)
        cls.filenames = (filename,) if isinstance(filename, str) else tuple(filename)
        for name in cls.filenames:
            _CLASSES[_base(name)] = cls

    def __init__(self, world: GazeboWorld, name: str) -> None:
        self.world = world
        """The running world."""
        self.name = name
        """The tag's name, after the name of its owner."""
        self._endings: list[Callable[[], object]] = []

    def every(self, rate: float, callback: Callable[[float], object]) -> None:
        """Call `callback(now)` at a rate [Hz] of the world's time, which is `now` [s], until the plugin is closed."""
        name = f"{self.name}/update{len(self._endings) or ''}"
        self.add(Update(self.world.host, name, rate, callback))

    def add(self, device: D) -> D:
        """Add a device to the world's host until the plugin is closed; return it."""
        self.world.host.add(device)
        self.at_close(lambda: self.world.host.remove(device))
        return device

    def at_close(self, ending: Callable[[], object]) -> None:
        """Call `ending()` when the plugin is closed, also if the rest of `load` fails."""
        self._endings.append(ending)

    def reset(self) -> None:
        """Return to the initial state, because the world is reset."""

    def close(self) -> None:
        """Clean up, in reverse order, because the owner is removed from the world. An override must call this too."""
        while self._endings:
            self._endings.pop()()


class WorldPlugin(Plugin):
    """A plugin of the whole world: a `<plugin>` in a `<world>`."""

    kind = "world"

    def load(self, world: GazeboWorld, sdf: Element) -> None:
        """Start; `sdf` is the plugin's tag."""


class ModelPlugin(Plugin):
    """A plugin of a model: a `<plugin>` in a `<model>`, or in a `<gazebo>` of a URDF."""

    kind = "model"

    @classmethod
    def prepare(cls, body: Body, sdf: Element, complain: Callable[[str], object]) -> None:
        """Describe the model's drive before it is inserted. Only drives need this."""

    def load(self, model: Model, sdf: Element) -> None:
        """Start; `sdf` is the plugin's tag."""


class SensorPlugin(Plugin):
    """A plugin of a sensor: a `<plugin>` in a `<sensor>`."""

    kind = "sensor"

    def load(self, sensor: Sensor, sdf: Element) -> None:
        """Start; `sdf` is the plugin's tag."""


class Update(Device):
    """The device that `Plugin.every` adds to the host."""

    def __init__(self, host: Host, name: str, rate: float, callback: Callable[[float], object]) -> None:
        super().__init__(host, name, rate)
        self._callback = callback

    def due(self, stamp: Stamp, _: int, /) -> None:
        """Call the plugin; an exception is reported, and the simulation continues."""
        self.host.node.guarded(self._callback, stamp[0] + stamp[1] * 1e-9, what=self.name)


def _base(filename: str) -> str:
    """Return a library's base name: Gazebo accepts it with and without folder, `lib` and `.so`."""
    name = filename.strip().rsplit("/", 1)[-1]
    return name.removeprefix("lib").removesuffix(".so").removesuffix(".dylib")


def plugin_class(filename: str) -> type[Plugin]:
    """Return the class that replaces a library.

    An unknown one is searched for as a Python file of its name (`libshout.so`: `shout.py` or `libshout.py`)
    in the folders of GAZEBO_PLUGIN_PATH, and run. Raises `UnknownPlugin`, with the nearest name, also if running it
    fails.
    """
    base = _base(filename)
    if base not in _CLASSES:
        for folder in os.environ.get(PLUGIN_PATH, "").split(os.pathsep):
            for name in (f"{base}.py", f"lib{base}.py"):
                if folder and (Path(folder) / name).is_file():
                    _run(Path(folder) / name, base)
    found = _CLASSES.get(base)
    if found is None:
        known = plugin_filenames()
        hint = nearest(filename, known) or f"there are: {', '.join(known)}"
        raise UnknownPlugin(f"Failed to load plugin {filename}: there is no plugin of this name in rosmini; {hint}")
    return found


def _run(path: Path, name: str) -> None:
    """Run a file that defines a plugin."""
    spec = importlib.util.spec_from_file_location(f"gazebo_plugin_{name}", path)
    if spec is None or spec.loader is None:
        raise UnknownPlugin(f"{path} is not a Python file")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise UnknownPlugin(f"the plugin {path} cannot be loaded: {type(error).__name__}: {error}") from error


def plugin_filenames() -> tuple[str, ...]:
    """Return the libraries that have a plugin here, sorted."""
    return tuple(sorted({name for cls in _CLASSES.values() for name in cls.filenames}))
