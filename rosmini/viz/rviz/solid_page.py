"""RViz's window in three dimensions: the data that its page receives besides the sheet, see `rosmini-rviz.js`.

The page turns the scene without asking the kernel. It reports the new view in words, `orbit N YAW PITCH DISTANCE
DX DY DZ`, in radians and metres of the fixed frame; DX DY DZ is the target's displacement since the last report.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from typing import Any

import numpy as np

from rosmini.viz.meshcat.scene3d import Camera
from rosmini.viz.rviz import Layer, Scene
from rosmini.viz.rviz.displays.interactive_markers import InteractiveMarkers
from rosmini.viz.rviz.labels import MAX_LABELS, Label
from rosmini.viz.rviz.primitives import Lines, Mesh, Points, Primitive, Text, Texture
from rosmini.viz.rviz.solid import Drawing, RvizScene, text_labels
from rosmini.viz.rviz.tools import Interact, MoveCamera, Tool
from rosmini.viz.rviz.views import Orbit
from rosmini.viz.style import hex_colour

SCRIPTS = ("rosmini-meshcat.js", "rosmini-rviz.js")
NUMBERS = 6
"""Number of arguments of the word `orbit`."""
HOST = '<div class="rq-solid" data-solid="view"></div>'
"""The element in which the page puts the viewer."""
DISTANCE = 8.0
"""Distance of the camera for which lights are set, and for which points with a size in pixels are drawn [m]."""

Message = tuple[dict[str, Any], list[bytes]]


def is_possible() -> bool:
    """Return True if meshcat, whose viewer draws the scene, is installed."""
    return find_spec("meshcat") is not None


def turn(scene: Scene, numbers: Sequence[float]) -> None:
    """Apply a view change that the page reported."""
    view = scene.view
    if isinstance(view, Orbit):
        yaw, pitch, distance, *offset = numbers
        view.turn(yaw, pitch, min(max(distance, 0.05), 1e4))
        view.pan(np.array(offset), scene.context)


class Feed:
    """Commands for meshcat's viewer that update a page from the scene it shows to the current one.

    A primitive that only moved is sent as its pose, and an unchanged one is not sent.
    """

    def __init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        """Start from an empty page; the first commands set up lights and stage."""
        self._has: dict[str, Primitive] = {}
        self._drawing = Drawing(RvizScene(Camera((0.0, 0.0, 0.0), DISTANCE)))
        # The page has its own camera, which the user moves; commands must not override it.
        recorder = self._drawing.scene.recorder
        recorder.commands = [each for each in recorder.commands if b"/Cameras/" not in each]

    def news(self, drawn: Iterable[tuple[str, Iterable[Primitive]]], *, whole: bool = False) -> list[bytes]:
        """Return the commands for displays' primitives, each under its own path; `whole` starts with an empty page."""
        if whole:
            self._begin()
        found: dict[str, Primitive] = {}
        maps = 0
        for path, shown in drawn:
            for i, primitive in enumerate(each for each in shown if not isinstance(each, Text)):
                name = f"{path}/{i}"
                if self._put(primitive, name, maps):
                    found[name] = primitive
                maps += isinstance(primitive, Texture)
        for name in self._has:
            if name not in found:
                self._drawing.scene.visualizer[name].delete()
        self._has = found
        return self._drawing.scene.recorder.take()

    def _put(self, primitive: Primitive, path: str, maps: int) -> bool:
        """Send the difference; return True if any of it is visible."""
        before = self._has.get(path)
        if before is not None and same_shape(before, primitive):
            if isinstance(primitive, Mesh | Texture) and _moved(before, primitive):
                self._drawing.place(primitive, path, maps)
            return True
        recorder = self._drawing.scene.recorder
        sent = len(recorder.commands)
        self._drawing.put(primitive, path, maps)
        return len(recorder.commands) > sent


def texts(drawn: Iterable[Primitive]) -> list[Text]:
    """Return the texts among primitives, as many as a page shows."""
    return [each for each in drawn if isinstance(each, Text)][:MAX_LABELS]


def same_shape(one: Primitive, other: Primitive) -> bool:
    """Return True if two primitives differ only in their pose."""
    match one, other:
        case Mesh(), Mesh():
            return one.lit == other.lit and _same(one, other, "vertices", "faces", "colours")
        case Texture(), Texture():
            return (one.size, one.behind) == (other.size, other.behind) and _same(one, other, "pixels")
        case Points(), Points():
            return (one.size, one.style) == (other.size, other.style) and _same(one, other, "points", "colours")
        case Lines(), Lines():
            return (one.width, one.strip) == (other.width, other.strip) and _same(one, other, "points", "colours")
        case _:
            return False


def _same(one: Primitive, other: Primitive, *names: str) -> bool:
    pairs = ((getattr(one, name), getattr(other, name)) for name in names)
    return all(first is second or np.array_equal(first, second) for first, second in pairs)


def _moved(before: Primitive, now: Mesh | Texture) -> bool:
    old, new = getattr(before, "pose", None), now.pose
    return old is not new and (old is None or new is None or not np.array_equal(old, new))


class SolidPage:
    """The state of a scene that its pages have received."""

    def __init__(self) -> None:
        self.turns = 0
        """Number of the last view change that a page reported."""
        self._feed = Feed()
        self._last: dict[str, Any] = {}

    def news(
        self,
        scene: Scene,
        layers: Sequence[Layer],
        tool: Tool,
        drawn: Sequence[Primitive],
        size: tuple[float, float],
        *,
        whole: bool,
    ) -> Message | None:
        """Return the changes; `drawn` is what the tool draws, `size` that of the picture [px]."""
        numbers = {id(display): i for i, display in enumerate(scene)}
        shown = [(f"rviz/{numbers[id(layer.display)]}", layer.primitives) for layer in layers]
        commands = self._feed.news([*shown, ("rviz/tool", drawn)], whole=whole)
        state = self._state(scene, layers, tool, size)
        changed = {key: value for key, value in state.items() if whole or self._last.get(key, self) != value}
        self._last = state
        if not commands and not changed and not whole:
            return None
        return {"type": "solid", "whole": whole, **changed}, commands

    def _state(self, scene: Scene, layers: Sequence[Layer], tool: Tool, size: tuple[float, float]) -> dict[str, Any]:
        view = scene.view
        camera: list[float] = []
        distance = 1.0
        if view is not None:
            viewpoint = view.viewpoint(scene.context)
            distance = viewpoint.distance
            camera = [
                round(float(each), 5)
                for each in (*viewpoint.target, viewpoint.yaw, viewpoint.pitch, distance, viewpoint.field_of_view)
            ]
        words = [each for layer in layers for each in texts(layer.primitives)]
        step = Camera((0.0, 0.0, 0.0), 2.0 ** round(math.log2(max(distance, 0.05))))
        numbers = [i for i, each in enumerate(scene) if isinstance(each, InteractiveMarkers)]
        is_interact = isinstance(tool, Interact)
        colour = scene.options["Background Color"]
        return {
            "camera": [self.turns, *camera],
            "labels": text_labels([Label(each, 0.0, 0.0, 0.0) for each in words], step),
            "grips": [f"/meshcat/rviz/{i}" for i in numbers] if is_interact else [],
            "turns": isinstance(tool, MoveCamera),
            "background": hex_colour(colour),
            "size": list(size),
        }
