"""Drawings of Logo programs as a player in which the lines grow; its still picture is the finished drawing."""

from __future__ import annotations

import math
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from rosmini.sim.logo.turtles import BACKGROUND, Drawing, Pose, Stroke
from rosmini.sim.logo.values import write
from rosmini.viz.replay.layers import Layer, Strokes
from rosmini.viz.replay.layers import Stroke as Line
from rosmini.viz.replay.player import PlayerRun, ReplayView
from rosmini.viz.replay.run import Body, Run
from rosmini.viz.style import hex_colour
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

MAX_DURATION = 30.0
"""Maximum duration of a drawing; turtles go faster if it would take longer [s]."""

TURNING_SPEED = 360.0
"""Turning speed of turtles [degrees/s]."""

TURTLE = ((0.3, 0.0), (0.1, 0.12), (-0.25, 0.17), (-0.15, 0.0), (-0.25, -0.17), (0.1, -0.12))
"""A turtle's outline [m], for a window of 11 m, x ahead."""


class _LogoRun(PlayerRun):
    """A drawing in a player, described in Logo's terms."""

    def __init__(self, drawing: Drawing, run: Run) -> None:
        super().__init__(run)
        self.drawing = drawing

    def text(self, title: str) -> str:
        """The number of lines, and the poses of the turtles."""
        return "\n".join(
            [f"{title}: {_lines(self.drawing)}", *(_turtle(*each) for each in self.drawing.turtles.items())]
        )

    @property
    def alt(self) -> str:
        """The same as sentences."""
        return " ".join(
            [
                f"A drawing by Logo, which grows: {_lines(self.drawing)}.",
                *(f"{_turtle(*each)}." for each in list(self.drawing.turtles.items())[:3]),
            ]
        )


def logo_picture(drawing: Drawing, *, title: str | None = None, speed: float = 200.0) -> ReplayView:
    """Return a player in which the turtles repeat a drawing.

    Args:
        drawing: the value of `Logo.drawing`.
        title: a caption, and the first words of the text form.
        speed: the speed of turtles [steps/s]; a drawing that would take longer than half a minute is drawn faster.

    Raises:
        ViewError: the speed is not above zero.

    """
    if not speed > 0:
        raise ViewError(f"turtles need a speed above 0 steps/s, not {speed}")
    times = _times(drawing.strokes, speed)
    end = float(times[-1])
    layers: tuple[Layer, ...] = tuple(
        Strokes(f"lines of {name}", lines) for name, lines in _strokes(drawing, times).items() if lines
    )
    bodies = tuple(_body(name, pose, drawing, times) for name, pose in drawing.turtles.items())
    run = Run(
        "Logo", 0.0, end, bodies=bodies, layers=layers, frame=drawing.place, bounds=_bounds(drawing),
        background=hex_colour(BACKGROUND) if drawing.middle else None, opens_at_end=True,
    )  # fmt: skip
    return ReplayView([_LogoRun(drawing, run)], title=title)


def _times(strokes: tuple[Stroke, ...], speed: float) -> Floats:
    """Return the time at which each movement begins [s], and at which the last one ends."""
    spans = [
        math.dist(stroke.start[:2], stroke.end[:2]) / speed
        + abs(math.remainder(stroke.end.heading - stroke.start.heading, 360.0)) / TURNING_SPEED
        for stroke in strokes
    ]
    times: Floats = np.concatenate([[0.0], np.cumsum(spans)])
    faster: Floats = times * min(1.0, MAX_DURATION / max(float(times[-1]), 1e-9))
    return faster


def _strokes(drawing: Drawing, times: Floats) -> dict[str, tuple[Line, ...]]:
    """Return the lines of each turtle; consecutive strokes of one pen are joined."""
    found: dict[str, tuple[Line, ...]] = {}
    numbered = [(i, stroke) for i, stroke in enumerate(drawing.strokes)]
    for name in dict.fromkeys(stroke.turtle for stroke in drawing.strokes):
        own = [each for each in numbered if each[1].turtle == name]
        lines = []
        for pen, group in groupby(own, key=lambda each: each[1].pen):
            members = list(group)
            if not pen.down:
                continue
            poses = [members[0][1].start, *(stroke.end for _, stroke in members)]
            when = np.array([times[members[0][0]], *(times[i + 1] for i, _ in members)])
            points = np.array([_metres(drawing, pose)[:2] for pose in poses])
            if (points != points[0]).any():
                colour = hex_colour(pen.colour) if drawing.middle else "blue"
                lines.append(Line(when, points, colour=colour, width=float(pen.size)))
        found[name] = tuple(lines)
    return found


def _body(name: str, pose: Pose, drawing: Drawing, times: Floats) -> Body:
    own = [(i, stroke) for i, stroke in enumerate(drawing.strokes) if stroke.turtle == name]
    poses = [own[0][1].start, *(stroke.end for _, stroke in own)] if own else [pose]
    when = np.array([times[own[0][0]], *(times[i + 1] for i, _ in own)]) if own else np.zeros(1)
    rows = np.array([_metres(drawing, pose) for pose in poses])
    rows[:, 2] = np.unwrap(rows[:, 2])
    scale = 45.0 / drawing.metre
    outline = tuple((scale * x, scale * y) for x, y in TURTLE)
    return Body(name, when, rows, colour="green", outline=outline, trail=False)


def _metres(drawing: Drawing, pose: Pose) -> tuple[float, float, float]:
    """Return a pose in metres, x to the right, y up, and radians counter-clockwise from x."""
    x, y = (drawing.middle + part / drawing.metre for part in pose[:2])
    return x, y, math.radians(90.0 - pose.heading)


def _bounds(drawing: Drawing) -> tuple[float, float, float, float] | None:
    """Return turtlesim's window; None if there is none or the drawing leaves it."""
    if not drawing.middle:
        return None
    side = 2.0 * drawing.middle
    inside = all(0 <= part <= side for stroke in drawing.strokes for part in _metres(drawing, stroke.end)[:2])
    return (0.0, 0.0, side, side) if inside else None


def _lines(drawing: Drawing) -> str:
    lines = drawing.lines
    if not drawing.middle:
        return f"{write(round(drawing.length) + 0.0)} steps driven"
    return f"{plural(len(lines), 'line')}, {write(round(drawing.length, 1) + 0.0)} steps"


def _turtle(name: str, pose: Pose) -> str:
    x, y, heading = (write(round(part, 1) + 0.0) for part in pose)
    return f"{name} at [{x} {y}], heading {heading}"
