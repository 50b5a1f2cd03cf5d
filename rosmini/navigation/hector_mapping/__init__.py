"""A map from a laser alone: scans are matched with the map so far, on several scales (http://wiki.ros.org/hector_mapping).

Kohlbrecher, Meyer, von Stryk and Klingauf, A flexible and scalable SLAM system with full 3D motion estimation (SSRR
2011). `grid` is one map with its update, `matching` puts a scan on it, `slam` has the scales, `scans` makes points of
ranges; `node` is apart.
"""

from __future__ import annotations

from .grid import OccupancyGrid
from .matching import Matched, match, surface
from .scans import Limits, scan_ends
from .slam import HectorSlam, Settings

__all__ = [
    "HectorSlam",
    "Limits",
    "Matched",
    "OccupancyGrid",
    "Settings",
    "match",
    "scan_ends",
    "surface",
]
