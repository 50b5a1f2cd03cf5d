"""global_planner: Dijkstra and A* in several forms (http://wiki.ros.org/global_planner)."""

from __future__ import annotations

from .search import GlobalAStar, GlobalDijkstra

__all__ = ["GlobalAStar", "GlobalDijkstra"]
