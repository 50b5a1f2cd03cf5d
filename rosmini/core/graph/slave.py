"""The slave API, which the Master, other nodes and tools call (http://wiki.ros.org/ROS/Slave_API).

Any thread may call it, such as one that reads a wire. It responds at once from a snapshot, which the scheduler's thread
updates, and posts the effects, so a callback that computes for long does not delay the response.
"""

# ruff: noqa: ARG002 - every call has a caller_id, whether it needs one or not
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from .connection import Connection
    from .node import Node
    from .publisher import Publication
    from .subscription import Subscription
    from .transport import Sender, Triple

METHODS = frozenset(
    [
        "getBusStats",
        "getBusInfo",
        "getMasterUri",
        "getName",
        "getUri",
        "shutdown",
        "getPid",
        "getSubscriptions",
        "getPublications",
        "paramUpdate",
        "publisherUpdate",
        "requestTopic",
    ]
)


class _Connections(NamedTuple):
    """The connections of a node: (topic, number, sender) if it publishes, (topic, connection) if it subscribes."""

    out: tuple[tuple[str, int, Sender], ...] = ()
    into: tuple[tuple[str, Connection], ...] = ()


class SlaveApi:
    """The slave API of one node; methods, codes and texts are ROS's."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._published: dict[str, str] = {}
        self._subscribed: dict[str, str] = {}
        self._connections = _Connections()
        self._is_stale = False

    # -- the snapshot, updated in the scheduler's thread ---------------------------------------------------------

    def topics_changed(self) -> None:
        """Update the snapshot of the topics that the node publishes and subscribes to."""
        publications: dict[str, Publication] = self._node.publications
        subscriptions: dict[str, Subscription] = self._node.subscriptions
        self._published = {topic: item.message_class._type for topic, item in publications.items()}
        self._subscribed = {topic: item.message_class._type for topic, item in subscriptions.items()}
        self.connections_changed()

    def end(self) -> None:
        """Stop offering topics: a subscriber that loses its connection may ask again before the Master notifies it."""
        self._published = {}

    def connections_changed(self) -> None:
        """Update the snapshot of the connections soon, because many change at once when a graph starts."""
        if not self._is_stale:
            self._is_stale = True
            self._node.scheduler.ready.append(self._renew)

    def _renew(self) -> None:
        self._is_stale = False
        publications: dict[str, Publication] = self._node.publications
        subscriptions: dict[str, Subscription] = self._node.subscriptions
        self._connections = _Connections(
            tuple((topic, *one) for topic, item in publications.items() for one in item.senders.items()),
            tuple((topic, one) for topic, item in subscriptions.items() for one in item.connections.values()),
        )

    def _current(self) -> _Connections:
        if self._is_stale and self._node.scheduler.is_scheduler_thread():
            self._renew()
        return self._connections

    def _post(self, effect: Callable[[], None]) -> None:
        """Run ``effect`` in the scheduler's thread; immediately if this is that thread."""
        scheduler = self._node.scheduler
        if scheduler.is_scheduler_thread():
            effect()
        else:
            scheduler.call_soon_threadsafe(effect)

    # -- the calls -----------------------------------------------------------------------------------------------

    def call(self, method: str, *arguments: Any) -> Triple:
        """Return the response to a call by method name; an unknown name or wrong arguments give code -1."""
        if method not in METHODS:
            return [-1, f'method "{method}" is not supported', 0]
        if not arguments:
            return [-1, "missing required caller_id parameter", 0]
        if not isinstance(arguments[0], str):
            return [-1, "caller_id must be a string", 0]
        function: Callable[..., Triple] = getattr(self, method)
        try:
            return function(*arguments)
        except TypeError as error:
            if error.__traceback__ is not None and error.__traceback__.tb_next is None:
                return [-1, f"{method} invoked with the wrong arguments: {error}", 0]
            raise

    def getBusStats(self, caller_id: str) -> Triple:
        """Return statistics of each connection: [publish stats, subscribe stats, service stats].

        A publisher's row has a fifth value that ROS does not have: the number of dropped messages.
        """
        now = self._current()
        publish: dict[str, list[Any]] = {topic: [] for topic in self._published}
        for topic, number, sender in now.out:
            publish.setdefault(topic, []).append([number, 0, sender.sent, True, sender.dropped])
        subscribe: dict[str, list[Any]] = {topic: [] for topic in self._subscribed}
        for topic, link in now.into:
            subscribe.setdefault(topic, []).append([link.id, link.bytes_received, link.dropped, link.is_open])
        stats = [
            [[topic, 0, rows] for topic, rows in publish.items()],
            [[topic, rows] for topic, rows in subscribe.items()],
            [],
        ]
        return [1, "", stats]

    def getBusInfo(self, caller_id: str) -> Triple:
        """Return one row per connection: [id, destination, direction, transport, topic, connected, description]."""
        now = self._current()
        rows: list[list[Any]] = [
            [number, sender.destination, "o", sender.protocol, topic, True, _info(sender, sender.destination)]
            for topic, number, sender in now.out
        ]
        rows += [
            [link.id, link.uri, "i", link.protocol, topic, link.is_open, _info(link, link.peer)]
            for topic, link in now.into
        ]
        return [1, "bus info", rows]

    def getMasterUri(self, caller_id: str) -> Triple:
        """Return the URI of the node's Master."""
        uri = self._node.graph.master_uri
        return [1, uri, uri]

    def getName(self, caller_id: str) -> Triple:
        """Return the node's name; only rospy's nodes have this call."""
        return [1, "", self._node.name]

    def getUri(self, caller_id: str) -> Triple:
        """Return the node's own URI; only rospy's nodes have this call."""
        return [1, "", self._node.uri]

    def shutdown(self, caller_id: str, msg: str = "") -> Triple:
        """Shut the node down. The Master calls this on the older of two nodes of one name, ``rosnode kill`` on any."""
        self._post(lambda: self._node.shutdown_requested(caller_id, str(msg)))
        return [1, "shutdown", 0]

    def getPid(self, caller_id: str) -> Triple:
        """Return the process id."""
        return [1, "", os.getpid()]

    def getSubscriptions(self, caller_id: str) -> Triple:
        """Return ``[topic, type]`` for each topic that the node subscribes to."""
        return [1, "subscriptions", [list(pair) for pair in self._subscribed.items()]]

    def getPublications(self, caller_id: str) -> Triple:
        """Return ``[topic, type]`` for each topic that the node publishes."""
        return [1, "publications", [list(pair) for pair in self._published.items()]]

    def paramUpdate(self, caller_id: str, parameter_key: str, parameter_value: Any) -> Triple:
        """Refuse a notice that a parameter has changed: no node of this process subscribes to parameters."""
        return [-1, _name_problem("parameter_key", parameter_key) or "not subscribed", 0]

    def publisherUpdate(self, caller_id: str, topic: str, publishers: list[str]) -> Triple:
        """Handle a notice that the publishers of a topic have changed: ``publishers`` are their URIs now."""
        problem = _name_problem("topic", topic)
        if not problem and not (isinstance(publishers, list) and all(map(_is_uri, publishers))):
            problem = "ERROR: parameter [publishers] must be a list of URIs"
        if problem:
            return [-1, problem, -1]
        self._post(lambda: self._node.publishers_changed(topic, publishers))
        return [1, "", 0]

    def requestTopic(self, caller_id: str, topic: str, protocols: list[list[Any]]) -> Triple:
        """Return the connection parameters of a topic that this node publishes, for the first protocol that suits."""
        problem = _name_problem("topic", topic)
        if not problem and not (isinstance(protocols, list) and protocols and all(map(_is_protocol, protocols))):
            problem = "ERROR: parameter [protocols] must be specified and non-empty: a list of lists"
        if problem:
            return [-1, problem, []]
        node = self._node
        published = topic in self._published
        parameters = node.graph.transport.topic_parameters(node.uri, protocols) if published else None
        if not published or (parameters is None and node.is_shutdown()):  # the node may end during the call
            return [-1, f"Not a publisher of [{topic}]", []]
        if parameters is None:
            return [0, "no supported protocol implementations", []]
        return [1, f"ready on {node.uri}", parameters]


def _name_problem(argument: str, name: Any) -> str:
    """Return the problem with the name of a topic or a parameter, or an empty text; the texts are rospy's."""
    if not isinstance(name, str) or not name:
        return f"ERROR: parameter [{argument}] must be a non-empty string"
    if ":" in name or " " in name:
        return f"ERROR: parameter [{argument}] contains illegal chars"
    if name == "/":
        return f"ERROR: parameter [{argument}] cannot be the global namespace"
    return ""


def _is_uri(value: Any) -> bool:
    return isinstance(value, str) and all(value.partition("://"))


def _is_protocol(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], str)


def _info(end: Sender | Connection, peer: str) -> str:
    return end.info or f"{end.protocol} connection to [{peer}]"
