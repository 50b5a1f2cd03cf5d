"""The layers that a player shows beside the robots: things that change from moment to moment, and strokes that grow.

Times are seconds by the clock of the run, lengths metres in the run's frame. A layer can reduce itself (`thinner`);
a player of bounded size asks the largest one to do so.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import norms
from rosmini.viz.replay.packing import ANGLE, LENGTH, TIME, pack, pack_columns, whole
from rosmini.viz.rounding import fixed, points_to_keep
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

Floats = NDArray[np.float64]
Bounds = tuple[float, float, float, float]
Mode = Literal["points", "line", "closed", "arrows"]

COARSE = 0.01
"""Resolution to which the content of messages is rounded [m]."""
COARSE_ANGLE = 0.02
"""Resolution to which their headings are rounded [rad]."""
RANGE = 0.02
"""Resolution to which scans are rounded [m]."""
MAX_POINTS = 400
"""Maximum number of points of one moment of a layer; of more, every second, third, ... is used."""


@dataclass(frozen=True, eq=False)
class Layer(ABC):
    """Something over time, with a name (mostly a topic). Raises `ViewError` if its parts do not match."""

    kind: ClassVar[str]
    depth: ClassVar[int]
    """Layers of a larger depth are drawn over others."""
    worth: ClassVar[float] = 1.0
    """Factor by which it may be larger than other layers before it is thinned."""

    name: str

    @property
    @abstractmethod
    def count(self) -> int:
        """Number of moments."""

    @abstractmethod
    def thinner(self) -> Self | None:
        """Return the layer with about half of its data; None if it cannot be reduced further."""

    @abstractmethod
    def data(self) -> dict[str, Any]:
        """Return the data for the script `rosmini-replay-layers.js`, with `kind` and `name`."""

    @abstractmethod
    def text(self) -> str:
        """Describe the content in a few words, without the name."""

    @property
    def bounds(self) -> Bounds | None:
        """The smallest and largest x and y that it ever covers; None if it covers nothing."""
        return None


@dataclass(frozen=True, eq=False)
class Frames(Layer):
    """A layer that shows one thing at a time: the latest.

    `found` is the number of messages, including those that are left out.
    """

    times: Floats
    found: int = field(default=0, kw_only=True)

    def __post_init__(self) -> None:
        if (np.diff(self.times) < 0).any() or not np.isfinite(self.times).all():
            raise ViewError(f"the times of the layer {self.name!r} must be finite and in order")

    @property
    def count(self) -> int:
        """Number of moments."""
        return len(self.times)

    def thinner(self) -> Self | None:
        """Return every second moment, and the last."""
        if self.count < 2:
            return None
        return (
            self.at(np.unique(np.append(np.arange(0, self.count, 2), self.count - 1)))
            if self.count > 2
            else (self.at(np.array([1])))
        )

    @abstractmethod
    def at(self, which: NDArray[np.intp]) -> Self:
        """Return the layer with only these moments."""

    def _head(self) -> dict[str, Any]:
        return {"kind": self.kind, "name": self.name, "times": pack(whole(self.times, TIME))}

    def _counted(self) -> str:
        found = max(self.found, self.count)
        return plural(found, "message") if found == self.count else f"{self.count} of {found} messages"


@dataclass(frozen=True, eq=False)
class Shape:
    """Points (n, 2), or arrows (n, 3) with headings, of one colour: a name of the palette, or `#rrggbb`."""

    mode: Mode
    points: Floats
    colour: str = "green"


@dataclass(frozen=True, eq=False)
class Shapes(Frames):
    """Plans, particles, markers, polygons: the shapes of each moment replace the previous ones."""

    kind: ClassVar[str] = "shapes"
    depth: ClassVar[int] = 3

    items: tuple[tuple[Shape, ...], ...]

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.items) != len(self.times):
            raise ViewError(f"the layer {self.name!r} has {len(self.times)} times but {len(self.items)} pictures")

    def at(self, which: NDArray[np.intp]) -> Self:
        """Return the layer with only these moments."""
        return replace(self, times=self.times[which], items=tuple(self.items[i] for i in which))

    def data(self) -> dict[str, Any]:
        """Return the number of shapes of each moment; of each, mode, colour and length; then all x, y and headings."""
        shapes = [_simplified(shape) for item in self.items for shape in item]
        colours = sorted({shape.colour for shape in shapes})
        modes = ("points", "line", "closed", "arrows")
        groups = [[modes.index(s.mode), colours.index(s.colour), len(s.points)] for s in shapes]
        points = np.vstack([np.empty((0, 2)), *(shape.points[:, :2] for shape in shapes)])
        headings = np.concatenate([np.empty(0), *(s.points[:, 2] for s in shapes if s.mode == "arrows")])
        return {
            **self._head(),
            "colours": colours,
            "counts": pack(np.array([len(item) for item in self.items], dtype=np.int64)),
            "groups": pack(np.array(groups, dtype=np.int64).ravel()),
            "points": pack_columns(points, COARSE, COARSE),
            "headings": pack(whole(headings, COARSE_ANGLE)),
        }

    def text(self) -> str:
        """Report the number of messages, and the size of the last one."""
        last = sum(len(shape.points) for shape in self.items[-1]) if self.items else 0
        return f"{self._counted()}, the last with {plural(last, 'point')}"

    @property
    def bounds(self) -> Bounds | None:
        """Bounds of all points."""
        return around([shape.points[:, :2] for item in self.items for shape in item])


def _simplified(shape: Shape) -> Shape:
    """Return a shape without points that would not be visible."""
    points = shape.points
    if shape.mode in ("line", "closed") and len(points) > 2:
        points = points[points_to_keep(points[:, :2], COARSE / 2)]
    elif len(points) > MAX_POINTS:
        points = points[:: -(-len(points) // MAX_POINTS)]
    return replace(shape, points=points)


@dataclass(frozen=True, eq=False)
class Scans(Frames):
    """The scans of a laser with its poses: poses (k, 3) and ranges (k, beams), inf where nothing was hit."""

    kind: ClassVar[str] = "scans"
    depth: ClassVar[int] = 2

    poses: Floats
    ranges: Floats
    start: float
    """Angle of the first beam [rad], in the laser's frame."""
    step: float
    """Angle from one beam to the next [rad]."""
    reach: float
    """The largest range [m]."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.poses.shape != (self.count, 3) or self.ranges.ndim != 2 or len(self.ranges) != self.count:
            raise ViewError(f"the scans {self.name!r} need as many poses (k, 3) and ranges (k, beams) as times")

    def at(self, which: NDArray[np.intp]) -> Self:
        """Return the layer with only these moments."""
        return replace(self, times=self.times[which], poses=self.poses[which], ranges=self.ranges[which])

    def data(self) -> dict[str, Any]:
        """Return ranges in units of `RANGE`, 0 where nothing was hit."""
        seen = np.isfinite(self.ranges) & (self.ranges > 0)
        return {
            **self._head(),
            "poses": pack_columns(self.poses, LENGTH, LENGTH, ANGLE),
            "beams": self.ranges.shape[1],
            "unit": RANGE,
            "start": round(self.start, 6),
            "step": round(self.step, 8),
            "max": round(self.reach, 3),
            "ranges": pack(whole(np.where(seen, self.ranges, 0.0), RANGE).ravel()),
        }

    def text(self) -> str:
        """Report the number of scans and of beams."""
        return f"{self._counted()}, {plural(self.ranges.shape[1], 'beam')}"

    @property
    def bounds(self) -> Bounds | None:
        """Bounds of all hits."""
        seen = np.isfinite(self.ranges) & (self.ranges > 0)
        angles = self.poses[:, 2:] + self.start + self.step * np.arange(self.ranges.shape[1])
        ranges = np.where(seen, self.ranges, 0.0)
        xs = self.poses[:, :1] + ranges * np.cos(angles)
        return around([np.column_stack([xs[seen], (self.poses[:, 1:2] + ranges * np.sin(angles))[seen]])])


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line that is drawn from its first time to its last, and erased at `until`; `width` is in CSS pixels."""

    times: Floats
    points: Floats
    colour: str = "blue"
    width: float = 2.0
    until: float = math.inf

    def __post_init__(self) -> None:
        n = len(self.times)
        if not n or self.times.shape != (n,) or self.points.shape != (n, 2):
            raise ViewError(
                f"a stroke has times (n,) and points (n, 2), at least one, not {self.times.shape} and "
                f"{self.points.shape}"
            )
        if not (np.isfinite(self.points).all() and np.isfinite(self.times).all()) or (np.diff(self.times) < 0).any():
            raise ViewError("the times of a stroke must be in order, and its points be finite")


