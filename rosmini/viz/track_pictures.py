"""A path on the ground, from above: positions from odometry, or any other array of positions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.figures import WIDTH, add_axes, blank_figure, house_style, set_ticks, step_of
from rosmini.viz.rounding import fixed, points_to_keep, snap
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.words import plural

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

LEFT, TOP, RIGHT, BOTTOM = 68.0, 14.0, 24.0, 44.0
"""Margins around the path [px]."""
MAX_HEIGHT = 360.0
MIN_EXTENT = 0.2
"""Minimum size of the area that a picture shows [m]."""
COLUMNS = ("pose.pose.position.x", "pose.pose.position.y")
"""Columns of positions in a table of `nav_msgs/Odometry`."""


def track_picture(source: Any, *, title: str | None = None, width: float = WIDTH) -> Picture:
    """Draw a path from above: a line, a ring at its start, a dot at its end; x to the right, y up, in metres.

    Args:
        source: a table of `nav_msgs/Odometry` or positions as an array (n, 2) [m].
        title: a caption under the picture, and the first words of its text form.
        width: the maximum width of the picture [CSS px].

    Raises:
        ViewError: it contains no positions.

    """
    points = _points(source)
    steps = np.diff(points, axis=0)
    length = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    start, end = (f"({fixed(x, 2)}, {fixed(y, 2)})" for x, y in (points[0], points[-1]))
    counted = plural(len(points), "position")
    text = f"{title or 'track'}: {fixed(length, 2)} m from {start} to {end}, {counted}"
    alt = f"A way from above, {fixed(length, 2)} m long: it begins at {start} and ends at {end}, in metres."
    low, high = points.min(axis=0), points.max(axis=0)
    extent = np.maximum(high - low, MIN_EXTENT)
    low, high = (low + high - 1.12 * extent) / 2, (low + high + 1.12 * extent) / 2
    scale = min((width - LEFT - RIGHT) / (high[0] - low[0]), MAX_HEIGHT / (high[1] - low[1]))
    across, up = (float(side) for side in np.maximum(scale * (high - low), 60.0))
    middle = (low + high) / 2
    low, high = middle - np.array([across, up]) / (2 * scale), middle + np.array([across, up]) / (2 * scale)
    with house_style():
        figure = blank_figure(max(100.0, LEFT + across + RIGHT), TOP + up + BOTTOM)
        axes = add_axes(figure, LEFT, TOP, across, up)
        _frame(axes, low, high, (across, up))
        _line(axes, points, 10.0 ** math.floor(math.log10(0.4 / scale)))
        return matplotlib_picture(figure, text=text, alt=alt, form="svg", caption=title)


def _points(source: Any) -> Floats:
    """Return the positions of a table or an array (n, 2)."""
    if isinstance(source, Mapping):
        missing = [name for name in COLUMNS if name not in source]
        if missing:
            raise ViewError(
                f"the table has no column {missing[0]}, so it contains no path: give the table of a topic with "
                "nav_msgs/Odometry"
            )
        source = np.stack([np.asarray(source[name], dtype=float) for name in COLUMNS], axis=-1)
    points = np.asarray(source, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or not len(points):
        raise ViewError(f"positions are an array of shape (n, 2) with at least one row, not {points.shape}")
    if not np.isfinite(points).all():
        raise ViewError("a position is infinite or not a number")
    return points


def _frame(axes: Axes, low: Floats, high: Floats, size: tuple[float, float]) -> None:
    low, high = snap(low), snap(high)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    step = max(step_of(float(side), max(2, int(pixels / 60))) for side, pixels in zip(high - low, size, strict=True))
    for i, axis in enumerate((axes.xaxis, axes.yaxis)):
        set_ticks(axis, float(low[i]), float(high[i]), step)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


def _line(axes: Axes, points: Floats, tolerance: float) -> None:
    drawn = snap(points[points_to_keep(points, tolerance)] if len(points) > 1 else points, tolerance)
    axes.plot(drawn[:, 0], drawn[:, 1], color=LIGHT["blue"], linewidth=1.8)
    for (x, y), fill, word, place_ in ((drawn[0], "page", "start", -11), (drawn[-1], "blue", "end", 11)):
        axes.plot([x], [y], "o", color=LIGHT["blue"], markerfacecolor=LIGHT[fill], markersize=7, zorder=3)
        axes.annotate(
            word,
            (x, y),
            xytext=(0, place_),
            textcoords="offset points",
            ha="center",
            va="center",
            color=LIGHT["muted"],
            size=LABEL_SIZE,
        )
