"""The house style for figures that readers make: their box, text sizes and colours become those of the book.

Our figures are made inside `rosmini.viz.figures.house_style`. A reader's figure begins with `Figure()` or
`pyplot.subplots()`; `rosmini.viz.matplotlib_picture` applies the style when it turns it into a picture.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

from rosmini.viz.style import HAIRLINE, LABEL_SIZE, LIGHT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CYCLE: Mapping[str, str] = MappingProxyType(
    {
        "#1f77b4": LIGHT["blue"],
        "#ff7f0e": LIGHT["orange"],
        "#2ca02c": LIGHT["green"],
        "#d62728": LIGHT["vermilion"],
        "#9467bd": LIGHT["purple"],
        "#17becf": LIGHT["sky"],
    }
)
"""matplotlib's colours C0 to C4 and C9 and their replacements; the palette has no equivalent of the others."""

_THEIR_SIZES = (10.0, 12.0)
"""matplotlib's default sizes of text and titles [pt]; one point becomes one CSS pixel, and 10 px are hard to read."""


def dress(figure: Figure) -> None:
    """Give the boxed axes of a figure the house style: no box, a faint grid, our ink and sizes.

    Axes without a box (in the house style, or because the reader removed it) stay as they are, and so does text whose
    size is not matplotlib's default.
    """
    boxed = [axes for axes in figure.axes if axes.axison and _is_boxed(axes)]
    if not boxed:
        return
    figure.patch.set_visible(False)
    for axes in boxed:
        _unbox(axes)
    for each in [*figure.legends, *filter(None, (axes.get_legend() for axes in boxed))]:
        each.get_frame().set_linewidth(0.0)
    _enlarge(figure)


def _is_boxed(axes: Axes) -> bool:
    sides = [axes.spines[side] for side in ("left", "right", "bottom", "top") if side in axes.spines]
    return len(sides) == 4 and all(side.get_visible() for side in sides)


def _unbox(axes: Axes) -> None:
    axes.patch.set_visible(False)
    axes.spines[:].set_visible(False)
    axes.set_axisbelow(True)
    axes.tick_params(which="both", bottom=False, left=False, labelcolor=LIGHT["muted"], labelsize=LABEL_SIZE)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_color(LIGHT["muted"])
    if not axes.images:
        axes.grid(visible=True, color=LIGHT["group-line"], alpha=0.3, linewidth=HAIRLINE)


def _enlarge(figure: Figure) -> None:
    from matplotlib.text import Text

    for words in figure.findobj(Text):
        if isinstance(words, Text) and words.get_fontsize() in _THEIR_SIZES:
            words.set_fontsize(LABEL_SIZE)
