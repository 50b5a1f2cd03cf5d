"""What wakes those who wait for the graph to change: registrations and connections in this process."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .lanes import Waiter
    from .scheduler import Scheduler


class Changes:
    """The conditions that somebody waits for; each is evaluated whenever something changes."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._watched: list[tuple[Callable[[], bool], Waiter]] = []
        self._check_queued = False

    def watch(self, condition: Callable[[], bool], waiter: Waiter) -> None:
        """Wake ``waiter`` as soon as ``condition()`` holds.

        The condition must not block: it asks only what is the node's own.
        """
        if condition():
            waiter.wake()
        else:
            self._watched.append((condition, waiter))

    def next(self, waiter: Waiter) -> None:
        """Wake ``waiter`` at the next change."""
        self._watched.append((_always, waiter))

    def notify(self) -> None:
        """Evaluate the conditions soon: something has changed. From any thread."""
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
