"""Maps in files (http://wiki.ros.org/map_server)."""

from __future__ import annotations

from .map_io import GridMap, MapError, load_map

__all__ = ["GridMap", "MapError", "load_map"]
