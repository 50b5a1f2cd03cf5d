"""Access to the Master: all calls go through one port, which may take time, may fail and may park the caller's lane.

A :class:`~rosmini.core.graph.master.Master` in this process is itself the port, and responds at once; a Master
elsewhere needs another :class:`MasterPort`. Nodes and tools do not call a port directly: each has a
:class:`MasterProxy`, which keeps its calls in order and retries where ROS does.
"""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections import deque
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, ROSException, ROSInterruptException

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from .graph import Graph
    from .lanes import Waiter
    from .transport import Triple

METHODS = frozenset(
    [
        "registerService",
        "unregisterService",
        "registerSubscriber",
        "unregisterSubscriber",
        "registerPublisher",
        "unregisterPublisher",
        "lookupNode",
        "getPublishedTopics",
        "getTopicTypes",
        "getSystemState",
        "getUri",
        "getPid",
        "shutdown",
        "lookupService",
        "setParam",
        "getParam",
        "hasParam",
        "deleteParam",
        "searchParam",
        "getParamNames",
        "subscribeParam",
        "unsubscribeParam",
    ]
)
"""The Master API and the Parameter Server API (http://wiki.ros.org/ROS/Master_API)."""

MASTER_TICKS = 300
"""Ticks that a call costs in a loop without a sleep: XML-RPC takes about 0.3 ms (see ``Scheduler.charge``)."""

RETRY_NS = 200_000_000
"""Delay before a node retries a registration, as in rospy [ns]."""

LEAVE_NS = 2_000_000_000
"""Time for which a node that ends tries to unregister at a Master that does not respond [ns]."""


class MasterPort(ABC):
    """Access to the Master. ``port.lookupNode(caller_id, name)`` is ``port.call("lookupNode", caller_id, name)``."""

    uri: str
    """The Master's address."""
    is_local = False
    """True for a Master in this process: it responds at once, in any thread, and its notifier reports every change."""
    keeps_trying = True
    """False if a registration without a response fails instead of being tried again."""
    leave_by: int | None = None
    """Graph time [ns] until which nodes that end try to unregister; None while the Master responds."""

    @abstractmethod
    def call(self, method: str, caller_id: str, *arguments: Any) -> Triple:
        """Return the Master's response: [code, status, value]. May park the calling lane.

        Raises ``MasterUnreachable`` if there is no response; the call may still have had its effect.
        """

    def __getattr__(self, name: str) -> Callable[..., Triple]:
        if name not in METHODS:
            raise AttributeError(f"the Master has no method {name}", name=name, obj=self)
        return partial(self.call, name)


