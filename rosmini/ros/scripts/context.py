"""The context of one script in the shared process: all state that it takes for its own.

The scheduler calls :meth:`ScriptContext.enter` and :meth:`ScriptContext.leave` whenever the running lane belongs to
another script. They swap the process state that the standard library and other packages use: ``sys.argv`` and the
standard streams, ``__main__`` and the modules beside the script, ``os.environ``, the warning filters, numpy's legacy
random generator. Modules that block or keep global state (``time``, ``threading``, ``logging``, ...) are
replaced by the script's importer instead.

Scripts share, like threads of one process: the current folder (``os.chdir``), open files,
``sys.setrecursionlimit``, the locale. A blocking call that is not covered by :mod:`rosmini.ros.scripts.shims`
(sockets, ``asyncio.run``) blocks the other scripts while it lasts.

For the client library (rospy), which finds its caller's script as ``scheduler.current().context``:

- ``argv``: the arguments with the script's name first, as ``sys.argv`` was at the start, remappings included;
  ``remaining_argv()`` is the current ``sys.argv``.
- ``name``: the prefix of the output: the stem of the file, until :meth:`set_node_name`.
- ``node``: the node that the script initialised, set by the client library; threads of the script inherit it.
- ``at_shutdown``: a list of functions ``f(reason)``, called once, last in, first out: after the script's ``atexit``
  functions when it ends, or when it is asked to end (Ctrl-C, the end of the duration). A client library adds a
  function that shuts its node down.
- ``threads``: the client library can ignore them; the runner ends them.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import warnings
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from rosmini.core.graph.lanes import LaneExit
from rosmini.core.graph.rosout import caller
from rosmini.core.graph.threads import call_from_thread, running_scheduler
from rosmini.core.packages import package_around

from .environment import ScriptEnviron, folders_of_the_users
from .failures import user_traceback
from .imports import Importer
from .shims import copy_of
from .shims.process import make_builtins_module
from .shims.randomness import NumpyRandom
from .shims.threads import Threads, script_classes
from .stdin import Feed, ScriptInput
from .streams import OutputSink, ScriptOutput
from .ticks import TICK

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from rosmini.core.graph import Graph
    from rosmini.core.graph.lanes import Lane, Waiter
    from rosmini.core.graph.scheduler import Scheduler


class ScriptContext:
    """The state of one script, as the module describes.

    Args:
        graph: the graph that runs its lanes.
        filename: path of the script, or a name like ``<talker>`` for a text.
        argv: ``sys.argv``, the script's name first.
        sink: receives its output.
        feed: its standard input.
        seed: seed of its random numbers in simulated time.
        folders: folders with further modules, searched after its own folder.
        modules: the client library: modules by the names under which the script imports them.

    """

    def __init__(
        self,
        graph: Graph,
        filename: str,
        argv: Sequence[str],
        *,
        sink: OutputSink,
        feed: Feed,
        seed: str = "",
        folders: Sequence[str] = (),
        modules: Mapping[str, ModuleType] | None = None,
        name: str | None = None,
        environ: Sequence[tuple[str, str]] = (),
    ) -> None:
        self.graph = graph
        self.scheduler = graph.scheduler
        self.filename = filename
        self.argv = tuple(argv)
        self.name = name or Path(filename.strip("<>")).stem
        self.seed = seed
        self.node: Any = None
        self.process: Any = None
        """Handle that runs the script."""
        self.at_shutdown: list[Callable[[str], object]] = []
        self.exit_calls: list[tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]] = []
        self.handlers: dict[int, Any] = {}
        self.ended = False
        self.on_threads_ended: Callable[[], object] = lambda: None
        """Called when the last of its threads has ended after the script."""
        self.was_cut_short = False
        """True if a second Ctrl-C ended it, or what it was running."""
        self._knows_that_it_polls = False
        self._sink = sink
        self._setup_modules(folders, modules or {})
        self._setup_swapped(feed)
        self._environ.update(environ)
        self._setup_threads()

    def _setup_modules(self, folders: Sequence[str], modules: Mapping[str, ModuleType]) -> None:
        is_file = not self.filename.startswith("<")
        own = [str(Path(self.filename).absolute().parent)] if is_file else []
        self.package = package_around(self.filename) if is_file else None
        """Folder of the ROS package that contains the script, if any."""
        self._own_folders = (*own, *folders)
        self._host_path = frozenset(sys.path) - frozenset(folders_of_the_users())
        self._folders: tuple[str, ...] = ()
        self._folders_for: list[str] = []
        self.importer = Importer(self, modules)
        self.builtins_module = make_builtins_module(self)
        self.builtins = self.builtins_module.__dict__
        self.builtins[TICK] = self._make_tick()
        self.library_builtins = {**self.builtins, "__import__": self._import_for_library}
        self.main_module = ModuleType("__main__")
        self.main_module.__dict__.update(__builtins__=self.builtins_module, __file__=self.filename, __cached__=None)
        if self.filename.startswith("<"):
            del self.main_module.__dict__["__file__"]

    def _setup_swapped(self, feed: Feed) -> None:
        charge = self.scheduler.charge
        self.stdout = ScriptOutput(self._sink, lambda: self.name, charge=charge)
        self.stderr = ScriptOutput(self._sink, lambda: self.name, is_error=True, charge=charge)
        self.stdin = ScriptInput(feed, self, self.stdout.flush)
        self._own: dict[str, Any] = {
            "argv": list(self.argv),
            "path": [*self._own_folders, *sys.path],
            "stdin": self.stdin,
            "stdout": self.stdout,
            "stderr": self.stderr,
        }
        self._host: Any = None
        self._entered = False
        self._environ = ScriptEnviron()
        if self.package is not None:
            self._environ.add_package(self.package)
        self._filters: Any = list(warnings.filters)
        self._replaced: dict[str, ModuleType | None] = {}
        self._numpy: NumpyRandom | None = None

    def _setup_threads(self) -> None:
        self._blocked: dict[Lane, Waiter] = {}
        self._foreign: set[Waiter] = set()
        self._to_raise: BaseException | None = None
        self._signal_waiter: Waiter | None = None
        self.main_lane: Lane | None = None
        self.threads = Threads(self)
        self.thread_classes: dict[str, Any] = script_classes(self)

    # -- for rospy -----------------------------------------------------------------------------------------------

    def set_node_name(self, name: str) -> None:
        """Use ``name`` (without the leading slash) as the prefix of the script's output from now on."""
        self.stdout.finish()
        self.stderr.finish()
        self.name = name.removeprefix("/")

    def remaining_argv(self) -> list[str]:
        """Return the script's current ``sys.argv``."""
        return list(self.get_own("argv"))

    # -- swapping ------------------------------------------------------------------------------------------------

    def enter(self) -> None:
        """Set the process state to this script's."""
        own = self._own
        self._host = (sys.argv, sys.stdin, sys.stdout, sys.stderr, os.environ, warnings.filters)
        sys.argv, sys.stdin = own["argv"], own["stdin"]
        sys.stdout, sys.stderr = own["stdout"], own["stderr"]
        os.environ, warnings.filters = self._environ, self._filters
        self._entered = True
        self._put_module("__main__", self.main_module)
        for name, module in self.importer.local.items():
            self._put_module(name, module)
        if self._numpy is not None:
            self._numpy.enter()

    def leave(self) -> None:
        """Restore the previous process state, and save what the script changed."""
        own = self._own
        own["argv"], own["stdin"] = sys.argv, sys.stdin
        own["stdout"], own["stderr"] = sys.stdout, sys.stderr
        self._filters = warnings.filters
        sys.argv, sys.stdin, sys.stdout, sys.stderr, os.environ, warnings.filters = self._host
        self._host = None
        self._entered = False
        for name in list(self._replaced):
            self._take_module(name)
        if self._numpy is not None:
            self._numpy.leave()

    @contextmanager
    def put_aside(self) -> Iterator[None]:
        """Return the process state to the host for a while, if this script has it and the scheduler's thread calls."""
        if not self._entered or not self.scheduler.is_scheduler_thread():
            yield
            return
        self.leave()
        try:
            yield
        finally:
            self.enter()

    def after_import(self, name: str) -> None:
        """Handle numpy's random generator after the script has imported a package (``name``) that may use it."""
        if self._numpy is not None or "numpy" not in sys.modules or not self.scheduler.is_scheduler_thread():
            return
        if name.partition(".")[0] not in sys.stdlib_module_names:
            with self.put_aside():
                self._numpy = NumpyRandom(self)

    def get_own(self, name: str) -> Any:
        """Return the script's ``sys.argv``, ``path``, ``stdin``, ``stdout`` or ``stderr``; from any thread."""
        if self._entered and name != "path" and self.scheduler.is_scheduler_thread():
            return getattr(sys, name)
        return self._own[name]

    def set_own(self, name: str, value: Any) -> None:
        """Set the value that :meth:`get_own` returns."""
        self._own[name] = value
        if self._entered and name != "path":
            setattr(sys, name, value)

    def module_added(self, name: str, module: ModuleType) -> None:
        """Show a module of the script in ``sys.modules`` while the script runs."""
        if self._entered and self.scheduler.is_scheduler_thread():
            self._put_module(name, module)

    def module_removed(self, name: str) -> None:
        """Undo :meth:`module_added`."""
        if name in self._replaced:
            self._take_module(name)

    def _put_module(self, name: str, module: ModuleType) -> None:
        if name not in self._replaced:
            self._replaced[name] = sys.modules.get(name)
        sys.modules[name] = module

    def _take_module(self, name: str) -> None:
        before = self._replaced.pop(name)
        if before is None:
            sys.modules.pop(name, None)
        else:
            sys.modules[name] = before

    def local_folders(self) -> tuple[str, ...]:
        """Return the folders whose modules belong to this script alone: its own, and those it added to ``sys.path``."""
        path = self._own["path"]
        if path != self._folders_for:
            self._folders_for = list(path)
            paths = [os.fspath(item) for item in path]
            strings = [os.path.abspath(item) if item else str(Path.cwd()) for item in paths]  # noqa: PTH100
            folders = [item for item in strings if item in self._own_folders or item not in self._host_path]
            self._folders = tuple(dict.fromkeys(folders))
        return self._folders

    def _import_for_library(self, name: str, *args: Any, **kwargs: Any) -> ModuleType:
        """Import for the private copies: their ``fork`` hooks would otherwise keep a script alive for ever."""
        if name == "os":
            module = copy_of(os)
            if hasattr(os, "register_at_fork"):
                module.__dict__["register_at_fork"] = _no_fork_hook
            return module
        return self.importer.import_name(name, *args, **kwargs)

    # -- blocking ------------------------------------------------------------------------------------------------

    def pause(self, reason: str, timeout_ns: int | None) -> bool:
        """Wait for ``timeout_ns`` of graph time, or for ever; return False when the time is over."""
        return self.block(self.scheduler.waiter(reason), timeout_ns)

    def block(self, waiter: Waiter, timeout_ns: int | None = None) -> bool:
        """Wait for ``waiter`` in such a way that the script can be interrupted or ended meanwhile."""
        self.check()
        if self.scheduler.is_scheduler_thread():
            lane = self.scheduler.current()
            self._blocked[lane] = waiter
            try:
                return waiter.wait(timeout_ns)
            finally:
                self._blocked.pop(lane, None)
        self._foreign.add(waiter)
        try:
            self.check()
            return waiter.wait(timeout_ns)
        finally:
            self._foreign.discard(waiter)

    def outside(self, function: Callable[[], Any]) -> Any:
        """Return ``function()``, which waits for another process; the graph runs meanwhile if that can reach it."""
        if not self.scheduler.is_scheduler_thread() or (self.graph.simulated and not self.graph.is_online):
            return function()
        waiter = self.scheduler.waiter("another process", remote=True)

        def work() -> None:
            try:
                waiter.wake(function())
            except BaseException as error:
                waiter.fail(error)

        helper = threading.Thread(target=work, name="rosmini-helper", daemon=True)
        helper.start()
        self.keep_pace(helper.is_alive)
        self.block(waiter)
        return waiter.value

    def keep_pace(self, condition: Callable[[], bool]) -> None:
        """Limit simulated time to real time while ``condition()`` is true, if others can see the graph."""
        self.graph.keep_pace(condition)

    def check(self) -> None:
        """Raise the pending exception: the end of the script, or an interrupt in its main thread."""
        if self.ended:
            raise LaneExit(f"{self.name} has ended")
        if self._to_raise is not None and self.scheduler.current() is self.main_lane:
            error, self._to_raise = self._to_raise, None
            raise error

    def _make_tick(self) -> Callable[[], None]:
        turn = self.scheduler.turn

        def __tick__(*, is_idle: bool = False) -> None:  # noqa: N807 - the name that scripts call
            turn(is_idle=is_idle)
            if self.ended or self._to_raise is not None:
                self.check()

        return __tick__

    # -- signals -------------------------------------------------------------------------------------------------

    def deliver(self, signum: int, *, in_place: bool = False) -> bool:
        """Deliver a signal to the script; return True if the script handles it.

        A handler runs in a lane of the script, or at once with ``in_place``; its exceptions, and the
        ``KeyboardInterrupt`` of a SIGINT without a handler, are raised in the main thread, which need not be in a
        blocking call. rospy handles a SIGINT of a script with a node and without a handler, by shutting the node
        down.
        """
        number = signal.Signals(signum)
        handler = self.handlers.get(number, signal.SIG_DFL)
        if self._signal_waiter is not None:
            self._signal_waiter.wake()
        if handler is signal.SIG_IGN:
            return False
        if callable(handler) and handler is not signal.default_int_handler:
            if in_place:
                handler(int(number), None)
            else:
                self.scheduler.spawn(
                    f"{self.name}/{number.name}", lambda: self._call_handler(handler, number), context=self
                )
            return True
        if number == signal.SIGINT and not self.at_shutdown:
            self.raise_in_main(KeyboardInterrupt())
            return True
        return False

    def _call_handler(self, handler: Any, number: signal.Signals) -> None:
        try:
            handler(int(number), None)
        except LaneExit:
            raise
        except BaseException as error:
            self.raise_in_main(error)

    def cut_short(self) -> None:
        """Record that a second Ctrl-C ended what the script was running."""
        self.was_cut_short = True

    def keeps_polling(self) -> None:
        """Warn, once, about a loop that never sleeps."""
        if self._knows_that_it_polls:
            return
        self._knows_that_it_polls = True
        frame = caller(1)
        place = f"{Path(frame.f_code.co_filename).name}, line {frame.f_lineno}"
        text = (
            f"{place}: this loop never sleeps. It keeps a processor busy, floods its subscribers, and in simulated "
            "time it slows down the whole graph. Add rate = rospy.Rate(10) before the loop, and rate.sleep() at the "
            "end of its body."
        )
        if self.node is not None:
            self.node.logwarn(text)
        else:
            self.stderr.write(f"Warning: {text}\n")

    def raise_in_main(self, error: BaseException) -> None:
        """Raise ``error`` in the script's main thread, in its blocking call or at the next turn of a loop."""
        waiter = None if self.main_lane is None else self._blocked.get(self.main_lane)
        if waiter is not None and not waiter.done:
            waiter.fail(error)
        else:
            self._to_raise = error

    def raise_signal(self, signum: int, /) -> None:
        """Do the same as ``os.kill(os.getpid(), signum)``: call its handler at once, or end the script without one."""
        number = signal.Signals(signum)
        self._run_in_scheduler(lambda: self.process.signal_itself(number))

    def leave_process(self, returncode: int) -> None:
        """End the script like ``os._exit``, without ending the process."""
        self._run_in_scheduler(lambda: self.process.leave(returncode))

    def _run_in_scheduler(self, function: Callable[[], object]) -> None:
        """Call a function that may end the script in the thread that drives the graph; leave the caller if it did."""
        if self.scheduler.is_scheduler_thread():
            function()
        else:
            call_from_thread(self.scheduler, function)
        self.check()

    def await_signal(self) -> None:
        """Wait until a signal is delivered, like ``signal.pause``."""
        self._signal_waiter = self.scheduler.waiter("a signal")
        try:
            self.block(self._signal_waiter)
        finally:
            self._signal_waiter = None

    # -- the end -------------------------------------------------------------------------------------------------

    def run_exit_calls(self) -> None:
        """Call the functions registered with ``atexit``, last in, first out; errors in them are reported."""
        while self.exit_calls:
            function, args, kwargs = self.exit_calls.pop()
            try:
                function(*args, **kwargs)
            except LaneExit:
                raise
            except SystemExit:
                pass
            except BaseException as error:
                self.stderr.write(f"Exception ignored in atexit callback {function!r}:\n{user_traceback(error)}")

    def run_shutdown(self, reason: str) -> None:
        """Call the functions in ``at_shutdown``, once."""
        while self.at_shutdown:
            function = self.at_shutdown.pop()
            try:
                function(reason)
            except LaneExit:
                raise
            except BaseException as error:
                self.stderr.write(user_traceback(error))

    def lane_failed(self, error: BaseException) -> None:
        """Report an uncaught exception of a lane of the script."""
        self.stderr.write(user_traceback(error))

    def end(self) -> None:
        """End the rest of the script: its threads, at their next blocking call or turn of a loop."""
        if self.ended:
            return
        self.ended = True
        for thread in list(self.threads.by_lane.values()):
            thread.end()
        for waiter in list(self._foreign):
            waiter.fail(LaneExit(f"{self.name} has ended"))

    def other_threads(self) -> bool:
        """Return True if a thread other than the main one may still run."""
        return any(thread.busy for thread in self.threads.alive() if thread is not self.threads.main)

    def thread_ended(self) -> None:
        """Handle the end of one of its threads."""
        if self.ended and not self.other_threads():
            self.on_threads_ended()

    def close(self) -> None:
        """Discard the script's modules and restore the environment."""
        self.stdout.finish()
        self.stderr.finish()
        self._environ.give_back()
        self.importer.local.clear()
        self.importer.private.clear()

    def thread_class(self) -> Any:
        """Return the script's ``threading.Thread``."""
        return self.thread_classes["Thread"]

    def event_class(self) -> Any:
        """Return the script's ``threading.Event``."""
        return self.thread_classes["Event"]


def _leave_child() -> None:
    """Make the child of a forking script end when it blocks or has ended, since the graph belongs to its parent."""
    scheduler = running_scheduler()
    context = None if scheduler is None else scheduler.current().context
    if isinstance(context, ScriptContext):
        vars(context)["leave"] = partial(os._exit, 0)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_leave_child)


def _no_fork_hook(**_hooks: object) -> None:
    """Replace ``os.register_at_fork``, without effect."""


def current_script(scheduler: Scheduler) -> ScriptContext | None:
    """Return the script of the caller's lane or thread, or None."""
    context = scheduler.current().context
    return context if isinstance(context, ScriptContext) else None
