"""Sockets that an idle hub reads: whoever reads them, all that is sent is read, and a wake is never missed."""

from __future__ import annotations

import os
import socket
import threading
from typing import TYPE_CHECKING

import pytest

from rosmini.core.graph.scheduler import Scheduler
from rosmini.ros.net import idle_reads
from rosmini.ros.net.idle_reads import IdleReads
from rosmini.ros.net.io_thread import IoThread

from ...processes import wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.skipif(not hasattr(os, "eventfd"), reason="only Linux has epoll and eventfd")


class Wire:
    """One end of a connection, read by an idle hub or by the I/O thread; the other end is the test's."""

    def __init__(self) -> None:
        self.scheduler = Scheduler(simulated=False)
        self.io = IoThread(self.scheduler)
        self.here, self.there = socket.socketpair()
        self.here.setblocking(False)
        self.read: list[tuple[bytes, str]] = []
        """What was read, and the name of the thread that did it."""
        self.idle = self.in_loop()

    def in_loop(self) -> IdleReads:
        """Have the socket read; return what sees to that."""

        async def begin() -> IdleReads:
            found = self.io.idle
            assert found is not None
            found.add(self.here, self._readable)
            return found

        return self.io.start(begin()).result()

    def _readable(self) -> None:
        data = self.here.recv(1000)
        self.read.append((data, threading.current_thread().name))
        if not data:
            self.idle.remove(self.here)

    def got(self, data: bytes) -> bool:
        """Whether these bytes are the last that were read."""
        return bool(self.read) and self.read[-1][0] == data

    def close(self) -> None:
        self.io.close()
        for end in (self.here, self.there):
            end.close()


@pytest.fixture
def wire() -> Iterator[Wire]:
    made = Wire()
    yield made
    made.close()


def test_a_sleeping_scheduler_reads_by_itself(wire: Wire) -> None:
    for number in range(1000):  # on a loaded machine many arrive before the hub sleeps
        threading.Thread(target=wire.there.send, args=(b"%d" % number,)).start()
        wire.scheduler.run(until=lambda number=number: wire.got(b"%d" % number))
        if threading.current_thread().name in {name for _, name in wire.read}:
            return
    pytest.fail("the hub's own thread read nothing")


def test_what_comes_while_the_scheduler_is_busy_is_read_by_the_io_thread(wire: Wire) -> None:
    """First while nobody has ever slept there, then after a sleep, and after one that something ended."""
    for number in range(3):
        wire.there.send(b"%d" % number)
        wait_until(lambda number=number: wire.got(b"%d" % number), "a read")  # this is the hub's thread: it is busy
        assert wire.read[-1][1] == "rosmini-net"
        wire.scheduler.run(until_ns=wire.scheduler.now_ns() + 1_000_000)
        wire.scheduler.call_soon_threadsafe(lambda: None)
        wire.scheduler.run(until_ns=wire.scheduler.now_ns() + 1_000_000)


def test_a_sleeping_scheduler_is_woken_for_what_others_want(wire: Wire) -> None:
    done: list[int] = []
    for number in range(200):
        thread = threading.Thread(target=wire.scheduler.call_soon_threadsafe, args=(lambda n=number: done.append(n),))
        thread.start()
        wire.scheduler.run(until=lambda number=number: done[-1:] == [number])
        thread.join()


def test_a_connection_that_was_closed_is_read_to_its_end_once(wire: Wire) -> None:
    wire.there.send(b"last")
    wire.there.close()
    wire.scheduler.run(until=lambda: wire.got(b""))
    assert b"".join(data for data, _ in wire.read) == b"last"
    wire.idle.remove(wire.here)  # harmless when repeated


def test_it_may_be_closed_while_the_scheduler_sleeps_there_and_leaves_no_descriptor() -> None:
    before = len(os.listdir("/proc/self/fd"))
    wire = Wire()
    woken: list[int] = []

    def when_asleep() -> None:
        wait_until(lambda: wire.idle.is_asleep, "a sleeping hub")
        wire.close()
        wire.scheduler.call_soon_threadsafe(lambda: woken.append(1))

    closer = threading.Thread(target=when_asleep)
    closer.start()
    wire.scheduler.run(until=lambda: woken)
    closer.join()
    wire.idle.wake()  # which comes too late
    wire.scheduler.run(until_ns=wire.scheduler.now_ns())
    wait_until(lambda: len(os.listdir("/proc/self/fd")) == before, "the descriptors of before")


def test_a_descriptor_that_select_does_not_take(wire: Wire, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(idle_reads, "SELECTABLE", 0)
    threading.Thread(target=wire.there.send, args=(b"x",)).start()
    due = wire.scheduler.now_ns() + 5_000_000
    wire.scheduler.run(until_ns=due)
    assert wire.scheduler.now_ns() >= due
    wire.scheduler.run(until=lambda: wire.got(b"x"))
