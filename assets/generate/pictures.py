"""The picture in the README."""

from __future__ import annotations

from rosmini.graph import Graph
from rosmini.msgs import message_class
from rosmini.viz import rqt_graph


def talker_and_listener() -> str:
    """The graph of the README's example, as SVG."""
    string = message_class("std_msgs/String")
    with Graph() as graph:
        graph.node("talker").publisher("chatter", string, queue_size=10)
        graph.node("listener").subscriber("chatter", string, print)
        return rqt_graph(graph).svg or ""
