"""One turtle of turtlesim, as a pad drives it and shows its window."""

from __future__ import annotations

import math
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose
from rosmini.msgs import service_class
from rosmini.sim.turtlesim import Turtle, TurtleSim
from rosmini.sim.turtlesim.drawings import DRAWINGS
from rosmini.sim.turtlesim.turtle import LIMIT, STEP_S, TIMEOUT_S
from rosmini.viz.words import plural
from rosmini.viz.world_pictures import pose_text

from .key_maps import TeleopError, key_map
from .teleop import Limits


class DrivenTurtle:
    """A turtle chosen by name; the first by default. Raises `TeleopError` if there is no such turtle."""

    def __init__(self, sim: TurtleSim, name: str = "") -> None:
        names = self.names(sim)
        if name not in names and (name or not names):
            hint = nearest(name, names) or f"there are: {', '.join(names) or 'none'}"
            raise TeleopError(f"no turtle {name!r} in the window of {sim.node.name}; {hint}")
        self.sim = sim
        self.name = name or names[0]
        keys = key_map("turtle_teleop_key")
        self.limits = Limits(keys.linear, keys.angular)
        """Speed limits. A turtle has none, so these are the speeds of `turtle_teleop_key`."""

    @staticmethod
    def names(sim: TurtleSim) -> tuple[str, ...]:
        """Return the names of all turtles in a window."""
        return tuple(sim.turtles)

    @property
    def topic(self) -> str:
        """Global name of the topic on which the turtle receives velocities."""
        return self.sim.node.resolve(f"{self.name}/cmd_vel")

    @property
    def namespace(self) -> str:
        """Namespace of the window's node."""
        return self.sim.node.namespace

    @property
    def title(self) -> str:
        """Short description of the driven turtle."""
        return f"Drive {self.name} of {self.sim.node.name.lstrip('/')}"

    @property
    def turtle(self) -> Turtle:
        """The turtle. Raises `TeleopError` if it was killed or its node has shut down."""
        node = self.sim.node
        if node.is_shutdown():
            raise TeleopError(f"the node {node.name} was shut down.")
        if self.name not in self.sim.turtles:
            raise TeleopError(f"the turtle {self.name!r} is no longer in the window of {node.name}.")
        return self.sim.turtles[self.name]

    def sample_pose(self) -> Pose:
        """Return the turtle's pose: x [m], y [m], heading [rad]."""
        turtle = self.turtle
        return turtle.x, turtle.y, turtle.theta

    @property
    def blocked(self) -> bool:
        """True if the turtle pushes against the border of its window."""
        turtle, (x, y, theta) = self.turtle, self.sample_pose()
        ahead = [turtle.forward * math.cos(theta), turtle.forward * math.sin(theta)]
        sides = zip((x, y), ahead, strict=True)
        return any((at <= 0 and way < 0) or (at >= LIMIT and way > 0) for at, way in sides)

    def describe(self) -> str:
        """Return one line with the turtle's pose and the number of strokes, the same on every machine."""
        strokes = plural(self.sim.frame.paper.count, "stroke")
        return f"{self.name} at {pose_text(self.sample_pose())} in the window of {self.sim.node.name}; {strokes}"

    def reset(self) -> None:
        """Reset the window by its service: one turtle in the middle and an empty background."""
        node = self.sim.node
        node.service_client("reset", service_class("std_srvs/Empty")).call()

    # -- for a page ----------------------------------------------------------------------------------------------

    def state(self, since: int = 0, clears: int | None = None) -> dict[str, Any]:
        """Return the data that a canvas draws; see `Frame.state`."""
        return self.sim.state(since, clears)

    def data(self) -> dict[str, Any]:
        """Return all data that the page's scripts need."""
        return {
            "name": self.name,
            "pose_topic": self.sim.node.resolve(f"{self.name}/pose"),
            "limit": LIMIT,
            "step": STEP_S,
            "holds": TIMEOUT_S,
            "state": self.state(),
            "drawings": [drawing.parts for drawing in DRAWINGS],
        }
