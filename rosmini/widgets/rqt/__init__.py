"""The tools of rqt that are operated: panels with controls, for a live notebook, a script and a page."""

from __future__ import annotations

from .logger_level import LoggerLevel
from .panel import Panel
from .publisher import MessagePublisher, Publication
from .service_caller import ServiceCaller

__all__ = ["LoggerLevel", "MessagePublisher", "Panel", "Publication", "ServiceCaller"]
