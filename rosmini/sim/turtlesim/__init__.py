"""`turtlesim` (http://wiki.ros.org/turtlesim): turtles that drive and draw.

`turtle`, `paper` and `frame` are the simulation without ROS, `node` connects it to a graph, and `window()` returns the
running one.
"""

from .node import TurtleSim
from .turtle import Turtle, TurtleError
from .windows import window

__all__ = ["Turtle", "TurtleError", "TurtleSim", "window"]