class MasterProxy:
    """Calls the Master on behalf of one node or tool, whose name is ``caller_id``.

    The calls reach the Master one after another, in the order in which they were made. ``stop_reason`` returns the
    reason not to retry a registration, or None.
    """

    def __init__(self, graph: Graph, caller_id: str, stop_reason: Callable[[], str | None] = lambda: None) -> None:
        self._graph = graph
        self._caller_id = caller_id
        self._stop_reason = stop_reason
        self.skips_unregister = False
        """True if the caller was killed, so that :meth:`unregister` has no effect."""
        self._has_registered = False
        self._lock = threading.Lock()
        self._busy = False
        self._queue: deque[Waiter] = deque()
        self._moved: dict[str, str] = {}

    def update_addresses(self, addresses: Mapping[str, str]) -> None:
        """Replace old addresses of the caller by new ones in calls that still wait for the Master.

        Otherwise the Master would see another node of the same name and would shut this one down.
        """
        self._moved = {old: addresses.get(new, new) for old, new in self._moved.items()} | dict(addresses)

    def call(self, method: str, *arguments: Any) -> Triple:
        """Return the Master's response: [code, status, value]. Raises ``MasterUnreachable`` if there is none."""
        port = self._graph.master
        if port.is_local:
            self._graph.scheduler.charge(MASTER_TICKS)
            return self._reach(port, method, arguments)
        with self._turn():  # by then the graph may have another Master
            return self._reach(self._graph.master, method, arguments)

    def _reach(self, port: MasterPort, method: str, arguments: tuple[Any, ...]) -> Triple:
        """Call a method of the Master and return its response; record the call if the graph is recording."""
        answer: Triple
        if port.is_local:
            answer = getattr(port, method)(self._caller_id, *arguments)
        else:
            answer = port.call(method, self._caller_id, *arguments)
        history = self._graph.scheduler.history
        if history is not None:
            history.called(self._caller_id, "", method, arguments, answer)
        return answer

    def ask(self, method: str, *arguments: Any) -> Any:
        """Return the value of the Master's response.

        Raises ``ROSException`` with the Master's status if the code is not 1, and ``MasterUnreachable`` if there is no
        response.
        """
        return self._value(method, self.call(method, *arguments))

    def _value(self, method: str, answer: Triple) -> Any:
        code, status, value = answer
        if code != 1:
            raise ROSException(f"the Master refused {method} of node {self._caller_id}: {status}")
        return value

    def find(self, method: str, *arguments: Any) -> Any:
        """Return the value of the Master's response, or None if the code is not 1.

        Raises ``MasterUnreachable`` if there is no response.
        """
        code, _, value = self.call(method, *arguments)
        return value if code == 1 else None

    def insist(self, method: str, *arguments: Any, warn: Callable[[str], None]) -> Triple:
        """Return the Master's response as :meth:`call`, but keep trying until there is one, and call ``warn`` once.

        Raises ``ROSInterruptException`` if the caller ends meanwhile, and ``MasterUnreachable`` if the Master's port
        does not keep trying.
        """
        port = self._graph.master
        if port.is_local:
            self._has_registered = True
            return self._reach(port, method, arguments)
        with self._turn():
            while True:
                try:
                    answer = self._reach(self._graph.master, method, self._current(arguments))
                    self._has_registered = True
                    return answer
                except MasterUnreachable as error:
                    if not port.keeps_trying:
                        raise
                    reason = self._stop_reason()
                    if reason is not None:
                        raise ROSInterruptException(reason) from error
                    silence = str(error)
                warn(
                    f"Unable to register with master node [{self._graph.master.uri}]: "
                    f"master may not be running yet. Will keep trying. ({silence})"
                )
                warn = _silent
                self._pause()

    def _current(self, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(self._moved.get(each, each) if isinstance(each, str) else each for each in arguments)

    def register(self, method: str, *arguments: Any, warn: Callable[[str], None]) -> Any:
        """Return the value of the response, or raise, as :meth:`ask`, but keep trying as :meth:`insist`."""
        return self._value(method, self.insist(method, *arguments, warn=warn))

    def unregister(self, method: str, *arguments: Any, warn: Callable[[str], None]) -> None:
        """Remove a registration. It is not an error if the Master no longer has it.

        After failed attempts only ``warn`` is called, once for all nodes that end at that time.
        """
        if self.skips_unregister:
            return
        port = self._graph.master
        if port.is_local:
            self._reach(port, method, arguments)
            return
        scheduler = self._graph.scheduler
        with self._turn():
            while True:
                started = scheduler.now_ns()
                if port.leave_by is not None and started >= port.leave_by:
                    return
                try:
                    self._reach(self._graph.master, method, arguments)
                except MasterUnreachable as error:
                    if not self._has_registered:
                        return  # nothing is registered there
                    port.leave_by = port.leave_by or started + LEAVE_NS
                    if not port.keeps_trying or scheduler.now_ns() + RETRY_NS >= port.leave_by:
                        port.leave_by = started
                        warn(f"{error} ({method}). The registration stays there; `rosnode cleanup` removes it.")
                        return
                    self._pause()
                else:
                    port.leave_by = None
                    return

    def who_publishes(self, topic: str) -> str:
        """Return a clause for error messages that names the publishers of a topic."""
        try:
            names = self._publishers(topic)
        except MasterUnreachable:
            return "the Master does not answer"
        return f"{', '.join(names)} publishes it" if names else "nobody publishes it"

    def publisher_at(self, topic: str, uri: str) -> str:
        """Return the name of the node at ``uri`` that publishes a topic, or the URI if the Master does not know it."""
        try:
            names = [name for name in self._publishers(topic) if self.find("lookupNode", name) == uri]
        except MasterUnreachable:
            names = []
        return names[0] if names else uri

    def _publishers(self, topic: str) -> list[str]:
        publishers: list[tuple[str, list[str]]] = self.ask("getSystemState")[0]
        return next((names for name, names in publishers if name == topic), [])

    def _pause(self) -> None:
        scheduler = self._graph.scheduler
        scheduler.sleep_until(scheduler.now_ns() + RETRY_NS, "the Master")

    @contextmanager
    def _turn(self) -> Iterator[None]:
        """Wait until this caller's earlier calls have ended; at the end of the block, let the next one start."""
        with self._lock:
            waiter = None
            if self._busy:
                waiter = self._graph.scheduler.waiter("its turn at the Master")
                self._queue.append(waiter)
            self._busy = True
        try:
            if waiter is not None:
                waiter.wait()
            yield
        finally:
            self._pass_on(waiter)

    def _pass_on(self, mine: Waiter | None) -> None:
        with self._lock:
            if mine is not None and mine in self._queue:  # it was asked to end before its turn came
                self._queue.remove(mine)
            elif self._queue:
                self._queue.popleft().wake()
            else:
                self._busy = False


def _silent(_text: str) -> None:
    """Ignore a warning."""
