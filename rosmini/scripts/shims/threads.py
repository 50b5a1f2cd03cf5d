"""``threading`` and ``_thread`` of one script.

In simulated time a thread is a lane of the graph: it runs when the others block, in the same order each time. In wall
time it is a real thread that knows its script and node, so that what it calls in rospy works. Locks (see
:mod:`rosmini.scripts.shims.locks`) work between all of them.
"""

from __future__ import annotations

import _thread as real_thread
import itertools
import sys
import threading as real_threading
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.graph.lanes import LaneExit
from rosmini.scripts.failures import user_traceback

from . import locks

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from rosmini.graph.lanes import Lane
    from rosmini.scripts.script import Script


class Threads:
    """The threads of one script: who is who."""

    def __init__(self, context: Script) -> None:
        self.context = context
        self.by_lane: dict[Lane, Thread] = {}
        self.idents = itertools.count(1)
        self.names = itertools.count(1)
        self.excepthook: Callable[[Any], object] = self.report
        self.at_end: list[Callable[[], object]] = []
        self.main: Thread | None = None
        self.trace: Any = None

    def current(self) -> Thread:
        """Return the thread of the caller; callbacks, which rospy runs, get one on first asking."""
        lane = self.context.scheduler.current()
        thread = self.by_lane.get(lane)
        if thread is None:
            thread = self.foreign(lane)
        return thread

    def foreign(self, lane: Lane) -> Thread:
        """Make a thread object for a lane that the script did not start."""
        cls = self.context.thread_class()
        thread: Thread = cls.__new__(cls)
        Thread.__init__(thread, name=f"Dummy-{next(self.names)}", daemon=True)
        thread.adopt(lane, next(self.idents))
        return thread

    def alive(self) -> list[Thread]:
        """The threads that run, the main one first."""
        return [thread for thread in self.by_lane.values() if thread.is_alive()]

    def report(self, args: Any) -> None:
        """Print an uncaught exception of a thread as Python does, with the user's frames."""
        if args.exc_type is SystemExit:
            return
        name = args.thread.name if args.thread is not None else "?"
        text = user_traceback(args.exc_value)
        self.context.get_own("stderr").write(f"Exception in thread {name}:\n{text}")


