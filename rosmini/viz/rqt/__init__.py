"""The tools of rqt, each as a function that returns a view."""

from __future__ import annotations

from rosmini.viz.rqt.console import LogTable, rqt_console
from rosmini.viz.rqt.graph import rqt_graph
from rosmini.viz.rqt.graph_state import GraphState

__all__ = ["GraphState", "LogTable", "rqt_console", "rqt_graph"]
