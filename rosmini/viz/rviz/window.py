"""RViz's window on a running graph: the scene, its tools for pointer and keys, its displays and their statuses.

It is a panel like those of rqt; the real RViz can be one as well (`rqt_rviz`). A script can do what a user does in
the page with :meth:`RVizWindow.set`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from rosmini.core.graph import Graph, Node
from rosmini.viz.figures import WIDTH
from rosmini.viz.rqt.panel import Panel, bar
from rosmini.viz.rqt.parts import Control, Drawing, Part, Row, Rows, Words
from rosmini.viz.rviz import Config, Display, Layer, Level, Scene
from rosmini.viz.rviz.displays.group import Group
from rosmini.viz.rviz.flat import draw
from rosmini.viz.rviz.picture import alt_text, flat_projection, words
from rosmini.viz.rviz.primitives import Floats, Lines, Primitive
from rosmini.viz.rviz.projection import ParallelProjection, Perspective, Projection
from rosmini.viz.rviz.selection import Picked, hit, picked
from rosmini.viz.rviz.suggestions import Suggestions, suggested
from rosmini.viz.rviz.tools import Select, Tools
from rosmini.viz.rviz.views import PIXELS, Orbit, TopDownOrtho, ViewController, view_like
from rosmini.viz.view import ViewError

from .solid_page import HOST, NUMBERS, SCRIPTS, Message, SolidPage, is_possible, turn

SETTLES_NS = 2_000_000_000
"""Time for which the view follows new data [ns], unless the user is moving it."""
ZOOM = 1.25
STEP = 0.2
"""Distance that an arrow key moves the pointer, in tenths of the picture's height."""
CROSS = 8.0
"""Half the size of the cross at a pointer that keys move [px]."""
MAGENTA = np.array([0.9, 0.0, 0.6, 1.0])
YELLOW = np.array([1.0, 0.9, 0.2, 1.0])
ARROWS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, -1), "ArrowDown": (0, 1)}
WORDS = {"press": 2, "move": 2, "release": 2, "wheel": 3, "orbit": NUMBERS}
"""Pointer actions on a picture, and the number of arguments of each."""
NO_WEBGL = "This browser draws nothing in three dimensions (WebGL): this is the view without perspective."


class TimePanel:
    """ROS time, and the time since the scene started or was reset."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._begin()

    def _begin(self) -> None:
        self._ros_ns = self.scene.context.now_ns

    def reset(self) -> None:
        """Restart: all displays discard what they received."""
        self.scene.root.attach(self.scene.context)
        self._begin()

    def words(self) -> str:
        """Return the panel's text, without wall time, so that it is the same in each run."""
        now = self.scene.context.now_ns
        return f"ROS Time: {now / 1e9:.2f}\nROS Elapsed: {(now - self._ros_ns) / 1e9:.2f}"


