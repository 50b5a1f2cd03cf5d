"""`turtlesim` (http://wiki.ros.org/turtlesim): turtles that drive and draw.

`turtle`, `paper` and `frame` are the simulation without ROS, `node` connects it to a graph, and `window()` returns the
running one.
"""

from .node import TurtleSim, window
from .turtle import Turtle, TurtleError

__all__ = ["Turtle", "TurtleError", "TurtleSim", "window"]
