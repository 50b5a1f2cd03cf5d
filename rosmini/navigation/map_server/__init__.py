"""Maps in files, and the nodes that read and write them (http://wiki.ros.org/map_server)."""

from __future__ import annotations

from .grid_map import FREE, OCCUPIED, UNKNOWN, GridMap, MapDataError, MapError, MapMetadataError, MapMissing
from .map_io import load_map
from .map_saving import save_map

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNKNOWN",
    "GridMap",
    "MapDataError",
    "MapError",
    "MapMetadataError",
    "MapMissing",
    "load_map",
    "save_map",
]
