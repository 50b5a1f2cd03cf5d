"""What goes between the page of something live (a pad, a view, a panel) and the graph behind it.

A page's messages arrive in the kernel's main thread, in a thread of JupyterLab's (a subshell) or in one of the page
server's (`rosmini.viz.live.loopback`). They go through the scheduler's inbox, and everything else happens in the graph.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

import anywidget
import traitlets

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node
    from rosmini.core.graph.lanes import Lane

LEFT_S = 3.0
"""A page that has sent nothing for this long [s] is closed: it is sent nothing more."""


class PageWidget(anywidget.AnyWidget):
    """The page of a pad, a view or a panel, as Jupyter knows it."""

    data = traitlets.Dict().tag(sync=True)

    elsewhere: Callable[[dict[str, Any], list[bytes] | None], None] | None = None
    """Takes what is sent to the page where a program serves it in place of Jupyter (`rosmini.viz.live.loopback`)."""

    def send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        """Send the page a message."""
        if self.elsewhere is None:
            super().send(content, buffers)
        else:
            self.elsewhere(content, buffers)

    @property
    def script(self) -> str:
        """The page's module."""
        return str(self._esm)

    @property
    def state(self) -> dict[str, Any]:
        """The data that the page starts from."""
        return dict(self.data)

    def hear(self, content: dict[str, Any]) -> None:
        """Take a message of the page, in any thread."""
        self._handle_custom_msg(content, [])


class PageLink(ABC):
    """Takes what a page sends and hands it to the graph. `clock` is wall time, in seconds."""

    acts: ClassVar[frozenset[str]]
    """The kinds of message that a hand causes; in a notebook they start a graph that stands still."""

    signs: ClassVar[frozenset[str]] = frozenset({"hello", "beat"})
    """The kinds that only say that a page is there; while the graph stands still they are answered and dropped."""

    def __init__(
        self, script: str, data: dict[str, Any], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._clock = clock
        self._heard = clock()
        self._lane: Lane | None = None
        self.widget = PageWidget(_esm=script, data=data)
        answer_in_subshells(self.widget.comm)
        self.widget.on_msg(self.receive)

    @property
    @abstractmethod
    def node(self) -> Node:
        """The node that acts for the page."""

    @property
    @abstractmethod
    def gone(self) -> str | None:
        """Why there is nothing to show any more, or None. Asked in the graph, and of a node that was shut down."""

    @abstractmethod
    def _take(self, kind: str | None, content: dict[str, Any]) -> None:
        """Do what a message says, in the graph."""

    def receive(self, _widget: object, content: dict[str, Any], _buffers: object) -> None:
        """Take a message of the page, in any thread."""
        self._heard = self._clock()
        node, graph, kind = self.node, self.node.graph, content.get("type")
        if node.is_shutdown():
            self._send({"type": "gone", "text": self.gone})
            return
        # Between two of its slices a program that serves the page does not drive the graph, but soon does again.
        is_driven = graph.is_live or graph.scheduler.driven or self.widget.elsewhere is not None
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
        """Have messages taken in order, though one may wait for the Master: a release must not overtake a press."""
        if self._lane is None or self._lane.dead:
            self._lane = self.node.spawn(f"{self.node.name} page")
        self._lane.submit(partial(self._take, kind, content))

    def _refuse(self, content: dict[str, Any], text: str) -> None:
        """Say on the page why a message was refused."""
        del content
        self._send({"type": "refused", "text": text})

    def _send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        self.widget.send(content, buffers)


def answer_in_subshells(comm: Any) -> None:
    """Let the page choose the thread that hears it.

    ipykernel 7.4 handles a page's messages where the kernel last sent it one. That is the main thread, which is busy
    while a cell runs: the stop key would wait for the cell's end.
    """
    if hasattr(comm, "_reply_subshell_for"):
        vars(comm)["_reply_subshell_for"] = lambda _data, asked: asked
