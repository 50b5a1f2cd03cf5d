"""The window of turtlesim in a terminal: a local page, as for `rosmini rviz`.

The page shows the turtles and their trails, and drives them by keys. Its node, `/teleop_pad`, starts when the page is
first opened: until then the graph has the same nodes as in ROS.
"""

from __future__ import annotations

import sys
import threading
from concurrent.futures import Future
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from .loopback import PageServer, open_window

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.sim.turtlesim import TurtleSim

    from .live import Link
    from .pad import TeleopPad

PATIENCE_S = 10.0
"""Time for which a page waits for its node [s]."""


class PadOnDemand:
    """The page of a pad for turtles; the graph creates the pad when a page first requests it."""

    def __init__(self, sim: TurtleSim) -> None:
        self._sim = sim
        self._pad: TeleopPad | None = None
        self._lock = threading.Lock()
        self._sink: Callable[..., None] | None = None

    @property
    def sink(self) -> Any:
        """Receives the messages to the page."""
        return self._sink

    @sink.setter
    def sink(self, send: Any) -> None:
        self._sink = send
        if self._pad is not None:
            self._pad.link.widget.sink = send

    @property
    def script(self) -> str:
        """JavaScript module of the page."""
        return self._link().widget.script

    @property
    def state(self) -> dict[str, Any]:
        """Initial data of the page, including all present turtles."""
        link = self._link()
        return {**link.widget.state, "choices": list(link.pad.choices)}

    def hear(self, content: dict[str, Any]) -> None:
        """Receive a message from the page."""
        self._link().widget.hear(content)

    def _link(self) -> Link:
        with self._lock:
            if self._pad is None or self._pad.node.is_shutdown():
                made: Future[TeleopPad] = Future()
                node = self._sim.node
                node.scheduler.call_soon_threadsafe(
                    lambda: node.spawn("the window of turtlesim", lambda: self._make(made))
                )
                self._pad = made.result(PATIENCE_S)
            link: Link = self._pad.link
            return link

    def _make(self, made: Future[TeleopPad]) -> None:
        try:
            pad: TeleopPad = self._sim.pad()
            pad.link.widget.sink = self._sink
        except Exception as error:  # it belongs to the page, whose thread waits for it
            made.set_exception(error)
        else:
            made.set_result(pad)


def turtle_window(sim: TurtleSim) -> PageServer | None:
    """The renderer "turtle_window": serve the window until the node shuts down, and print its address."""
    name = sim.node.name.lstrip("/")
    if find_spec("anywidget") is None:
        print(f"{name}: its window needs `pip install anywidget`", file=sys.stderr, flush=True)
        return None
    server = PageServer(PadOnDemand(sim), title=name)
    sim.node.on_shutdown(server.close)
    open_window(server, name)
    return server
