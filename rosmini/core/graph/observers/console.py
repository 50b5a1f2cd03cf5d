"""Collection of a graph's log messages, as in ``rqt_console`` (http://wiki.ros.org/rqt_console)."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from rosmini.core.graph.show import show

if TYPE_CHECKING:
    from rosmini.core.graph.graph import Graph
    from rosmini.core.graph.node import Node


class Console:
    """Collects the messages on ``/rosout_agg`` from now on; made by ``graph.console()``.

    Args:
        graph: the graph whose log is collected.
        limit: maximum number of messages to keep (the newest); by default rqt_console's own limit.
        name: name of the node that listens.
        node: an existing node to use as the listener; it continues when the console is closed.

    """

    def __init__(
        self, graph: Graph, *, limit: int = 20000, name: str = "rqt_console", node: Node | None = None
    ) -> None:
        self._messages: deque[Any] = deque(maxlen=limit)
        self.total = 0
        """Number of messages received, including those dropped because of the limit."""
        listener = graph.node(name) if node is None else node
        self._own = listener if node is None else None
        self._subscriber = listener.subscriber("/rosout_agg", graph.log_class, self._take)

    def _take(self, message: Any) -> None:
        self.total += 1
        self._messages.append(message)

    @property
    def messages(self) -> list[Any]:
        """The messages (``rosgraph_msgs/Log``), in the order in which they arrived."""
        return list(self._messages)

    def clear(self) -> None:
        """Remove all messages."""
        self._messages.clear()
        self.total = 0

    def close(self) -> None:
        """Stop listening. The collected messages are kept."""
        self._subscriber.unregister()
        if self._own is not None:
            self._own.shutdown("the console was closed")

    def __repr__(self) -> str:
        return f"<Console with {len(self._messages)} messages>"

    def show(self, **filters: Any) -> Any:
        """Return a table of the messages, as the tool ``rqt_console`` shows them, oldest first.

        Options, with their defaults:
            level='DEBUG': the lowest level that is shown, or a collection of the levels that are shown
            node='/': only these nodes: names or regular expressions separated by commas; - excludes
            text='': only messages that contain this text
            exclude='': no messages that contain this text
            highlight='': mark messages that contain this text
            regex=False: True if these three are regular expressions; otherwise they ignore case
            topic='/': only messages of nodes that publish these topics, in the same form as `node`
            location='': only messages whose `file:line function` contains this text
            start=None: no earlier messages [s], or a `rosmini.Time`
            end=None: no later messages
            columns=('stamp', 'severity', 'node', 'message', 'location'): the columns, in order
            limit=None: maximum number of messages after filtering, the newest; None for all
            title=None: a caption under the table, and the first words of its text form
        """
        return show("log_console", self, **filters)