class RVizWindow(Panel):
    """A live RViz scene.

    Args:
        graph: the graph.
        config: a `.rviz` file, or its path; without one, each topic that can be shown has a display, also if it
            appears later.
        fixed_frame: overrides the file's fixed frame.
        name: name of the window's node, which replaces an earlier window of the name; `rviz` by default.
        node: node that subscribes and publishes; by default the window creates one.
        height: height of the picture [CSS px].

    Raises:
        ConfigError: the file is not an RViz configuration.

    """

    tool: ClassVar[str] = "rviz"
    heading: ClassVar[str] = "RViz"
    plugin: ClassVar[str] = "rqt_rviz/RViz"
    update_interval_s: ClassVar[float] = 1 / 30

    def __init__(
        self, graph: Graph, config: Config | str | Path | None = None, *, fixed_frame: str | None = None,
        name: str | None = None, node: Node | None = None, height: float = 0.62 * WIDTH,
    ) -> None:  # fmt: skip
        chosen = suggested(graph, fixed_frame) if config is None else config
        found = chosen if isinstance(chosen, Config) else Config.read(chosen)
        super().__init__(graph, name=name, node=node)
        self.scene = Scene(graph, found, fixed_frame=fixed_frame, node=self.node)
        self._suggestions = Suggestions(graph, self.scene, fixed_frame) if config is None else None
        self._numbered: list[Display] = []
        """The displays by the number of their control, so that a click cannot reach a display that took its place."""
        self.tools = Tools(self.scene)
        self.time = TimePanel(self.scene)
        self.selected: list[Picked] = []
        """Last selection of the tool Select."""
        self._size = (WIDTH, height)
        self._layers: list[Layer] = []
        self._projection: Projection | None = None
        self._solid = SolidPage()
        self._is_live = False
        """True if a live page shows the window."""
        self._has_webgl = is_possible()
        self._is_pressed = self._is_dragged = False
        self._pointer = np.array(self._size) / 2
        self._uses_keys = False
        """True if a key moved the pointer last; then the window draws it."""
        self._said = self.tools.current.hint
        self._fits_until_ns = self.scene.context.now_ns + SETTLES_NS if self.scene.view is None else 0

    def close(self) -> None:
        """Close the window. Calling it again has no effect."""
        self.scene.close()
        super().close()

    # -- what it shows -------------------------------------------------------------------------------------------

    def parts(self) -> Sequence[Part]:
        """Parts of the panel: tools, scene, tool message, view and frame, displays, time, and selection."""
        now_ns = self.scene.context.now_ns
        if self._suggestions is not None and self._suggestions.add_new() and self._fits_until_ns:
            self._fits_until_ns = now_ns + SETTLES_NS
        if self.scene.view is None or now_ns < self._fits_until_ns:
            self.fit()
        self._layers = self.scene.update()
        if (
            self._projection is None
            or not self._is_pressed
            or isinstance(self._projection, ParallelProjection) == self.is_solid
        ):
            self._projection = self._current_projection()  # keeps a dragged object under the pointer
        level = max(status.level for status in self.scene.global_status)
        found: list[Part] = [
            bar(*(self._tool(tool.label) for tool in self.tools)),
            self._picture(self._projection),
            Words(self._said),
            bar(
                Control("type", "View", "choice", self._type, tuple(TYPES)),
                Control("frame", "Fixed Frame", "choice", self.scene.fixed_frame, self._frames()),
                Control("closer", "Zoom in", "button"),
                Control("farther", "Zoom out", "button"),
                Control("fit", "Show all", "button"),
                Control("reset", "Reset", "button"),
            ),
            Words(
                "; ".join(f"Global Status: {level}: {each.name}: {each.text}" for each in self.scene.global_status),
                is_bad=level is Level.ERROR,
            ),
            Rows(("Display", "on", "Status"), tuple(self._rows(self.scene.displays, 0)), "Displays"),
            Words(self.time.words().replace("\n", ", ")),
        ]
        return [*found, Words("\n".join(each.words() for each in self.selected))] if self.selected else found

    def _tool(self, label: str) -> Control:
        return Control(f"tool/{label}", label, "button", label == self.tools.current.label)

    def _frames(self) -> tuple[str, ...]:
        return tuple(sorted({*self.scene.context.tree, self.scene.fixed_frame}))

    @property
    def is_solid(self) -> bool:
        """True if a page shows it in three dimensions: the view can turn and the browser supports it."""
        return self._is_live and self._has_webgl and isinstance(self.scene.view, Orbit)

    @property
    def _type(self) -> str:
        view = self.scene.view
        return "" if view is None else _title(view.plugin_name)

    def _current_projection(self) -> Projection:
        view = self.scene.view
        if self.is_solid and view is not None:
            return Perspective.of(view.viewpoint(self.scene.context), *self._size)
        return flat_projection(self.scene, self._layers, *self._size)

    @property
    def scripts(self) -> tuple[str, ...]:
        """Scripts of its page."""
        return (*super().scripts, *SCRIPTS) if is_possible() else super().scripts

    def markup(self, *, live: bool) -> str:
        """Return the window as HTML; a live page has a separate element for the 3D viewer."""
        self._is_live = live
        return super().markup(live=live)

    def news(self, *, whole: bool) -> Message | None:
        """Return what a page in three dimensions needs in addition to the sheet."""
        if not self.is_solid:
            return None
        return self._run_in_scheduler(
            lambda: self._solid.news(
                self.scene, self._layers, self.tools.current, self._tool_primitives(), self._size, whole=whole
            )
        )

    def _tool_primitives(self) -> list[Primitive]:
        """Return what the current tool draws."""
        tool, projection = self.tools.current, self._projection
        found = list(tool.primitives())
        if isinstance(tool, Select) and tool.corners is not None and self._is_pressed and projection is not None:
            found.append(_rectangle(*tool.corners, projection))
        if self._uses_keys and projection is not None:
            found += _cross(self._pointer, projection)
        return found

    def _picture(self, projection: Projection) -> Drawing:
        said = words(self.scene, self._layers)
        tool = self.tools.current
        pointer = Control("view", f"The scene; {tool.label}: arrow keys and Enter", "text")
        if not isinstance(projection, ParallelProjection):
            return Drawing(HOST, said, pointer=pointer)
        shown: list[Primitive] = [each for layer in self._layers for each in layer.primitives]
        shown += self._tool_primitives()
        alt = alt_text(self.scene, self._layers)
        panes = [pane for layer in self._layers for pane in layer.panes]
        background = self.scene.options["Background Color"]
        svg = draw(shown, projection, background, title="RViz", alt=alt, panes=panes)
        return Drawing(svg, said, pointer=pointer)

    def _rows(self, displays: Sequence[Display], depth: int) -> list[Row]:
        rows = []
        for display in displays:
            key = f"display/{self._number(display)}"
            said = "; ".join(map(str, display.statuses)) if display.enabled else ""
            level = str(display.level) if display.enabled else "off"
            switch = Control(key, display.name, "check", display.enabled)
            rows.append(Row((display.name, switch, f"{level}: {said}" if said else level), depth))
            if isinstance(display, Group):
                rows += self._rows(display.displays, depth + 1)
        return rows

    def _number(self, wanted: Display) -> int:
        for number, each in enumerate(self._numbered):
            if each is wanted:
                return number
        self._numbered.append(wanted)
        return len(self._numbered) - 1

    # -- pointer and keys ----------------------------------------------------------------------------------------

    def _operate(self, key: Sequence[str], value: Any) -> None:
        match key[0]:
            case "tool":
                self._said = self.tools.take(key[1]).hint
            case "view":
                self._pointer_action(str(value))
            case "frame":
                self.scene.fixed_frame = value
            case "closer" | "farther":
                self.zoom(ZOOM if key[0] == "closer" else 1 / ZOOM)
            case "type":
                self._change_view(str(value))
            case "fit":
                self._fit_all()
            case "reset":
                self.time.reset()
                self.selected = []
            case _:
                self._numbered[int(key[1])].enabled = value

    def fit(self) -> None:
        """Look from above at the whole scene."""
        self._fit_all(TopDownOrtho())

    def _fit_all(self, made: ViewController | None = None) -> None:
        """Fit the whole scene into the present view, or into another kind of view."""
        made = made or self.scene.view or TopDownOrtho()
        self._layers = self.scene.update()
        self.scene.view = None
        projection = flat_projection(self.scene, self._layers, *self._size, fit=True)
        self.scene.view = made
        if isinstance(made, Orbit):
            wide = projection.width / projection.scale
            made["Distance"] = made["Distance"] * wide / made.viewpoint(self.scene.context).width
        else:
            made["Scale"] = projection.scale * PIXELS / projection.width
        made.centre_on(projection.ground, self.scene.context)

    def _change_view(self, title: str) -> None:
        view, projection = self.scene.view, self._projection
        if view is None or projection is None or title == self._type:
            return
        self._fits_until_ns = 0
        self._is_pressed = False
        viewpoint = view.viewpoint(self.scene.context)
        self.scene.view = view_like(TYPES[title], viewpoint, view["Target Frame"], self.scene.context)

    def zoom(self, factor: float) -> None:
        """Zoom in by a factor, or out if it is below 1."""
        self._fits_until_ns = 0
        view = self.scene.view
        if view is not None:
            view.zoom(factor)

    def _pointer_action(self, text: str) -> None:
        """Carry out a pointer action on the picture; see `Drawing`. Raises `ViewError` for any other text."""
        kind, *rest = text.split() or [""]
        self._fits_until_ns = 0
        self._uses_keys = kind == "key"
        if kind == "key" and len(rest) == 1:
            self._press_key(rest[0])
            return
        try:
            numbers = [float(each) for each in rest]
        except ValueError:
            numbers = []
        if kind == "flat" and not rest:
            self._has_webgl, self._said = False, NO_WEBGL
            return
        if len(numbers) != WORDS.get(kind, -1) + (kind == "orbit") or not np.isfinite(numbers).all():
            raise ViewError(f"a pointer action on a picture is {', '.join(WORDS)} or key, not {text!r:.60}")
        if kind == "orbit":
            self._solid.turns = int(numbers[0])
            turn(self.scene, numbers[1:])
            return
        self._pointer = np.array(numbers[-2:])
        if kind == "wheel":
            self.zoom(ZOOM ** -np.sign(numbers[0]))
        else:
            self._use(kind)

    def _use(self, kind: str) -> None:
        """Let the current tool press, move or release at the pointer."""
        projection = self._projection
        if projection is None:
            return
        tool = self.tools.current
        tool.ray = projection.ray(*self._pointer)
        at = self._point(projection)
        if at is None and kind == "release" and tool.needs_object:
            self._said, self._is_pressed = tool.hint, False
            return
        place = np.array(projection.metres(*self._pointer)) if at is None else at
        self._is_pressed = kind != "release"
        tool.is_finished = False
        if kind == "release" and self._is_dragged:  # the page may skip the last move of a fast drag
            tool.move(place)
        self._is_dragged = kind == "move"
        self._said = {"press": tool.press, "move": tool.move, "release": tool.release}[kind](place)
        if kind == "move":
            self._projection = self._current_projection()  # the tool may have moved the view
        if kind == "release" and isinstance(tool, Select) and tool.corners is not None:
            first, last = projection.pixels(np.array(tool.corners))
            self.selected = picked(self._layers, projection, first, last)
            self._said = f"{sum(each.number for each in self.selected)} selected"
        if kind == "release":
            self.tools.finish()

    def _point(self, projection: Projection) -> Floats | None:
        """Return the scene point under the pointer if the tool picks objects, otherwise the point on the ground."""
        if self.tools.current.needs_object:
            return hit(self._layers, projection, self._pointer)
        return np.array(projection.metres(*self._pointer))

    def _press_key(self, key: str) -> None:
        """Select a tool by its key, move the pointer by arrow keys, press and release by Enter."""
        if key in ARROWS:
            self._pointer = np.clip(self._pointer + STEP * 0.1 * self._size[1] * np.array(ARROWS[key]), 0, self._size)
            if self._is_pressed:
                self._use("move")
            else:
                self._said = f"{self.tools.current.label}: {self._where()}"
        elif key == "Enter":
            self._use("release" if self._is_pressed else "press")
        elif key in ("+", "-"):
            self.zoom(ZOOM if key == "+" else 1 / ZOOM)
        else:
            keys = {tool.key: tool for tool in self.tools}
            if key in keys:
                self._said = self.tools.take(key).hint

    def _where(self) -> str:
        if self._projection is None:
            return ""
        x, y, _ = self._projection.metres(*self._pointer)
        return f"at ({x:.2f}, {y:.2f})"


def _rectangle(first: Floats, last: Floats, projection: Projection) -> Lines:
    """Return the outline of a rectangle of the picture, on the ground."""
    (left, top), (right, bottom) = projection.pixels(np.array([first, last]))
    corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)]
    return Lines(np.array([projection.metres(*corner) for corner in corners]), YELLOW)


def _cross(pointer: Floats, projection: Projection) -> Iterator[Lines]:
    """Yield the two lines of a cross on the ground, at a pixel."""
    for along in ((CROSS, 0.0), (0.0, CROSS)):
        yield Lines(np.array([projection.metres(*(pointer + side * np.array(along))) for side in (-1, 1)]), MAGENTA)


def _title(name: str) -> str:
    """Return the title of a kind of view in RViz's Views panel."""
    package, _, kind = name.partition("/")
    return f"{kind} ({package})"


TYPES = {_title(kind.plugin_name): kind.plugin_name for kind in (Orbit, TopDownOrtho)}
"""The available kinds of view."""
