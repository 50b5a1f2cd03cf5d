"""`rqt_graph`: the computation graph as a picture, with the modes and switches of the tool of that name."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from optparse import Values
from typing import Any, get_args

from rosmini.core.graph import Graph
from rosmini.core.verbs import Call, Parser
from rosmini.ros.introspection.nodes import names, silent
from rosmini.viz.layout import Direction
from rosmini.viz.rqt.drawing import draw
from rosmini.viz.rqt.graph_state import CALLER_ID, GraphState, graph_state
from rosmini.viz.rqt.highlight import highlighted
from rosmini.viz.rqt.selection import MEANING, Group, Hide, Mode, Selection, matches, select
from rosmini.viz.view import Picture, View, ViewError
from rosmini.viz.words import plural

from .panel import Panel, bar
from .parts import Control, Drawing, Part

MAX_PARTS = 1000
"""Maximum number of nodes, topics and arrows of a picture."""
ALT_FLOWS = 6
"""Number of topics that the alt text contains."""

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

    Args:
        source: a Master (anything with `getSystemState` and `getTopicTypes`), an object with a `master`, the value
            of `getSystemState`, or a `GraphState`.
        mode: "nodes_only" draws a topic as a label on each edge from publisher to subscriber; "nodes_topics_active"
            draws topics with a connection as boxes; "nodes_topics_all" draws all registered topics.
        hide: switches of the "Hide" row. "debug": tools and their topics, such as /rosout and /clock; "dead_sinks":
            topics without subscribers; "leaf_topics": topics with one end only; "params": dynamic_reconfigure;
            "tf": /tf and /tf_static; "unreachable": nodes that do not answer. `()` hides nothing.
        group: switches of the "Group" row: one box for the topics of an "actions" server, of "images", of "tf".
            They have an effect only if topics are boxes.
        namespaces: depth of nested boxes around namespaces; 0 draws none.
        namespace: filter for nodes: names or regular expressions with commas between, `-` excludes. "/" is all.
        topics: filter for topics, in the same form.
        direction: "right" as rqt_graph, or "down".
        since: an earlier state, in any form of `source`: additions since then are bold, removals dashed.
        highlight: a node or topic in the drawing: its inputs are blue, its outputs green, all others pale.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: the source has no graph state, or a mode, switch or filter is not known, or nothing of the name
            to highlight is drawn, or there is too much to draw.

    """
    state = shown = graph_state(source)
    added: frozenset[str] = frozenset()
    removed: frozenset[str] = frozenset()
    if since is not None:
        before = graph_state(since)
        shown = before.joined(state)
        added, removed = state.parts() - before.parts(), before.parts() - state.parts()
    selected = select(shown, mode, hide=hide, group=group, nodes=namespace, topics=topics)
    count = len(selected.drawn())
    if count > MAX_PARTS:
        raise ViewError(
            f"this graph has {count} nodes, topics and arrows, and a picture at most {MAX_PARTS}: choose nodes or "
            "topics by their names (rqt_graph --nodes, --topics)"
        )
    selection = replace(selected, added=added, removed=removed)
    text, alt = text_form(selection, title), alt_text(selection)
    found = highlighted(selection, highlight) if highlight else None
    if found is not None:
        text, alt = f"{text}\n{found.text}", f"{alt} {found.text[0].upper()}{found.text[1:]}."
    advice = _advice(shown.topics, topics) if not selected.topics else ""
    if advice:
        text, alt = f"{text}\n{advice}", f"{alt} {advice}"
    svg = draw(
        selection, namespaces=namespaces, direction=direction, title=title or "rqt_graph", alt=alt, highlight=found
    )
    caption = " ".join(filter(None, (title, advice)))
    return Picture(svg, text=text, alt=alt, caption=caption or None)


def _advice(names: Collection[str], topics: str) -> str:
    """Return advice if a filter matches topics but none of them is drawn; empty without a filter."""
    if topics in ("", "/"):
        return ""
    asked = [name for name in names if matches(name, topics)]
    if not asked:
        return f"No topic matches {topics}."
    return (
        f"{', '.join(asked[:3])}{' ...' if len(asked) > 3 else ''}: not drawn. A topic without a connection is drawn "
        "in mode all, and only if it is not hidden (debug, dead_sinks, leaf_topics, params, tf)."
    )


