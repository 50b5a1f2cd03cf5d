"""Plots of numbers over time, or over anything else: a few lines with markers in one frame."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from rosmini.core.lazy import np
from rosmini.viz.figures import WIDTH, add_axes, blank_figure, house_style, legend, set_ticks, step_of
from rosmini.viz.rounding import fixed, snap
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.words import plural

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]

COLOURS = ("blue", "orange", "green", "vermilion", "purple")
MARKS = ("o", "s", "^", "D", "v")
LEFT, RIGHT, TOP, BOTTOM, HEIGHT = 50.0, 24.0, 58.0, 42.0, 220.0
"""Margins around the plot, and its height [px]."""


def plot(
    series: Mapping[str, tuple[ArrayLike, ArrayLike]],
    *,
    x: str,
    y: str,
    title: str | None = None,
    alt: str = "",
    width: float = WIDTH,
    marks: bool = True,
) -> Picture:
    """Plot up to five series of points, each with a line through it.

    Args:
        series: for each name, the numbers along x and along y, of the same length.
        x: the label of the x axis, with its unit in brackets.
        y: the label of the y axis, likewise.
        title: a caption under the picture, and the first words of its text form.
        alt: a description for people who cannot see the picture; the text form is appended to it.
        width: width of the picture [CSS px].
        marks: True to mark each point.

    Raises:
        ViewError: there are no series or too many, or a series has lists of different lengths or no numbers.

    """
    points = {name: _points(name, values) for name, values in series.items()}
    if not 1 <= len(points) <= len(COLOURS):
        raise ViewError(f"a plot has 1 to {len(COLOURS)} series, not {len(points)}")
    lines = [f"{title or 'plot'}: {y} over {x}"]
    lines += [_line(name, values) for name, values in points.items()]
    text = "\n".join(lines)
    with house_style():
        figure = blank_figure(width, TOP + HEIGHT + BOTTOM)
        axes = add_axes(figure, LEFT, TOP, width - LEFT - RIGHT, HEIGHT)
        _frame(axes, np.vstack(list(points.values())), x, y)
        for (name, values), colour, shape in zip(points.items(), COLOURS, MARKS, strict=False):
            box, low = axes.viewLim, axes.viewLim.min
            pixel = np.array([box.width, box.height]) / 2000.0  # much finer than the screen
            drawn = snap((values - low) / pixel, 1.0) * pixel + low
            axes.plot(
                *drawn.T, color=LIGHT[colour], linewidth=1.4, marker=shape if marks else None, markersize=4.5,
                label=name, zorder=4.0, clip_on=False,
            )  # fmt: skip
        handles, _ = axes.get_legend_handles_labels()
        legend(figure, handles, LEFT)
        return matplotlib_picture(figure, text=text, alt=f"{alt} {text}".strip(), form="svg", caption=title)


def _points(name: str, values: tuple[ArrayLike, ArrayLike]) -> Floats:
    try:
        along_x, along_y = (np.asarray(part, dtype=float) for part in values)
        points: Floats = np.column_stack([along_x, along_y])
    except (TypeError, ValueError) as error:
        raise ViewError(f"series {name!r} must be two lists of numbers of the same length: {error}") from error
    if not len(points) or points.shape[1] != 2 or not np.isfinite(points).all():
        raise ViewError(f"series {name!r} must be two lists of finite numbers, with at least one in each")
    return points


def _frame(axes: Axes, points: Floats, x: str, y: str) -> None:
    """Set limits and ticks around the points and zero."""
    edges = []
    for low, high, most in (
        (points[:, 0].min(), points[:, 0].max(), 6),
        (min(0.0, points[:, 1].min()), max(0.0, points[:, 1].max()), 5),
    ):
        extent = high - low or 1.0
        step = step_of(extent, most)
        edges.append((math.floor(low / step + 1e-6) * step, math.ceil((low + extent) / step - 1e-6) * step, step))
    (left, right, across), (bottom, top, up) = edges
    axes.set(xlim=(left, right), ylim=(bottom, top), xlabel=x)
    set_ticks(axes.xaxis, left, right, across)
    set_ticks(axes.yaxis, bottom, top, up)
    axes.set_title(y, loc="left", fontsize=LABEL_SIZE, color=LIGHT["ink"], pad=7.0)


def _line(name: str, points: Floats) -> str:
    low, high = points[:, 1].min(), points[:, 1].max()
    low, high, last = (fixed(value, 2) for value in (low, high, points[-1, 1]))
    return f"{name}: {plural(len(points), 'point')}, from {low} to {high}, last {last}"
