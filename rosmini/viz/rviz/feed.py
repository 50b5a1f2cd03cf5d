"""Updates for a page that shows a scene in three dimensions: only new or changed primitives are sent."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rosmini.viz.meshcat.scene3d import Camera

from .labels import MAX_LABELS
from .primitives import Lines, Mesh, Points, Primitive, Text, Texture
from .solid import Drawing, RvizScene

DISTANCE = 8.0
"""Distance of the camera for which lights are set, and for which points with a size in pixels are drawn [m]."""


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
