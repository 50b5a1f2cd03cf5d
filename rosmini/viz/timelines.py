"""The state of something over time: a row for each state, and events on top."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from rosmini.viz.figures import WIDTH, add_axes, blank_figure, house_style, set_ticks, step_of
from rosmini.viz.rounding import fixed, snap
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture

COLOURS = ("blue", "green", "orange", "purple", "vermilion")
LEFT, RIGHT, BOTTOM, ROW, LINE = 118.0, 24.0, 42.0, 34.0, 16.0
"""Margins around the plot, and the height of a row and of a line of text [px]."""
MIN_SPAN = 1 / 400
"""Minimum width of a span, as a share of the whole time."""


class Span(NamedTuple):
    """A state and its start and end [s]."""

    state: str
    begin: float
    end: float


def spans_of(history: Iterable[Any], begin: float | None = None) -> list[Span]:
    """Return the spans between the transitions of a history, which have `time`, and `before` and `after`, two enums.

    With `begin`, there is another span from then to the first transition.
    """
    steps = list(history)
    spans = [Span(one.after.name, one.time, after.time) for one, after in pairwise(steps)]
    if begin is not None and steps and begin < steps[0].time:
        spans.insert(0, Span(steps[0].before.name, begin, steps[0].time))
    return spans


def timeline(
    history: Iterable[Any],
    *,
    states: Sequence[str],
    marks: Iterable[tuple[float, str]] = (),
    begin: float | None = None,
    title: str | None = None,
    alt: str = "",
) -> Picture:
    """Draw the state of something, from `begin` or the first transition of its history to the last.

    Args:
        history: transitions, in order, each with a `time` [s], and `before` and `after`, two enums.
        states: the rows, from above.
        marks: events and their times [s].
        begin: the start of the timeline [s]; None for the first transition.
        title: a caption under the picture, and the first words of its text form.
        alt: a description for people who cannot see the picture; the text form is appended to it.

    Times are relative to the start. Raises `ViewError` for fewer than two transitions, and for a state without a row.

    """
    spans = spans_of(history, begin)
    if not spans:
        raise ViewError("a timeline needs two transitions: let more time pass, or ask for an earlier part")
    unknown = sorted({span.state for span in spans} - set(states))
    if unknown or len(states) > len(COLOURS):
        raise ViewError(
            f"a timeline has up to {len(COLOURS)} rows, one for each state; {unknown} are not in {list(states)}"
        )
    zero = spans[0].begin
    spans = [Span(span.state, span.begin - zero, span.end - zero) for span in spans]
    events = [(time - zero, name) for time, name in marks]
    text = "\n".join(_lines(title or "timeline", spans, states, events))
    with house_style():
        top = 14.0 + LINE * len(events)
        height = ROW * len(states)
        figure = blank_figure(WIDTH, top + height + BOTTOM)
        axes = add_axes(figure, LEFT, top, WIDTH - LEFT - RIGHT, height)
        _draw(axes, spans, states)
        for number, (time, name) in enumerate(events):
            _event(axes, time, name, (len(events) - number) * LINE / ROW)
        return matplotlib_picture(figure, text=text, alt=f"{alt} {text}".strip(), form="svg", caption=title)


def _lines(title: str, spans: Sequence[Span], states: Sequence[str], events: Sequence[tuple[float, str]]) -> list[str]:
    lines = [f"{title}: {fixed(spans[-1].end, 1)} s"]
    for state in states:
        own = [span for span in spans if span.state == state]
        took = sum(span.end - span.begin for span in own)
        lines.append(f"  {state}: {len(own)} x, together {fixed(took, 1)} s")
    return [*lines, *(f"  {fixed(time, 1)} s: {name}" for time, name in events)]


def _draw(axes: Any, spans: Sequence[Span], states: Sequence[str]) -> None:
    whole = spans[-1].end or 1.0
    for row, (state, colour) in enumerate(zip(states, COLOURS, strict=False)):
        own = [(span.begin, max(span.end - span.begin, MIN_SPAN * whole)) for span in spans if span.state == state]
        pieces = [tuple(part) for part in snap(own, whole / 4000).tolist()] if own else []
        axes.broken_barh(pieces, (row - 0.32, 0.64), facecolors=LIGHT[colour], zorder=3.0, clip_on=False)
    step = step_of(whole, 8)
    right = math.ceil(whole / step - 1e-6) * step
    axes.set(xlim=(0.0, right), ylim=(len(states) - 0.5, -0.5), xlabel="time [s]")
    set_ticks(axes.xaxis, 0.0, right, step)
    axes.set_yticks(range(len(states)), labels=list(states))


def _event(axes: Any, time: float, name: str, above: float) -> None:
    """Draw a line down from the text of an event; texts near the right end are to the left of the line."""
    left, right = axes.get_xlim()
    (time,) = snap([time], (right - left) / 4000).tolist()
    ends = time > left + 0.75 * (right - left)
    bottom, top = axes.get_ylim()
    axes.plot([time, time], [bottom, top - above], color=LIGHT["muted"], linewidth=1.0, clip_on=False, zorder=2.0)
    axes.annotate(
        name, (time, top - above + 0.16), xytext=(-4 if ends else 4, 0), textcoords="offset points",
        ha="right" if ends else "left", va="center", fontsize=LABEL_SIZE, color=LIGHT["ink"], annotation_clip=False,
    )  # fmt: skip
