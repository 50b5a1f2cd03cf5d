"""What a player shows beside the robots: things that are there from one moment to the next, and strokes that grow.

Times are seconds by the clock of the run, lengths metres in the run's frame. A layer knows how to become less
(`thinner`), which a player of bounded size asks of the heaviest one.
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
from rosmini.viz.rounding import fixed, kept
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

Floats = NDArray[np.float64]
Bounds = tuple[float, float, float, float]
Mode = Literal["points", "line", "closed", "arrows"]

COARSE = 0.01
"""[m] to which what messages show is rounded"""
COARSE_ANGLE = 0.02
"""[rad]"""
RANGE = 0.02
"""[m] to which scans are rounded"""
MOST_POINTS = 400
"""Points of one moment of a layer, at most; of more, every second, third, ... is kept."""


@dataclass(frozen=True, eq=False)
class Layer(ABC):
    """Something over time, under a name (mostly a topic). Raises `ViewError` where its parts do not fit together."""

    kind: ClassVar[str]
    depth: ClassVar[int]
    """Layers of a larger depth are drawn over others."""
    worth: ClassVar[float] = 1.0
    """How much heavier than others it may be before it is thinned."""

    name: str

    @property
    @abstractmethod
    def count(self) -> int:
        """How many moments it has."""

    @abstractmethod
    def thinner(self) -> Self | None:
        """The same with about half of its data; None if less would be nothing."""

    @abstractmethod
    def data(self) -> dict[str, Any]:
        """What the script `rosmini-replay-layers.js` draws, with `kind` and `name`."""

    @abstractmethod
    def text(self) -> str:
        """What there is, in a few words, without the name."""

    @property
    def bounds(self) -> Bounds | None:
        """The smallest and largest x and y that it ever covers; None if it never covers anything."""
        return None


@dataclass(frozen=True, eq=False)
class Frames(Layer):
    """A layer that shows one thing at a time: what came last.

    `found` is how many messages there were, of which some are left out.
    """

    times: Floats
    found: int = field(default=0, kw_only=True)

    def __post_init__(self) -> None:
        if (np.diff(self.times) < 0).any() or not np.isfinite(self.times).all():
            raise ViewError(f"the times of the layer {self.name!r} must be finite and in order")

    @property
    def count(self) -> int:
        """How many moments it has."""
        return len(self.times)

    def thinner(self) -> Self | None:
        """Every second moment, and the last."""
        if self.count < 2:
            return None
        return (
            self.at(np.unique(np.append(np.arange(0, self.count, 2), self.count - 1)))
            if self.count > 2
            else (self.at(np.array([1])))
        )

    @abstractmethod
    def at(self, which: NDArray[np.intp]) -> Self:
        """The same with these moments alone."""

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
    """Plans, particles, markers, polygons: at each moment some shapes, which replace those before."""

    kind: ClassVar[str] = "shapes"
    depth: ClassVar[int] = 3

    items: tuple[tuple[Shape, ...], ...]

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.items) != len(self.times):
            raise ViewError(
                f"the layer {self.name!r} has {len(self.times)} times but {len(self.items)} pictures"
            )

    def at(self, which: NDArray[np.intp]) -> Self:
        """The same with these moments alone."""
        return replace(self, times=self.times[which], items=tuple(self.items[i] for i in which))

    def data(self) -> dict[str, Any]:
        """Groups of points: how many at each moment; of each mode, colour and length; then all x, y and headings."""
        shapes = [_lean(shape) for item in self.items for shape in item]
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
        """How many messages, and what the last one has."""
        last = sum(len(shape.points) for shape in self.items[-1]) if self.items else 0
        return f"{self._counted()}, the last with {plural(last, 'point')}"

    @property
    def bounds(self) -> Bounds | None:
        """Around all points."""
        return around([shape.points[:, :2] for item in self.items for shape in item])


def _lean(shape: Shape) -> Shape:
    """Not more points than one can tell apart."""
    points = shape.points
    if shape.mode in ("line", "closed") and len(points) > 2:
        points = points[kept(points[:, :2], COARSE / 2)]
    elif len(points) > MOST_POINTS:
        points = points[:: -(-len(points) // MOST_POINTS)]
    return replace(shape, points=points)


@dataclass(frozen=True, eq=False)
class Scans(Frames):
    """What a laser measured, and from where: poses (k, 3) and ranges (k, beams), inf where nothing was hit."""

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
            raise ViewError(
                f"the scans {self.name!r} need as many poses (k, 3) and ranges (k, beams) as times"
            )

    def at(self, which: NDArray[np.intp]) -> Self:
        """The same with these moments alone."""
        return replace(self, times=self.times[which], poses=self.poses[which], ranges=self.ranges[which])

    def data(self) -> dict[str, Any]:
        """Ranges in units of `RANGE`, 0 where nothing was hit."""
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
        """How many, and of how many beams."""
        return f"{self._counted()}, {plural(self.ranges.shape[1], 'beam')}"

    @property
    def bounds(self) -> Bounds | None:
        """Around what was hit."""
        seen = np.isfinite(self.ranges) & (self.ranges > 0)
        angles = self.poses[:, 2:] + self.start + self.step * np.arange(self.ranges.shape[1])
        ranges = np.where(seen, self.ranges, 0.0)
        xs = self.poses[:, :1] + ranges * np.cos(angles)
        return around([np.column_stack([xs[seen], (self.poses[:, 1:2] + ranges * np.sin(angles))[seen]])])


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line that is drawn from its first time to its last, and wiped at `until`; `width` is in CSS pixels."""

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
        if (
            not (np.isfinite(self.points).all() and np.isfinite(self.times).all())
            or (np.diff(self.times) < 0).any()
        ):
            raise ViewError("the times of a stroke must be in order, and its points be finite")


