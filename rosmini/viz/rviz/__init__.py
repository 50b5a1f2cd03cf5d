"""RViz: a scene of displays, configured by a `.rviz` file, drawn in two and in three dimensions (http://wiki.ros.org/rviz).

`Scene` contains displays and subscribes to topics; `rviz` listens for some time and shows the result.
"""

from __future__ import annotations

from .config import Config, ConfigError
from .display import Display, Level, Status
from .picture import RvizView, look_from, rviz, still, turnable
from .primitives import DisplayError
from .scene import Layer, Scene

__all__ = [
    "Config", "ConfigError", "Display", "DisplayError", "Layer", "Level", "RvizView", "Scene", "Status", "look_from",
    "rviz", "still", "turnable",
]  # fmt: skip
