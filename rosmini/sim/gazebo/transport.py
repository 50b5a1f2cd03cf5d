"""Gazebo's own Master and its topics, beside ROS's (http://classic.gazebosim.org/tutorials?tut=components).

Gazebo was a program before it was a ROS node: its server and its client find each other by a Master of Gazebo's own,
which gzserver starts and GAZEBO_MASTER_URI names. It is built here of the same parts as ROS's: the same Master, which
only introduces nodes to each other, and the same links between them. It has its own address, its own names, and the
messages of `rosmini.sim.gazebo.msgs`; it knows nodes by host and port alone.

>>> from rosmini import Graph
>>> from rosmini.sim.gazebo.msgs import Time
>>> graph = Graph()
>>> master = GazeboMaster(graph, address(), "gzserver", "default")
>>> server, client = TransportNode(master, "server"), TransportNode(master, "client")
>>> publisher = server.advertise("~/clock", Time)
>>> client.subscribe("~/clock", print)
>>> publisher.publish(Time(7))
>>> graph.run(0.0).reason
sec: 7
nsec: 0
'time'
>>> master.topics()
{'/gazebo/default/clock': 'gazebo.msgs.Time'}
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, NoReturn, TypeVar

from rosmini.errors import TransportException, TransportInitError, nearest
from rosmini.graph.graph_core import GraphCore
from rosmini.graph.lanes import Lane
from rosmini.graph.master import Master
from rosmini.graph.transport import Endpoint, Header, LocalTransport, Sender, Triple

from .errors import GazeboError
from .msgs import Message

VARIABLE, DEFAULT = "GAZEBO_MASTER_URI", "http://localhost:11345"

HOST = "GAZEBO_IP"
"""The environment variable by which a program of Gazebo's says at which address it is."""

LOOPBACK, FIRST_PORT = "127.0.0.1", 49152
"""The addresses of nodes: ports from the first dynamic one on. All is one process, so nobody listens there."""

_NO_NAME = str.maketrans(": ", "__")

M = TypeVar("M", bound=Message)

_RUNNING: weakref.WeakKeyDictionary[GraphCore, dict[str, GazeboMaster]] = weakref.WeakKeyDictionary()


def address() -> str:
    """Where the Master is, or is looked for."""
    return os.environ.get(VARIABLE) or DEFAULT


def start_master(graph: GraphCore, owner: str, namespace: str) -> GazeboMaster:
    """Start the Master of a server, the node `owner`. Raises `GazeboError` if there is one at the address."""
    uri, there = address(), _RUNNING.setdefault(graph, {})
    if uri in there:
        raise GazeboError(
            f"Unable to start server[bind: Address already in use]: {there[uri].owner} runs at {uri}. One server is "
            f"enough for many robots; for a second world set {VARIABLE} to another address"
        )
    there[uri] = GazeboMaster(graph, uri, owner, namespace)
    return there[uri]


def find_master(graph: GraphCore) -> GazeboMaster | None:
    """The Master at the address, if a server of the graph runs there."""
    return _RUNNING.get(graph, {}).get(address())


class Network(LocalTransport):
    """The links between Gazebo's nodes, and the calls of their Master."""

    def attach(self, endpoint: Endpoint, uri: str | None = None) -> str:
        """Make a node reachable at the next port of this host."""
        uri = f"http://{os.environ.get(HOST) or LOOPBACK}:{FIRST_PORT + self._numbers}"
        self._numbers += 1
        self._endpoints[uri] = endpoint
        return uri

    def publisher_update(self, caller_api: str, topic: str, uris: list[str]) -> None:
        """Tell a subscriber who publishes its topic now: at once, so that what is published next is heard."""
        if caller_api in self._endpoints:  # else it is leaving
            self.call(caller_api, "publisherUpdate", topic, uris)

    def param_update(self, caller_api: str, key: str, value: Any) -> None:
        """Gazebo's Master has no parameters."""

    def shutdown(self, caller_api: str, reason: str) -> None:
        """Gazebo's Master ends nobody: no two nodes have the same address, by which it knows them."""

    def registrations_changed(self) -> None:
        """Nobody waits for a registration of Gazebo's nodes."""


@dataclass(frozen=True)
class TopicInfo:
    """What the Master knows of a topic."""

    topic: str
    type: str
    publishers: tuple[str, ...]
    """Names of the nodes."""
    subscribers: tuple[str, ...]
    publisher_addresses: tuple[str, ...]
    """Host and port of the same nodes: all that Gazebo's own Master knows of them."""
    subscriber_addresses: tuple[str, ...]


