"""The nodes of `tf` and `tf2_ros`: `static_transform_publisher`, `tf_echo`, `tf_monitor`, `view_frames`.

For their output see http://wiki.ros.org/tf.
"""

from __future__ import annotations

import math
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ScriptError
from rosmini.core.graph.show import show
from rosmini.core.tf.broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from rosmini.core.tf.buffer import Buffer
from rosmini.core.tf.errors import InvalidArgumentException, TransformException
from rosmini.core.tf.listener import TransformListener
from rosmini.core.tf.rigid import Rigid, from_rpy, rigid, rpy
from rosmini.core.tf.tree import Found
from rosmini.core.time import Duration
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rosmini.core.graph import Node

USAGE = """Usage: static_transform_publisher x y z qx qy qz qw frame_id child_frame_id{period}
   or: static_transform_publisher x y z yaw pitch roll frame_id child_frame_id{period}
x, y, z in metres, angles in radians: where child_frame_id is in frame_id."""


def parse(arguments: tuple[str, ...], period: str = "") -> tuple[str, str, Rigid]:
    """Return frame, child frame and transform from the arguments of the tool, as described by `USAGE`.

    Raises `ScriptError`, with `period` in the usage text, if they are invalid.
    """
    usage = USAGE.format(period=period)
    if len(arguments) not in (8, 9):
        raise ScriptError(
            f"static_transform_publisher got {len(arguments)} arguments before the period, if any.\n{usage}"
        )
    *words, frame, child = arguments
    try:
        numbers = [float(word) for word in words]
    except ValueError as error:
        raise ScriptError(f"static_transform_publisher: {error}.\n{usage}") from error
    if frame == child:
        raise ScriptError(f"frame_id and child_frame_id are the same ({frame}): they must differ.\n{usage}")
    if len(numbers) == 6:
        yaw, pitch, roll = numbers[3:]
        return frame, child, from_rpy(numbers[:3], roll, pitch, yaw)
    try:
        return frame, child, rigid(numbers[:3], numbers[3:])
    except InvalidArgumentException as error:
        raise ScriptError(f"static_transform_publisher: {error}\n{usage}") from error


def words_of_parameter(node: Node, name: str) -> tuple[str, ...]:
    """Return the arguments of `parse` for a parameter that contains a `geometry_msgs/TransformStamped`.

    Raises `ScriptError` if the parameter is not set, or lacks a field.
    """
    stamped = node.get_param(name, None)
    try:
        transform = stamped["transform"]
        numbers = [transform["translation"][axis] for axis in "xyz"]
        numbers += [transform["rotation"][axis] for axis in "xyzw"]
        return *map(str, numbers), str(stamped["header"]["frame_id"]), str(stamped["child_frame_id"])
    except (KeyError, TypeError, IndexError) as error:
        raise ScriptError(
            f"static_transform_publisher: the parameter {node.resolve_parameter(name)} must have header/frame_id, "
            "child_frame_id, transform/translation/x, y, z and transform/rotation/x, y, z, w"
        ) from error


class StaticTransformPublisher:
    """`tf2_ros/static_transform_publisher`: one transform, latched on `/tf_static`.

    Instead of the transform, the only argument may be the name of a parameter that contains it.
    """

    def __init__(self, node: Node, *arguments: str) -> None:
        if len(arguments) == 1:
            arguments = words_of_parameter(node, *arguments)
        self.frame, self.child, self.transform = parse(arguments)
        self.broadcaster = StaticTransformBroadcaster(node)
        self.broadcaster.send_rigid(self.frame, self.child, self.transform)
        node.loginfo(f"Spinning until killed publishing {self.frame} to {self.child}")


class RepeatingTransformPublisher:
    """`tf/static_transform_publisher`: one transform, sent periodically on `/tf`, stamped one period ahead."""

    def __init__(self, node: Node, *arguments: str) -> None:
        usage = " period_in_ms"
        self.frame, self.child, self.transform = parse(arguments[:-1], usage)
        try:
            self.period = Duration.from_sec(float(arguments[-1]) / 1e3)
        except ValueError as error:
            raise ScriptError(
                f"static_transform_publisher: {error} as the period.\n{USAGE.format(period=usage)}"
            ) from error
        if self.period.to_nsec() <= 0:
            raise ScriptError(f"the period must be positive, not {arguments[-1]} ms.\n{USAGE.format(period=usage)}")
        self.node = node
        self.broadcaster = TransformBroadcaster(node)
        self.timer = node.timer(self.period, lambda _event: self.send())

    def send(self) -> None:
        """Send the transform now."""
        self.broadcaster.send_rigid(self.frame, self.child, self.transform, self.node.now() + self.period)


def listed(values: Iterable[float]) -> str:
    """Return a list of numbers as text, with three decimals and without negative zeros."""
    return "[" + ", ".join(f"{round(value, 3) + 0.0:.3f}" for value in values) + "]"


def report(found: Found) -> str:
    """Return the output of `tf_echo` for a transform."""
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
            raise ScriptError(f"tf_echo: {echo_rate!r} is not a rate: give the number of outputs per second") from error
        self.node = node
        self.frames = source_frame.lstrip("/"), target_frame.lstrip("/")
        self.buffer = TransformListener(node).buffer
        self.buffer.wait_for_transform(*self.frames, timeout=1.0)
        self.echo()
        self.timer = node.timer(period, lambda _event: self.echo())

    def echo(self) -> None:
        """Print the latest transform, or the error if there is none."""
        try:
            text = report(self.buffer.tree.lookup(*self.frames))
        except TransformException as error:
            text = (
                f"Failure at {self.node.now().to_sec():.9f}\nException thrown:{error}\n"
                f"The current list of frames is:\n{self.buffer.all_frames_as_string()}"
            )
        print(text)


