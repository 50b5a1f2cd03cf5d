"""`costmap_2d/costmap_2d_node`: a stand-alone costmap, whose topics and parameters are in `~costmap/`."""

from __future__ import annotations

from rosmini.core.graph import Node
from rosmini.core.tf import Buffer, TransformListener

from .costmap_ros import Costmap2DROS


class Costmap2DNode:
    """The node `costmap_2d_node`: a costmap without a planner."""

    def __init__(self, node: Node) -> None:
        buffer = Buffer(node)
        TransformListener(node, buffer)
        self.costmap = Costmap2DROS("costmap", buffer, node)