class GazeboMaster(Master):
    """Gazebo's Master.

    Args:
        graph: whose nodes find each other by it.
        uri: its address.
        owner: the node whose server started it.
        namespace: what `~` stands for in topic names, after /gazebo/: the name of the world.

    """

    def __init__(self, graph: GraphCore, uri: str, owner: str, namespace: str) -> None:
        self.scheduler = graph.scheduler
        self.network = Network(graph.scheduler)
        super().__init__(uri, self.network)
        self.owner, self.namespace = owner, namespace
        self._graph = weakref.ref(graph)

    def close(self) -> None:
        """End: the address is free again."""
        graph = self._graph()
        if graph is not None:
            _RUNNING.get(graph, {}).pop(self.uri, None)

    def _ends(self) -> tuple[dict[str, list[str]], dict[str, list[str]]]:
        """Topic: the addresses of its publishers; and of its subscribers."""
        publishers, subscribers, _ = self.getSystemState("gz")[2]
        return dict(publishers), dict(subscribers)

    def type_of(self, topic: str) -> str:
        """The type of a topic that somebody publishes; "" if nobody does."""
        found = dict(self.getPublishedTopics("gz", "")[2]).get(topic, "")
        return str(found).replace("/", ".")

    def topics(self) -> dict[str, str]:
        """The topics that somebody publishes or hears, sorted, each with its type if it is published: `gz topic -l`."""
        publishers, subscribers = self._ends()
        return {topic: self.type_of(topic) for topic in sorted({*publishers, *subscribers})}

    def info(self, topic: str) -> TopicInfo:
        """Who publishes and who hears a topic: `gz topic -i`. Raises `GazeboError` if nobody does."""
        publishers, subscribers = self._ends()
        if topic not in publishers and topic not in subscribers:
            hint = nearest(topic, publishers) or f"there are: {', '.join(self.topics()) or 'no topics'}"
            msg = f"Gazebo's Master knows no topic {topic!r}; {hint}. These are not ROS's topics, which rostopic lists"
            raise GazeboError(msg)
        ends = publishers.get(topic, []), subscribers.get(topic, [])
        names = (tuple(self.network.endpoint(f"http://{each}").name for each in end) for end in ends)
        return TopicInfo(topic, self.type_of(topic), *names, *map(tuple, ends))


class Publication(Generic[M]):
    """A node's end of a topic that it publishes; made by `TransportNode.advertise`."""

    def __init__(self, node: TransportNode, topic: str, message_class: type[M]) -> None:
        self.node, self.topic, self.message_class = node, topic, message_class
        self._senders: list[Sender] = []

    @property
    def heard(self) -> bool:
        """Whether anybody hears it."""
        return bool(self._senders)

    def publish(self, message: M) -> None:
        """Send a message to all who hear it. Raises `GazeboError` for one of another type."""
        if not isinstance(message, self.message_class):
            kind = getattr(message, "TYPE", type(message).__name__)
            raise GazeboError(f"{self.topic} is a topic of {self.message_class.TYPE}, not of {kind}")
        for sender in self._senders:
            sender.send(message, None)

    def connect(self, sender: Sender) -> None:
        """Take a subscriber's connection."""
        self._senders.append(sender)
        sender.on_closed = partial(self._disconnected, sender)

    def _disconnected(self, sender: Sender) -> None:
        if sender in self._senders:  # else this end was closed first
            self._senders.remove(sender)

    def close(self) -> None:
        """Stop publishing. Harmless when repeated."""
        for sender in self._senders:
            sender.close()
        self._senders.clear()
        self.node.drop(self)


