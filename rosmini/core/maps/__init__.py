"""Maps as grids, and their files (http://wiki.ros.org/map_server)."""

from __future__ import annotations

from .grid_map import GridMap, MapDataError, MapError, MapMetadataError, MapMissing
from .map_io import load_map, map_file, save_map

__all__ = ["GridMap", "MapDataError", "MapError", "MapMetadataError", "MapMissing", "load_map", "map_file", "save_map"]
