"""Repeats all registrations of a node after the Master lost them or was replaced."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rosmini.core.graph import Node


def register_again(node: Node) -> None:
    """Register the publishers, subscribers and services of a node.

    It may park the calling lane, and retries while the Master does not answer and the node runs. Raises
    ``ROSException`` if the Master refuses.
    """
    master, warn = node.master, node.logerr
    for topic, publication in list(node.publications.items()):
        if node.publications.get(topic) is publication and node.shutdown_reason is None:
            master.register("registerPublisher", topic, publication.message_class._type, node.uri, warn=warn)
    for topic, subscription in list(node.subscriptions.items()):
        if node.subscriptions.get(topic) is not subscription or node.shutdown_reason is not None:
            continue
        before = subscription.updates
        uris = master.register("registerSubscriber", topic, subscription.message_class._type, node.uri, warn=warn)
        if subscription.updates == before and node.subscriptions.get(topic) is subscription:
            subscription.update_publishers(uris)
    services_at = node.graph.transport.service_uri(node.uri)
    for name, server in list(node.services.items()):
        if node.services.get(name) is server and node.shutdown_reason is None:
            master.register("registerService", name, services_at, node.uri, warn=warn)
