"""`rqt_graph`: the computation graph as a picture, with the modes and switches of the tool of that name."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from rosmini.viz.layout import Direction
from rosmini.viz.rqt.condensing import condensed
from rosmini.viz.rqt.drawing import draw
from rosmini.viz.rqt.graph_state import graph_state
from rosmini.viz.rqt.highlight import highlighted
from rosmini.viz.rqt.selection import Group, Hide, Mode, matches, select
from rosmini.viz.rqt.wording import alt_text, text_form
from rosmini.viz.view import Picture

DEFAULT_HIDE: tuple[Hide, ...] = ("debug", "dead_sinks", "leaf_topics", "params", "unreachable")
DEFAULT_GROUP: tuple[Group, ...] = ("actions", "images", "tf")


def rqt_graph(
    source: object,
    *,
    mode: Mode = "nodes_only",
    hide: Collection[Hide] = DEFAULT_HIDE,
    group: Collection[Group] = DEFAULT_GROUP,
    namespaces: int = 2,
    namespace: str = "/",
    topics: str = "/",
    direction: Direction = "right",
    since: object = None,
    highlight: str = "",
    title: str | None = None,
) -> Picture:
    """Draw who publishes what to whom, as rqt_graph does (wiki.ros.org/rqt_graph).

    A graph of more than 300 nodes, topics and arrows is drawn in groups of nodes that are alike, and says so.

    Args:
        source: a Master (anything with `getSystemState` and `getTopicTypes`), an object with a `master`, the value
            of `getSystemState`, or a `GraphState`.
        mode: "nodes_only" draws a topic as a label on each edge from publisher to subscriber; "nodes_topics_active"
            draws topics as boxes, those with a connection; "nodes_topics_all" those that are only registered too.
        hide: switches of the "Hide" row. "debug": tools and their topics, such as /rosout and /clock; "dead_sinks":
            topics without subscribers; "leaf_topics": topics with one end only; "params": dynamic_reconfigure;
            "tf": /tf and /tf_static; "unreachable": nodes that do not answer. `()` hides nothing.
        group: switches of the "Group" row: one box for the topics of an "actions" server, of "images", of "tf".
            They matter only where topics are boxes.
        namespaces: how deep boxes around namespaces nest; 0 draws none.
        namespace: filter for nodes: names or regular expressions with commas between, `-` excludes. "/" is all.
        topics: filter for topics, in the same form.
        direction: "right" as rqt_graph, or "down".
        since: an earlier state, in any form of `source`: what is new since then is drawn in bold, what is gone dashed.
        highlight: a node or topic that is drawn: what it hears is blue, what hears it green, all else pale.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: the source has no graph state, or a mode, switch or filter is not known, or nothing of the name
            to highlight is drawn.

    """
    state = shown = graph_state(source)
    added: frozenset[str] = frozenset()
    removed: frozenset[str] = frozenset()
    if since is not None:
        before = graph_state(since)
        shown = before.joined(state)
        added, removed = state.parts() - before.parts(), before.parts() - state.parts()
    selected = select(shown, mode, hide=hide, group=group, nodes=namespace, topics=topics)
    selection = condensed(replace(selected, added=added, removed=removed))
    text, alt = text_form(selection, title), alt_text(selection)
    found = highlighted(selection, highlight) if highlight else None
    if found is not None:
        text, alt = f"{text}\n{found.text}", f"{alt} {found.text[0].upper()}{found.text[1:]}."
    advice = _advice(shown.topics, topics) if not selected.topics else ""
    if advice:
        text, alt = f"{text}\n{advice}", f"{alt} {advice}"
    svg = draw(
        selection,
        namespaces=namespaces,
        direction=direction,
        title=title or "rqt_graph",
        alt=alt,
        highlight=found,
    )
    caption = " ".join(filter(None, (title, advice)))
    return Picture(svg, text=text, alt=alt, caption=caption or None)


def _advice(names: Collection[str], topics: str) -> str:
    """What to do where a filter lets topics through and none of them is drawn; nothing where there is no filter."""
    if topics in ("", "/"):
        return ""
    asked = [name for name in names if matches(name, topics)]
    if not asked:
        return f"No topic matches {topics}."
    return (
        f"{', '.join(asked[:3])}{' ...' if len(asked) > 3 else ''}: not drawn. A topic without a connection is drawn "
        "in mode all, and only if it is not hidden (debug, dead_sinks, leaf_topics, params, tf)."
    )
