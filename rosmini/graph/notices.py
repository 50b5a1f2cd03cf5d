"""What the Master asks of nodes: calls of their slave API, one after another, in a lane of the Master's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.errors import TransportException

from .lanes import Lane

if TYPE_CHECKING:
    from .graph import Graph


class Notices:
    """Carries the Master's notices to the nodes."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._lane = Lane(graph.scheduler, "the Master", on_error=lambda error: graph.report(error, None))

    def publisher_update(self, caller_api: str, topic: str, uris: list[str]) -> None:
        """Tell a subscriber who publishes its topic now."""
        self._post(caller_api, "publisherUpdate", topic, uris)

    def param_update(self, caller_api: str, key: str, value: Any) -> None:
        """Tell a node that a parameter to which it subscribes has changed."""
        self._post(caller_api, "paramUpdate", key, value)

    def shutdown(self, caller_api: str, reason: str) -> None:
        """Ask a node to shut down."""
        self._post(caller_api, "shutdown", reason)

    def _post(self, caller_api: str, method: str, *arguments: Any) -> None:
        graph = self._graph

        def deliver() -> None:
            try:
                graph.transport.call(caller_api, method, "/master", *arguments)
            except TransportException:
                return  # the node has gone meanwhile: its registrations go with it
            graph.changed()

        self._lane.submit(deliver)
