"""The graph as displays see it: time, frames, the fixed frame, and a node that only subscribes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Node
from rosmini.core.tf import Buffer, ExtrapolationException, FrameTree, TransformException
from rosmini.core.tf.rigid import IDENTITY, Rigid

TF_CACHE_S = 600.0
"""Duration of tf's past that RViz stores [s]."""
FIXED_FRAME = "<Fixed Frame>"
"""The fixed frame, as the value of a property that names a frame."""


class NoMessages(NamedTuple):
    """The reason why no message arrives on a topic, and whether waiting would be pointless."""

    text: str
    is_permanent: bool = False


class Context:
    """The graph as displays see it; `fixed_frame` is the frame in which everything is drawn."""

    def __init__(self, node: Node, fixed_frame: str) -> None:
        self.node = node
        self.buffer = Buffer(node, TF_CACHE_S)
        self.fixed_frame = fixed_frame
        self._types: dict[str, str] | None = None
        self._publishers: dict[str, list[str]] = {}

    @property
    def tree(self) -> FrameTree:
        """The frames known from tf."""
        return self.buffer.tree

    @property
    def now_ns(self) -> int:
        """The time of the node [ns]."""
        return self.node.clock.now_ns()

    def refresh(self) -> None:
        """Discard the Master's answers, so that the next question asks again."""
        self._types = None

    def place(self, frame: str, stamp_ns: int = 0) -> Rigid:
        """Return the pose of a frame in the fixed frame at a time [ns]; 0 means the latest known.

        Raises `TransformException` if it is unknown.
        """
        frame = self.fixed_frame if frame == FIXED_FRAME else frame.lstrip("/")
        if frame == self.fixed_frame:
            return IDENTITY
        return self.tree.lookup(self.fixed_frame, frame, stamp_ns).transform

    def knows(self, frame: str) -> bool:
        """Return True if tf has a frame and the fixed frame; otherwise a lookup would fail."""
        name = frame.lstrip("/")
        return frame == FIXED_FRAME or name == self.fixed_frame or (name in self.tree and self.fixed_frame in self.tree)

    def is_past(self, frame: str, stamp_ns: int) -> bool:
        """Return True if a transform is missing because its time is too long ago for it to arrive any more."""
        try:
            return 0 < stamp_ns < self.tree.latest_common_time(self.fixed_frame, frame.lstrip("/"))
        except TransformException:
            return False

    def problem(self, frame: str, error: TransformException | None = None) -> str:
        """Return RViz's message for a frame that cannot be transformed to the fixed frame."""
        name = frame.lstrip("/")
        if self.fixed_frame not in self.tree:
            reason = f"Fixed Frame [{self.fixed_frame}] does not exist"
        elif name not in self.tree:
            reason = f"Frame [{name}] does not exist"
        else:
            late = isinstance(error, ExtrapolationException)
            said = str(error).partition("\n")[0]
            reason = (
                f"No transform from [{name}] to fixed frame [{self.fixed_frame}]"
                f"{' at that time' if late else ''}. TF error: [{said}]"
            )
        return f"For frame [{name}]: {reason}"

    def why_no_messages(self, topic: str, kind: str) -> NoMessages:
        """Return the reason why no message of a type arrived on a topic, as far as the Master knows."""
        if self._types is None:
            try:
                master = self.node.graph.ask_as(self.node.name)
                self._types = {str(name): str(each) for name, each in master.ask("getTopicTypes")}
                state = master.ask("getSystemState")
                self._publishers = {str(name): list(nodes) for name, nodes in state[0]}
            except RosminiError:
                self._types = {}
        name = self.node.resolve(topic)
        publishers = self._publishers.get(name, [])
        found = self._types.get(name, kind)
        if publishers and found not in (kind, "*"):
            return NoMessages(f"{name} has the type {found}, and this display shows {kind}", is_permanent=True)
        if not publishers:
            return NoMessages(f"nobody publishes {name}")
        return NoMessages(f"{', '.join(sorted(publishers))} published nothing yet")

    def subscribe(
        self, topic: str, kind: str, callback: Callable[[Any], object], queue_size: int | None
    ) -> Callable[[], None]:
        """Call `callback` for each message on a topic, until the returned function is called.

        Raises the errors of `Node.subscriber`.
        """
        from rosmini.msgs import message_class

        handle = self.node.subscriber(topic, message_class(kind), callback, queue_size=queue_size)
        return handle.unregister
