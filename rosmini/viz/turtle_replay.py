"""A recording of turtlesim in the player of runs."""

from __future__ import annotations

import math

import numpy as np

from rosmini.sim.turtlesim.drawings import DRAWINGS
from rosmini.sim.turtlesim.tape import Line, Tape, Track
from rosmini.sim.turtlesim.turtle import LIMIT
from rosmini.viz.replay.layers import Stroke, Strokes
from rosmini.viz.replay.player import ReplayView, replay
from rosmini.viz.replay.run import Body, Run
from rosmini.viz.style import hex_colour

THINNER = 0.7
"""Width of pens relative to the window, because the player is smaller."""

OUTLINE = (
    (0.5, 0.0), (0.42, 0.1), (0.32, 0.12), (0.3, 0.34), (0.2, 0.34), (0.14, 0.25), (-0.1, 0.27), (-0.2, 0.34),
    (-0.3, 0.32), (-0.3, 0.12), (-0.46, 0.0),
)  # fmt: skip
"""Left half of a turtle's outline from above [m]."""


def turtle_replay(*tapes: Tape, title: str | None = None) -> ReplayView:
    """Play a tape: moving turtles, and their strokes as they grew, on the final background of the window.

    Before it is played, it shows the final drawing. Several tapes are shown side by side with one clock.

    Args:
        tapes: results of `TurtleSim.record()`.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: the tapes contain nothing to show.

    """
    return replay(*map(_run, tapes), names=[tape.name for tape in tapes] if len(tapes) > 1 else None, title=title)


def _run(tape: Tape) -> Run:
    strokes = tuple(_stroke(line) for line in tape.lines())
    notes = ("The tape was full before the end.",) if tape.is_full else ()
    return Run(
        tape.name,
        tape.start_s,
        tape.end_s,
        bodies=tuple(_body(track, tape) for track in tape.tracks),
        layers=(Strokes("drawing", strokes),) if strokes else (),
        bounds=(0.0, 0.0, LIMIT, LIMIT),
        background=hex_colour(tape.background),
        notes=notes,
        opens_at_end=bool(strokes),
    )


def _body(track: Track, tape: Tape) -> Body:
    half = [*OUTLINE, *((x, -y) for x, y in reversed(OUTLINE[1:-1]))]
    drawing = DRAWINGS[track.turtle.kind % len(DRAWINGS)]
    came = -math.inf if track.came_s <= tape.start_s else track.came_s
    return Body(
        track.turtle.name,
        np.array(track.times),
        np.array(track.poses),
        colour=drawing.colour,
        outline=tuple(half),
        shown_from=came,
        shown_until=track.gone_s,
        trail=False,
    )


def _stroke(line: Line) -> Stroke:
    return Stroke(
        np.array(line.times),
        np.array(line.points),
        colour=hex_colour(line.pen.colour),
        width=THINNER * line.pen.width,
        until=line.until_s,
    )
