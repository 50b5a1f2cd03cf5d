"""carrot_planner: moves as close to the goal as a straight line allows (http://wiki.ros.org/carrot_planner)."""

from __future__ import annotations

from .carrot import nearest_legal_pose

__all__ = ["nearest_legal_pose"]
