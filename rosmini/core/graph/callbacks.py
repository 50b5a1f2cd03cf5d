"""User callbacks: how they are called, and how a failure is reported with its place and message."""

from __future__ import annotations

import linecache
import os
from abc import ABC, abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import CallbackError

from .rosout import OWN, source_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    from .node import Node

STANDARD_LIBRARY = str(Path(os.__file__).parent) + os.sep

SHOWN_LINES = 12
"""Maximum number of lines of a message that an error report shows."""


class Callback(NamedTuple):
    """A user's function, and the extra arguments that are passed to it after each message."""

    function: Callable[..., object]
    arguments: tuple[Any, ...]

    def caller(self) -> Callable[[Any], object]:
        """Return a function of a message that calls the user's function with all arguments."""
        function, arguments = self.function, self.arguments
        return (lambda message: function(message, *arguments)) if arguments else function


def describe_failure(
    error: BaseException, callback: Callable[..., object], where: str, message: Any, node: str
) -> CallbackError:
    """Return a ``CallbackError`` for ``error``: it shows callback, user's line, topic or service, and message."""
    name = getattr(callback, "__qualname__", None) or type(callback).__name__
    lines = [f"{name.rpartition('<locals>.')[2]} of {node}, called for {where}, raised {type(error).__name__}: {error}"]
    place = _users_line(error)
    if place is not None:
        lines.append(place)
    if message is not None:
        shown = str(message).splitlines()
        lines.append(f"  The message ({message._type}):")
        lines += [f"    {line}" for line in shown[:SHOWN_LINES]]
        if len(shown) > SHOWN_LINES:
            lines.append(f"    ... and {len(shown) - SHOWN_LINES} more lines")
    problem = CallbackError("\n".join(lines))
    problem.__cause__ = error
    return problem


def _users_line(error: BaseException) -> str | None:
    """Return the last line of the traceback outside rosmini and the standard library, as text, or None."""
    best: tuple[FrameType, int] | None = None
    trace = error.__traceback__
    while trace is not None:
        filename = trace.tb_frame.f_code.co_filename
        if not filename.startswith((OWN, STANDARD_LIBRARY)):
            best = (trace.tb_frame, trace.tb_lineno)
        trace = trace.tb_next
    if best is None:
        return None
    frame, number = best
    code = frame.f_code
    linecache.checkcache(code.co_filename)  # a notebook's cell may have written the script again
    text = linecache.getline(code.co_filename, number, frame.f_globals).strip()
    source = source_of(code.co_filename)
    return f"  {Path(source).name}, line {number}, in {code.co_name}" + (f": {text}" if text else "")


class TopicHandle(ABC):
    """Base class of `Publisher` and `Subscriber`.

    The callbacks ``on_connect`` and ``on_disconnect`` receive the name of the node that was connected or disconnected.
    """

    node: Node
    topic: str
    _on_connect: Callable[[str], object] | None
    _on_disconnect: Callable[[str], object] | None

    @abstractmethod
    def _unregister(self) -> None:
        """Leave the topic. Runs in the scheduler's thread."""

    @abstractmethod
    def detach(self) -> None:
        """End this handle after its node has shut down."""

    def unregister(self) -> None:
        """End this handle. The node leaves the topic when its last handle for it ends. Safe to call again."""
        self.node.scheduler.run_in_scheduler(self._unregister)

    def connected(self, peer: str) -> None:
        """Run ``on_connect`` after the node ``peer`` has been connected."""
        self._run_callback(self._on_connect, peer)

    def disconnected(self, peer: str) -> None:
        """Run ``on_disconnect`` after the node ``peer`` has been disconnected."""
        self._run_callback(self._on_disconnect, peer)

    def _run_callback(self, callback: Callable[[str], object] | None, peer: str) -> None:
        if callback is not None:
            self.node.spawn(
                f"{self.node.name} connections of {self.topic}",
                lambda: self.node.guarded(callback, peer, what=f"connection callback of {self.topic}"),
            )
