"""The slave API: what each node answers to the Master, to other nodes and to tools (http://wiki.ros.org/ROS/Slave_API)."""

# ruff: noqa: ARG002 - every call has a caller_id, whether it needs one or not
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node import Node
    from .transport import Triple


class SlaveApi:
    """The slave API of one node; methods, codes and texts are ROS's."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._methods: dict[str, Callable[..., Triple]] = {
            "getBusStats": self.getBusStats,
            "getBusInfo": self.getBusInfo,
            "getMasterUri": self.getMasterUri,
            "shutdown": self.shutdown,
            "getPid": self.getPid,
            "getSubscriptions": self.getSubscriptions,
            "getPublications": self.getPublications,
            "paramUpdate": self.paramUpdate,
            "publisherUpdate": self.publisherUpdate,
            "requestTopic": self.requestTopic,
        }

    def call(self, method: str, *arguments: Any) -> Triple:
        """Answer a call by method name; an unknown one or wrong arguments give code -1."""
        function = self._methods.get(method)
        if function is None:
            return [-1, f'method "{method}" is not supported', 0]
        try:
            return function(*arguments)
        except TypeError as error:
            if error.__traceback__ is not None and error.__traceback__.tb_next is None:
                return [-1, f"{method} invoked with the wrong arguments: {error}", 0]
            raise

    def getBusStats(self, caller_id: str) -> Triple:
        """Return counts of what went over each connection: [publish stats, subscribe stats, service stats]."""
        publish = [
            [
                topic,
                0,
                [
                    [number, 0, getattr(sender, "sent", 0), True]
                    for number, sender in publication.senders.items()
                ],
            ]
            for topic, publication in self._node.publications.items()
        ]
        subscribe = [
            [topic, [[link.id, 0, link.dropped, link.is_open] for link in subscription.connections.values()]]
            for topic, subscription in self._node.subscriptions.items()
        ]
        return [1, "", [publish, subscribe, []]]

    def getBusInfo(self, caller_id: str) -> Triple:
        """Return one row per connection: [id, destination, direction, transport, topic, connected, description]."""
        protocol = self._node.graph.transport.protocol
        rows: list[list[Any]] = [
            [
                number,
                sender.destination,
                "o",
                protocol,
                topic,
                True,
                f"{protocol} connection to [{sender.destination}]",
            ]
            for topic, publication in self._node.publications.items()
            for number, sender in publication.senders.items()
        ]
        rows += [
            [link.id, link.uri, "i", protocol, topic, link.is_open, f"{protocol} connection to [{link.peer}]"]
            for topic, subscription in self._node.subscriptions.items()
            for link in subscription.connections.values()
        ]
        return [1, "bus info", rows]

    def getMasterUri(self, caller_id: str) -> Triple:
        """Return the URI of the node's Master."""
        uri = self._node.graph.master_uri
        return [1, uri, uri]

    def shutdown(self, caller_id: str, msg: str = "") -> Triple:
        """Shut the node down: what the Master asks of the older of two nodes with one name, and ``rosnode kill`` of any."""
        self._node.shutdown_requested(caller_id, msg)
        return [1, "shutdown", 0]

    def getPid(self, caller_id: str) -> Triple:
        """Return the process id."""
        return [1, "", os.getpid()]

    def getSubscriptions(self, caller_id: str) -> Triple:
        """Return [topic, type] pairs."""
        pairs = [[topic, item.message_class._type] for topic, item in self._node.subscriptions.items()]
        return [1, "subscriptions", pairs]

    def getPublications(self, caller_id: str) -> Triple:
        """Return [topic, type] pairs."""
        pairs = [[topic, item.message_class._type] for topic, item in self._node.publications.items()]
        return [1, "publications", pairs]

    def paramUpdate(self, caller_id: str, parameter_key: str, parameter_value: Any) -> Triple:
        """Learn that a parameter to which the node subscribes has changed."""
        self._node.parameter_changed(parameter_key, parameter_value)
        return [1, "", 0]

    def publisherUpdate(self, caller_id: str, topic: str, publishers: list[str]) -> Triple:
        """Learn who publishes a topic now."""
        subscription = self._node.subscriptions.get(topic)
        if subscription is not None:
            subscription.update_publishers(publishers)
        return [1, "", 0]

    def requestTopic(self, caller_id: str, topic: str, protocols: list[list[Any]]) -> Triple:
        """Tell a subscriber how to connect to a topic that this node publishes."""
        node = self._node
        if topic not in node.publications:
            return [-1, f"Not a publisher of [{topic}]", []]
        transport = node.graph.transport
        if not any(protocol and protocol[0] == transport.protocol for protocol in protocols):
            return [0, "no supported protocol implementations", []]
        return [1, f"ready on {node.uri}", transport.topic_parameters(node.uri)]
