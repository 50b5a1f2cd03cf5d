"""`rqt_tf_tree`: the tree of frames (http://wiki.ros.org/rqt_tf_tree)."""

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