def text_form(selection: Selection, title: str | None = None) -> str:
    """Return counts, a line for each flow `publishers -> topic [type] -> subscribers`, and lone nodes."""
    head = f"{title or 'rqt_graph'}: {_counts(selection)}"
    hidden = [
        plural(count, noun)
        for count, noun in ((selection.hidden_nodes, "node"), (selection.hidden_topics, "topic"))
        if count
    ]
    lines = [head + (f" (hidden: {' and '.join(hidden)})" if hidden else "")]
    flows = _flows(selection)
    for publishers, topic, subscribers in flows:
        source = ", ".join(publishers) or "(no publisher)"
        sink = ", ".join(subscribers) or "(no subscriber)"
        lines.append(f"{source} -> {topic}{_type(selection, topic)} -> {sink}")
    connected = {name for publishers, _, subscribers in flows for name in (*publishers, *subscribers)}
    lines += [f"{node} (not connected)" for node in selection.nodes if node not in connected]
    for name, members in sorted(selection.groups.items()):
        lines.append(f"{name} stands for {', '.join(m + _type(selection, m) for m in members)}")
    lines += [f"{node} does not answer" for node in sorted(selection.unreachable)]
    lines += _changes(selection)
    return "\n".join(lines)


def _changes(selection: Selection) -> list[str]:
    """Return a line with the additions and one with the removals in the drawing."""
    lines = []
    for word, parts in (("new", selection.added), ("gone", selection.removed)):
        found = [part for part in selection.drawn() if part in parts]
        names = [part.partition(":")[2] if part[1] == ":" else part for part in found]
        if names:
            lines.append(f"{word}: {', '.join(name.replace(' ', ' -> ') for name in names)}")
    return lines


def alt_text(selection: Selection) -> str:
    """Describe the picture in a sentence or two."""
    if not selection.nodes and not selection.topics:
        return "Computation graph with nothing to show."
    flows = _flows(selection)
    said = [_clause(*flow) for flow in flows[:ALT_FLOWS]]
    if len(flows) > ALT_FLOWS:
        said.append(f"and {plural(len(flows) - ALT_FLOWS, 'more flow')}")
    start = f"Computation graph with {_counts(selection, ' and ')}"
    if not said:
        return f"{start}: {_listed(selection.nodes)} without a connection."
    sentence = f"{start}: {'; '.join(said)}."
    if selection.unreachable:
        verb = "does" if len(selection.unreachable) == 1 else "do"
        sentence += f" {_listed(sorted(selection.unreachable))} {verb} not answer."
    changes = "; ".join(_changes(selection))
    return f"{sentence} {changes[0].upper()}{changes[1:]}." if changes else sentence


def _counts(selection: Selection, separator: str = ", ") -> str:
    return plural(len(selection.nodes), "node") + separator + plural(len(selection.topics), "topic")


def _type(selection: Selection, topic: str) -> str:
    return f" [{selection.types[topic]}]" if topic in selection.types else ""


def _flows(selection: Selection) -> list[tuple[tuple[str, ...], str, tuple[str, ...]]]:
    """Return (publishers, topic, subscribers), sorted by topic."""
    ends: dict[str, tuple[set[str], set[str]]] = {topic: (set(), set()) for topic in selection.topics}
    if selection.mode == "nodes_only":
        for publisher, topic, subscriber in selection.connections:
            ends[topic][0].add(publisher)
            ends[topic][1].add(subscriber)
    else:
        for role, pairs in enumerate((selection.publications, selection.subscriptions)):
            for node, topic in pairs:
                ends[topic][role].add(node)
    return [(tuple(sorted(sources)), topic, tuple(sorted(sinks))) for topic, (sources, sinks) in sorted(ends.items())]


def _clause(publishers: Collection[str], topic: str, subscribers: Collection[str]) -> str:
    if not publishers:
        return f"nobody publishes {topic} to {_listed(subscribers)}"
    verb = "publishes" if len(publishers) == 1 else "publish"
    sink = f"to {_listed(subscribers)}" if subscribers else "to nobody"
    return f"{_listed(publishers)} {verb} {topic} {sink}"


