"""The polygon of an area to explore: selection by clicks, and validation."""

from __future__ import annotations

import math
from enum import Enum

import numpy as np

from rosmini.core.geometry.polygons import Floats, crossing_sides, inside, sides_of

Point = tuple[float, float]

NEAR = 0.1
"""A click this close to the first vertex closes the polygon, as a fraction of the mean edge length."""


class Step(Enum):
    """The effect of a click."""

    ADDED = "added"
    CLOSED = "closed"
    COMPLETE = "complete"
    REFUSED = "refused"


def contains(vertices: Floats, point: Point) -> bool:
    """Return whether a point is inside the polygon (n, 2)."""
    return bool(inside(np.array([point]), sides_of(vertices))[0])


def polygon_error(vertices: Floats) -> str | None:
    """Return the reason why these vertices (n, 2) do not enclose a valid area, or None if they do."""
    if len(vertices) < 3:
        return f"a polygon of {len(vertices)} vertices has no area: at least 3 are needed"
    if not np.isfinite(vertices).all():
        return "a vertex of the polygon is not finite"
    crossing = crossing_sides(vertices)
    if crossing is not None:
        a, b = crossing
        return (
            f"the edges after vertices {a + 1} and {b + 1} of the polygon meet: name its vertices in order, around the "
            "area"
        )
    return None


class Selection:
    """A polygon selected by clicks: vertices, one near the first to close it, and finally a point inside.

    Use `step, text = selection.click("map", x, y)`; an invalid click restarts the selection.
    """

    def __init__(self) -> None:
        self.frame = "map"
        self.vertices: list[Point] = []
        self.is_closed = False
        """True if the next click is the start point."""

    @property
    def polygon(self) -> Floats:
        """The vertices (n, 2) [m] in `frame`."""
        return np.array(self.vertices, dtype=np.float64).reshape(-1, 2)

    def clear(self) -> None:
        """Restart the selection."""
        self.vertices, self.is_closed = [], False

    def click(self, frame: str, x: float, y: float) -> tuple[Step, str]:
        """Add a point [m] in `frame`; return its effect and a message for the user. After `COMPLETE`, call `clear`."""
        if not self.vertices:
            self.frame = frame
        elif frame != self.frame:
            text = f"Frame mismatch, restarting polygon selection: '{frame}' after '{self.frame}'"
            return self._restart(text)
        if self.is_closed:
            if contains(self.polygon, (x, y)):
                return Step.COMPLETE, "Sending goal"
            return self._restart("Center not inside polygon, restarting")
        if self._closes(x, y):
            return self._close()
        self.vertices.append((x, y))
        return Step.ADDED, ""

    def _closes(self, x: float, y: float) -> bool:
        if len(self.vertices) < 2:
            return False
        ends = [*self.vertices[1:], self.vertices[0]]
        mean = sum(map(math.dist, self.vertices, ends)) / len(self.vertices)
        return math.dist(self.vertices[0], (x, y)) < NEAR * mean

    def _close(self) -> tuple[Step, str]:
        wrong = polygon_error(self.polygon)
        if wrong is not None:
            return self._restart(f"Not a valid polygon, restarting: {wrong}")
        self.is_closed = True
        return Step.CLOSED, "Please select an initial point for exploration inside the polygon"

    def _restart(self, text: str) -> tuple[Step, str]:
        self.clear()
        return Step.REFUSED, text
