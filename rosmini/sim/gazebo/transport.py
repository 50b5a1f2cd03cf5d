"""Gazebo's own Master and its topics, which have nothing to do with ROS's (http://classic.gazebosim.org/tutorials?tut=components).

Gazebo was a program before it was a ROS node: its server and its client find each other by a Master of Gazebo's own, which gzserver starts and
GAZEBO_MASTER_URI names. Like ROS's it is a name server only: who publishes and who subscribes to a topic tells it so, it tells them of one another,
and what is published goes from the one to the other without it. Topics are of messages of `rosmini.sim.gazebo.msgs`.

>>> master = Master()
>>> server, client = TransportNode(master, "server"), TransportNode(master, "client")
>>> publisher = server.advertise("~/greeting", str)
>>> subscription = client.subscribe("~/greeting", print)
>>> publisher.publish("good morning")
good morning
>>> master.topics()
{'/gazebo/default/greeting': 'str'}
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rosmini.errors import nearest

from .errors import GazeboError

HOST = "GAZEBO_IP"
"""The environment variable by which a program of Gazebo's says at which address it is."""

LOOPBACK, FIRST_PORT = "127.0.0.1", 49152
"""Where nodes are said to be, one after the other: the first of the ports that systems give away. Here nobody listens there, for all is one process."""

NAMESPACE = "default"
"""Of a world that says no other name; `~` in the name of a topic stands for /gazebo/<namespace>."""


def type_name(message_class: type) -> str:
    """What a kind of messages is called: gazebo.msgs.WorldStatistics."""
    return str(getattr(message_class, "TYPE", message_class.__name__))


@dataclass(frozen=True)
class TopicInfo:
    """What the Master knows of a topic."""

    topic: str
    type: str
    publishers: tuple[str, ...]
    """Names of the nodes."""
    subscribers: tuple[str, ...]
    publisher_addresses: tuple[str, ...]
    """Host and port of the same nodes: all that Gazebo's own Master knows, and tells, of them."""
    subscriber_addresses: tuple[str, ...]


class Master:
    """Gazebo's Master: a server of topic names."""

    def __init__(self) -> None:
        self._publications: dict[str, list[Publication]] = {}
        self._subscriptions: dict[str, list[Subscription]] = {}
        self._ports = FIRST_PORT

    def topics(self) -> dict[str, str]:
        """The topics that somebody publishes or hears, sorted, each with its type if it is published: `gz topic -l`."""
        ends = (*self._publications.items(), *self._subscriptions.items())
        names = sorted({topic for topic, there in ends if there})
        published = {topic: there[0] for topic, there in self._publications.items() if there}
        return {
            topic: type_name(published[topic].message_class) if topic in published else "" for topic in names
        }

    def port(self) -> int:
        """One that no node has."""
        self._ports += 1
        return self._ports - 1

    def info(self, topic: str) -> TopicInfo:
        """Who publishes and who hears a topic: `gz topic -i`. Raises `GazeboError` if nobody does."""
        publications, heard = self._publications.get(topic, []), self._subscriptions.get(topic, [])
        if not publications and not heard:
            hint = (
                nearest(topic, self._publications) or f"there are: {', '.join(self.topics()) or 'no topics'}"
            )
            msg = f"Gazebo's Master knows no topic {topic!r}; {hint}. These are not ROS's topics, which rostopic lists"
            raise GazeboError(msg)
        kind = type_name(publications[0].message_class) if publications else ""
        return TopicInfo(
            topic,
            kind,
            *(tuple(end.node.name for end in ends) for ends in (publications, heard)),
            *(tuple(end.node.address for end in ends) for ends in (publications, heard)),
        )

    def add(self, end: Publication | Subscription) -> None:
        """Hear of a new publisher or subscriber, and tell those at the other end. Raises `GazeboError` if the types differ."""
        if isinstance(end, Publication):
            there = self._publications.setdefault(end.topic, [])
            if there and there[0].message_class is not end.message_class:
                msg = (
                    f"{there[0].node.name} publishes {end.topic} as {type_name(there[0].message_class)}, so {end.node.name} cannot "
                    f"publish it as {type_name(end.message_class)}"
                )
                raise GazeboError(msg)
            there.append(end)
            for subscription in self._subscriptions.get(end.topic, []):
                end.connect(subscription)
        else:
            self._subscriptions.setdefault(end.topic, []).append(end)
            for publication in self._publications.get(end.topic, []):
                publication.connect(end)

    def remove(self, end: Publication | Subscription) -> None:
        """Hear that a publisher or a subscriber is gone."""
        if isinstance(end, Publication):
            self._publications[end.topic].remove(end)
        else:
            self._subscriptions[end.topic].remove(end)
            for publication in self._publications.get(end.topic, []):
                publication.disconnect(end)