def _listed(names: Iterable[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


POLL_PERIOD_S = 1.0
"""Interval between requests to the Master and the nodes [s]."""
MODES = ("nodes_only", "nodes_topics_active", "nodes_topics_all")
"""The modes in the order of rqt_graph's setting."""
SHORT_MODES = dict(zip(("nodes", "active", "all"), MODES, strict=True))
"""Names of the modes on the command line."""
TEXTS = {
    "filter_line_edit_text": "namespace",
    "topic_filter_line_edit_text": "topics",
    "namespace_cluster_spin_box_value": "namespaces",
}
BOXES = {
    "quiet_check_box_state": ("hide", "debug"),
    "dead_sinks_check_box_state": ("hide", "dead_sinks"),
    "leaf_topics_check_box_state": ("hide", "leaf_topics"),
    "hide_dynamic_reconfigure_check_box_state": ("hide", "params"),
    "hide_tf_nodes_check_box_state": ("hide", "tf"),
    "unreachable_check_box_state": ("hide", "unreachable"),
    "actionlib_check_box_state": ("group", "actions"),
    "group_image_check_box_state": ("group", "images"),
    "group_tf_check_box_state": ("group", "tf"),
}
"""Keys of rqt_graph's settings in a perspective."""
WORDS = {"dead_sinks": "Dead sinks", "leaf_topics": "Leaf topics", "tf": "tf"}


class NodeGraph(Panel):
    """The computation graph with the switches of rqt_graph; a click on a node highlights its neighbours.

    Args:
        graph: the graph.
        name: name of the panel's node.
        options: options of :func:`rosmini.viz.rqt.graph.rqt_graph`: ``mode``, ``hide``, ``group``, ``namespaces``,
            ``namespace``, ``topics``, ``highlight``.

    Raises:
        ViewError: an option is not known, or has no such value.

    """

    tool, heading, plugin = "rqt_graph", "Node Graph", "rqt_graph/RosGraph"
    group, summary = "Introspection", "the computation graph: who publishes what to whom"
    example = "--mode active --hide debug,tf"

    def __init__(self, graph: Graph, *, name: str | None = None, **options: Any) -> None:
        super().__init__(graph, name=name)
        self.options: dict[str, Any] = {
            "mode": "nodes_only", "hide": DEFAULT_HIDE, "group": DEFAULT_GROUP, "namespaces": 2, "namespace": "/",
            "topics": "/", "highlight": "",
        }  # fmt: skip
        self._state = GraphState()
        self._asked: float | None = None
        self._picture: tuple[Any, Picture] | None = None
        self.change(**options)

    @classmethod
    def add_options(cls, parser: Parser) -> None:
        """Add the switches."""
        parser.add_option(
            "--mode",
            choices=sorted(SHORT_MODES),
            default="nodes",
            help="topics as labels (nodes), or as boxes (active, all)",
        )
        parser.add_option(
            "--hide", metavar="LIST",
            help=f"what to leave out: {'; '.join(f'{name}: {what}' for name, what in MEANING.items())}; or none",
        )  # fmt: skip
        parser.add_option("--nodes", default="/", metavar="FILTER", help="names or regular expressions, - excludes")
        parser.add_option("--topics", default="/", metavar="FILTER", help="likewise")
        parser.add_option("--group", metavar="LIST", help="what is one box: actions, images, tf, none")
        parser.add_option(
            "--namespaces", type="int", default=2, metavar="N", help="depth of the boxes around namespaces"
        )
        parser.add_option(
            "--highlight", default="", metavar="NAME", help="a node or topic, and what it is connected with"
        )

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the switches."""

        def switches(text: str | None, default: tuple[str, ...]) -> tuple[str, ...]:
            return default if text is None else tuple(part for part in text.split(",") if part != "none")

        return [], {
            "mode": SHORT_MODES[given.mode],
            "hide": switches(given.hide, DEFAULT_HIDE),
            "group": switches(given.group, DEFAULT_GROUP),
            "namespaces": given.namespaces,
            "namespace": given.nodes,
            "topics": given.topics,
            "highlight": given.highlight,
        }

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Ask the Master and the nodes, without a node, and draw the graph."""
        master = call.peers.ask_as(CALLER_ID)
        state = GraphState.of(
            master.ask("getSystemState"), master.ask("getTopicTypes"), unreachable=silent(call.peers, names(call.peers))
        )
        return rqt_graph(state, title=given.title, **cls.arguments(given)[1])

    def change(self, **options: Any) -> None:
        """Change options of the drawing. Raises ``ViewError`` for options and values unknown to :func:`rqt_graph`."""
        unknown = set(options) - set(self.options)
        if unknown:
            raise ViewError(f"rqt_graph has no option {', '.join(sorted(unknown))}; it has {', '.join(self.options)}")
        wanted = self.options | options
        self.refresh()
        rqt_graph(self._state, **wanted)
        self.options = wanted

    def refresh(self) -> None:
        """Ask the Master and the nodes now."""
        self._state, self._asked = graph_state(self.graph), self.graph.now().to_sec()

    def picture(self) -> Picture:
        """Return the drawing; a highlight of a node or topic that has gone is removed."""
        now = self.graph.now().to_sec()
        if self._asked is None or abs(now - self._asked) >= POLL_PERIOD_S:
            self.refresh()
        key = (self._state, tuple(sorted(self.options.items())))
        if self._picture is None or self._picture[0] != key:
            try:
                drawn = rqt_graph(self._state, **self.options)
            except ViewError:
                self.options["highlight"] = ""
                drawn = rqt_graph(self._state, **self.options)
            self._picture = (key, drawn)
        return self._picture[1]

    def parts(self) -> Sequence[Part]:
        """The switches, and the drawing."""
        picture, options = self.picture(), self.options
        shown = ("", *sorted({*self._state.all_nodes, *self._state.topics}))
        hide = [_switch("hide", name, name in options["hide"]) for name in get_args(Hide)]
        group = [_switch("group", name, name in options["group"]) for name in get_args(Group)]
        return [
            bar(
                Control("mode", "Mode", "choice", options["mode"], get_args(Mode)),
                Control("namespace", "Nodes", "text", options["namespace"]),
                Control("topics", "Topics", "text", options["topics"]),
                Control("namespaces", "Namespaces", "number", float(options["namespaces"]), (), 0, 9, whole=True),
                Control("highlight", "Highlight", "choice", options["highlight"], shown),
                Control("refresh", "Refresh", "button"),
            ),
            bar("Hide:", *hide),
            bar("Group:", *group),
            Drawing(picture.svg or "", picture.text, "highlight"),
        ]

    def settings(self) -> dict[str, Any]:
        """Return the options under rqt_graph's keys."""
        found = {key: self.options[name] for key, name in TEXTS.items()}
        found["graph_type_combo_box_index"] = MODES.index(self.options["mode"])
        return found | {key: name in self.options[kind] for key, (kind, name) in BOXES.items()}

    def restore(self, settings: dict[str, Any]) -> None:
        """Restore options from rqt_graph's keys."""
        wanted: dict[str, Any] = {name: settings[key] for key, name in TEXTS.items() if key in settings}
        if "namespaces" in wanted:
            wanted["namespaces"] = int(wanted["namespaces"])
        if "graph_type_combo_box_index" in settings:
            wanted["mode"] = MODES[int(settings["graph_type_combo_box_index"])]
        for kind in ("hide", "group"):
            chosen = {name: name in self.options[kind] for name in get_args(Hide if kind == "hide" else Group)}
            chosen |= {
                name: str(settings[key]).lower() == "true"
                for key, (at, name) in BOXES.items()
                if at == kind and key in settings
            }
            wanted[kind] = tuple(name for name, on in chosen.items() if on)
        self.change(**wanted)

    def _operate(self, key: Sequence[str], value: Any) -> None:
        match key[0]:
            case "refresh":
                self.refresh()
            case "hide" | "group":
                chosen = [name for name in self.options[key[0]] if name != key[1]]
                self.change(**{key[0]: tuple(sorted([*chosen, key[1]] if value else chosen))})
            case "namespaces":
                self.change(namespaces=int(value))
            case "highlight":
                self.change(highlight="" if value == self.options["highlight"] else value)
            case _:
                self.change(**{key[0]: value})


def _switch(kind: str, name: str, on: bool) -> Control:
    return Control(f"{kind}/{name}", WORDS.get(name, name.capitalize()), "check", on)
