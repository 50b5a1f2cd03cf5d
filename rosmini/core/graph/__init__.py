"""The computation graph: scheduler, Master and Parameter Server, nodes, topics, services, log messages.

The kernel, in the order in which it is best read:

1. how a message travels: ``publisher``, ``connection``, ``lanes``, ``callbacks``, ``subscription``;
2. what runs it: ``scheduler``, ``event_queue``;
3. how nodes find each other: ``master``, ``parameters``, ``master_port``, ``transport``, ``local_transport``;
4. the interface for users: ``service``, ``node``, ``graph``.

The other modules support these: clock, log messages, slave API, threads, Jupyter. ``observers`` watch the graph.
"""

from __future__ import annotations

from .clock import Timer
from .graph import Graph, default_graph, running_graph, set_default_graph
from .lanes import LaneExit, Waiter
from .node import Node
from .publisher import MessageFactory, Publisher
from .report import RunReport
from .service import ServiceClient, ServiceServer
from .subscription import Subscriber

__all__ = [
    "Graph",
    "LaneExit",
    "MessageFactory",
    "Node",
    "Publisher",
    "RunReport",
    "ServiceClient",
    "ServiceServer",
    "Subscriber",
    "Timer",
    "Waiter",
    "default_graph",
    "running_graph",
    "set_default_graph",
]
