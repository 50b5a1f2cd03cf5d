"""The tools of rqt (http://wiki.ros.org/rqt): panels with controls, and functions that return a picture or a table."""

from __future__ import annotations

from .bag import BagTimeline
from .console import LogConsole, LogTable, rqt_console
from .definitions import ActionTypes, MessageTypes, ServiceTypes
from .graph import NodeGraph, rqt_graph
from .graph_state import GraphState
from .image_view import ImageView
from .logger_level import LoggerLevel
from .panel import Panel
from .perspective import Perspective
from .plot import Plot
from .publisher import MessagePublisher, Publication
from .reconfigure import DynamicReconfigure
from .service_caller import ServiceCaller
from .tf_tree import TfTree
from .topics import TopicMonitor
from .window import Rqt

__all__ = [
    "ActionTypes",
    "BagTimeline",
    "DynamicReconfigure",
    "GraphState",
    "ImageView",
    "LogConsole",
    "LogTable",
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
    "rqt_console",
    "rqt_graph",
]