class Publication:
    """One node's end of a topic that it publishes; made by `TransportNode.advertise`."""

    def __init__(self, node: TransportNode, topic: str, message_class: type) -> None:
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self._peers: list[Subscription] = []
        self._open = True
        node.master.add(self)

    def connect(self, subscription: Subscription) -> None:
        """Learn from the Master of somebody who wants to hear it."""
        self._peers.append(subscription)

    def disconnect(self, subscription: Subscription) -> None:
        """Learn from the Master that somebody is gone."""
        self._peers.remove(subscription)

    @property
    def heard(self) -> bool:
        """Whether anybody hears it."""
        return bool(self._peers)

    def publish(self, message: Any) -> None:
        """Send a message to all who hear it. Raises `GazeboError` for one of another type."""
        if not isinstance(message, self.message_class):
            msg = f"{self.topic} is a topic of {type_name(self.message_class)}, not of {type_name(type(message))}"
            raise GazeboError(msg)
        for peer in tuple(self._peers):
            peer.callback(message)

    def close(self) -> None:
        """Publish no more. Harmless when repeated."""
        if self._open:
            self._open = False
            self.node.master.remove(self)


class Subscription:
    """One node's end of a topic that it hears; made by `TransportNode.subscribe`."""

    def __init__(self, node: TransportNode, topic: str, callback: Callable[[Any], object]) -> None:
        self.node = node
        self.topic = topic
        self.callback = callback
        self._open = True
        node.master.add(self)

    def close(self) -> None:
        """Hear no more. Harmless when repeated."""
        if self._open:
            self._open = False
            self.node.master.remove(self)


class TransportNode:
    """A node of Gazebo's transport; `~/x` means /gazebo/<namespace>/x to it."""

    def __init__(self, master: Master, name: str, namespace: str = NAMESPACE) -> None:
        self.master = master
        self.name = name
        self.namespace = namespace
        self.address = f"{os.environ.get(HOST) or LOOPBACK}:{master.port()}"
        """By which Gazebo's Master knows it: host and port."""
        self._ends: list[Publication | Subscription] = []

    def resolve(self, topic: str) -> str:
        """The whole name of a topic.

        >>> TransportNode(Master(), "client").resolve("~/world_stats")
        '/gazebo/default/world_stats'
        """
        if topic.startswith("~/"):
            return f"/gazebo/{self.namespace}/{topic[2:]}"
        return topic if topic.startswith("/") else f"/{topic}"

    def advertise(self, topic: str, message_class: type) -> Publication:
        """Publish messages of a class on a topic. Raises `GazeboError` if somebody publishes others there."""
        publication = Publication(self, self.resolve(topic), message_class)
        self._ends.append(publication)
        return publication

    def subscribe(self, topic: str, callback: Callable[[Any], object]) -> Subscription:
        """Call `callback(message)` for each message on a topic, whether anybody publishes it already or not."""
        subscription = Subscription(self, self.resolve(topic), callback)
        self._ends.append(subscription)
        return subscription

    def close(self) -> None:
        """Leave all topics."""
        for end in self._ends:
            end.close()
        self._ends.clear()
