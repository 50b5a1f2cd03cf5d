"""The Master's notices to nodes: calls of their slave API, one after another for each node, in a separate lane."""

from __future__ import annotations

import threading
from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import TransportException

from .lanes import Lane

if TYPE_CHECKING:
    from collections.abc import Callable

    from .scheduler import Scheduler

    Notice = tuple[str, tuple[Any, ...]]

    from .lanes import Waiter


class Changes:
    """Conditions that end waits; each is evaluated whenever the graph changes."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._watched: list[tuple[Callable[[], bool], Waiter]] = []
        self._check_queued = False

    def watch(self, condition: Callable[[], bool], waiter: Waiter) -> None:
        """Wake ``waiter`` as soon as ``condition()`` is true.

        The condition must not block: it may use only the node's own data.
        """
        if condition():
            waiter.wake()
        else:
            self._watched.append((condition, waiter))

    def next(self, waiter: Waiter) -> None:
        """Wake ``waiter`` at the next change."""
        self._watched.append((_always, waiter))

    def notify(self) -> None:
        """Evaluate the conditions soon, because the graph has changed. Safe in any thread."""
        if self._watched and not self._check_queued:
            self._check_queued = True
            self._scheduler.call_soon(self._check)

    def _check(self) -> None:
        self._check_queued = False
        watched, self._watched = self._watched, []
        for condition, waiter in watched:
            if waiter.done:
                continue
            if condition():
                waiter.wake()
            else:
                self._watched.append((condition, waiter))


def _always() -> bool:
    return True


LIMIT = 1_000
"""Maximum number of notices waiting for a node that hangs; beyond it, only the latest per topic and parameter stay."""


class Notices:
    """Delivers the Master's notices to the nodes, after the registration that caused them.

    Each node gets its notices in order, and a node that does not respond does not delay the others. ``call(uri, method,
    caller_id, *arguments)`` calls a node's slave API. ``on_error`` is called with errors other than
    ``TransportException``, which is ignored. Safe in any thread.
    """

    def __init__(
        self,
        scheduler: Scheduler,
        changes: Changes,
        call: Callable[..., object],
        on_error: Callable[[BaseException], None],
    ) -> None:
        self._scheduler = scheduler
        self._changes = changes
        self._call = call
        self._on_error = on_error
        self._lock = threading.Lock()
        self._waiting: dict[str, deque[Notice]] = {}

    def publisher_update(self, caller_api: str, topic: str, uris: list[str]) -> None:
        """Send a subscriber the current publishers of its topic."""
        self._post(caller_api, "publisherUpdate", topic, uris)

    def param_update(self, caller_api: str, key: str, value: Any) -> None:
        """Notify a node that a parameter to which it subscribes has changed."""
        self._post(caller_api, "paramUpdate", key, value)

    def shutdown(self, caller_api: str, reason: str) -> None:
        """Ask a node to shut down."""
        self._post(caller_api, "shutdown", reason)

    def registrations_changed(self) -> None:
        """Evaluate the conditions that wait for a registration."""
        self._changes.notify()

    def _post(self, caller_api: str, method: str, *arguments: Any) -> None:
        with self._lock:
            waiting = self._waiting.get(caller_api)
            is_busy = waiting is not None
            if waiting is None:
                waiting = self._waiting[caller_api] = deque()
            elif len(waiting) >= LIMIT:
                _keep_latest(waiting)
            waiting.append((method, arguments))
        if not is_busy:
            lane = Lane(self._scheduler, f"the Master's notices to {caller_api}", on_error=self._on_error)
            lane.submit(partial(self._deliver, caller_api, waiting))

    def _deliver(self, caller_api: str, waiting: deque[Notice]) -> None:
        while True:
            with self._lock:
                if not waiting:
                    if self._waiting.get(caller_api) is waiting:
                        del self._waiting[caller_api]
                    return
                method, arguments = waiting.popleft()
            try:
                self._call(caller_api, method, "/master", *arguments)
            except TransportException:
                pass  # the node has gone, and its registrations with it
            except Exception as error:
                self._on_error(error)

    def clear(self) -> None:
        """Drop the waiting notices: the graph was closed with its lanes."""
        with self._lock:
            self._waiting.clear()


def _keep_latest(waiting: deque[Notice]) -> None:
    """Drop the notices that a later one about the same topic or parameter replaces."""
    latest = {(method, arguments[0]): arguments for method, arguments in reversed(waiting)}
    waiting.clear()
    waiting.extend((method, arguments) for (method, _), arguments in reversed(latest.items()))