class Thread(locks.ForScript):
    """``threading.Thread``."""

    _started_waiters: ClassVar[None] = None

    def __init__(
        self,
        group: None = None,
        target: Callable[..., object] | None = None,
        name: str | None = None,
        args: Iterable[Any] = (),
        kwargs: Mapping[str, Any] | None = None,
        *,
        daemon: bool | None = None,
        context: Any = None,
    ) -> None:
        if group is not None:
            raise AssertionError("group argument must be None for now")
        threads = self._script.threads
        self._target = target
        self._args = tuple(args)
        self._kwargs = dict(kwargs or {})
        if name is None:
            suffix = f" ({target.__name__})" if target is not None and hasattr(target, "__name__") else ""
            name = f"Thread-{next(threads.names)}{suffix}"
        self._name = str(name)
        self._run_context = context
        self._daemonic = (
            bool(threads.current().daemon) if daemon is None and threads.main is not None else bool(daemon)
        )
        self._ident: int | None = None
        self._lane: Lane | None = None
        self._real: real_threading.Thread | None = None
        self._ended = self._script.event_class()()

    # -- what a user sees ----------------------------------------------------------------------------------------

    def run(self) -> None:
        """Call the target; subclasses override it."""
        try:
            if self._target is not None:
                self._target(*self._args, **self._kwargs)
        finally:
            del self._target, self._args, self._kwargs

    def start(self) -> None:
        """Begin to run."""
        if not hasattr(self, "_ended"):
            raise RuntimeError("thread.__init__() not called")
        if self._ident is not None:
            raise RuntimeError("threads can only be started once")
        script = self._script
        if script.ended:
            raise RuntimeError("can't create new thread at interpreter shutdown")
        self._ident = next(script.threads.idents)
        if script.scheduler.simulated:
            lane = script.scheduler.spawn(
                f"{script.name}/{self._name}", node=script.node, context=script, on_error=script.lane_failed
            )
            self.adopt(lane, self._ident)
            lane.on_exit = self._over
            lane.submit(self._bootstrap)
            return
        started = real_threading.Event()
        # Real ones are daemons: the end of the script waits for them, the end of the host's process does not.
        self._real = real_threading.Thread(
            target=self._run_really, args=(started,), name=f"{script.name}/{self._name}", daemon=True
        )
        self._real.start()
        started.wait()

    def join(self, timeout: float | None = None) -> None:
        """Wait until the thread has ended, for at most ``timeout`` seconds."""
        if self._ident is None:
            raise RuntimeError("cannot join thread before it is started")
        if self is self._script.threads.current():
            raise RuntimeError("cannot join current thread")
        self._ended.wait(timeout)

    def is_alive(self) -> bool:
        """Tell whether it was started and has not ended."""
        return self._ident is not None and not self._ended.is_set()

    isAlive = is_alive  # Python 2's name, in many public scripts

    @property
    def name(self) -> str:
        """A name, for people."""
        return self._name

    @name.setter
    def name(self, name: str) -> None:
        self._name = str(name)

    @property
    def ident(self) -> int | None:
        """A number, the same on each run in simulated time; None before the start."""
        return self._ident

    @property
    def native_id(self) -> int | None:
        """The number of the real thread if there is one, else :attr:`ident`."""
        return self._real.native_id if self._real is not None else self._ident

    @property
    def daemon(self) -> bool:
        """Whether the end of the script ends it."""
        return self._daemonic

    @daemon.setter
    def daemon(self, daemonic: bool) -> None:
        if self._ident is not None:
            raise RuntimeError("cannot set daemon status of active thread")
        self._daemonic = bool(daemonic)

    def isDaemon(self) -> bool:
        """Return :attr:`daemon`."""
        return self.daemon

    def setDaemon(self, daemonic: bool) -> None:
        """Set :attr:`daemon`."""
        self.daemon = daemonic

    def getName(self) -> str:
        """Return :attr:`name`."""
        return self.name

    def setName(self, name: str) -> None:
        """Set :attr:`name`."""
        self.name = name

    def __repr__(self) -> str:
        state = "initial" if self._ident is None else "started" if self.is_alive() else "stopped"
        return f"<{type(self).__name__}({self._name}, {state}{' daemon' if self._daemonic else ''})>"

    # -- running -------------------------------------------------------------------------------------------------

    def adopt(self, lane: Lane, ident: int) -> None:
        """Be the thread of ``lane``."""
        self._lane = lane
        self._ident = ident
        self._script.threads.by_lane[lane] = self

    def _run_really(self, started: real_threading.Event) -> None:
        script = self._script
        lane = script.scheduler.adopt_thread(f"{script.name}/{self._name}", node=script.node, context=script)
        try:
            self.adopt(lane, self._ident or 0)
            started.set()
            self._bootstrap()
        except LaneExit:
            pass
        finally:
            script.scheduler.release_thread()
            self._over()

    def _bootstrap(self) -> None:
        threads = self._script.threads
        try:
            if threads.trace is not None:
                sys.settrace(threads.trace)
            if self._run_context is not None:
                self._run_context.run(self.run)
            else:
                self.run()
        except LaneExit:
            raise
        except BaseException as error:
            args = SimpleNamespace(
                exc_type=type(error), exc_value=error, exc_traceback=error.__traceback__, thread=self
            )
            threads.excepthook(args)
        finally:
            if self._script.scheduler.simulated:
                self._over()

    def _over(self) -> None:
        if self._lane is not None:
            self._script.threads.by_lane.pop(self._lane, None)
        self._ended.set()
        self._script.scheduler.call_soon(self._script.thread_ended)

    @property
    def busy(self) -> bool:
        """Whether it may still run code of the script: false for a callback's between two calls."""
        return self.is_alive() and (
            self._real is not None or (self._lane is not None and not self._lane.idle)
        )

    def end(self) -> None:
        """Ask it to end where it blocks: the script is over."""
        if self._real is None and self._lane is not None:
            self._lane.kill()


