"""Effort: the efforts in a robot's joints, as circles around their axes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.products import matrix_product
from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import matrix
from rosmini.sim.urdf import Joint, Robot, load
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.marker_shapes import towards
from rosmini.viz.rviz.points_display import rainbow
from rosmini.viz.rviz.primitives import INVALID, DisplayError, Floats, Lines, Primitive
from rosmini.viz.rviz.properties import Property, Tree
from rosmini.viz.rviz.shapes import arrow
from rosmini.viz.rviz.topic_display import Received, TopicDisplay

INNER = 0.05
"""Radius of a circle without effort [m]."""
TURNING = ("revolute", "continuous")


class Effort(TopicDisplay, plugin="rviz/Effort"):
    """A circle for each rotating joint of a `sensor_msgs/JointState`; wide and red near its limit."""

    message = "sensor_msgs/JointState"
    history = "History Length"
    needs_transform = False
    properties = (
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Width", 0.02, "width of the circles' lines", unit="m", minimum=0.0),
        Property("Scale", 1.0, "scale of the circles", minimum=0.0),
        Property("History Length", 1, "number of messages shown", minimum=1, maximum=100_000),
        Property("Robot Description", "robot_description", "the parameter with the URDF"),
        Property("TF Prefix", "", "prefix of the names of all links"),
        Property("Joints", Tree(), "which joints are shown"),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self._read = ""
        self._robot: Robot | None = None

    def reset(self) -> None:
        """Discard messages and robot."""
        super().reset()
        self._read, self._robot = "", None

    def update(self, context: Context) -> None:
        """Reload the robot if its description changed, and draw again with the current poses of its links."""
        super().update(context)
        self._load(context)
        for received in self.stored:
            received.drawn = None

    def _load(self, context: Context) -> None:
        """Load the robot if its description changed."""
        name = self["Robot Description"]
        key = context.node.search_param(name)
        text = "" if key is None else str(context.node.get_param(key))
        if key is not None and text == self._read:
            return
        self._read, self._robot = text, None
        if key is None:
            said = f"Parameter [{name}] does not exist, and was not found by searchParam()"
            self.set_status(Level.ERROR, "URDF", said)
            return
        try:
            self._robot = load(text.strip().encode(), meshes=False, path=key)
            self.set_status(Level.OK, "URDF", "URDF parsed OK")
        except RosminiError as error:
            self.set_status(Level.ERROR, "URDF", str(error).partition("\n")[0])

    def accept(self, received: Received, context: Context) -> bool:
        """Accept a message with the same number of efforts and joints."""
        del context
        if len(received.message.name) != len(received.message.effort):
            raise DisplayError("Received a joint state msg with different joint names and efforts size!")
        if not np.isfinite(np.asarray(received.message.effort, dtype=float)).all():
            raise DisplayError(INVALID)
        return True

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the circles."""
        joints = {} if self._robot is None else self._robot.joints
        for name, effort in zip(received.message.name, received.message.effort, strict=True):
            joint = joints.get(name)
            if joint is None or joint.type not in TURNING or not self["Joints"].is_enabled(name):
                continue
            link = "/".join(filter(None, (self["TF Prefix"].strip("/"), joint.child)))
            try:
                place = matrix(context.place(link))
            except TransformException as error:
                self.set_status(Level.ERROR, name, context.problem(link, error))
                continue
            limit = 0.0 if joint.limit is None else joint.limit.effort
            self.set_status(Level.OK, name, f"{effort:.4g} N m" + (f" of {limit:g}" if limit else ""))
            yield from self._circle(joint, place, float(effort), limit)

    def _circle(self, joint: Joint, place: Floats, effort: float, limit: float) -> Iterator[Primitive]:
        share = (min(abs(effort) / limit, 1.0) if limit else abs(effort)) + 0.05
        radius, width = INNER + 0.5 * share * self["Scale"], self["Width"]
        angles = np.arange(30) * (math.tau / 32)
        sign = -1.0 if effort < 0 else 1.0
        flat = np.column_stack([np.zeros(30), -sign * radius * np.sin(angles), radius * np.cos(angles)])
        pose = matrix_product(place, towards(np.zeros(3), np.array(joint.axis)))
        colour = np.append(rainbow(np.array([share]))[0], self["Alpha"])
        placed = matrix_product(flat, pose[:3, :3].T) + pose[:3, 3]
        yield Lines(placed, colour, width)
        head = towards(placed[0], placed[0] + sign * pose[:3, 1])
        yield arrow(head, colour, 0.0, 2 * width, 2 * width, 2 * width)
