"""What the Master asks of nodes: calls of their slave API, one after another, in a lane of the Master's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.errors import TransportException

from .lanes import Lane

if TYPE_CHECKING:
    from collections.abc import Callable

    from .changes import Changes
    from .scheduler import Scheduler


class Notices:
    """Carries the Master's notices to the nodes, after the registration that caused them.

    ``call(uri, method, caller_id, *arguments)`` reaches a node's slave API; ``on_error`` gets what else goes wrong.
    """

    def __init__(
        self,
        scheduler: Scheduler,
        changes: Changes,
        call: Callable[..., object],
        on_error: Callable[[BaseException], None],
    ) -> None:
        self._changes = changes
        self._call = call
        self._lane = Lane(scheduler, "the Master", on_error=on_error)

    def publisher_update(self, caller_api: str, topic: str, uris: list[str]) -> None:
        """Tell a subscriber who publishes its topic now."""
        self._post(caller_api, "publisherUpdate", topic, uris)

    def param_update(self, caller_api: str, key: str, value: Any) -> None:
        """Tell a node that a parameter to which it subscribes has changed."""
        self._post(caller_api, "paramUpdate", key, value)

    def shutdown(self, caller_api: str, reason: str) -> None:
        """Ask a node to shut down."""
        self._post(caller_api, "shutdown", reason)

    def registrations_changed(self) -> None:
        """Let those ask again who wait for a registration."""
        self._changes.notify()

    def _post(self, caller_api: str, method: str, *arguments: Any) -> None:
        def deliver() -> None:
            try:
                self._call(caller_api, method, "/master", *arguments)
            except TransportException:
                return  # the node has gone meanwhile: its registrations go with it

        self._lane.submit(deliver)
