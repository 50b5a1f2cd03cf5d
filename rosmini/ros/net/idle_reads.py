"""Connected sockets that the scheduler's own thread reads while it is idle.

Normally a message wakes the I/O thread, which then wakes the scheduler's: two thread switches, each as long as the
rest of a message's path. So an idle scheduler waits for the sockets themselves instead of for a wake-up. When it
has been busy for a while, the I/O thread reads them again, so that incoming data is received and bounded during a
long callback.

The sockets are in one epoll set (``_set``). The I/O thread's loop does not watch that set but another (``_switch``),
whose only member it is: one system call turns the loop's interest on or off. Without epoll (macOS,
Windows) the I/O thread reads everything.
"""

from __future__ import annotations

import os
import select
import threading
from contextlib import suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import asyncio
    import socket
    from collections.abc import Callable

    from rosmini.core.graph.scheduler import Scheduler

SELECTABLE = 1024
"""Limit of file descriptors for ``select``."""

COARSE_S = 0.1
"""Timeout from which precision does not matter [s]; epoll's has a resolution of a millisecond."""

BEAT_S = 0.02
"""How long the scheduler may be busy before the I/O thread reads [s]."""

QUIET_BEATS = 10
"""Number of beats without activity after which the scheduler's state is not checked until data arrives."""


class IdleReads:
    """Sockets of one graph; created and closed in the loop's thread."""

    def __init__(self, loop: asyncio.AbstractEventLoop, scheduler: Scheduler) -> None:
        self.is_asleep = False
        """True while the scheduler sleeps here or is about to; only then must it be woken for new work."""
        self._loop = loop
        self._scheduler = scheduler
        self._lock = threading.RLock()
        self._readers: dict[int, Callable[[], None]] = {}
        self._is_closed = False
        self._is_on = True
        self.beats = False
        """True if the loop checks periodically how busy the scheduler is."""
        self._naps = self._seen = self._quiet = 0
        self._set = select.epoll()
        self._switch = select.epoll()
        self._alarm = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._alarm_lock = threading.RLock()  # of its own: who wakes the scheduler may hold what a reader wants
        self._set.register(self._alarm, select.EPOLLIN)
        self._switch.register(self._set, select.EPOLLIN)
        loop.add_reader(self._switch, self._read_in_loop)
        scheduler.sleep_in(self)

    def add(self, sock: socket.socket, reader: Callable[[], None]) -> None:
        """Call ``reader`` when there is data to read, in the scheduler's thread or the loop's, one at a time."""
        with self._lock:
            if not self._is_closed:
                self._readers[sock.fileno()] = reader
                self._set.register(sock, select.EPOLLIN)

    def remove(self, sock: socket.socket) -> None:
        """Stop reading a socket; on return its reader does not run any more, unless it is the caller."""
        with self._lock:
            if not self._is_closed and self._readers.pop(sock.fileno(), None) is not None:
                self._set.unregister(sock)

    def wake(self) -> None:
        """Wake the scheduler; may be called from any thread and from a signal handler."""
        with self._alarm_lock:
            if not self._set.closed:
                os.eventfd_write(self._alarm, 1)

    # -- in the scheduler's thread -------------------------------------------------------------------------------

    def sleep(self, timeout: float, nothing_came: Callable[[], bool]) -> None:
        """Sleep until data arrives or the scheduler is woken, unless something came already; then read the data."""
        with self._lock:
            if self._is_closed:
                return
            if self._is_on:
                self._turn(on=False)
            self.is_asleep = True
        events: list[tuple[int, int]] = []
        came = True
        try:
            if nothing_came():
                came = False
                events = self._wait(timeout)
                came = bool(events)
        finally:
            self._wake_up(something_came=came)
        self._read(events)

    def _wait(self, timeout: float) -> list[tuple[int, int]]:
        if timeout < COARSE_S and self._set.fileno() < SELECTABLE:
            if not select.select([self._set], [], [], timeout)[0]:
                return []
            timeout = 0
        return self._set.poll(timeout)

    def _wake_up(self, *, something_came: bool) -> None:
        with self._lock:
            self.is_asleep = False
            self._naps += 1
            if self._is_closed:
                self._end()
            elif self.beats:
                pass  # if the scheduler does not sleep soon, the loop notices
            elif something_came:
                self.beats = True
                self._loop.call_soon_threadsafe(self._beat)
            else:
                self._turn(on=True)

    # -- in either thread ----------------------------------------------------------------------------------------

    def _turn(self, *, on: bool) -> None:
        """Turn reading in the loop on or off, with the lock held."""
        self._is_on = on
        self._switch.modify(self._set, select.EPOLLIN if on else 0)

    def _read(self, events: list[tuple[int, int]]) -> None:
        with self._lock:
            for number, _ in [] if self._is_closed else events:
                if number == self._alarm:
                    with suppress(BlockingIOError):
                        os.eventfd_read(number)
                elif (reader := self._readers.get(number)) is not None:
                    reader()

    # -- in the loop's thread ------------------------------------------------------------------------------------

    def _read_in_loop(self) -> None:
        with self._lock:
            if self._is_on and not self._is_closed:
                self._read(self._set.poll(0))

    def _beat(self) -> None:
        """Start reading in the loop if the scheduler has been awake since the last beat."""
        with self._lock:
            if self._is_closed:
                return
            is_same, self._seen = self._naps == self._seen, self._naps
            self._quiet = self._quiet + 1 if is_same and self.is_asleep else 0
            if is_same and not self.is_asleep:
                self._turn(on=True)
            self.beats = self._quiet < QUIET_BEATS and not self._is_on
            if self.beats:
                self._loop.call_later(BEAT_S, self._beat)

    def close(self) -> None:
        """Stop reading; the scheduler then sleeps at its inbox."""
        self._scheduler.sleep_in(None)
        self._loop.remove_reader(self._switch)
        with self._lock:
            self._is_closed = True
            self._readers.clear()
            self.wake()
            if not self.is_asleep:
                self._end()

    def _end(self) -> None:
        with self._alarm_lock:
            if not self._set.closed:
                self._set.close()
                self._switch.close()
                os.close(self._alarm)


def idle_reads(loop: asyncio.AbstractEventLoop, scheduler: Scheduler) -> IdleReads | None:
    """Return the sockets that the scheduler reads too; None if the system has no epoll."""
    return IdleReads(loop, scheduler) if hasattr(select, "epoll") and hasattr(os, "eventfd") else None
