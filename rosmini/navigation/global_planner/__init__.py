"""global_planner: several forms of Dijkstra's algorithm and A* (http://wiki.ros.org/global_planner)."""

from __future__ import annotations

from .search import GlobalAStar, GlobalDijkstra

__all__ = ["GlobalAStar", "GlobalDijkstra"]
