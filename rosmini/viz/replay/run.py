"""A run as the player shows it: moving bodies, and layers, in one frame and with one clock."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.replay.layers import Bounds, Layer, around
from rosmini.viz.replay.packing import ANGLE, LENGTH, TIME, pack_columns, whole
from rosmini.viz.rounding import MILLIMETRE, fixed, snap
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural
from rosmini.viz.world_pictures import length_of, pose_text

Floats = NDArray[np.float64]

BUDGET = 205_000
"""Maximum size of the data of a run [bytes]: with the still picture and its page, it stays below 300 kB."""
MAX_POSES = 1200
MIN_EXTENT = 0.5
"""Minimum width and height of the area that a player shows [m]."""


@dataclass(frozen=True, eq=False)
class Body:
    """A robot or a turtle and its trajectory: times (n,) [s] and poses (n, 3), x and y [m] and headings [rad].

    Args:
        name: its name in the legend.
        times: the times of the poses, in order.
        poses: the poses; headings are not wrapped.
        colour: a name of the palette, or `#rrggbb`.
        outline: its vertices (x, y) [m] in its own frame, x ahead; None for an arrowhead.
        shown_from: when it appears [s].
        shown_until: when it disappears [s].
        trail: True to draw the path behind it.

    Raises `ViewError` if the arrays do not match.

    """

    name: str
    times: Floats
    poses: Floats
    colour: str = "blue"
    outline: tuple[tuple[float, float], ...] | None = None
    shown_from: float = -math.inf
    shown_until: float = math.inf
    trail: bool = True

    def __post_init__(self) -> None:
        n = len(self.times)
        if not n or self.times.shape != (n,) or self.poses.shape != (n, 3):
            raise ViewError(
                f"{self.name!r} needs times (n,) and poses (n, 3), at least one, not {self.times.shape} and "
                f"{self.poses.shape}"
            )
        if not (np.isfinite(self.poses).all() and np.isfinite(self.times).all()) or (np.diff(self.times) < 0).any():
            raise ViewError(f"the times of {self.name!r} must be in order, and its poses be finite")

    def data(self) -> dict[str, Any]:
        """Return the data for the script: `track` has times, x, y and headings."""
        every = -(-len(self.times) // MAX_POSES)
        keep = np.unique(np.append(np.arange(0, len(self.times), every), len(self.times) - 1))
        rows = np.column_stack([self.times, self.poses])[keep]
        data: dict[str, Any] = {
            "name": self.name,
            "colour": self.colour,
            "track": pack_columns(rows, TIME, LENGTH, LENGTH, ANGLE),
        }
        if not self.trail:
            data["trail"] = False
        if self.outline is not None:
            data["outline"] = np.round(snap(self.outline, MILLIMETRE), 3).tolist()
        for key, value in (("from", self.shown_from), ("until", self.shown_until)):
            if math.isfinite(value):
                data[key] = whole(value, TIME).item()
        return data

    def text(self) -> str:
        """Report where it began and ended."""
        way = fixed(length_of(self.poses[:, :2]), 2)
        return f"start {pose_text(self.poses[0])}, end {pose_text(self.poses[-1])}, {way} m"


@dataclass(frozen=True, eq=False)
class Run:
    """A run for a player. Raises `ViewError` if there is nothing to see, or if it ends before it starts.

    Args:
        name: the name of the run, for titles.
        start: the time of its start [s], which is 0 in the player.
        end: the time of its end [s].
        bodies: the moving bodies; the view follows the first.
        layers: everything else, drawn in this order.
        frame: the name of the frame of all data, for the reader.
        bounds: the area shown, x0, y0, x1, y1 [m]; None for everything.
        background: a colour `#rrggbb`; None for the page's own, with a grid of metres.
        notes: sentences about what was left out or thinned.
        opens_at_end: True to show the end until the run is played, as for a drawing.

    """

    name: str
    start: float
    end: float
    bodies: tuple[Body, ...] = ()
    layers: tuple[Layer, ...] = ()
    frame: str = ""
    bounds: Bounds | None = None
    background: str | None = None
    notes: tuple[str, ...] = ()
    opens_at_end: bool = False

    def __post_init__(self) -> None:
        if not math.isfinite(self.start) or not math.isfinite(self.end) or self.end < self.start:
            raise ViewError(
                f"the run {self.name!r} has no valid time span: it goes from {self.start} s to {self.end} s"
            )
        if not self.bodies and not self.layers:
            raise ViewError(f"there is nothing to see in the run {self.name!r}: it has no bodies and no layers")

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return self.end - self.start

    def extent(self) -> Bounds:
        """Return the area shown: `bounds`, or everything with a small margin."""
        if self.bounds is not None:
            return self.bounds
        found = [layer.bounds for layer in self.layers]
        found += [around([body.poses[:, :2]]) for body in self.bodies]
        boxes = [np.array(box).reshape(2, 2) for box in found if box is not None]
        whole_box = around(boxes) or (0.0, 0.0, 0.0, 0.0)
        x0, y0, x1, y1 = (float(v) for v in snap(whole_box, 0.01))
        more = [max(0.1, (MIN_EXTENT - (high - low)) / 2) for low, high in ((x0, x1), (y0, y1))]
        return (x0 - more[0], y0 - more[1], x1 + more[0], y1 + more[1])

    def data(self, budget: int = BUDGET) -> dict[str, Any]:
        """Return the data that `rosmini-replay-data.js` decodes; layers are thinned to fit into `budget` bytes."""
        data: dict[str, Any] = {
            "name": self.name,
            "start": whole(self.start, TIME).item(),
            "duration": whole(self.duration, TIME).item(),
            "bounds": [round(side, 3) for side in self.extent()],
            "bodies": [body.data() for body in self.bodies],
        }
        if self.opens_at_end:
            data["opens"] = "end"
        if self.background is not None:
            data["background"] = self.background
        layers, notes = thinned(self.layers, budget - size(data))
        data["layers"] = layers
        if notes or self.notes:
            data["notes"] = [*self.notes, *notes]
        return data

    def text(self, title: str | None = None) -> str:
        """Describe the contents, line by line."""
        named = f", in the frame {self.frame}" if self.frame else ""
        lines = [f"{title or self.name}: {fixed(self.duration, 1)} s{named}"]
        lines += [f"{body.name}: {body.text()}" for body in self.bodies]
        lines += [f"{layer.name}: {layer.text()}" for layer in self.layers]
        return "\n".join([*lines, *self.notes])

    def alt(self) -> str:
        """Describe the contents in sentences."""
        where = f" in the frame {self.frame}" if self.frame else ""
        said = [f"Player of the run {self.name}, {fixed(self.duration, 1)} seconds long, seen from above{where}."]
        said += [f"{body.name}: {body.text()}." for body in self.bodies[:4]]
        names = [layer.name for layer in self.layers]
        if names:
            more = f" and {plural(len(names) - 8, 'other')}" if len(names) > 8 else ""
            said.append(f"Layers that can be switched: {', '.join(names[:8])}{more}.")
        return " ".join(said)


def size(data: Any) -> int:
    """Return the approximate size of data in a page [bytes]."""
    return len(json.dumps(data, separators=(",", ":")))


def thinned(layers: Sequence[Layer], budget: int) -> tuple[list[dict[str, Any]], list[str]]:
    """Return the data of layers, thinned, the largest first, until they fit `budget` [bytes], and notes about it."""
    kept = list(layers)
    data = [layer.data() for layer in kept]
    sizes = [size(each) for each in data]
    less: set[str] = set()
    stuck: set[int] = set()
    while sum(sizes) > budget and len(stuck) < len(kept):
        heaviest = max((i for i in range(len(kept)) if i not in stuck), key=lambda i: sizes[i] / kept[i].worth)
        smaller = kept[heaviest].thinner()
        if smaller is None:
            stuck.add(heaviest)
            continue
        kept[heaviest], less = smaller, less | {smaller.name}
        data[heaviest] = smaller.data()
        sizes[heaviest] = size(data[heaviest])
    notes = [f"{name} is thinned, so that the page stays small: {_last(kept, name).text()}." for name in sorted(less)]
    return data, notes


def _last(layers: Sequence[Layer], name: str) -> Layer:
    return next(layer for layer in layers if layer.name == name)
