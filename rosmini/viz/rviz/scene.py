"""A scene: displays, a fixed frame, and a node that subscribes for them; RViz without its window.

>>> from rosmini import Graph
>>> with Graph() as graph, Scene(graph, fixed_frame="odom") as scene:
...     grid = scene.add("Grid", {"Plane Cell Count": 4})
...     layer = scene.update()[0]
...     print(layer.display.name, len(layer.primitives))
Grid 1
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Self

from rosmini.core.errors import nearest
from rosmini.core.graph import Graph, Node
from rosmini.core.plugins import PluginError
from rosmini.core.tf import TransformListener
from rosmini.viz.view import ViewError

from .config import Config
from .context import Context
from .display import Display, FailedDisplay, Level, Status
from .displays.group import Group
from .primitives import Pane, Primitive
from .views import ViewController, view_controller


class Layer(NamedTuple):
    """The drawing of a display."""

    display: Display
    primitives: tuple[Primitive, ...]
    panes: tuple[Pane, ...]


class Scene:
    """Displays in a graph. By default its node subscribes and publishes nothing; `close` removes it from the graph.

    Args:
        graph: the graph.
        config: a `.rviz` file, its path, or None for a scene without displays.
        fixed_frame: overrides the fixed frame of the file.
        node: subscribes and, with tools, publishes; by default a separate node, `rviz` with a number.

    Raises:
        ConfigError: the file is not a configuration of RViz.

    """

    def __init__(
        self, graph: Graph, config: Config | str | Path | None = None, *, fixed_frame: str | None = None,
        node: Node | None = None,
    ) -> None:  # fmt: skip
        if config is None:
            config = Config()
        self.config = config if isinstance(config, Config) else Config.read(config)
        self.options = self.config.options()
        if fixed_frame is not None:
            self.options["Fixed Frame"] = fixed_frame
        self.root = Group("root", {"Displays": self.config.mappings("Displays")})
        self.view: ViewController | None = view_controller(self.config.mapping("Views", "Current"))
        self.node = graph.node("rviz", anonymous=True) if node is None else node
        self.context = Context(self.node, str(self.options["Fixed Frame"]).lstrip("/"))
        self._listener = TransformListener(self.node, self.context.buffer)
        self._last_ns = self.context.now_ns
        self.root.attach(self.context)

    # -- displays ------------------------------------------------------------------------------------------------

    @property
    def displays(self) -> list[Display]:
        """The displays that are in no group, in drawing order."""
        return self.root.displays

    def __iter__(self) -> Any:
        return self.root.walk()

    def __getitem__(self, name: str) -> Display:
        """Return the first display with this name, also in groups. Raises `ViewError` if there is none."""
        for display in self.root.walk():
            if display.name == name:
                return display
        names = [display.name for display in self.root.walk()]
        hint = nearest(name, names) or f"the displays are: {', '.join(names) or 'none'}"
        raise ViewError(f"there is no display {name!r:.60}; {hint}")

    def add(
        self,
        kind: str | Display,
        properties: Mapping[str, Any] | None = None,
        *,
        name: str = "",
        group: Group | None = None,
    ) -> Display:
        """Add a display by its class, `rviz/LaserScan` or `LaserScan`, with properties that differ from their defaults.

        >>> from rosmini import Graph
        >>> with Graph() as graph, Scene(graph) as scene:
        ...     scene.add("LaserScan", {"Topic": "/scan", "Size (m)": 0.05})["Size (m)"]
        0.05

        Raises:
            ViewError: the class does not exist.
            DisplayError: it has no such property, or the value has another type.

        """
        if isinstance(kind, str):
            try:
                display = Display.named(kind if "/" in kind.replace("::", "/") else f"rviz/{kind}")(name)
            except PluginError as error:
                raise ViewError(str(error)) from error
        else:
            display = kind
        for each, value in (properties or {}).items():
            display[each] = value
        (group or self.root).displays.append(display)
        self.context.refresh()
        display.attach(self.context)
        return display

    def remove(self, display: Display) -> None:
        """Remove a display. Raises `ViewError` if it is not in the scene."""
        for group in (self.root, *(each for each in self.root.walk() if isinstance(each, Group))):
            if display in group.displays:
                display.detach()
                group.displays.remove(display)
                return
        raise ViewError(f"the display {display.name!r} is not in this scene")

    # -- time and frames -----------------------------------------------------------------------------------------

    @property
    def fixed_frame(self) -> str:
        """The frame in which everything is drawn; when it changes, all displays restart."""
        return self.context.fixed_frame

    @fixed_frame.setter
    def fixed_frame(self, frame: str) -> None:
        self.options["Fixed Frame"] = frame
        self.context.fixed_frame = str(frame).lstrip("/")
        self.root.attach(self.context)

    @property
    def global_status(self) -> tuple[Status, ...]:
        """The status of the fixed frame."""
        tree, frame = self.context.tree, self.fixed_frame
        if frame in tree:
            return (Status(Level.OK, "Fixed Frame", "OK"),)
        if not list(tree):
            return (Status(Level.WARN, "Fixed Frame", f"No tf data. Actual error: Frame [{frame}] does not exist"),)
        hint = nearest(frame, tree) or f"the frames are: {', '.join(sorted(tree)[:12])}"
        return (Status(Level.ERROR, "Fixed Frame", f"Unknown frame {frame}; {hint}"),)

    def update(self) -> list[Layer]:
        """Update all displays, and return the drawing of each, in order; disabled ones draw nothing.

        An exception in a display becomes its status. If time jumped back, all displays restart.
        """
        context = self.context
        now = context.now_ns
        if now < self._last_ns:
            self.root.attach(context)
        self._last_ns = now
        context.refresh()
        layers = [self._layer(display) for display in self.root.walk() if display.is_running]
        return [Layer(one.display, one.primitives, self._panes(one.display, layers)) for one in layers]

    def _layer(self, display: Display) -> Layer:
        try:
            display.update(self.context)
            drawn = tuple(display.primitives(self.context))
        except Exception as error:  # an error in one display must not stop the scene
            display.fail("Display", error)
            return Layer(display, (), ())
        display.clear_status("Display")
        return Layer(display, drawn, ())

    def _panes(self, display: Display, layers: list[Layer]) -> tuple[Pane, ...]:
        shown = [(layer.display.name, layer.primitives) for layer in layers if layer.display is not display]
        try:
            return tuple(display.panes(self.context, shown))
        except Exception as error:  # an error in one display must not stop the scene
            display.fail("Display", error)
            return ()

    # -- files ---------------------------------------------------------------------------------------------------

    @property
    def warning(self) -> str:
        """The unknown contents of the file, in one line; empty if there are none."""
        displays = list(self.root.walk())
        parts = [f"display {each.kind} ({each.name})" for each in displays if isinstance(each, FailedDisplay)]
        parts += self.config.unknown_classes()
        parts += [f"property {each.name}/{path}" for each in displays for path in each.unknown()]
        view = self.config.mapping("Views", "Current").get("Class")
        parts += [f"view {view}"] if view and self.view is None else []
        errors = [f"{each.name}: {text}" for each in displays for text in each.errors] + self.options.errors
        said = f"unknown, but preserved: {', '.join(parts)}" if parts else ""
        return "; ".join(filter(None, [said, *errors]))

    def saved(self) -> Config:
        """Return the current configuration."""
        displays = [display.tree() for display in self.displays]
        return self.config.with_parts(displays, self.options, None if self.view is None else self.view.tree())

    def save(self, path: str | Path) -> Path:
        """Write a `.rviz` file, which the real RViz can also load. Raises `ConfigError` if it cannot be written."""
        return self.saved().write(path)

    # -- the end -------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Leave the graph."""
        self.root.detach()
        self._listener.unregister()
        self.node.shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()
