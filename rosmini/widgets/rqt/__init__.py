"""The tools of rqt that are operated: panels with controls, for a live notebook, a script and a page."""

from __future__ import annotations

from .console import LogConsole
from .graph import NodeGraph
from .logger_level import LoggerLevel
from .panel import Panel
from .plot import Plot
from .publisher import MessagePublisher, Publication
from .reconfigure import DynamicReconfigure
from .service_caller import ServiceCaller
from .topic import TopicMonitor

__all__ = [
    "DynamicReconfigure",
    "LogConsole",
    "LoggerLevel",
    "MessagePublisher",
    "NodeGraph",
    "Panel",
    "Plot",
    "Publication",
    "ServiceCaller",
    "TopicMonitor",
]
