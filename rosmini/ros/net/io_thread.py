"""The only thread of a process that reads from and writes to the network: an asyncio loop.

Its results enter a graph through the scheduler's inbox; a graph gives it work through
:meth:`IoThread.call` and :meth:`IoThread.start`.
"""

from __future__ import annotations

import asyncio
import threading
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar, cast

from rosmini.core.errors import TransportTerminated

from .idle_reads import idle_reads

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from concurrent.futures import Future

    from rosmini.core.graph.scheduler import Scheduler

    from .idle_reads import IdleReads

T = TypeVar("T")

LEAVE_S = 2.0
"""Maximum duration of closing [s]."""

KEPT = 16 * 1024 * 1024
"""Maximum size of a freed memory block that is kept for reuse [bytes]."""

TURNS = 6
"""Number of loop iterations needed to close a connection."""


class IoThread:
    """Starts on first use; after :meth:`close` it can be used again, with a new loop.

    If a ``scheduler`` is given, it reads shared sockets while it is idle.
    """

    def __init__(self, scheduler: Scheduler | None = None) -> None:
        self._scheduler = scheduler
        self.idle: IdleReads | None = None
        """Sockets that an idle scheduler reads, or None. Loop's thread only."""
        self._lock = threading.Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._thread: threading.Thread | None = None
        self.closers: dict[Callable[[], object], None] = {}
        """Functions called once in the loop's thread when it ends, to close what is open. Change it there only."""

    @property
    def loop(self) -> asyncio.AbstractEventLoop:
        """The running loop."""
        with self._lock:
            if self._loop is None:
                self._loop = loop = asyncio.SelectorEventLoop()  # also where Windows would take another
                self._thread = threading.Thread(target=_run, args=(loop, self.closers), name="rosmini-net", daemon=True)
                if self._scheduler is not None:
                    loop.call_soon(self._begin_idle, loop, self._scheduler)
                self._thread.start()
            return self._loop

    @property
    def runs(self) -> bool:
        """True between the first use and :meth:`close`."""
        return self._loop is not None

    def _begin_idle(self, loop: asyncio.AbstractEventLoop, scheduler: Scheduler) -> None:
        self.idle = idle_reads(loop, scheduler)
        if self.idle is not None:
            self.closers[self.idle.close] = None

    def call(self, function: Callable[..., object], *arguments: Any) -> None:
        """Call a function soon in the loop's thread; may be called from any thread."""
        self.loop.call_soon_threadsafe(function, *arguments)

    def start(self, coroutine: Coroutine[Any, Any, T]) -> Future[T]:
        """Run a coroutine in the loop's thread; may be called from any thread."""
        return asyncio.run_coroutine_threadsafe(coroutine, self.loop)

    def ask(
        self,
        scheduler: Scheduler,
        coroutine: Coroutine[Any, Any, T],
        reason: str,
        discard: Callable[[T], object] | None = None,
    ) -> T:
        """Return the result of a coroutine; the calling lane is parked, while simulated time continues.

        ``discard`` gets the result, in any thread, if the caller was interrupted and cannot take it.
        Raises the errors of the coroutine, and ``TransportTerminated`` if the network is closed meanwhile.
        """
        waiter = scheduler.waiter(reason, remote=True)
        future = self.start(coroutine)
        future.add_done_callback(lambda done: _pass_on(done, waiter))
        try:
            waiter.wait()
        except BaseException:
            if discard is None:
                future.cancel()
            else:  # a cancelled future may already have its result
                future.add_done_callback(partial(_throw_away, discard))
            raise
        return cast("T", waiter.value)

    def submit(self, scheduler: Scheduler, function: Callable[[], T]) -> asyncio.Future[T]:
        """Return a future for a function that is called in the scheduler's thread. Loop's thread only."""
        loop = asyncio.get_running_loop()
        result: asyncio.Future[T] = loop.create_future()

        def settle(value: Any, error: Exception | None) -> None:
            if result.done():
                return
            if error is None:
                result.set_result(value)
            else:
                result.set_exception(error)

        def work() -> None:
            try:
                answer: tuple[Any, Exception | None] = (function(), None)
            except Exception as error:
                answer = (None, error)
            if not loop.is_closed():
                loop.call_soon_threadsafe(settle, *answer)

        scheduler.call_soon_threadsafe(work)
        return result

    def close(self) -> None:
        """End the tasks of the loop, and the thread, within two seconds."""
        with self._lock:
            loop, self._loop = self._loop, None
            thread, self._thread = self._thread, None
            self.idle = None
        if loop is not None and thread is not None:
            loop.call_soon_threadsafe(loop.stop)
            thread.join(LEAVE_S)


def _throw_away(discard: Callable[[Any], object], done: Future[Any]) -> None:
    if not done.cancelled() and done.exception() is None:
        discard(done.result())


def _pass_on(done: Future[Any], waiter: Any) -> None:
    if done.cancelled():
        waiter.fail(TransportTerminated("the network of this graph was closed"))
    elif (error := done.exception()) is not None:
        waiter.fail(error)
    else:
        waiter.wake(done.result())


def _run(loop: asyncio.AbstractEventLoop, closers: dict[Callable[[], object], None]) -> None:
    """Run the loop until it is stopped, then close what is open and end its tasks."""
    asyncio.set_event_loop(loop)
    _keep_memory()
    try:
        loop.run_forever()
    finally:
        loop.run_until_complete(_end(closers))
        asyncio.set_event_loop(None)
        loop.close()


async def _end(closers: dict[Callable[[], object], None]) -> None:
    """Close and cancel until nothing is left: the latest requests open only in one of the next iterations."""
    loop, quiet = asyncio.get_running_loop(), 0
    deadline = loop.time() + LEAVE_S / 2
    while quiet < TURNS and loop.time() < deadline:
        found = list(closers)
        closers.clear()
        for closer in found:
            closer()
        tasks = asyncio.all_tasks() - {asyncio.current_task()}
        for task in tasks:
            task.cancel()
        quiet = 0 if tasks or found else quiet + 1
        await asyncio.sleep(0)


def _keep_memory() -> None:
    """Keep memory freed by large messages for the next ones, up to twice ``KEPT``.

    The GNU C library adjusts the size at which it returns memory to the system to the largest block that was ever
    freed. Otherwise each large message returns its pages and makes the system clear others: four times as slow.
    """
    bytes(KEPT)  # never written to: it takes no memory


def later(loop: asyncio.AbstractEventLoop, seconds: float, function: Callable[[], object]) -> None:
    """Call a function in the loop's thread after some seconds of wall-clock time; from any thread."""
    loop.call_soon_threadsafe(partial(loop.call_later, seconds, function))
