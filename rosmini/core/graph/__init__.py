"""The computation graph: scheduler, Master and Parameter Server, nodes, topics, services, log messages.

The kernel, in the order in which it is best read:

1. how a message travels: ``publisher``, ``connection``, ``lanes``, ``callbacks``, ``subscription``;
2. what runs it: ``scheduler``, ``event_queue``;
3. how nodes find each other: ``master``, ``parameters``, ``master_port``, ``transport``, ``local_transport``;
4. the interface for users: ``service``, ``node``, ``graph``.

The other modules support these: clock, log messages, slave API, threads, Jupyter. ``observers`` watch the graph.
"""

from __future__ import annotations

from .clock import Rate, Timer, TimerEvent
from .graph import Graph, default_graph, running_graph, set_default_graph
from .lanes import Lane, LaneContext, LaneExit, Waiter
from .node import Node
from .publisher import MessageFactory, Publisher
from .report import RunReport, Waiting
from .scheduler import Scheduler
from .service import ServiceClient, ServiceServer
from .subscription import Subscriber

__all__ = [
    "Graph",
    "Lane",
    "LaneContext",
    "LaneExit",
    "MessageFactory",
    "Node",
    "Publisher",
    "Rate",
    "RunReport",
    "Scheduler",
    "ServiceClient",
    "ServiceServer",
    "Subscriber",
    "Timer",
    "TimerEvent",
    "Waiter",
    "Waiting",
    "default_graph",
    "running_graph",
    "set_default_graph",
]
