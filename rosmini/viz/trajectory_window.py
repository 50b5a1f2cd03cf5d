"""The trajectories that a local planner tried in a cycle, in colours of their cost.

Blue is cheap and faint is dear; what a critic rejected is thin and vermilion. In the page one
is chosen by a slider, which shows what each critic gave; with a second one the footprint goes along it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.geometry.poses import transform_points
from rosmini.navigation.base_local_planner.trajectory import Samples
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.viz.costmap_pictures import published
from rosmini.viz.map_colours import colours_of, painted
from rosmini.viz.map_pictures import gif_address
from rosmini.viz.moving_view import MovingView
from rosmini.viz.rounding import fixed, kept, snap
from rosmini.viz.rviz.gifs import gif
from rosmini.viz.style import LABEL_SIZE, variable
from rosmini.viz.svg import document, element, escape
from rosmini.viz.view import ViewError

Floats = NDArray[np.float64]

SIDE = 440.0
"""The longer side of the picture [CSS px]."""
LINE = 24.0
CONTROLS = 300
"""The height of the sliders and the table, about [px]."""
MARGIN = 0.15
"""What is shown around the trajectories [m], without a costmap."""
TOLERANCE = 0.004
"""How far a drawn line may be from its points [m]."""
LARGEST = 200
"""A costmap has so many cells a side, at most: they are in the page."""
SHADES = 5


def trajectory_window(
    samples: Samples,
    *,
    costmap: Costmap2D | None = None,
    plan: ArrayLike | None = None,
    footprint: ArrayLike | None = None,
    chosen: int | None = None,
    title: str | None = None,
) -> TrajectoryWindow:
    """Show the trajectories of a cycle.

    Args:
        samples: `planner.samples`.
        costmap: the costs on which they were scored: `planner.costmap.grid`.
        plan: the plan (n, 2) or (n, 3) [m].
        footprint: its outline (n, 2) [m] in the base frame.
        chosen: the number of the one that is shown at first, by default the best.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: there are no trajectories, or no such number, or the costmap is too large.

    """
    if not isinstance(samples, Samples) or not len(samples):
        raise ViewError(
            "there are no trajectories to show: `samples` of a local planner has them after its first command"
        )
    if chosen is not None and not 0 <= chosen < len(samples):
        raise ViewError(f"there is no trajectory {chosen}: they have the numbers 0 to {len(samples) - 1}")
    if costmap is not None and max(costmap.width, costmap.height) > LARGEST:
        raise ViewError(
            f"the costmap has {costmap.width} x {costmap.height} cells: under trajectories, {LARGEST} a side are shown "
            "at most; that of a local planner is a small window"
        )
    path = None if plan is None else np.asarray(plan, dtype=np.float64)[:, :2]
    outline = None if footprint is None else np.asarray(footprint, dtype=np.float64)
    return TrajectoryWindow(samples, costmap, path, outline, chosen, title)


class TrajectoryWindow(MovingView):
    """What `trajectory_window` gives."""

    scripts = ("rosmini-canvas.js", "rosmini-trajectories.js")
    call = "rosminiTrajectories.mount"
    usual_name = "trajectories"

    def __init__(
        self,
        samples: Samples,
        costmap: Costmap2D | None,
        plan: Floats | None,
        footprint: Floats | None,
        chosen: int | None,
        title: str | None,
    ) -> None:
        self._samples, self._costmap, self._plan = samples, costmap, plan
        self._footprint, self.title = footprint, title
        totals = np.array([float(fixed(value, 6)) for value in samples.totals])
        # The cheapest first, then what was rejected, critic by critic.
        rank = np.where(samples.accepted, -1, samples.rejected_by)
        self._order = np.lexsort((np.arange(len(totals)), np.where(samples.accepted, totals, 0.0), rank))
        best = samples.best if samples.best is not None else int(self._order[0])
        self._chosen = best if chosen is None else chosen
        self._costs: NDArray[np.uint8] = np.empty((0, 0), dtype=np.uint8)
        self._area = self._seen()

    def _seen(self) -> tuple[float, float, float, float]:
        """What is shown: x and y of two corners [m], where there is a costmap those of cells."""
        points = np.vstack([self._samples.trajectory(n)[:, :2] for n in range(len(self._samples))])
        reach = MARGIN if self._footprint is None else MARGIN + float(np.hypot(*self._footprint.T).max())
        low, high = snap(points.min(axis=0) - reach), snap(points.max(axis=0) + reach)
        if self._costmap is None:
            return float(low[0]), float(low[1]), float(high[0]), float(high[1])
        grid = self._costmap
        x0, y0 = grid.world_to_map_clamped(*low)
        x1, y1 = grid.world_to_map_clamped(*high)
        self._costs = published(grid.costs[y0 : y1 + 1, x0 : x1 + 1])[::-1]
        size, (left, bottom) = grid.resolution, grid.origin
        return left + x0 * size, bottom + y0 * size, left + (x1 + 1) * size, bottom + (y1 + 1) * size

    # -- words ---------------------------------------------------------------------------------------------------

    @property
    def text(self) -> str:
        """How many there are, the best with what each critic added, and how many each critic rejected."""
        s = self._samples
        lines = [f"{self.name}: {len(s)} of {len(s) + s.refused} velocities driven"]
        lines.append(self._said(self._chosen))
        counts = {name: count for name, count in s.counts().items() if name != "generator"}
        lines.append(
            "rejected: " + (", ".join(f"{name} {count}" for name, count in counts.items()) or "none")
        )
        return "\n".join(lines)

    def _said(self, number: int) -> str:
        s = self._samples
        x, y, theta = (fixed(value, 3) for value in s.commands[number])
        aside = f", {y} m/s to the left" if float(y) else ""
        word = "best" if number == s.best else f"number {number}"
        told = f"{word}: {x} m/s ahead{aside}, {theta} rad/s"
        if s.rejected_by[number] >= 0:
            return f"{told}, rejected by {s.reason(number)}"
        row = s.explain(number)
        total = row.pop("total") or 0.0
        parts = ", ".join(f"{name} {fixed(value or 0.0, 2)}" for name, value in row.items())
        return f"{told}, cost {fixed(total, 2)}: {parts}"

    @property
    def alt(self) -> str:
        """The same in a sentence or two."""
        head, chosen, rejected = self.text.split("\n")
        return f"A fan of trajectories, {head}; {chosen}; {rejected}."

    # -- the still picture ---------------------------------------------------------------------------------------

    @property
    def _scale(self) -> float:
        x0, y0, x1, y1 = self._area
        return SIDE / max(x1 - x0, y1 - y0)

    def _line(self, points: Floats) -> str:
        x0, _, _, y1 = self._area
        placed = snap(points)
        placed = placed[kept(placed, TOLERANCE)] if len(placed) > 2 else placed
        scale = self._scale
        return " ".join(f"{(x - x0) * scale:.1f},{LINE + (y1 - y) * scale:.1f}" for x, y in placed)

    def _shades(self) -> NDArray[np.int64]:
        """How cheap each one is, 0 the cheapest of `SHADES`; -1 if it was rejected."""
        s, found = self._samples, np.full(len(self._samples), -1)
        accepted = self._order[: int(s.accepted.sum())]
        found[accepted] = np.arange(len(accepted)) * SHADES // max(len(accepted), 1)
        return found

    @property
    def svg(self) -> str:
        """The still picture: costs, trajectories, the plan, the chosen one, and the footprint at its end."""
        x0, y0, x1, y1 = self._area
        width, height = (x1 - x0) * self._scale, (y1 - y0) * self._scale
        parts = [self._words()]
        if self._costmap is not None:
            data, _ = gif(painted(self._costs, "costmap"))
            parts.append(
                element("image", href=gif_address(data), x=0.0, y=LINE, width=width, height=height,
                        preserveAspectRatio="none", style="image-rendering:pixelated", opacity="0.6")
            )  # fmt: skip
        shades = self._shades()
        for number in self._order[::-1]:
            kind = f"t{shades[number]}" if shades[number] >= 0 else "tx"
            parts.append(self._polyline(self._samples.trajectory(int(number))[:, :2], kind))
        if self._plan is not None:
            inside = np.all((self._plan >= (x0, y0)) & (self._plan <= (x1, y1)), axis=1)
            if inside.any():
                parts.append(self._polyline(self._plan[inside], "tp"))
        track = self._samples.trajectory(self._chosen)
        parts.append(self._polyline(track[:, :2], "tb"))
        for pose, kind in ((track[0], "tf"), (track[-1], "tf te")):
            parts.append(self._outline(pose, kind))
        shadows = "".join(
            f".rosmini-svg .t{n}{{stroke:{variable('blue')};stroke-opacity:{0.9 - 0.17 * n:.2f}}}"
            for n in range(SHADES)
        )
        return document(
            "".join(parts), width=width, height=LINE + height, title=self.name, alt=self.alt,
            css=_CSS + shadows, colours=["ink", "muted", "blue", "vermilion", "green", "orange"],
        )  # fmt: skip

    def _words(self) -> str:
        x, words = 0.0, []
        for text, kind in (("cheap", "t0"), ("dear", f"t{SHADES - 1}"), ("rejected", "tx"), ("chosen", "tb")):
            mark = element("polyline", points=f"{x:.1f},12 {x + 20:.1f},12", class_=kind)
            words.append(mark + element("text", escape(text), x=x + 26, y=16.0, font_size=LABEL_SIZE))
            x += 26 + 8.0 * len(text) + 12
        return "".join(words)

    def _polyline(self, points: Floats, kind: str) -> str:
        if len(points) == 1 or np.ptp(points, axis=0).max() < TOLERANCE:
            return ""
        return element("polyline", points=self._line(points), class_=kind)

    def _outline(self, pose: Floats, kind: str) -> str:
        if self._footprint is None or len(self._footprint) < 3:
            return ""
        placed = transform_points((float(pose[0]), float(pose[1]), float(pose[2])), self._footprint)
        x0, _, _, y1 = self._area
        points = " ".join(
            f"{(x - x0) * self._scale:.1f},{LINE + (y1 - y) * self._scale:.1f}" for x, y in snap(placed)
        )
        return element("polygon", points=points, class_=kind)

    # -- the page ------------------------------------------------------------------------------------------------

    @property
    def height(self) -> int:
        """With the controls, about [CSS px]."""
        return round((self._area[3] - self._area[1]) * self._scale) + CONTROLS

    @property
    def data(self) -> dict[str, Any]:
        """What the page's script gets: points in millimetres and milliradians from the lower left corner, and words."""
        s, order = self._samples, self._order
        shades = self._shades()
        found: dict[str, Any] = {
            "area": [round(value, 3) for value in self._area],
            "points": _bytes([s.trajectory(int(n)) for n in order], self._area),
            "lengths": [int(s.lengths[n]) for n in order],
            "shades": [int(shades[n]) for n in order],
            "commands": [[float(fixed(value, 3)) for value in s.commands[n]] for n in order],
            "gave": [[float(fixed(value, 2)) for value in s.raw[n]] for n in order],
            "weights": [float(fixed(value, 4)) for value in s.scales],
            "reasons": [s.reason(int(n)) for n in order],
            "critics": list(s.critics),
            "chosen": int(np.flatnonzero(order == self._chosen)[0]),
            "outline": [] if self._footprint is None else snap(self._footprint).round(3).tolist(),
            "plan": [] if self._plan is None else snap(self._plan).round(3).tolist(),
        }
        if self._costmap is not None:
            found["size"] = list(self._costs.shape[::-1])
            found["costs"] = self._costs.tobytes()
            found["colours"] = colours_of("costmap").tobytes()
        return found


def _bytes(tracks: Sequence[Floats], area: Sequence[float]) -> bytes:
    """Tracks (s, 3) one after another, as int16: millimetres from the corner, and milliradians."""
    points = np.vstack(tracks)
    points = np.column_stack([points[:, :2] - area[:2], np.mod(points[:, 2] + np.pi, 2 * np.pi) - np.pi])
    return (snap(points) * 1000).round().astype("<i2").tobytes()


_CSS = f""".rosmini-svg polyline{{fill:none;stroke-width:1.2;stroke-linejoin:round}}
.rosmini-svg polyline.tx{{stroke:{variable("vermilion")};stroke-width:.7;stroke-opacity:.55}}
.rosmini-svg polyline.tp{{stroke:{variable("green")};stroke-width:2;stroke-dasharray:5 3}}
.rosmini-svg polyline.tb{{stroke:{variable("orange")};stroke-width:3}}
.rosmini-svg polygon.tf{{fill:none;stroke:{variable("ink")};stroke-width:1.4}}
.rosmini-svg polygon.te{{stroke:{variable("orange")}}}
.rosmini-svg text{{fill:{variable("muted")}}}
"""
