"""``threading`` and ``_thread`` of one script.

In simulated time a thread is a lane of the graph: it runs when the others block, always in the same order. In
wall-clock time it is a real thread that knows its script and node, so that its rospy calls work. Locks (see
:mod:`rosmini.ros.scripts.shims.locks`) work between all of them. The classes that the standard library builds on locks
are its own code, executed for each script with these locks.
"""

from __future__ import annotations

import _thread as real_thread
import ast
import functools
import inspect
import itertools
import sys
import threading as real_threading
from types import CodeType, ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

from rosmini.core.graph.lanes import LaneExit
from rosmini.ros.scripts.failures import user_traceback

from . import locks

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.lanes import Lane
    from rosmini.ros.scripts.context import ScriptContext


_REUSED = (
    "_RLock",
    "Condition",
    "Semaphore",
    "BoundedSemaphore",
    "BrokenBarrierError",
    "Barrier",
    "_newname",
    "Thread",
    "Timer",
)
"""Names reused from the source of the standard library's ``threading``."""


class Threads:
    """The threads of one script, by lane."""

    def __init__(self, context: ScriptContext) -> None:
        self.context = context
        self.by_lane: dict[Lane, LaneThread] = {}
        self.idents = itertools.count(1)
        self.names = itertools.count(1)
        self.excepthook: Callable[[Any], object] = self.report
        self.at_end: list[Callable[[], object]] = []
        self.main: LaneThread | None = None
        self.trace: Any = None

    def current(self) -> LaneThread:
        """Return the thread of the caller; a callback, which rospy runs, gets one on first use."""
        lane = self.context.scheduler.current()
        thread = self.by_lane.get(lane)
        if thread is None:
            thread = self.foreign(lane)
        return thread

    def foreign(self, lane: Lane) -> LaneThread:
        """Create a thread object for a lane that the script did not start."""
        thread: LaneThread = self.context.thread_class()(name=f"Dummy-{next(self.names)}", daemon=True)
        thread.adopt(lane, next(self.idents))
        return thread

    def alive(self) -> list[LaneThread]:
        """Return the running threads, the main one first."""
        return [thread for thread in self.by_lane.values() if thread.is_alive()]

    def report(self, args: Any) -> None:
        """Print an uncaught exception of a thread as Python does, with only the user's frames."""
        if args.exc_type is SystemExit:
            return
        name = args.thread.name if args.thread is not None else "?"
        text = user_traceback(args.exc_value)
        self.context.get_own("stderr").write(f"Exception in thread {name}:\n{text}")


class LaneThread(locks.ForScript):
    """The parts of a script's ``threading.Thread`` that differ: how it starts, runs and ends."""

    # Set by the standard library's ``Thread.__init__``.
    _initialized: bool
    _started: locks.Event
    _ident: int | None
    ident: int | None
    name: str
    daemon: bool
    run: Callable[[], None]

    _ended: locks.Event
    _lane: Lane | None = None
    _real: real_threading.Thread | None = None

    def start(self) -> None:
        """Start the thread."""
        if not self._initialized:
            raise RuntimeError("thread.__init__() not called")
        if self._started.is_set():
            raise RuntimeError("threads can only be started once")
        script = self._script
        if script.ended:
            raise RuntimeError("can't create new thread at interpreter shutdown")
        ident = next(script.threads.idents)
        name = f"{script.name}/{self.name}"
        if script.scheduler.simulated:
            lane = script.scheduler.spawn(name, node=script.node, context=script, on_error=script.lane_failed)
            self.adopt(lane, ident)
            lane.on_exit = self._over
            lane.submit(self._bootstrap)
            return
        started = real_threading.Event()
        # Real ones are daemons: the end of the script waits for them, but the end of the host's process does not.
        self._real = real_threading.Thread(target=self._run_really, args=(name, ident, started), name=name, daemon=True)
        self._real.start()
        started.wait()

    def join(self, timeout: float | None = None) -> None:
        """Wait until the thread has ended, up to ``timeout`` seconds."""
        if not self._started.is_set():
            raise RuntimeError("cannot join thread before it is started")
        if self is self._script.threads.current():
            raise RuntimeError("cannot join current thread")
        self._ended.wait(timeout)

    def is_alive(self) -> bool:
        """Return True if it was started and has not ended."""
        return self._started.is_set() and not self._ended.is_set()

    isAlive = is_alive  # Python 2's name, in many public scripts

    @property
    def native_id(self) -> int | None:
        """Id of the real thread if there is one, otherwise its ``ident``."""
        return self._real.native_id if self._real is not None else self._ident

    # Without deprecation warnings: public scripts use these names often.

    def isDaemon(self) -> bool:
        """Return ``daemon``."""
        return self.daemon

    def setDaemon(self, daemonic: bool) -> None:
        """Set ``daemon``."""
        self.daemon = daemonic

    def getName(self) -> str:
        """Return ``name``."""
        return self.name

    def setName(self, name: str) -> None:
        """Set ``name``."""
        self.name = name

    def __repr__(self) -> str:
        state = "initial" if not self._started.is_set() else "started" if self.is_alive() else "stopped"
        return f"<{type(self).__name__}({self.name}, {state}{' daemon' if self.daemon else ''})>"

    # -- running -------------------------------------------------------------------------------------------------

    def adopt(self, lane: Lane, ident: int) -> None:
        """Become the thread of ``lane``."""
        self._lane = lane
        self._ident = ident
        self._ended = self._script.event_class()()
        self._script.threads.by_lane[lane] = self
        self._started.set()

    def _run_really(self, name: str, ident: int, started: real_threading.Event) -> None:
        script = self._script
        lane = script.scheduler.adopt_thread(name, node=script.node, context=script)
        try:
            self.adopt(lane, ident)
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
            context = getattr(self, "_context", None)  # since Python 3.14
            if context is not None:
                context.run(self.run)
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
        """True if it may still run code of the script: False between two calls of a callback."""
        return self.is_alive() and (self._real is not None or (self._lane is not None and not self._lane.idle))

    def end(self) -> None:
        """Ask it to end at its blocking call, at the end of the script."""
        if self._real is None and self._lane is not None:
            self._lane.kill()


