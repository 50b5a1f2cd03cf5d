"""Costmaps: the cost of each position of the robot's centre (http://wiki.ros.org/costmap_2d)."""

from __future__ import annotations

from .costmap import FREE_SPACE, INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D

__all__ = ["FREE_SPACE", "INSCRIBED_INFLATED_OBSTACLE", "LETHAL_OBSTACLE", "NO_INFORMATION", "Costmap2D"]
