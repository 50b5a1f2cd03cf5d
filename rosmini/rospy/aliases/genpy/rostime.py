"""``genpy.rostime``: ROS's time and duration."""

from __future__ import annotations

from rosmini.time import Duration, Time, TVal

__all__ = ["Duration", "TVal", "Time"]