class _Subscription:
    """A node's end of a topic that it hears."""

    message_class: Any = Message

    def __init__(self, node: TransportNode, topic: str) -> None:
        self.node, self.topic = node, topic
        self.callbacks: list[Callable[[Any], object]] = []
        self._links: dict[str, Callable[[], None]] = {}

    def update(self, uris: list[str]) -> None:
        """Connect to new publishers, and forget those that have gone."""
        network = self.node.master.network
        for uri in [uri for uri in self._links if uri not in uris]:
            del self._links[uri]
        for uri in [uri for uri in uris if uri not in self._links]:
            header = {"callerid": self.node.name, "topic": self.topic}
            try:
                _, close = network.connect_topic(self.node.uri, [network.protocol, uri], header, self)
            except (TransportException, TransportInitError):
                continue  # it has left meanwhile
            self._links[uri] = close

    def deliver(self, messages: Iterable[Any]) -> None:
        """Queue messages for the callbacks, which run in the node's lane, where they may block."""
        for message in messages:
            for callback in self.callbacks:
                self.node.lane.post(partial(callback, message))

    def closed(self) -> None:
        """Do nothing: the Master reports who publishes."""

    def failed(self, error: Exception) -> None:
        """Do nothing: what stays in this process does not fail."""

    def close(self) -> None:
        """Close all connections."""
        for close in self._links.values():
            close()
        self._links.clear()


class TransportNode:
    """A node of Gazebo's transport; `~/x` means /gazebo/<namespace>/x to it.

    Args:
        master: who introduces it to others.
        name: what it is.
        lane: in which its callbacks run; one of its own if None.

    """

    def __init__(self, master: GazeboMaster, name: str, lane: Lane | None = None) -> None:
        self.master, self.name = master, name
        self.lane = Lane(master.scheduler, name) if lane is None else lane
        self.uri = master.network.attach(self)
        self.address = self.uri.removeprefix("http://")
        """Host and port, by which Gazebo's Master knows it."""
        self._publications: dict[str, Publication[Any]] = {}
        self._subscriptions: dict[str, _Subscription] = {}

    def resolve(self, topic: str) -> str:
        """The whole name of a topic; characters of worlds' and models' names that no topic may have become _."""
        if topic.startswith("~/"):
            topic = f"/gazebo/{self.master.namespace}/{topic[2:]}"
        topic = topic.replace("::", "/").translate(_NO_NAME)
        return topic if topic.startswith("/") else f"/{topic}"

    def advertise(self, topic: str, message_class: type[M]) -> Publication[M]:
        """Publish messages of a class on a topic. Raises `GazeboError` if somebody publishes others there."""
        topic, kind = self.resolve(topic), message_class.TYPE
        there = self.master.type_of(topic)
        if there not in ("", kind):
            who = self.master.info(topic).publishers[0]
            raise GazeboError(
                f"{who} publishes {topic} as {there}, so {self.name} cannot publish it as {kind}"
            )
        publication = self._publications[topic] = Publication(self, topic, message_class)
        package, _, name = kind.rpartition(".")
        self.master.registerPublisher(self.address, topic, f"{package}/{name}", self.uri)
        return publication

    def subscribe(self, topic: str, callback: Callable[[Any], object]) -> None:
        """Call `callback(message)` for each message on a topic, whether anybody publishes it already or not."""
        topic = self.resolve(topic)
        if topic not in self._subscriptions:
            subscription = self._subscriptions[topic] = _Subscription(self, topic)
            subscription.update(self.master.registerSubscriber(self.address, topic, "*", self.uri)[2])
        self._subscriptions[topic].callbacks.append(callback)

    def drop(self, publication: Publication[Any]) -> None:
        """Leave a topic; for the publication only."""
        if self._publications.get(publication.topic) is publication:
            del self._publications[publication.topic]
            self.master.unregisterPublisher(self.address, publication.topic, self.uri)

    def close(self) -> None:
        """Leave all topics. Harmless when repeated."""
        for publication in list(self._publications.values()):
            publication.close()
        for topic, subscription in self._subscriptions.items():
            subscription.close()
            self.master.unregisterSubscriber(self.address, topic, self.uri)
        self._subscriptions.clear()
        self.master.network.detach(self.uri)

    # -- called by the Master and by other nodes -----------------------------------------------------------------

    def slave_call(self, method: str, *arguments: Any) -> Triple:
        """Answer the Master, which says who publishes a topic."""
        topic, uris = arguments
        if method == "publisherUpdate" and topic in self._subscriptions:
            self._subscriptions[topic].update(uris)
        return [1, "", 0]

    def accept_subscriber(self, header: Header, sender: Sender) -> Header:
        """Take a subscriber's connection."""
        publication = self._publications.get(header["topic"])
        if publication is None:
            raise TransportInitError(f"{self.name} does not publish {header['topic']}")
        publication.connect(sender)
        return {"callerid": self.name}

    def accept_client(self, header: Header) -> NoReturn:
        """Refuse: Gazebo's transport has no services."""
        raise TransportInitError(f"{self.name} offers no services, and no {header.get('service')}")