@dataclass(frozen=True, eq=False)
class Strokes(Layer):
    """Coloured lines that grow, like those of a turtle's pen."""

    kind: ClassVar[str] = "strokes"
    depth: ClassVar[int] = 4

    strokes: tuple[Stroke, ...]
    tolerance: float = 0.002
    """Maximum deviation of a drawn line from its points [m]."""

    @property
    def count(self) -> int:
        """Number of strokes."""
        return len(self.strokes)

    def thinner(self) -> Self | None:
        """Return the layer with twice the tolerance."""
        return None if self.tolerance > 0.5 else replace(self, tolerance=2 * self.tolerance)

    def data(self) -> dict[str, Any]:
        """Return colour, width, end and length of each stroke; then all times, x and y."""
        lean = [self._simplified(stroke) for stroke in self.strokes]
        times = np.concatenate([np.empty(0), *(stroke.times for stroke in lean)])
        points = np.vstack([np.empty((0, 2)), *(stroke.points for stroke in lean)])
        return {
            "kind": self.kind,
            "name": self.name,
            "pens": [
                [
                    s.colour,
                    round(s.width, 2),
                    None if math.isinf(s.until) else whole(s.until, TIME).item(),
                    len(s.times),
                ]
                for s in lean
            ],
            "points": pack_columns(np.column_stack([times, points]), TIME, LENGTH, LENGTH),
        }

    def _simplified(self, stroke: Stroke) -> Stroke:
        """Return the points that matter, in space and time: a straight line at constant speed needs only its ends."""
        if len(stroke.times) < 3:
            return stroke
        spatial = set(points_to_keep(stroke.points, self.tolerance))
        length = np.concatenate([[0.0], np.cumsum(norms(np.diff(stroke.points, axis=0)))])
        pace = set(points_to_keep(np.column_stack([stroke.times, length]), 10 * self.tolerance))
        which = sorted(spatial | pace)
        return replace(stroke, times=stroke.times[which], points=stroke.points[which])

    def text(self) -> str:
        """Report the number of strokes and their total length."""
        length = sum(float(norms(np.diff(s.points, axis=0)).sum()) for s in self.strokes)
        return f"{plural(self.count, 'stroke')}, {fixed(length, 2)} m"

    @property
    def bounds(self) -> Bounds | None:
        """Bounds of all strokes."""
        return around([stroke.points for stroke in self.strokes])


def around(parts: list[Floats]) -> Bounds | None:
    """Return the smallest and largest x and y of points (n, 2)."""
    points = np.vstack([np.empty((0, 2)), *parts])
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return None
    (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return (x0, y0, x1, y1)
