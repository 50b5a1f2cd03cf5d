"""`tf/tf_echo`: prints the pose of one frame in another (http://wiki.ros.org/tf#tf_echo)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rosmini.core.errors import ScriptError
from rosmini.core.tf.errors import TransformException
from rosmini.core.tf.listener import TransformListener
from rosmini.core.tf.rigid import rpy
from rosmini.core.tf.tree import Found

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rosmini.core.graph import Node


def listed(values: Iterable[float]) -> str:
    """Return numbers with three decimals, without a negative zero."""
    return "[" + ", ".join(f"{round(value, 3) + 0.0:.3f}" for value in values) + "]"


def report(found: Found) -> str:
    """Return the tool's output for a transform."""
    angles = rpy(found.transform)
    return (
        f"At time {found.stamp_ns / 1e9:.3f}\n"
        f"- Translation: {listed(found.transform[:3])}\n"
        f"- Rotation: in Quaternion {listed(found.transform[3:])}\n"
        f"            in RPY (radian) {listed(angles)}\n"
        f"            in RPY (degree) {listed(map(math.degrees, angles))}"
    )


class TfEcho:
    """Prints the pose of `target_frame` in `source_frame` `echo_rate` times a second (default 1).

    The argument names are the tool's: the transform converts data from `target_frame` to `source_frame`. Raises
    `ScriptError` for an invalid rate.
    """

    def __init__(self, node: Node, source_frame: str, target_frame: str, echo_rate: str = "1") -> None:
        try:
            period = 1 / float(echo_rate)
        except (ValueError, ZeroDivisionError) as error:
            raise ScriptError(
                f"tf_echo: {echo_rate!r} is no rate; give how often a second it shall print"
            ) from error
        self.node = node
        self.frames = source_frame.lstrip("/"), target_frame.lstrip("/")
        self.buffer = TransformListener(node).buffer
        self.buffer.wait_for_transform(*self.frames, timeout=1.0)
        self.echo()
        self.timer = node.timer(period, lambda _event: self.echo())

    def echo(self) -> None:
        """Print the transform now, or the error."""
        try:
            text = report(self.buffer.tree.lookup(*self.frames))
        except TransformException as error:
            text = (
                f"Failure at {self.node.now().to_sec():.9f}\nException thrown:{error}\n"
                f"The current list of frames is:\n{self.buffer.all_frames_as_string()}"
            )
        print(text)
