"""One turtle of a turtlesim, as a pad drives it and shows its window."""

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
    """A turtle, chosen by its name; the first by default. Raises `TeleopError` if there is none of this name."""

    def __init__(self, sim: TurtleSim, name: str = "") -> None:
        names = self.names(sim)
        if name not in names and (name or not names):
            hint = nearest(name, names) or f"there are: {', '.join(names) or 'none'}"
            raise TeleopError(f"no turtle {name!r} in the window of {sim.node.name}; {hint}")
        self.sim = sim
        self.name = name or names[0]
        keys = key_map("turtle_teleop_key")
        self.limits = Limits(keys.linear, keys.angular)
        """How fast it may be sent. A turtle has no bound of its own: these are the speeds of `turtle_teleop_key`."""

    @staticmethod
    def names(sim: TurtleSim) -> tuple[str, ...]:
        """All turtles of a window."""
        return tuple(sim.turtles)

    @property
    def topic(self) -> str:
        """Where it hears velocities, as a global name."""
        return self.sim.node.resolve(f"{self.name}/cmd_vel")

    @property
    def namespace(self) -> str:
        """Of the window's node."""
        return self.sim.node.namespace

    @property
    def title(self) -> str:
        """What is driven, in a few words."""
        return f"Drive {self.name} of {self.sim.node.name.lstrip('/')}"

    @property
    def turtle(self) -> Turtle:
        """The turtle. Raises `TeleopError` if it was killed or the node has ended."""
        node = self.sim.node
        if node.is_shutdown():
            raise TeleopError(f"the node {node.name} was shut down.")
        if self.name not in self.sim.turtles:
            raise TeleopError(f"the turtle {self.name!r} is no longer in the window of {node.name}.")
        return self.sim.turtles[self.name]

    def look(self) -> Pose:
        """Where it is: x [m], y [m], heading [rad]."""
        turtle = self.turtle
        return turtle.x, turtle.y, turtle.theta

    @property
    def blocked(self) -> bool:
        """Whether it runs against the border of its window."""
        turtle, (x, y, theta) = self.turtle, self.look()
        ahead = [turtle.forward * math.cos(theta), turtle.forward * math.sin(theta)]
        sides = zip((x, y), ahead, strict=True)
        return any((at <= 0 and way < 0) or (at >= LIMIT and way > 0) for at, way in sides)

    def describe(self) -> str:
        """Where it is and how much was drawn, in a line that is the same on every machine."""
        strokes = plural(self.sim.frame.paper.count, "stroke")
        return f"{self.name} at {pose_text(self.look())} in the window of {self.sim.node.name}; {strokes}"

    def reset(self) -> None:
        """Reset the window, by its service: one turtle in the middle, and nothing drawn."""
        node = self.sim.node
        node.service_client("reset", service_class("std_srvs/Empty")).call()

    # -- for a page ----------------------------------------------------------------------------------------------

    def state(self, since: int = 0, clears: int | None = None) -> dict[str, Any]:
        """What a canvas draws: see `Frame.state`."""
        return self.sim.state(since, clears)

    def data(self) -> dict[str, Any]:
        """All that the scripts of a page have to know."""
        return {
            "name": self.name,
            "pose_topic": self.sim.node.resolve(f"{self.name}/pose"),
            "limit": LIMIT,
            "step": STEP_S,
            "holds": TIMEOUT_S,
            "state": self.state(),
            "drawings": [drawing.parts for drawing in DRAWINGS],
        }
