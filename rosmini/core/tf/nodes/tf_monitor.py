"""`tf/tf_monitor`: lists the senders of transforms, with rates and delays (http://wiki.ros.org/tf#tf_monitor)."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ScriptError
from rosmini.core.tf.buffer import Buffer
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from rosmini.core.graph import Node

KEPT = 1000
"""Number of latest messages of a node, or transforms of a frame, used for the statistics."""


class Delays:
    """Delays of the latest transforms of one sender or frame [s]."""

    def __init__(self) -> None:
        self.times: deque[float] = deque(maxlen=KEPT)
        self.delays: deque[float] = deque(maxlen=KEPT)
        self.sender = ""

    def add(self, now: float, delay: float) -> None:
        """Add a transform received at `now`."""
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
    """Prints statistics once a second, for all frames or for the chain between two.

    Raises `ScriptError` if only one frame is given.
    """

    def __init__(self, node: Node, framea: str = "", frameb: str = "") -> None:
        if bool(framea) != bool(frameb):
            raise ScriptError(
                "Usage: tf_monitor or tf_monitor framea frameb: two frames make a chain, none means all"
            )
        self.node = node
        self.chain = (framea.lstrip("/"), frameb.lstrip("/")) if framea else None
        self.buffer = Buffer(node)
        self.senders: dict[str, Delays] = {}
        self.frames: dict[str, Delays] = {}
        self.net = Delays()
        kind = message_class("tf2_msgs/TFMessage")
        node.subscriber("/tf", kind, lambda data: self._hear(data, static=False), numpy=False)
        node.subscriber("/tf_static", kind, lambda data: self._hear(data, static=True), numpy=False)
        if self.chain:
            print(f"Waiting for transform chain to become available between {framea} and {frameb} ")
        self.timer = node.timer(1.0, lambda _event: self.report())

    def _hear(self, data: Any, *, static: bool) -> None:
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
        wanted = sorted(self.frames)
        if self.chain is None:
            head = "RESULTS: for all Frames"
        elif self.buffer.tree.why_not(*self.chain):
            return
        else:
            way = self.buffer.tree.chain(*self.chain)[::-1]
            wanted = [frame for frame in way if frame in self.frames]
            delays = self.net.delays
            head = (
                f"RESULTS: for {self.chain[0]} to {self.chain[1]}\nChain is: {' -> '.join(way)}\n"
                f"Net delay     avg = {sum(delays) / len(delays):.6g}: max = {max(0.0, *delays):.6g}"
            )
        lines = [head, "", "Frames:"]
        lines += [
            f"Frame: {frame} published by {self.frames[frame].sender} {self.frames[frame]}"
            for frame in wanted
        ]
        lines += ["", "All Broadcasters:"]
        lines += [
            f"Node: {name} {delays.rate:.6g} Hz, {delays}" for name, delays in sorted(self.senders.items())
        ]
        print("\n".join(["", "", "", *lines]))
