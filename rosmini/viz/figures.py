"""Figures in the house style: sized in CSS pixels, no frame, a faint grid, independent of the user's matplotlibrc.

Pictures of worlds and runs are SVG: sharp, in the page's theme, readable by screen readers, and a few dozen kB.
nbval compares them byte by byte, so the data drawn are rounded first (`rosmini.viz.rounding`), and matplotlib's
output is rounded again (`rosmini.viz.themed`). A PNG would have to look good on both light and dark pages.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rosmini.viz.style import HAIRLINE, LABEL_SIZE, LIGHT
from rosmini.viz.view import ViewError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

WIDTH = 660.0
"""The width of the book's text column [CSS px]."""

MAX_SIZE = 4000.0
"""Maximum width and height of a picture [CSS px]."""

_STYLE: dict[Any, Any] = {
    "font.family": ["DejaVu Sans"],  # comes with matplotlib, so the layout is the same everywhere
    "font.size": LABEL_SIZE,
    "axes.labelsize": LABEL_SIZE,
    "axes.labelcolor": LIGHT["muted"],
    "axes.facecolor": "none",
    "axes.edgecolor": LIGHT["group-line"],
    "axes.linewidth": HAIRLINE,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": LIGHT["group-line"],
    "grid.alpha": 0.3,
    "grid.linewidth": HAIRLINE,
    "xtick.labelsize": LABEL_SIZE,
    "ytick.labelsize": LABEL_SIZE,
    "xtick.labelcolor": LIGHT["muted"],
    "ytick.labelcolor": LIGHT["muted"],
    "xtick.bottom": False,
    "ytick.left": False,
    "figure.facecolor": "none",
    "figure.edgecolor": "none",
    "legend.fontsize": LABEL_SIZE,
    "legend.labelcolor": LIGHT["ink"],
    "legend.frameon": False,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "lines.dash_joinstyle": "round",
    "path.simplify": False,
    "axes.unicode_minus": True,
}


@contextmanager
def house_style() -> Iterator[None]:
    """Use matplotlib's defaults and the house style inside the block.

    Raises:
        ViewError: matplotlib is not installed.

    """
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise ViewError(
            "pictures of worlds and runs are drawn with matplotlib, which is not installed: `pip install matplotlib`"
        ) from error
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_STYLE)
        yield


def blank_figure(width: float, height: float) -> Figure:
    """Return an empty figure of this size in CSS pixels; call it inside `house_style`.

    Raises:
        ViewError: it would be too small to draw in, or larger than a screen.

    """
    from matplotlib.figure import Figure

    for name, value in (("width", width), ("height", height)):
        if not 100 <= value <= MAX_SIZE:
            raise ViewError(f"the {name} of a picture must be 100 to {MAX_SIZE:g} pixels, not {value}")
    return Figure(figsize=(width / 72, height / 72), dpi=72)


def add_axes(figure: Figure, left: float, top: float, width: float, height: float) -> Axes:
    """Add axes to a figure, by their upper left corner and their size [CSS px].

    Raises:
        ViewError: the figure is so small that no space is left for them.

    """
    full_width, full_height = figure.get_size_inches() * 72
    if width <= 0 or height <= 0:
        raise ViewError(
            f"a picture of {full_width:.0f} by {full_height:.0f} pixels is too small for its contents: make it wider"
        )
    axes = figure.add_axes(
        (left / full_width, 1 - (top + height) / full_height, width / full_width, height / full_height)
    )
    axes.spines[:].set_visible(False)
    return axes


def legend(figure: Figure, handles: Sequence[Any], left: float) -> None:
    """Add a one-line legend in the top 28 pixels of a figure, `left` from its left edge [CSS px]."""
    width, height = figure.get_size_inches() * 72
    figure.legend(
        handles=list(handles),
        loc="upper left",
        bbox_to_anchor=((left - 2) / width, 1 - 2 / height),
        ncols=max(1, len(handles)),
        borderpad=0.0,
        borderaxespad=0.4,
        columnspacing=1.8,
        handlelength=2.4,
    )


def legend_width(handles: Sequence[Any]) -> float:
    """Return the approximate width of a legend with these handles [CSS px]."""
    return sum(64.0 + 6.6 * len(handle.get_label()) for handle in handles)


def ticks(low: float, high: float, step: float) -> list[float]:
    """Return the multiples of `step` from `low` to `high`."""
    return [round(i * step, 9) for i in range(math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6) + 1)]


def set_ticks(axis: Axis, low: float, high: float, step: float) -> None:
    """Put labelled ticks at the multiples of `step` from `low` to `high`."""
    marks = ticks(low, high, step)
    axis.set_ticks(marks, labels=say(marks))


def step_of(extent: float, most: int, steps: Sequence[float] = (1, 2, 5)) -> float:
    """Return the smallest of `steps` times a power of ten that divides `extent` into at most `most` parts."""
    least = extent / most * (1 - 1e-9)
    power = 10.0 ** math.floor(math.log10(least / max(steps)))
    while True:
        for step in steps:
            if step * power >= least:
                return step * power
        power *= 10


def say(values: Sequence[float]) -> list[str]:
    """Return the labels of ticks: as few decimals as possible, and a proper minus sign."""
    digits = max((len(f"{v:.6f}".rstrip("0").partition(".")[2]) for v in values), default=0)
    return [f"{v + 0.0:.{digits}f}".replace("-", "\N{MINUS SIGN}") for v in values]