@dataclass(frozen=True, eq=False)
class Strokes(Layer):
    """Coloured lines that grow, as a turtle's pen leaves them."""

    kind: ClassVar[str] = "strokes"
    depth: ClassVar[int] = 4

    strokes: tuple[Stroke, ...]
    tolerance: float = 0.002
    """By how much a line may be drawn too straight [m]."""

    @property
    def count(self) -> int:
        """How many strokes there are."""
        return len(self.strokes)

    def thinner(self) -> Self | None:
        """With twice the tolerance."""
        return None if self.tolerance > 0.5 else replace(self, tolerance=2 * self.tolerance)

    def data(self) -> dict[str, Any]:
        """Of each stroke colour, width, end and length; then all times, x and y."""
        lean = [self._lean(stroke) for stroke in self.strokes]
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

    def _lean(self, stroke: Stroke) -> Stroke:
        """The points that matter, in place and in time: at even speed along a straight line the ends are enough."""
        if len(stroke.times) < 3:
            return stroke
        spatial = set(kept(stroke.points, self.tolerance))
        length = np.concatenate([[0.0], np.cumsum(norms(np.diff(stroke.points, axis=0)))])
        pace = set(kept(np.column_stack([stroke.times, length]), 10 * self.tolerance))
        which = sorted(spatial | pace)
        return replace(stroke, times=stroke.times[which], points=stroke.points[which])

    def text(self) -> str:
        """How many strokes, how long together."""
        length = sum(float(norms(np.diff(s.points, axis=0)).sum()) for s in self.strokes)
        return f"{plural(self.count, 'stroke')}, {fixed(length, 2)} m"

    @property
    def bounds(self) -> Bounds | None:
        """Around all of them."""
        return around([stroke.points for stroke in self.strokes])


def around(parts: list[Floats]) -> Bounds | None:
    """The smallest and largest x and y of points (n, 2)."""
    points = np.vstack([np.empty((0, 2)), *parts])
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return None
    (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return (x0, y0, x1, y1)
