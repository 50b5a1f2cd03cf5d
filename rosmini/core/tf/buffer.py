"""Buffers that store transforms from messages and look them up, with tf2's names (http://wiki.ros.org/tf2)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException
from rosmini.core.time import Duration, Time

from .errors import TransformException
from .messages import from_transform, to_stamped, transformed
from .rigid import Floats, transform_points
from .tree import CACHE_NS, FrameTree
from .wording import draw

if TYPE_CHECKING:
    from rosmini.core.graph import Node, Waiter

LATEST = Time()
"""The time 0: a lookup then uses the latest time for which all transforms of the chain are known."""


class BufferCore:
    """A buffer of transforms that works without a node; `tree` stores them as numbers.

    `cache_time` is the length of the history, in seconds or as a `Duration` (10 s if None).
    """

    def __init__(self, cache_time: float | Duration | None = None) -> None:
        self.tree = FrameTree(
            CACHE_NS if cache_time is None else span_ns(cache_time), warn=self._warn, now_ns=self._clock()
        )

    def _warn(self, text: str) -> None:
        import sys

        sys.stderr.write(f"Warning: {text}\n")

    def _clock(self) -> Callable[[], int] | None:
        return None

    # -- incoming transforms -------------------------------------------------------------------------------------

    def set_transform(self, transform: Any, authority: str = "default_authority") -> bool:
        """Add a `geometry_msgs/TransformStamped` from the node `authority`; return True if it was accepted.

        A leading `/` of a frame's name is removed, as in tf2.
        """
        return self._set(transform, authority, static=False)

    def set_transforms(self, transforms: Iterable[Any], authority: str = "default_authority") -> None:
        """Add each `geometry_msgs/TransformStamped`, for example all of a `tf2_msgs/TFMessage`."""
        for transform in transforms:
            self._set(transform, authority, static=False)

    def set_transform_static(self, transform: Any, authority: str = "default_authority") -> bool:
        """Add a transform that is valid at all times; return True if it was accepted."""
        return self._set(transform, authority, static=True)

    def _set(self, message: Any, authority: str, *, static: bool) -> bool:
        return self.tree.set(
            message.header.frame_id.lstrip("/"),
            message.child_frame_id.lstrip("/"),
            from_transform(message.transform),
            message.header.stamp.to_nsec(),
            authority,
            static=static,
        )

    def clear(self) -> None:
        """Remove all transforms except static ones, as tf does when time jumps back."""
        self.tree.clear()

    # -- queries -------------------------------------------------------------------------------------------------

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Time) -> Any:
        """Return the pose of `source_frame` in `target_frame`, as a `geometry_msgs/TransformStamped`.

        Raises the same errors as `FrameTree.lookup`.
        """
        found = self.tree.lookup(target_frame, source_frame, time.to_nsec())
        return to_stamped(target_frame, source_frame, *found)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> Any:
        """Return the pose of the source frame at `source_time` in the target frame at `target_time`.

        `fixed_frame` is a frame that does not move in between. Raises the same errors as `FrameTree.lookup`.
        """
        found = self.tree.lookup_full(
            target_frame, target_time.to_nsec(), source_frame, source_time.to_nsec(), fixed_frame
        )
        return to_stamped(target_frame, source_frame, *found)

    def can_transform_core(self, target_frame: str, source_frame: str, time: Time) -> tuple[bool, str]:
        """Return whether a lookup would succeed, and the error message if not."""
        return _verdict(lambda: self.lookup_transform_core(target_frame, source_frame, time))

    def can_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> tuple[bool, str]:
        """Return whether the lookup with two times would succeed, and the error message if not."""
        return _verdict(
            lambda: self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)
        )

    def get_latest_common_time(self, source_frame: str, dest_frame: str) -> Time:
        """Return the latest time for which all transforms between two frames are known; 0 if all are static.

        Raises the same errors as `FrameTree.lookup`.
        """
        return Time.from_nsec(self.tree.latest_common_time(source_frame, dest_frame))

    # -- contents ------------------------------------------------------------------------------------------------

    def all_frames_as_string(self) -> str:
        """Return a line for each frame that has a parent, in tf's words."""
        return "".join(
            f"Frame {frame} exists with parent {edge.newest.parent}.\n" for frame, edge in self.tree.edges.items()
        )

    def all_frames_as_dot(self) -> str:
        """Return the tree for graphviz, in the format of `view_frames`."""
        edges = "".join(
            f'"{edge.newest.parent}" -> "{frame}"[label="Broadcaster: {edge.newest.authority}\\nAverage rate: '
            f"{edge.rate:.3f} Hz\\nMost recent transform: {edge.newest_ns / 1e9:.3f} \\nBuffer length: "
            f'{edge.span_ns / 1e9:.3f} sec\\n"];\n'
            for frame, edge in self.tree.edges.items()
        )
        return f"digraph G {{\n{edges}}}\n"

    def __str__(self) -> str:
        return draw(self.tree) or "(no frame)"


