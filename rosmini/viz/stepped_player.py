"""A player of stored frames: pictures made in Python, of which a page shows one at a time.

A player has one or more *panels* side by side, each with a constant background. It has one or more *axes*, and each
axis is a slider: the steps of an algorithm, or the values of a parameter. There is a frame for each combination of
values: SVG on top of each panel's background, and a text. The still picture, which pages without scripts show and
which is printed, is one of the frames. `rosmini.viz.stepped_pictures` makes the players of the book's chapters.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from rosmini.viz.embed import MovingView
from rosmini.viz.figures import WIDTH
from rosmini.viz.style import LABEL_SIZE, variable
from rosmini.viz.svg import document, element, escape
from rosmini.viz.view import ViewError

GAP, NAME_HEIGHT = 20.0, 22.0
"""Space between two panels, and for a name above each panel [CSS px]."""
CONTROLS = 80
"""Minimum height of the controls and the text in the page [CSS px]."""


class Panel(NamedTuple):
    """One of the pictures shown side by side, with (0, 0) at its top left corner."""

    name: str
    width: float
    """Width in the page [CSS px], if there is room for it."""
    height: float
    ground: str = ""
    """SVG elements below every frame."""


class Axis(NamedTuple):
    """A slider: its name and the text of each value."""

    name: str
    values: Sequence[str]


class Frame(NamedTuple):
    """The content of a player at one combination of values."""

    pictures: Sequence[str]
    """SVG elements for each panel."""
    text: str
    """The text below the panels, of one or more lines."""


class SteppedPlayer(MovingView):
    """A view that shows one frame at a time.

    Args:
        name: the name of the view, in a few words.
        panels: the panels, from left to right; a panel without room starts a new row.
        axes: the sliders. A player with a single axis also has the buttons *Play* and *Next step*.
        frames: a frame for each combination of values; the last axis varies fastest.
        text: the text form.
        alt: the alt text.
        title: a caption.
        first: the index on each axis of the frame that a page shows first; by default the first frame.
        still: the same for the still picture; by default `first`.
        css: rules for the elements of the panels; each selector begins with `.rosmini-svg`.
        colours: colours of the palette that `css` uses.
        period: time between two frames during play [ms].

    Raises:
        ViewError: the number of frames does not match the axes, or the pictures of a frame do not match the panels.

    """

    scripts = ("rosmini-steps.js",)
    call = "rosminiSteps.mount"

    def __init__(
        self,
        name: str,
        panels: Sequence[Panel],
        axes: Sequence[Axis],
        frames: Sequence[Frame],
        *,
        text: str,
        alt: str,
        title: str | None = None,
        first: Sequence[int] | None = None,
        still: Sequence[int] | None = None,
        css: str = "",
        colours: Sequence[str] = (),
        period: int = 350,
    ) -> None:
        wanted = math.prod(len(axis.values) for axis in axes)
        if not panels or len(frames) != wanted or any(len(each.pictures) != len(panels) for each in frames):
            raise ViewError(
                f"a player of {len(panels)} panels needs {wanted} frames with a picture for each panel, "
                f"but {len(frames)} frames were given"
            )
        self._name, self._text, self._alt, self.title = name, text, alt, title
        self.panels, self.axes, self.frames = panels, axes, frames
        self._first = list(first or [0] * len(axes))
        self._still = list(still or self._first)
        self._css, self._colours, self._period = css, colours, period

    @property
    def name(self) -> str:
        """The name of the view, in a few words."""
        return self._name

    @property
    def text(self) -> str:
        """The text form."""
        return self._text

    @property
    def alt(self) -> str:
        """The alt text."""
        return self._alt

    def frame(self, indices: Sequence[int]) -> Frame:
        """Return the frame at these indices, one for each axis."""
        number = 0
        for axis, index in zip(self.axes, indices, strict=True):
            number = number * len(axis.values) + index
        return self.frames[number]

    @property
    def svg(self) -> str:
        """The still picture: the panels with one of the frames. The page's script takes the panels from it."""
        pictures = self.frame(self._still).pictures
        parts, left, top, bottom, right = [], 0.0, 0.0, 0.0, 0.0
        for panel, picture in zip(self.panels, pictures, strict=True):
            if left and left + panel.width > WIDTH + 1:
                left, top = 0.0, bottom + GAP
            head = NAME_HEIGHT if panel.name else 0.0
            if panel.name:
                where = {"x": left, "y": top + head - 7, "font_size": LABEL_SIZE}
                parts.append(element("text", escape(panel.name), **where, class_="rm-name"))
            parts.append(
                element(
                    "svg", element("g", panel.ground) + element("g", picture), class_="rosmini-svg rm-panel", x=left,
                    y=top + head, width=panel.width, height=panel.height, data_name=panel.name,
                    viewBox=f"0 0 {panel.width:g} {panel.height:g}",
                )
            )  # fmt: skip
            bottom = max(bottom, top + head + panel.height)
            right = max(right, left + panel.width)
            left += panel.width + GAP
        css = f".rosmini-svg .rm-name{{fill:{variable('muted')}}}{self._css}"
        colours = sorted({"muted", *self._colours})
        return document(
            "".join(parts), width=right, height=bottom + 1, title=self.name, alt=self.alt, css=css, colours=colours
        )  # fmt: skip

    @property
    def height(self) -> int:
        """The height of the controls [CSS px]; the panels are as high as the width of the page allows."""
        return CONTROLS

    @property
    def data(self) -> dict[str, Any]:
        """The data for the page's script; a picture that several frames share appears once."""
        numbers: dict[str, int] = {}
        frames = [
            [[numbers.setdefault(picture, len(numbers)) for picture in each.pictures], each.text]
            for each in self.frames
        ]
        return {
            "axes": [[axis.name, list(axis.values)] for axis in self.axes],
            "first": self._first,
            "period": self._period,
            "pictures": list(numbers),
            "frames": frames,
        }
