"""Sequence diagrams: calls between participants in order, with their answers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rosmini.core.errors import nearest
from rosmini.core.graph.observers.recording import Call, Recording
from rosmini.viz import style
from rosmini.viz.graph_drawing import MARGIN, arrow, box, name, rule, text
from rosmini.viz.layout import Rect, Route
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import document, element
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

COLOURS = ["page", "ink", "line", "label", "muted", "node-fill", "node-line", "group-line"]
HEAD = 30.0
ROW = 32.0
GAP = 150.0
"""Minimum distance between two participants [px]."""
LOOP = 34.0
"""Distance of the label of a loop from the line of its participant [px]."""


def sequence_diagram(calls: Iterable[Call], *, title: str | None = None, name: str = "sequence") -> Picture:
    """Draw calls: a line for each participant, downwards in time, and an arrow for each call.

    Args:
        calls: (caller, callee, what, answer), in order. An answer is a dashed arrow back; None for no answer.
        title: the caption, and the first words of the text form.
        name: the first words of the text form without a title.

    Participants are in order of appearance; what one sends to itself is a loop. Raises ``ViewError`` without calls.

    """
    made = [(who, whom, what, answer) for who, whom, what, answer in calls]
    if not made:
        raise ViewError("a sequence diagram needs at least one call: (who, whom, what, answer)")
    actors = list(dict.fromkeys(one for call in made for one in call[:2]))
    arrows = [one for call in made for one in _arrows(call)]
    head = f"{title or name}: {len(made)} calls between {len(actors)}"
    words = "\n".join([head, *(_line(*one) for one in arrows)])
    alt = f"Sequence diagram of {', '.join(actors)}. " + " ".join(
        f"{who} to {whom}: {what}." for who, whom, what, _ in made
    )
    return Picture(_draw(actors, arrows, title or name, alt), text=words, alt=alt, caption=title)


def recorded_calls(
    recording: Recording,
    *,
    names: Sequence[str] = (),
    everything: bool = False,
    since: float | None = None,
    limit: int = 40,
    title: str | None = None,
) -> Picture:
    """Draw the calls in a graph while it recorded; the arguments are those of ``Recording.show``.

    Raises ``ViewError`` if there were none.
    """
    calls = recording.calls(*names, everything=everything, since=since)
    about = f" about {', '.join(names)}" if names else ""
    if not calls:
        known = recording.names()
        hints = [hint for name in names if name not in known and (hint := nearest(name, known))]
        hint = "; ".join(hints) or "let time pass while the graph records, or ask about less"
        raise ViewError(f"nothing was recorded{about}: {hint}")
    rest = len(calls) - limit
    more = f" (and {plural(rest, 'more call')} after these)" if rest > 0 else ""
    return sequence_diagram(calls[:limit], title=title and f"{title}{more}", name=f"What happened{about}{more}")


Arrow = tuple[str, str, str, bool]
"""(from, to, label, True for an answer)"""


def _arrows(call: Call) -> list[Arrow]:
    who, whom, what, answer = call
    return [(who, whom, what, False)] + ([] if answer is None else [(whom, who, answer, True)])


def _line(source: str, target: str, label: str, is_answer: bool) -> str:
    return f"  {target} <- {source}: {label}" if is_answer else f"  {source} -> {target}: {label}"


def _columns(actors: Sequence[str], arrows: Sequence[Arrow]) -> list[float]:
    """Return the x of each participant's line: as close as labels and names allow."""
    at = [text_width(actors[0], style.TEXT_SIZE) / 2 + 12]
    for index in range(1, len(actors)):
        names = sum(text_width(one, style.TEXT_SIZE) / 2 + 20 for one in actors[index - 1 : index + 1])
        x = at[-1] + max(GAP, names)
        for source, target, label, _ in arrows:
            left, right = sorted((actors.index(source), actors.index(target)))
            if right == index and left < right:
                x = max(x, at[left] + text_width(label, style.LABEL_SIZE) + 28)
            elif left == right == index - 1:
                x = max(x, at[left] + _loop_width(label))
        at.append(x)
    return at


def _loop_width(label: str) -> float:
    return LOOP + text_width(label, style.LABEL_SIZE) + 16


def _draw(actors: Sequence[str], arrows: Sequence[Arrow], title: str, alt: str) -> str:
    columns = _columns(actors, arrows)
    bottom = HEAD + ROW * len(arrows) + 14
    parts = [_actor(actor, x, bottom) for actor, x in zip(actors, columns, strict=True)]
    for row, (source, target, label, is_answer) in enumerate(arrows, start=1):
        ends = columns[actors.index(source)], columns[actors.index(target)]
        parts.append(_message(ends, HEAD + ROW * row, label, is_answer))
    moved = element("g", "".join(parts), transform=f"translate({MARGIN:g},{MARGIN:g})")
    last = [_loop_width(label) for source, target, label, _ in arrows if source == target == actors[-1]]
    width = columns[-1] + max([text_width(actors[-1], style.TEXT_SIZE) / 2 + 12, *last])
    return document(
        moved, width=width + 2 * MARGIN, height=bottom + 2 * MARGIN, title=title, alt=alt, css=_css(), colours=COLOURS
    )


def _actor(actor: str, x: float, bottom: float) -> str:
    width = text_width(actor, style.TEXT_SIZE) + 24
    head = Rect(x - width / 2, 0, width, HEAD)
    line = element("path", d=f"M{x:.1f},{HEAD:g}V{bottom:.1f}", stroke=style.LIGHT["group-line"], class_="rm-life")
    return line + element("g", box(head, "node", 5) + name(actor, head), class_="rm-actor")


def _message(ends: tuple[float, float], y: float, label: str, is_answer: bool) -> str:
    begin, end = ends
    if begin == end:
        out = begin + LOOP
        route = Route(((begin, y - 8), (out, y - 8), (out, y + 8), (begin, y + 8)), None)
        words = text(label, out, y + 4, size=style.LABEL_SIZE, colour="label", anchor=None)
    else:
        third = (end - begin) / 3
        route = Route(((begin, y), (begin + third, y), (end - third, y), (end, y)), None)
        words = text(label, (begin + end) / 2, y - 6, size=style.LABEL_SIZE, colour="label")
    return element("g", arrow(route) + words, class_="rm-answer" if is_answer else "rm-call")


def _css() -> str:
    return (
        rule(".rm-actor rect", fill="node-fill", stroke="node-line")
        + rule(".rm-actor text", fill="ink")
        + rule(".rm-life", stroke="group-line")
        + rule(".rm-call text", fill="label")
        + rule(".rm-answer text", fill="muted")
        + rule(":is(.rm-call,.rm-answer) path:first-of-type", stroke="line")
        + rule(":is(.rm-call,.rm-answer) path:last-of-type", fill="line")
        + ".rosmini-svg :is(.rm-actor rect,.rm-call path:first-of-type,.rm-answer path:first-of-type)"
        + f"{{stroke-width:{style.LINE_WIDTH}}}"
        + rule(":is(.rm-call,.rm-answer) text", stroke="page")
        + ".rosmini-svg :is(.rm-call,.rm-answer) text{stroke-width:4;paint-order:stroke}"
        + ".rosmini-svg .rm-answer path:first-of-type{stroke-dasharray:5 4}"
        + ".rosmini-svg .rm-life{stroke-dasharray:2 4}"
    )