class Buffer(BufferCore):
    """A node's buffer, whose lookups can wait for transforms: they block the calling lane, not the rest of the graph.

    >>> from rosmini import Graph
    >>> from rosmini.core.tf import Buffer, TransformBroadcaster, TransformListener
    >>> graph = Graph()
    >>> node = graph.node("looker")
    >>> buffer = Buffer(node)
    >>> listener = TransformListener(node, buffer)
    >>> broadcaster = TransformBroadcaster(graph.node("robot"))
    >>> timer = broadcaster.node.timer(0.1, lambda event: broadcaster.send("odom", "base", (1, 2, 0)))
    >>> buffer.lookup_transform("odom", "base", timeout=1.0).transform.translation.y
    2.0
    """

    def __init__(self, node: Node | None, cache_time: float | Duration | None = None) -> None:
        self._node = node
        self._waiting: dict[Waiter, Callable[[], bool]] = {}
        self._watching: list[Callable[[], object]] = []
        self._several = False
        super().__init__(cache_time)

    @property
    def node(self) -> Node:
        """The node whose clock and log are used. Raises `TransformException` if there is none."""
        if self._node is None:
            raise TransformException("this buffer has no node: give it one to let it wait")
        return self._node

    def _warn(self, text: str) -> None:
        self.node.logwarn(text)

    def _warn_once(self, text: str) -> None:
        if self.node.logger.gates.is_first(text):
            self._warn(text)

    def _clock(self) -> Callable[[], int]:
        return lambda: self.node.clock.now_ns()  # noqa: PLW0108 - a script's node is created later

    def _set(self, message: Any, authority: str, *, static: bool) -> bool:
        taken = super()._set(message, authority, static=static)
        if taken and not self._several:
            self._changed()
        return taken

    def set_transforms(self, transforms: Iterable[Any], authority: str = "default_authority") -> None:
        """Add several transforms; wake waiters and call watchers once, after the last one."""
        self._several = True
        try:
            super().set_transforms(transforms, authority)
        finally:
            self._several = False
        self._changed()

    def _changed(self) -> None:
        for waiter, ready in list(self._waiting.items()):
            if ready():
                self._waiting.pop(waiter, None)
                waiter.wake()
        for watcher in list(self._watching):
            watcher()

    def watch(self, callback: Callable[[], object]) -> Callable[[], None]:
        """Call `callback()` after each addition of transforms; return a function that stops this."""
        self._watching.append(callback)
        return lambda: self._watching.remove(callback)

    def _wait(self, ready: Callable[[], bool], timeout: float | Duration, what: str) -> bool:
        span = span_ns(timeout)
        if ready():
            return True
        if span <= 0:
            return False
        node = self.node
        waiter = node.waiter(what)
        node.scheduler.run_in_scheduler(lambda: self._waiting.__setitem__(waiter, ready))
        try:
            return node.wait(waiter, timeout_ns=span) or ready()
        finally:
            self._waiting.pop(waiter, None)

    def wait_for_transform(
        self, target_frame: str, source_frame: str, time: Time = LATEST, timeout: float | Duration = 1.0
    ) -> bool:
        """Block until a lookup would succeed, for at most `timeout` seconds; return whether it would.

        Raises `ROSInterruptException` if the node shuts down meanwhile.
        """
        stamp = time.to_nsec()
        return self._wait(
            lambda: self.tree.knows(target_frame, source_frame, stamp),
            timeout,
            f"the transform from {source_frame} to {target_frame}",
        )

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time = LATEST,
        timeout: float | Duration = 0.0,
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Return whether a lookup succeeds within `timeout` [s]; with `return_debug_tuple`, also the error message."""
        self.wait_for_transform(target_frame, source_frame, time, timeout)
        verdict = self.can_transform_core(target_frame, source_frame, time)
        return verdict if return_debug_tuple else verdict[0]

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: float | Duration = 0.0,
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Return whether the lookup with two times succeeds within `timeout` [s]; see `can_transform`."""
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(lambda: self.can_transform_full_core(*arguments)[0], timeout, _full(*arguments))
        verdict = self.can_transform_full_core(*arguments)
        return verdict if return_debug_tuple else verdict[0]

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time = LATEST, timeout: float | Duration = 0.0
    ) -> Any:
        """Return the pose of `source_frame` in `target_frame` as a `TransformStamped`; wait for it up to `timeout` [s].

        Raises the same errors as `FrameTree.lookup`, and `ROSInterruptException` if the node shuts down meanwhile.
        """
        self.wait_for_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: float | Duration = 0.0,
    ) -> Any:
        """Return the pose of the source frame at `source_time` in the target frame at `target_time`.

        `fixed_frame` is a frame that does not move in between. Waits up to `timeout` [s]; raises as `lookup_transform`.
        """
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(lambda: self.can_transform_full_core(*arguments)[0], timeout, _full(*arguments))
        return self.lookup_transform_full_core(*arguments)

    def transform(self, object_stamped: Any, target_frame: str, timeout: float | Duration = 0.0) -> Any:
        """Return a copy of a stamped point, vector, pose, quaternion, wrench or cloud, transformed to `target_frame`.

        Uses the transform at the time in its header. Raises the errors of `lookup_transform`, and `TransformException`
        for a message of another type.
        """
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id.lstrip("/"), header.stamp, timeout)
        return transformed(object_stamped, found, self._warn_once)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: float | Duration = 0.0,
    ) -> Any:
        """Transform as `transform` does, but to the target frame at `target_time`; see `lookup_transform_full`."""
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id.lstrip("/"), header.stamp, fixed_frame, timeout
        )
        return transformed(object_stamped, found, self._warn_once)

    def transform_points(self, points: Any, target_frame: str, source_frame: str, time: Time = LATEST) -> Floats:
        """Return the points (..., 3) [m], given in `source_frame`, in `target_frame`.

        Raises the same errors as `FrameTree.lookup`. `scan_points` returns the points of a laser scan.
        """
        found = self.tree.lookup(target_frame, source_frame, time.to_nsec())
        return transform_points(found.transform, points)

    def show(self, **options: Any) -> Any:
        """Show a picture of the tree, as `rqt_tf_tree` draws it.

        Options and their defaults:
            title=None: a caption under the picture, and the first words of its text form
        """
        from rosmini.core.graph.show import show

        return show("tf_tree", self, **options)


def _full(target: str, _target_time: Time, source: str, _source_time: Time, fixed: str) -> str:
    return f"the transform from {source} to {target} by way of {fixed}"


def _verdict(ask: Callable[[], object]) -> tuple[bool, str]:
    try:
        ask()
    except ROSInterruptException:
        raise
    except TransformException as error:
        return False, str(error)
    return True, ""


def span_ns(span: float | Duration) -> int:
    """Return seconds, or a duration, in nanoseconds."""
    return span.to_nsec() if isinstance(span, Duration) else int(span * 1e9)
