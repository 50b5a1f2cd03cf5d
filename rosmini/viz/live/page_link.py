"""The link between the page of a live view (pad, simulation view or panel) and its graph.

A page's messages arrive in the kernel's main thread, in a JupyterLab thread (a subshell) or in a thread of the page
server (`rosmini.viz.live.loopback`). They pass through the scheduler's inbox; all other work happens in the graph.
"""

from __future__ import annotations

import sys
import time
from abc import ABC, abstractmethod
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.errors import RosminiError

if sys.platform == "emscripten":
    from .own_widget import new_widget
else:
    from .jupyter_widget import new_widget

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.core.graph import Node
    from rosmini.core.graph.lanes import Lane

LEFT_S = 3.0
"""Timeout [s] after which a silent page counts as closed and receives no more messages."""


class PageLink(ABC):
    """Receives a page's messages and passes them to the graph.

    Args:
        scripts: scripts of `rosmini/viz/static/`, in the order in which they run.
        driver: the global object that they set, with the function `render`.
        data: initial data of the page.
        clock: returns wall-clock time [s].

    """

    acts: ClassVar[frozenset[str]]
    """Kinds of message that a user's action causes; in a notebook they start a stopped graph."""

    signs: ClassVar[frozenset[str]] = frozenset({"hello", "beat"})
    """Kinds that only report that a page exists; while the graph is stopped they are answered and dropped."""

    def __init__(
        self, scripts: Sequence[str], driver: str, data: dict[str, Any], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._clock = clock
        self._heard = clock()
        self._lane: Lane | None = None
        self.widget = new_widget(scripts, driver, data)
        answer_in_subshells(self.widget.comm)
        self.widget.on_msg(self.receive)

    @property
    @abstractmethod
    def node(self) -> Node:
        """The node that acts for the page."""

    @property
    @abstractmethod
    def gone(self) -> str | None:
        """Reason why there is nothing left to show, or None. Called in the graph, also after the node was shut down."""

    @abstractmethod
    def _take(self, kind: str | None, content: dict[str, Any]) -> None:
        """Carry out a message, in the graph."""

    def receive(self, _widget: object, content: dict[str, Any], _buffers: object) -> None:
        """Receive a message from the page, in any thread."""
        self._heard = self._clock()
        node, graph, kind = self.node, self.node.graph, content.get("type")
        if node.is_shutdown():
            self._send({"type": "gone", "text": self.gone})
            return
        # Between two slices a program that serves the page does not drive the graph, but it soon will again.
        is_driven = graph.is_live or graph.scheduler.driven or self.widget.sink is not None
        if kind in self.acts and not graph.is_live:
            try:
                graph.live()
            except RosminiError as error:
                if not is_driven:
                    self._refuse(content, str(error))
                    return
        elif not is_driven and kind in self.signs:
            self._send({"type": "still"})
            return
        graph.scheduler.call_soon_threadsafe(partial(self._queue, kind, content))

    def _queue(self, kind: str | None, content: dict[str, Any]) -> None:
        """Queue messages in order even if one must wait for the Master: a release must not overtake a press."""
        if self._lane is None or self._lane.dead:
            self._lane = self.node.spawn(f"{self.node.name} page")
        self._lane.submit(partial(self._take, kind, content))

    def _refuse(self, content: dict[str, Any], text: str) -> None:
        """Tell the page why a message was refused."""
        del content
        self._send({"type": "refused", "text": text})

    def _send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        self.widget.send(content, buffers)


def answer_in_subshells(comm: Any) -> None:
    """Let the page choose the thread that receives its messages.

    ipykernel 7.4 handles a page's messages in the thread that last sent it one. That is the main thread, which is busy
    while a cell runs, so the stop key would wait for the end of the cell.
    """
    if hasattr(comm, "_reply_subshell_for"):
        vars(comm)["_reply_subshell_for"] = lambda _data, asked: asked
