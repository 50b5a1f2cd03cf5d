"""`turtlesim` (http://wiki.ros.org/turtlesim): turtles that drive, and draw while they do.

`turtle`, `paper` and `frame` are the simulation without ROS, `node` puts it into a graph, and `window()` finds the one
that runs.
"""

from .frame import Frame
from .node import TurtleSim
from .turtle import Turtle, TurtleError
from .windows import window

__all__ = ["Frame", "Turtle", "TurtleError", "TurtleSim", "window"]