class _Threading(ModuleType):
    """A script's ``threading``; ``local`` is created on first use, because it needs the rest."""

    def __init__(self, context: ScriptContext) -> None:
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


@functools.cache
def _definitions() -> dict[str, CodeType]:
    """Compile the reused parts of the standard library's ``threading`` one by one.

    They count as part of this file, so that a user's traceback omits them.
    """
    return {
        node.name: compile(ast.Module([node], []), __file__, "exec")
        for node in ast.parse(inspect.getsource(real_threading)).body
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name in _REUSED
    }


def script_classes(context: ScriptContext) -> dict[str, type]:
    """Create the classes of one script's ``threading``."""

    def own(*bases: type, **more: object) -> type:
        members = {"_script": context, "__module__": "threading", **more}
        return type(bases[-1].__name__, bases, members)

    lock = own(locks.Lock)
    scheduler = context.scheduler
    names: dict[str, Any] = {
        **vars(real_threading),
        "Lock": lock,
        "_allocate_lock": lock,
        "Event": own(locks.Event),
        "_time": lambda: scheduler.now_ns() / 1e9,
        "get_ident": scheduler.current,  # a lane identifies itself
        "current_thread": context.threads.current,
        "_counter": lambda: next(context.threads.names),
        "_dangling": WeakSet(),
    }
    for name in _REUSED:
        # In reports, a lane that waits for a notification must not appear to wait for a lock.
        other = {"_allocate_lock": own(locks.Lock, _reason="a condition")} if name == "Condition" else {}
        namespace = {**names, **other} if other else names
        exec(_definitions()[name], namespace)  # noqa: S102 - the standard library's own code
        names[name] = namespace[name]
        if name == "_RLock":
            names["RLock"] = names[name]
        elif name == "Condition":
            names[name].notifyAll = names[name].notify_all  # without the deprecation warning
        elif name == "Thread":
            names[name] = own(LaneThread, names[name])
    return {name: names[name] for name in ("Lock", "RLock", "Event", *_REUSED) if name[0] != "_"}


def make_threading(context: ScriptContext) -> ModuleType:
    """Create the ``threading`` of one script."""
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
        "_register_atexit": lambda function, *args, **kwargs: threads.at_end.append(lambda: function(*args, **kwargs)),
        "TIMEOUT_MAX": real_threading.TIMEOUT_MAX,
        "ThreadError": RuntimeError,
        "ExceptHookArgs": SimpleNamespace,
        "__excepthook__": threads.report,
    }
    module.__dict__.update(functions)
    module.__dict__["excepthook"] = threads.excepthook
    return module  # type: ignore[no-any-return]


def make_thread(context: ScriptContext) -> ModuleType:
    """Create the ``_thread`` of one script."""
    module = ModuleType("_thread", real_thread.__doc__)
    lock: Any = context.thread_classes["Lock"]

    def start_new_thread(function: Callable[..., object], args: tuple[Any, ...], kwargs: Any = None, /) -> int:
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
