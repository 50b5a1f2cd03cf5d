"""The tools of rqt (http://wiki.ros.org/rqt): panels with controls, and functions that return a picture or a table."""

from __future__ import annotations

from .console import rqt_console
from .graph import rqt_graph
from .publisher import MessagePublisher
from .reconfigure import DynamicReconfigure
from .service_caller import ServiceCaller
from .window import Rqt

__all__ = ["DynamicReconfigure", "MessagePublisher", "Rqt", "ServiceCaller", "rqt_console", "rqt_graph"]
