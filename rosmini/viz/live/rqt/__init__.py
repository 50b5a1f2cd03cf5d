"""The tools of rqt that are operated: panels with controls, for a live notebook, a script and a page."""

from __future__ import annotations

from .bag import BagTimeline
from .browsers import ActionTypes, ImageView, MessageTypes, ServiceTypes, TfTree
from .console import LogConsole
from .graph import NodeGraph
from .logger_level import LoggerLevel
from .panel import Panel
from .perspective import Perspective
from .plot import Plot
from .publisher import MessagePublisher, Publication
from .reconfigure import DynamicReconfigure
from .service_caller import ServiceCaller
from .topic import TopicMonitor
from .window import Rqt

__all__ = [
    "ActionTypes",
    "BagTimeline",
    "DynamicReconfigure",
    "ImageView",
    "LogConsole",
    "LoggerLevel",
    "MessagePublisher",
    "MessageTypes",
    "NodeGraph",
    "Panel",
    "Perspective",
    "Plot",
    "Publication",
    "Rqt",
    "ServiceCaller",
    "ServiceTypes",
    "TfTree",
    "TopicMonitor",
]
