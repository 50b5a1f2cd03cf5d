"""What publishers, subscribers, services, clocks and loggers need of their node."""

# ruff: noqa: D102 - the class Node describes the methods
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.time import Time

    from .graph_core import GraphCore
    from .lanes import Lane, Waiter
    from .master_port import MasterProxy
    from .scheduler import Scheduler


class NodeClock(Protocol):
    """What time it is for a node."""

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` at ``when_ns``; return a function that takes it back."""


class NodePort(Protocol):
    """A node as its own parts see it; :class:`~rosmini.graph.node.Node` describes the methods."""

    name: str
    uri: str
    graph: GraphCore
    scheduler: Scheduler
    master: MasterProxy
    shutdown_reason: str | None
    publications: dict[str, Any]
    subscriptions: dict[str, Any]
    timers: dict[Any, None]
    logger: Any
    """A :class:`~rosmini.graph.rosout.Logger`, which needs a node itself."""

    @property
    def clock(self) -> NodeClock: ...
    def now(self) -> Time: ...
    def get_param(self, name: str, default: Any = ..., *, expect: Any = ...) -> Any: ...
    def publisher(self, topic: str, message_class: Any, *, queue_size: int | None = 10) -> Any: ...
    def is_shutdown(self) -> bool: ...
    def sleep_ns(self, span: int) -> None: ...
    def waiter(self, reason: str, *, remote: bool = False) -> Waiter: ...
    def wait(self, waiter: Waiter, timeout: float | None = None) -> bool: ...
    def wait_until(
        self, condition: Callable[[], bool], timeout: float | None, reason: str, failure: Callable[[], str]
    ) -> None: ...
    def wait_for_service(self, name: str, timeout: float | None = None) -> None: ...
    def spawn(self, name: str, task: Callable[[], object] | None = None) -> Lane: ...
    def guarded(self, callback: Callable[..., object], *arguments: Any, what: str) -> None: ...
    def callback_failed(
        self,
        error: Exception,
        callback: Callable[..., object],
        where: str,
        message: Any,
        *,
        service: bool = False,
    ) -> None: ...
    def logwarn(self, text: object) -> None: ...
    def logerr(self, text: object) -> None: ...
    def next_connection_id(self) -> int: ...
    def connections_changed(self) -> None: ...
    def drop_publication(self, publication: Any) -> None: ...
    def drop_subscription(self, subscription: Any) -> None: ...
    def drop_service(self, server: Any) -> None: ...
    def parameter_changed(self, key: str, value: Any) -> None: ...
    def publishers_changed(self, topic: str, uris: list[str]) -> None: ...
    def shutdown_requested(self, caller: str, reason: str) -> None: ...
