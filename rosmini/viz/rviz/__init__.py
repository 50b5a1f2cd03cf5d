"""RViz: a scene of displays, configured by a `.rviz` file, drawn in two and in three dimensions (http://wiki.ros.org/rviz).

`Scene` contains displays and subscribes to topics; `rviz` listens for some time and shows the result.
"""

from __future__ import annotations

from .config import Config
from .display import Display, Level
from .picture import look_from, rviz, still, turnable
from .scene import Layer, Scene

__all__ = [
    "Config", "Display", "Layer", "Level", "Scene", "look_from",
    "rviz", "still", "turnable",
]  # fmt: skip
