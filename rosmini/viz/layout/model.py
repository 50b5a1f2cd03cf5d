"""Input and output of a layered layout: sizes in, positions and curves out.

All lengths are in CSS pixels, x to the right and y downwards, as in SVG.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Point = tuple[float, float]
Shape = Literal["box", "ellipse"]
Direction = Literal["right", "down"]


@dataclass(frozen=True)
class Vertex:
    """A vertex to be placed: its unique name, its size, and its groups, outermost first."""

    name: str
    width: float
    height: float
    shape: Shape = "box"
    groups: tuple[str, ...] = ()


@dataclass(frozen=True)
class Edge:
    """An arrow between two vertices; `name` distinguishes parallel edges. A label of size 0 means no label."""

    name: str
    source: str
    target: str
    label_width: float = 0.0
    label_height: float = 0.0

    @property
    def labelled(self) -> bool:
        """True if the edge needs room for a label."""
        return self.label_width > 0 and self.label_height > 0


@dataclass(frozen=True)
class Rect:
    """An axis-parallel rectangle, given by its upper left corner and its size."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """The x of the right side."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """The y of the lower side."""
        return self.y + self.height

    @property
    def centre(self) -> Point:
        """The middle, as (x, y)."""
        return (self.x + self.width / 2, self.y + self.height / 2)

    def overlaps(self, other: Rect, tolerance: float = 0.0) -> bool:
        """True if the two share more than a strip of `tolerance`."""
        return (
            self.x < other.right - tolerance
            and other.x < self.right - tolerance
            and self.y < other.bottom - tolerance
            and other.y < self.bottom - tolerance
        )

    def moved(self, dx: float, dy: float) -> Rect:
        """Return the rectangle moved by (dx, dy)."""
        return Rect(self.x + dx, self.y + dy, self.width, self.height)


@dataclass(frozen=True)
class Route:
    """A curve from the border of the source to the border of the target.

    `points` is a chain of cubic Bezier curves: a start, then two control points and an end for each segment.
    `label` is the rectangle reserved for the label. `reversed` edges run against the layers.
    """

    points: tuple[Point, ...]
    label: Rect | None = None
    reversed: bool = False

    def moved(self, dx: float, dy: float) -> Route:
        """Return the curve moved by (dx, dy)."""
        label = self.label.moved(dx, dy) if self.label else None
        return Route(tuple((x + dx, y + dy) for x, y in self.points), label, self.reversed)


@dataclass(frozen=True)
class Layout:
    """The positions of everything. `layers` gives the layer of each vertex, counted from 0 within its component."""

    width: float = 0.0
    height: float = 0.0
    vertices: dict[str, Rect] = field(default_factory=dict)
    edges: dict[str, Route] = field(default_factory=dict)
    groups: dict[tuple[str, ...], Rect] = field(default_factory=dict)
    layers: dict[str, int] = field(default_factory=dict)
