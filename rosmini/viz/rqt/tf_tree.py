"""Panels that only show: the fields of types, the tree of frames, images."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.tf import TransformListener
from rosmini.viz.tf_trees import tf_tree
from rosmini.viz.view import Picture

from .panel import Panel, bar
from .parts import Control, drawn

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.core.graph import Graph

    from .parts import Part

REDRAW_S = 1.0
"""How often a picture is drawn again [s]."""


class TfTree(Panel):
    """The tree of frames, as it is now (http://wiki.ros.org/rqt_tf_tree)."""

    tool, heading, plugin = "rqt_tf_tree", "TF Tree", "rqt_tf_tree/RosTfTree"
    group, summary = "Visualization", "the tree of frames"
    example, listen_s = "--duration 3", 2.0

    def __init__(self, graph: Graph, *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self._listener = TransformListener(self.node)
        self._drawn: tuple[float, Picture] | None = None

    def view(self, title: str | None = None) -> Picture:
        """Return the tree as a picture."""
        return tf_tree(self._listener, title=title)

    def parts(self) -> Sequence[Part]:
        """The tree, drawn again every second."""
        now = self.graph.now().to_sec()
        if self._drawn is None or abs(now - self._drawn[0]) >= REDRAW_S:
            self._drawn = (now, self.view())
        return [bar(Control("refresh", "Refresh", "button")), drawn(self._drawn[1])]

    def _operate(self, _key: Sequence[str], _value: Any) -> None:
        self._drawn = None
