"""The window of a turtlesim in its current state: the background, the strokes, and the turtles."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rosmini.core.lazy import np
from rosmini.sim.turtlesim.drawings import DRAWINGS
from rosmini.sim.turtlesim.frame import Frame
from rosmini.sim.turtlesim.paper import SIZE, Colour, Pen, Stroke
from rosmini.sim.turtlesim.turtle import Turtle
from rosmini.viz.rounding import degrees, fixed, points_to_keep, snap
from rosmini.viz.style import hex_colour
from rosmini.viz.svg import document, element, number
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

KIND = "rosmini-turtles"
MAX_DESCRIBED = 12
"""Maximum number of turtles that are described."""
TOLERANCE = 0.3
"""Maximum deviation of a drawn line [px]."""


def turtle_picture(frame: Frame, *, title: str | None = None, size: float = 360.0) -> Picture:
    """Draw a window of turtlesim; strokes are drawn in the order in which they started.

    Args:
        frame: the value of `TurtleSim.frame`.
        title: a caption under the picture, and the first words of its text form.
        size: its width and height [CSS px].

    Raises:
        ViewError: the size is not a positive number.

    """
    if not size > 0:
        raise ViewError(f"the size of a picture must be a positive number of pixels, not {size}")
    text = "\n".join([f"{title or 'turtlesim'}: {_contents(frame)}", *_descriptions(frame)])
    turtles = list(frame.turtles.values())
    alt = f"A window of turtlesim: {_contents(frame)}. " + " ".join(f"{_line(each)}." for each in turtles[:3])
    body = element("rect", width=SIZE, height=SIZE, fill=hex_colour(frame.paper.background))
    body += "".join(_drawn(pen, points) for pen, points in chains(frame.paper.strokes()))
    body += "".join(_turtle(each) for each in turtles)
    inner = element("svg", body, viewBox=f"0 0 {SIZE} {SIZE}", width=size, height=size)
    svg = document(
        inner, width=size, height=size, title=text.partition("\n")[0], alt=alt.strip(), css="", colours=[], kind=KIND
    )
    return Picture(svg, text=text, alt=alt.strip(), caption=title)


def _contents(frame: Frame) -> str:
    paper = frame.paper
    there = plural(len(frame.turtles), "turtle")
    older = f", the oldest {paper.first} not in the picture" if paper.first else ""
    return f"{there}, {plural(paper.count, 'stroke')} on {_rgb(paper.background)}{older}"


def _descriptions(frame: Frame) -> list[str]:
    turtles = list(frame.turtles.values())
    more = [f"and {len(turtles) - MAX_DESCRIBED} more"] if len(turtles) > MAX_DESCRIBED else []
    return [_line(each) for each in turtles[:MAX_DESCRIBED]] + more


def _line(turtle: Turtle) -> str:
    """Describe the pose and the pen of a turtle."""
    place = f"({fixed(turtle.x, 2)}, {fixed(turtle.y, 2)}, {degrees(turtle.theta)} deg)"
    pen = f"{_rgb(turtle.pen.colour)}, {turtle.pen.width} px" if turtle.pen_on else "up"
    return f"{turtle.name}: pose {place}, pen {pen}"


def chains(strokes: Iterable[Stroke]) -> list[tuple[Pen, list[tuple[float, float]]]]:
    """Join consecutive strokes of one turtle and one pen to lines, in the order of their first strokes."""
    found: list[tuple[Pen, list[tuple[float, float]]]] = []
    open_: dict[str, tuple[Pen, list[tuple[float, float]]]] = {}
    for stroke in strokes:  # a stroke goes from its end to its start: turtles draw backwards, as in ROS
        last = open_.get(stroke.owner)
        start, end = (stroke.x2, stroke.y2), (stroke.x1, stroke.y1)
        if last is not None and last[0] == stroke.pen and last[1][-1] == start:
            last[1].append(end)
        else:
            open_[stroke.owner] = last = (stroke.pen, [start, end])
            found.append(last)
    return found


def _drawn(pen: Pen, points: list[tuple[float, float]]) -> str:
    line = np.clip(np.array(points), -SIZE, 2 * SIZE)  # a teleport may start far outside
    line = snap(line[points_to_keep(line, TOLERANCE)] if len(line) > 2 else line, TOLERANCE / 3)
    path = "M" + "L".join(f"{number(float(x))},{number(float(y))}" for x, y in line)
    return element(
        "path", d=path, fill="none", stroke=hex_colour(pen.colour), stroke_width=float(pen.width),
        stroke_linecap="square", stroke_linejoin="bevel",
    )  # fmt: skip


def _turtle(turtle: Turtle) -> str:
    x, y = turtle.pixel
    drawing = DRAWINGS[turtle.kind % len(DRAWINGS)]
    parts = "".join(element("path", d=path, fill=colour) for path, colour in drawing.parts)
    turned = fixed(-math.degrees(turtle.theta), 1)
    return element("g", parts, transform=f"translate({number(x)},{number(y)}) rotate({turned})")


def _rgb(colour: Colour) -> str:
    return f"rgb{colour}"
