"""The log of a graph, as the window of ``rqt_console`` gathers it (http://wiki.ros.org/rqt_console)."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from rosmini.core.graph.show import show

if TYPE_CHECKING:
    from rosmini.core.graph.graph import Graph
    from rosmini.core.graph.node import Node

__all__ = ["Console"]


class Console:
    """Keeps what comes on ``/rosout_agg`` from now on; made by ``graph.console()``.

    Args:
        graph: whose log.
        limit: how many messages to keep, the newest; rqt_console's own limit if not given.
        name: of the node that listens.
        node: listens instead of one of its own, and goes on when the console is closed.

    """

    def __init__(
        self, graph: Graph, *, limit: int = 20000, name: str = "rqt_console", node: Node | None = None
    ) -> None:
        self._messages: deque[Any] = deque(maxlen=limit)
        self.total = 0
        """How many messages came; those over the limit are gone."""
        listener = graph.node(name) if node is None else node
        self._own = listener if node is None else None
        self._subscriber = listener.subscriber("/rosout_agg", graph.log_class, self._take)

    def _take(self, message: Any) -> None:
        self.total += 1
        self._messages.append(message)

    @property
    def messages(self) -> list[Any]:
        """The messages (``rosgraph_msgs/Log``), in the order in which they came."""
        return list(self._messages)

    def clear(self) -> None:
        """Forget all messages."""
        self._messages.clear()
        self.total = 0

    def close(self) -> None:
        """Listen no more. What came is kept."""
        self._subscriber.unregister()
        if self._own is not None:
            self._own.shutdown("the console was closed")

    def __repr__(self) -> str:
        return f"<Console with {len(self._messages)} messages>"

    def show(self, **filters: Any) -> Any:
        """Return a table of the messages, as the tool ``rqt_console`` shows them, the oldest first.

        Options, with what they are unless given:
            level='DEBUG': the lowest level that is shown, or a collection of the levels that are
            node='/': only these nodes: names or regular expressions with commas between, - excludes
            text='': only messages that contain this
            exclude='': no messages that contain this
            highlight='': mark messages that contain this
            regex=False: these three are regular expressions; else upper and lower case are alike
            topic='/': only messages of nodes that publish these topics, in the form of `node`
            location='': only messages whose `file:line function` contains this
            start=None: nothing earlier [s], or a `rosmini.Time`
            end=None: nothing later
            columns=('stamp', 'severity', 'node', 'message', 'location'): which columns, in which order
            limit=None: the newest so many of what passes the filters; None: all
            title=None: a caption under the table, and the first words of its text form
        """
        return show("log_console", self, **filters)
