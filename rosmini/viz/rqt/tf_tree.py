"""`rqt_tf_tree`: the tree of frames, each edge with its broadcaster, rate and buffer (http://wiki.ros.org/rqt_tf_tree)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.core.graph import Graph
from rosmini.core.tf import FrameTree, TransformListener
from rosmini.core.tf.history import History
from rosmini.viz import style
from rosmini.viz.graph_drawing import arrow, drawing, ellipse, facts, name, room_for, rule, text
from rosmini.viz.layout import Edge, Layout, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

from .panel import Panel, bar
from .parts import Control, Part, drawn

COLOURS = ["ink", "muted", "line", "node-fill", "node-line", "topic-fill", "topic-line", "label"]


def tf_tree(source: Any, *, title: str | None = None) -> Picture:
    """Draw the frames of a buffer, each under its parent, as rqt_tf_tree and view_frames do.

    Args:
        source: a `Buffer`, a `TransformListener`, or a `FrameTree`.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: `source` has no tree of frames.

    """
    tree = _tree(source)
    head = f"{title or 'tf tree'}: {plural(len(list(tree)), 'frame')}, {plural(len(tree.edges), 'transform')}"
    lines = [
        f"{edge.newest.parent} -> {frame}: " + ", ".join(_facts(edge))
        for frame, edge in sorted(tree.edges.items(), key=lambda item: (item[1].newest.parent, item[0]))
    ]
    alt = _alt(tree)
    return Picture(_draw(tree, title or "tf tree", alt), text="\n".join([head, *lines]), alt=alt, caption=title)


def _tree(source: Any) -> FrameTree:
    for found in (source, getattr(source, "tree", None), getattr(getattr(source, "buffer", None), "tree", None)):
        if isinstance(found, FrameTree):
            return found
    raise ViewError(
        f"a {type(source).__name__} has no tree of frames: give a Buffer, a TransformListener or a FrameTree"
    )


def _facts(edge: History) -> list[str]:
    """Return the facts beside an edge: broadcaster, rate, most recent transform and buffer length."""
    sender = f"Broadcaster: {edge.newest.authority or 'unknown'}"
    if edge.static:
        return [sender, "static"]
    return [
        sender,
        f"Average rate: {edge.rate:.1f} Hz",
        f"Most recent: {edge.newest_ns / 1e9:.3f} s",
        f"Buffer length: {edge.span_ns / 1e9:.3f} s",
    ]


def _lines(edge: History) -> list[str]:
    """Return the facts as lines; a broadcaster's name has its own, since siblings make a tree wider than a page."""
    sender, *others = _facts(edge)
    return [*sender.split(" "), *others]


def _alt(tree: FrameTree) -> str:
    if not tree.edges:
        return "Tree of frames with nothing in it: no transform was received."
    children = tree.children()
    said = [f"{', '.join(frames)} under {parent}" for parent, frames in sorted(children.items())]
    return f"Tree of {plural(len(list(tree)), 'frame')}: {'; '.join(said)}."


def _draw(tree: FrameTree, title: str, alt: str) -> str:
    vertices = [
        Vertex(frame, max(64.0, text_width(frame, style.TEXT_SIZE) + 34), 36.0, "ellipse") for frame in sorted(tree)
    ]
    edges = []
    for frame, edge in sorted(tree.edges.items()):
        edges.append(Edge(frame, edge.newest.parent, frame, *room_for(_lines(edge))))
    layout = layered(vertices, edges, direction="down")
    parts = [_edge(layout, edge, _lines(tree.edges[edge.name])) for edge in edges]
    parts += [_frame(layout, vertex, root=vertex.name not in tree.edges) for vertex in vertices]
    if not parts:
        parts = [text("(no frame to show)", 80.0, 20.0, size=None, colour="muted", kind="tf-none")]
        layout = Layout(160.0, 30.0)
    return drawing(parts, layout, title=title, alt=alt, css=_css(), colours=COLOURS)


def _frame(layout: Layout, vertex: Vertex, *, root: bool) -> str:
    rect = layout.vertices[vertex.name]
    shape = ellipse(rect, "topic" if root else "node")
    return element("g", shape + name(vertex.name, rect), class_="tf-root" if root else "tf-frame")


def _edge(layout: Layout, edge: Edge, lines: list[str]) -> str:
    route = layout.edges[edge.name]
    return element("g", arrow(route) + facts(lines, route.label), class_="tf-edge")


def _css() -> str:
    return (
        rule(".tf-frame ellipse", fill="node-fill", stroke="node-line")
        + rule(".tf-root ellipse", fill="topic-fill", stroke="topic-line")
        + rule(".tf-frame text,.rosmini-svg .tf-root text", fill="ink")
        + rule(".tf-edge text", fill="label")
        + rule(".tf-none", fill="muted")
        + rule(".tf-edge path:first-of-type", stroke="line")
        + rule(".tf-edge path:last-of-type", fill="line")
        + f".rosmini-svg path:first-of-type,.rosmini-svg ellipse{{stroke-width:{style.LINE_WIDTH}}}"
    )


class TfTree(Panel):
    """The tree of frames, as it is now (http://wiki.ros.org/rqt_tf_tree)."""

    tool, heading, plugin = "rqt_tf_tree", "TF Tree", "rqt_tf_tree/RosTfTree"
    group, summary = "Visualization", "the tree of frames"
    example, listen_s = "--duration 3", 2.0

    def __init__(self, graph: Graph, *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self._listener = TransformListener(self.node)

    def view(self, title: str | None = None) -> Picture:
        """Return the tree as a picture."""
        return tf_tree(self._listener, title=title)

    def parts(self) -> Sequence[Part]:
        """The tree, drawn again every second."""
        return [bar(Control("refresh", "Refresh", "button")), self._redrawn(lambda: drawn(self.view()))]

    def _operate(self, _key: Sequence[str], _value: Any) -> None:
        self._drawn = None
