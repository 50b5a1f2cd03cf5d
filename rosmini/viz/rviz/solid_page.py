"""RViz's window in three dimensions: the data that its page receives besides the sheet, see `rosmini-rviz.js`.

The page turns the scene without asking the kernel. It reports the new view in words, `orbit N YAW PITCH DISTANCE
DX DY DZ`, in radians and metres of the fixed frame; DX DY DZ is the target's displacement since the last report.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.viz.meshcat.scene3d import Camera
from rosmini.viz.rviz.displays.interactive_markers import InteractiveMarkers
from rosmini.viz.rviz.feed import Feed, texts
from rosmini.viz.rviz.labels import Label
from rosmini.viz.rviz.solid import text_labels
from rosmini.viz.rviz.tools import Interact, MoveCamera, Tool
from rosmini.viz.rviz.views import Orbit
from rosmini.viz.style import hex_colour

if TYPE_CHECKING:
    from rosmini.viz.rviz import Layer, Scene
    from rosmini.viz.rviz.primitives import Primitive

SCRIPTS = ("rosmini-meshcat.js", "rosmini-rviz.js")
NUMBERS = 6
"""Number of arguments of the word `orbit`."""
HOST = '<div class="rq-solid" data-solid="view"></div>'
"""The element in which the page puts the viewer."""

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