class Timer(Thread):
    """``threading.Timer``."""

    def __init__(
        self,
        interval: float,
        function: Callable[..., object],
        args: Iterable[Any] | None = None,
        kwargs: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__()
        self.interval = interval
        self.function = function
        self.args = list(args or ())
        self.kwargs = dict(kwargs or {})
        self.finished = self._script.event_class()()

    def cancel(self) -> None:
        """Do not call."""
        self.finished.set()

    def run(self) -> None:
        """Wait, then call."""
        self.finished.wait(self.interval)
        if not self.finished.is_set():
            self.function(*self.args, **self.kwargs)
        self.finished.set()


class _Threading(ModuleType):
    """``threading``; its ``local`` is made on first use, because it needs the rest."""

    def __init__(self, context: Script) -> None:
        super().__init__("threading", real_threading.__doc__)
        self.__dict__["_context"] = context
        self.__dict__["__all__"] = list(real_threading.__all__)

    def __getattr__(self, name: str) -> Any:
        if name == "local":
            self.__dict__["local"] = self.__dict__["_context"].importer.load("_threading_local").local
            return self.__dict__["local"]
        raise AttributeError(f"module 'threading' has no attribute {name!r}")

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "excepthook":
            self.__dict__["_context"].threads.excepthook = value
        super().__setattr__(name, value)


def script_classes(context: Script) -> dict[str, type]:
    """Make the subclasses of one script."""

    def own(base: type, **more: object) -> type:
        return type(base.__name__, (base,), {"_script": context, "__module__": "threading", **more})

    lock = own(locks.Lock)
    rlock = own(locks.RLock, _lock_class=lock)
    condition = own(locks.Condition, _lock_class=rlock)
    parts = {"_condition_class": condition, "_lock_class": lock}
    semaphore = own(locks.Semaphore, **parts)
    thread = own(Thread)
    return {
        "Lock": lock,
        "RLock": rlock,
        "Condition": condition,
        "Event": own(locks.Event),
        "Semaphore": semaphore,
        "BoundedSemaphore": own(locks.BoundedSemaphore, **parts),
        "Barrier": own(locks.Barrier, **parts),
        "Thread": thread,
        # So that `issubclass(Timer, Thread)` holds as in the standard library.
        "Timer": type("Timer", (Timer, thread), {"_script": context, "__module__": "threading"}),
    }


def make_threading(context: Script) -> ModuleType:
    """Make the ``threading`` of one script."""
    threads = context.threads
    module: Any = _Threading(context)
    module.__dict__.update(context.thread_classes)

    def settrace(function: Any) -> None:
        threads.trace = function

    functions: dict[str, Any] = {
        "current_thread": threads.current,
        "currentThread": threads.current,
        "main_thread": lambda: threads.main,
        "get_ident": lambda: threads.current().ident,
        "get_native_id": lambda: threads.current().native_id,
        "enumerate": threads.alive,
        "active_count": lambda: len(threads.alive()),
        "activeCount": lambda: len(threads.alive()),
        "settrace": settrace,
        "gettrace": lambda: threads.trace,
        "setprofile": lambda _function: None,
        "getprofile": lambda: None,
        "stack_size": lambda size=0: 0 if size == 0 else real_threading.stack_size(),
        "_register_atexit": lambda function, *args, **kwargs: threads.at_end.append(
            lambda: function(*args, **kwargs)
        ),
        "TIMEOUT_MAX": real_threading.TIMEOUT_MAX,
        "ThreadError": RuntimeError,
        "BrokenBarrierError": locks.BrokenBarrierError,
        "ExceptHookArgs": SimpleNamespace,
        "__excepthook__": threads.report,
    }
    module.__dict__.update(functions)
    module.__dict__["excepthook"] = threads.excepthook
    return module  # type: ignore[no-any-return]


def make_thread(context: Script) -> ModuleType:
    """Make the ``_thread`` of one script."""
    module = ModuleType("_thread", real_thread.__doc__)
    lock: Any = context.thread_classes["Lock"]

    def start_new_thread(
        function: Callable[..., object], args: tuple[Any, ...], kwargs: Any = None, /
    ) -> int:
        thread = context.thread_class()(target=function, args=args, kwargs=kwargs, daemon=True)
        thread.start()
        return thread.ident or 0

    def leave() -> None:
        raise SystemExit

    module.__dict__.update(
        start_new_thread=start_new_thread,
        start_new=start_new_thread,
        allocate_lock=lock,
        allocate=lock,
        LockType=lock,
        lock=lock,
        RLock=context.thread_classes["RLock"],
        get_ident=lambda: context.threads.current().ident,
        get_native_id=lambda: context.threads.current().native_id,
        exit=leave,
        exit_thread=leave,
        interrupt_main=lambda signum=2: context.deliver(signum),
        stack_size=lambda size=0: 0 if size == 0 else real_thread.stack_size(),
        error=RuntimeError,
        TIMEOUT_MAX=real_thread.TIMEOUT_MAX,
    )
    return module