MAX_SAMPLES = 1000
"""Maximum number of messages of a node, or transforms of a frame, in the statistics: the latest ones count."""


class Delays:
    """Delays [s] of the latest transforms of one sender or frame, from their stamp to their arrival."""

    def __init__(self) -> None:
        self.times: deque[float] = deque(maxlen=MAX_SAMPLES)
        self.delays: deque[float] = deque(maxlen=MAX_SAMPLES)
        self.sender = ""

    def add(self, now: float, delay: float) -> None:
        """Add a transform that was received at `now` [s], with its delay [s]."""
        self.times.append(now)
        self.delays.append(delay)

    @property
    def rate(self) -> float:
        """Transforms per second; 1e8 for a single one, as in the tool."""
        return (len(self.times) - 1 or 1) / max(self.times[-1] - self.times[0], 1e-8)

    def __str__(self) -> str:
        average = sum(self.delays) / len(self.delays)
        return f"Average Delay: {average:.6g} Max Delay: {max(0.0, *self.delays):.6g}"


class TfMonitor:
    """Prints delays and rates of transforms once a second, for all frames or for the chain between two.

    Raises `ScriptError` if only one frame is given.
    """

    def __init__(self, node: Node, framea: str = "", frameb: str = "") -> None:
        if bool(framea) != bool(frameb):
            raise ScriptError("Usage: tf_monitor or tf_monitor framea frameb: two frames make a chain, none means all")
        self.node = node
        self.chain = (framea.lstrip("/"), frameb.lstrip("/")) if framea else None
        self.buffer = Buffer(node)
        self.senders: dict[str, Delays] = {}
        self.frames: dict[str, Delays] = {}
        self.net = Delays()
        kind = message_class("tf2_msgs/TFMessage")
        node.subscriber("/tf", kind, lambda data: self._on_transforms(data, static=False), numpy=False)
        node.subscriber("/tf_static", kind, lambda data: self._on_transforms(data, static=True), numpy=False)
        if self.chain:
            print(f"Waiting for transform chain to become available between {framea} and {frameb} ")
        self.timer = node.timer(1.0, lambda _event: self.report())

    def _on_transforms(self, data: Any, *, static: bool) -> None:
        now = self.node.now().to_sec()
        sender = data._connection_header.get("callerid", "unknown_publisher")
        label = sender + ("(static)" if static else "")
        total = 0.0
        for one in data.transforms:
            delay = 0.0 if static else now - one.header.stamp.to_sec()
            total += delay
            frame = self.frames.setdefault(one.child_frame_id.lstrip("/"), Delays())
            frame.sender = label
            frame.add(now, delay)
            (self.buffer.set_transform_static if static else self.buffer.set_transform)(one, sender)
        if data.transforms:
            self.senders.setdefault(label, Delays()).add(now, total / len(data.transforms))
        if self.chain and not self.buffer.tree.why_not(*self.chain):
            stamp = self.buffer.tree.latest_common_time(*self.chain)
            self.net.add(now, now - stamp / 1e9 if stamp else 0.0)

    def report(self) -> None:
        """Print the statistics up to now, once the chain is complete."""
        frames = sorted(self.frames)
        if self.chain is None:
            head = "RESULTS: for all Frames"
        elif self.buffer.tree.why_not(*self.chain):
            return
        else:
            chain = self.buffer.tree.chain(*self.chain)[::-1]
            frames = [frame for frame in chain if frame in self.frames]
            delays = self.net.delays
            head = (
                f"RESULTS: for {self.chain[0]} to {self.chain[1]}\nChain is: {' -> '.join(chain)}\n"
                f"Net delay     avg = {sum(delays) / len(delays):.6g}: max = {max(0.0, *delays):.6g}"
            )
        lines = [head, "", "Frames:"]
        lines += [f"Frame: {frame} published by {self.frames[frame].sender} {self.frames[frame]}" for frame in frames]
        lines += ["", "All Broadcasters:"]
        lines += [f"Node: {name} {delays.rate:.6g} Hz, {delays}" for name, delays in sorted(self.senders.items())]
        print("\n".join(["", "", "", *lines]))


LISTEN_S = 5.0


class ViewFrames:
    """Listens for `LISTEN_S` seconds, then writes `frames.gv` (for graphviz) and `frames.svg` to `folder`, and ends.

    rosmini draws `frames.svg`, which is also the attribute `picture`; the real tool converts `frames.gv` to
    `frames.pdf` instead.
    """

    def __init__(self, node: Node, folder: str = ".") -> None:
        self.buffer = TransformListener(node).buffer
        print(f"Listening to /tf for {LISTEN_S} seconds")
        node.sleep(LISTEN_S)
        print("Done Listening")
        self.dot = self.buffer.all_frames_as_dot()
        self.picture: Any = show("tf_tree", self.buffer)
        Path(folder, "frames.gv").write_text(self.dot, encoding="utf-8")
        self.picture.save(Path(folder, "frames.svg"))
        print("frames.gv and frames.svg generated")
