"""`rqt_graph` that goes on: the computation graph, drawn again when it has changed (http://wiki.ros.org/rqt_graph)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, get_args

from rosmini.viz.rqt.graph import DEFAULT_GROUP, DEFAULT_HIDE, rqt_graph
from rosmini.viz.rqt.graph_state import GraphState, graph_state
from rosmini.viz.rqt.selection import Group, Hide, Mode
from rosmini.viz.view import Picture, ViewError

from .panel import Panel, bar
from .parts import Control, Drawing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.core.graph import Graph

    from .parts import Part

LOOK_S = 1.0
"""How often Master and nodes are asked [s]."""
MODES = ("nodes_only", "nodes_topics_active", "nodes_topics_all")
"""As the real one counts them."""
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
"""What the real rqt_graph calls its options where it saves them."""
WORDS = {"dead_sinks": "Dead sinks", "leaf_topics": "Leaf topics", "tf": "tf"}


class NodeGraph(Panel):
    """Who publishes what to whom, with the switches of rqt_graph; a click on a node highlights what is beside it.

    Args:
        graph: the graph.
        name: of the panel's node.
        options: those of :func:`rosmini.viz.rqt.graph.rqt_graph`: ``mode``, ``hide``, ``group``, ``namespaces``,
            ``namespace``, ``topics``, ``highlight``.

    Raises:
        ViewError: an option is not known, or has no such value.

    """

    tool: ClassVar[str] = "rqt_graph"
    heading: ClassVar[str] = "Node Graph"
    plugin: ClassVar[str] = "rqt_graph/RosGraph"

    def __init__(self, graph: Graph, *, name: str | None = None, **options: Any) -> None:
        super().__init__(graph, name=name)
        self.options: dict[str, Any] = {
            "mode": "nodes_only", "hide": DEFAULT_HIDE, "group": DEFAULT_GROUP, "namespaces": 2, "namespace": "/",
            "topics": "/", "highlight": "",
        }  # fmt: skip
        self._state = GraphState()
        self._asked: float | None = None
        self._drawn: tuple[Any, Picture] | None = None
        self.change(**options)

    def change(self, **options: Any) -> None:
        """Draw it otherwise. Raises ``ViewError`` for what :func:`rqt_graph` does not know."""
        unknown = set(options) - set(self.options)
        if unknown:
            raise ViewError(
                f"rqt_graph has no option {', '.join(sorted(unknown))}; it has {', '.join(self.options)}"
            )
        wanted = self.options | options
        self.refresh()
        rqt_graph(self._state, **wanted)
        self.options = wanted

    def refresh(self) -> None:
        """Ask Master and nodes now."""
        self._state, self._asked = graph_state(self.graph), self.graph.now().to_sec()

    def picture(self) -> Picture:
        """Return the drawing; what was highlighted and is gone is highlighted no more."""
        now = self.graph.now().to_sec()
        if self._asked is None or abs(now - self._asked) >= LOOK_S:
            self.refresh()
        key = (self._state, tuple(sorted(self.options.items())))
        if self._drawn is None or self._drawn[0] != key:
            try:
                drawn = rqt_graph(self._state, **self.options)
            except ViewError:
                self.options["highlight"] = ""
                drawn = rqt_graph(self._state, **self.options)
            self._drawn = (key, drawn)
        return self._drawn[1]

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
                Control(
                    "namespaces", "Namespaces", "number", float(options["namespaces"]), (), 0, 9, whole=True
                ),
                Control("highlight", "Highlight", "choice", options["highlight"], shown),
                Control("refresh", "Refresh", "button"),
            ),
            bar("Hide:", *hide),
            bar("Group:", *group),
            Drawing(picture.svg or "", picture.text, "highlight"),
        ]

    def settings(self) -> dict[str, Any]:
        """The options, by the names of the real rqt_graph."""
        found = {key: self.options[name] for key, name in TEXTS.items()}
        found["graph_type_combo_box_index"] = MODES.index(self.options["mode"])
        return found | {key: name in self.options[kind] for key, (kind, name) in BOXES.items()}

    def restore(self, settings: dict[str, Any]) -> None:
        """Take the options by those names."""
        wanted: dict[str, Any] = {name: settings[key] for key, name in TEXTS.items() if key in settings}
        if "namespaces" in wanted:
            wanted["namespaces"] = int(wanted["namespaces"])
        if "graph_type_combo_box_index" in settings:
            wanted["mode"] = MODES[int(settings["graph_type_combo_box_index"])]
        for kind in ("hide", "group"):
            chosen = {
                name: name in self.options[kind] for name in get_args(Hide if kind == "hide" else Group)
            }
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
