"""Pictures: one display funnel (`rosmini.viz.view`), one house style, and the tools of rqt."""

from __future__ import annotations

from rosmini.viz.rqt import GraphState, rqt_graph
from rosmini.viz.view import Picture, View, ViewError, matplotlib_picture

__all__ = ["GraphState", "Picture", "View", "ViewError", "matplotlib_picture", "rqt_graph"]
