"""State machines as pictures: states as rounded boxes, final ones with a double frame, and the path of a goal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Literal

from rosmini.core.actionlib import CLIENT_TRANSITIONS, SERVER_TRANSITIONS, CommState, GoalEvent, Status
from rosmini.core.actionlib.client_machine import CANCELLABLE
from rosmini.core.errors import nearest
from rosmini.viz import style
from rosmini.viz.graph_drawing import LINE_HEIGHT, arrow, drawing, rule, text
from rosmini.viz.graph_drawing import name as label_of
from rosmini.viz.layout import Edge, Layout, Rect, Vertex, layered
from rosmini.viz.layout.model import Direction
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError

Transition = tuple[str, str, str]
"""(from, event, to)"""

COLOURS = ["ink", "line", "label", "muted", "node-fill", "node-line", "topic-fill", "topic-line", "vermilion"]
HEIGHT = 30.0


def action_states(
    side: Literal["server", "client"] = "server",
    *,
    visited: Sequence[str | Status | CommState] = (),
    title: str | None = None,
    direction: Direction = "down",
) -> Picture:
    """Draw the state machine of an action's server or client (http://wiki.ros.org/actionlib/DetailedDescription).

    Args:
        side: the side of the action.
        visited: the states of a goal, in order; they and the arrows between them are highlighted.
        title: the caption, and the first line of the text form.
        direction: the direction of the arrows, "right" or "down".

    The client's arrows are labelled with the received status; shortcuts past a missed status are left out.
    Raises ``ViewError`` for a state that the machine does not have.

    """
    names = [one if isinstance(one, str) else one.name for one in visited]
    transitions = server_transitions() if side == "server" else client_transitions()
    return state_machine(
        transitions, visited=names, title=title, name=f"The states of a goal at the {side}", direction=direction
    )


def server_transitions() -> list[Transition]:
    """Return the steps of the server's machine, named after the methods of a goal handle, and the client's request."""
    return [
        (before.name, "cancel request" if event is GoalEvent.CANCEL_REQUEST else event.value, after.name)
        for event, table in SERVER_TRANSITIONS.items()
        for before, after in table.items()
    ]


def client_transitions() -> list[Transition]:
    """Return the single steps of the client's machine, named after the received status or the client's call."""
    steps = [
        (state.name, status.name, way[0].name)
        for state, row in CLIENT_TRANSITIONS.items()
        for status, way in row.items()
        if way is not None and len(way) == 1
    ]
    steps += [(state.name, "cancel()", "WAITING_FOR_CANCEL_ACK") for state in CommState if state in CANCELLABLE]
    return [*steps, ("WAITING_FOR_RESULT", "result", "DONE")]


def state_machine(
    transitions: Iterable[Transition],
    *,
    visited: Sequence[str] = (),
    title: str | None = None,
    name: str = "state machine",
    direction: Direction = "down",
    first: str | None = None,
    alt: str | None = None,
) -> Picture:
    """Draw a state machine; a state without outgoing transitions is final.

    ``title`` is the caption, and the first words of the text form; without it these are ``name``. ``first`` is the
    initial state, where the picture begins. ``alt`` is the alt text; None lists the states. Raises ``ViewError`` if a
    visited state is unknown.
    """
    labels: dict[tuple[str, str], list[str]] = {}
    for source, label, target in transitions:
        labels.setdefault((source, target), []).append(label)
    states = sorted({state for pair in labels for state in pair})
    for state in visited:
        if state not in states:
            hint = nearest(state, states)
            raise ViewError(f"{state} is not a state of this machine: {hint or ', '.join(states)}")
    ends = {state for state in states if all(source != state for source, _ in labels)}
    text = _text(title or name, labels, ends, visited)
    alt = alt or _alt(states, ends, visited)
    edges = [_edge_of(pair, names) for pair, names in labels.items()]
    vertices = [Vertex(state, text_width(state, style.TEXT_SIZE) + 24, HEIGHT) for state in states]
    layout = layered(vertices, edges, direction=direction, first=first)
    svg = _draw(layout, edges, labels, ends, visited, title or name, alt)
    return Picture(svg, text=text, alt=alt, caption=title)


def _edge_of(pair: tuple[str, str], names: list[str]) -> Edge:
    width = max(text_width(name, style.LABEL_SIZE) for name in names) + 8
    return Edge(f"{pair[0]} {pair[1]}", *pair, width, LINE_HEIGHT * len(names))


def _text(title: str, labels: dict[tuple[str, str], list[str]], ends: set[str], visited: Sequence[str]) -> str:
    lines = [f"{title}: {len({state for pair in labels for state in pair})} states"]
    for (source, target), names in sorted(labels.items()):
        lines.append(f"  {source} -> {target}: {', '.join(names)}")
    if ends:
        lines.append(f"  final: {', '.join(sorted(ends))}")
    if visited:
        lines.append(f"  visited: {' -> '.join(visited)}")
    return "\n".join(lines)


def _alt(states: list[str], ends: set[str], visited: Sequence[str]) -> str:
    way = f" One goal came through {', '.join(visited)}." if visited else ""
    end = f"; it ends in {', '.join(sorted(ends))}" if ends else ""
    return f"State machine with the states {', '.join(states)}{end}.{way}"


def _draw(
    layout: Layout,
    edges: list[Edge],
    labels: dict[tuple[str, str], list[str]],
    ends: set[str],
    visited: Sequence[str],
    title: str,
    alt: str,
) -> str:
    taken = set(pairwise(visited))
    quiet = sorted(edges, key=lambda edge: ((edge.source, edge.target) in taken, edge.name))
    parts = [_arrow(layout, edge, (edge.source, edge.target) in taken) for edge in quiet]
    parts += [_label(layout, edge, labels[edge.source, edge.target]) for edge in quiet]
    parts += [_state(name, rect, name in ends, name in visited) for name, rect in sorted(layout.vertices.items())]
    return drawing(parts, layout, title=title, alt=alt, css=_css(), colours=COLOURS)


def _state(name: str, rect: Rect, ends: bool, visited: bool) -> str:
    kind = "topic" if visited else "node"
    paint = {"fill": style.LIGHT[f"{kind}-fill"], "stroke": style.LIGHT[f"{kind}-line"]}
    frames = [_frame(rect, 0.0, paint)] + ([_frame(rect, 3.0, {**paint, "fill": "none"})] if ends else [])
    return element("g", "".join(frames) + label_of(name, rect), class_="rm-visited" if visited else "rm-state")


def _frame(rect: Rect, inset: float, paint: dict[str, str]) -> str:
    return element(
        "rect",
        x=rect.x + inset,
        y=rect.y + inset,
        width=rect.width - 2 * inset,
        height=rect.height - 2 * inset,
        rx=12.0 - inset,
        class_="rm-inner" if inset else None,
        **paint,
    )


def _arrow(layout: Layout, edge: Edge, taken: bool) -> str:
    colour = "vermilion" if taken else "line"
    drawn = arrow(layout.edges[edge.name], colour)
    return element("g", drawn, class_="rm-taken" if taken else "rm-step")


def _label(layout: Layout, edge: Edge, names: list[str]) -> str:
    room = layout.edges[edge.name].label
    if room is None:
        return ""
    x, _ = room.centre
    texts = [
        text(name, x, room.y + LINE_HEIGHT * (row + 1) - 3, size=style.LABEL_SIZE, colour="label")
        for row, name in enumerate(names)
    ]
    return element("g", "".join(texts), class_="rm-what")


def _css() -> str:
    return (
        rule(".rm-state rect", fill="node-fill", stroke="node-line")
        + rule(".rm-visited rect", fill="topic-fill", stroke="topic-line")
        + rule("g text", fill="ink")
        + rule(".rm-what text", fill="label")
        + rule(".rm-step path:first-of-type", stroke="line")
        + rule(".rm-step path:last-of-type", fill="line")
        + rule(".rm-taken path:first-of-type", stroke="vermilion")
        + rule(".rm-taken path:last-of-type", fill="vermilion")
        + ".rosmini-svg .rm-inner{fill:none}"
        + f".rosmini-svg path:first-of-type,.rosmini-svg rect{{stroke-width:{style.LINE_WIDTH}}}"
        + ".rosmini-svg .rm-taken path:first-of-type{stroke-width:2.8}"
    )
