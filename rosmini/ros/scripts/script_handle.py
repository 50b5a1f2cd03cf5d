"""Handle of a script: from its file to an exit status, for each start."""

from __future__ import annotations

import os
import signal
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSException, ROSInterruptException, ScriptError
from rosmini.core.graph.lanes import LaneExit

from .context import ScriptContext
from .failures import user_traceback
from .handle import LaneHandle
from .source import Source, compile_script, forget_lines, read_script, remember_lines

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from types import ModuleType

    from rosmini.core.graph import Graph

    from .console import Console
    from .streams import ScriptOutput

END_GRACE_S = 0.2
"""Time to end for a script that was forced out of its last blocking call, in graph time [s]."""

INTERRUPTED = -signal.SIGINT
"""Return code of a script ended by Ctrl-C."""

_IGNORED_BY_DEFAULT = ("SIGCHLD", "SIGCONT", "SIGURG", "SIGWINCH")


@dataclass(frozen=True)
class ScriptSpec:
    """A script to run: ``path`` with ``args``, or the text ``source`` under the name ``path``.

    ``environ`` are changes to its environment.
    """

    path: str
    args: tuple[str, ...] = ()
    source: str | None = None
    environ: tuple[tuple[str, str], ...] = ()

    def read(self) -> Source:
        """Read and compile it. Raises ``ScriptError`` if it is missing or is not Python."""
        if self.source is None:
            return read_script(self.path)
        filename = f"<{self.path}>"
        source = compile_script(self.source.encode(), filename)
        remember_lines(filename, self.source)
        return source


class ScriptHandle(LaneHandle):
    """A script of a graph; see :class:`~rosmini.ros.scripts.handle.Handle`.

    ``seed`` is the seed of its random numbers in simulated time, ``folders`` are folders with its modules besides
    its own folder, and ``modules`` is the client library by the names under which it is imported: by default rosmini's
    rospy.

    Raises ``ScriptError`` if the script is missing or is not Python.
    """

    def __init__(
        self,
        graph: Graph,
        spec: ScriptSpec,
        console: Callable[[], Console],
        *,
        seed: str = "",
        folders: Sequence[str] = (),
        modules: Mapping[str, ModuleType] | None = None,
        owns_console: bool = True,
    ) -> None:
        super().__init__(graph, spec.args, console, owns_console=owns_console)
        self.spec = spec
        self._seed = f"{seed}/{spec.path.replace(os.sep, '/').rpartition('/')[2]}"
        self._folders = folders
        if modules is None:
            from rosmini.ros.rospy.importer import modules as rospy_modules

            modules = rospy_modules()
        self._modules = modules
        self._source: Source | None = spec.read()
        self._context: ScriptContext | None = None
        self._asked = False
        self._status = 0
        self._forced: int | None = None
        self.ended_itself = False
        """True if the script sent itself the signal that ended it, or called ``os._exit``."""

    @property
    def name(self) -> str:
        """Name of its node, or of its file before it has one."""
        return Path(self.spec.path).stem if self._context is None else self._context.name

    @property
    def node(self) -> Any:
        """The node that it initialised since its latest start, or None."""
        return None if self._context is None else self._context.node

    def writes(self, stream: ScriptOutput) -> bool:
        """Return True if a stream is its standard output or error since its latest start."""
        return self._context is not None and stream in (self._context.stdout, self._context.stderr)

    @property
    def context(self) -> ScriptContext:
        """The context of its latest start."""
        if self._context is None:
            raise ScriptError(f"{self.name} was not started; call start() first")
        return self._context

    def _launch(self) -> None:
        source = self._source or self.spec.read()
        self._source = None  # a respawn reads the file again
        self._asked = False
        self._status = 0
        self._forced = None
        self.ended_itself = False
        console = self.console
        context = self._context = ScriptContext(
            self.graph,
            source.filename,
            [self.spec.path, *self.args],
            sink=console.sink,
            feed=console.feed,
            seed=self._seed,
            folders=self._folders,
            modules=self._modules,
            environ=self.spec.environ,
        )
        context.on_threads_ended = lambda: self._close(context)
        context.process = self
        lane = self.scheduler.spawn(context.name, context=context, on_error=context.lane_failed)
        lane.node = None  # not the node of the notebook cell that starts it
        lane.on_exit = self._main_ended
        context.main_lane = lane
        main = context.thread_class()(name="MainThread", daemon=False)
        main.adopt(lane, next(context.threads.idents))
        context.threads.main = main
        lane.submit(lambda: self._main(source))

    # -- in its main lane ----------------------------------------------------------------------------------------

    def _main(self, source: Source) -> None:
        try:
            self._execute(source)
            self._finish()
        except LaneExit:
            pass
        finally:
            self._main_ended()

    def _execute(self, source: Source) -> None:
        namespace = self.context.main_module.__dict__
        namespace["__doc__"] = source.doc
        try:
            exec(source.code, namespace)  # noqa: S102 - this is what running a script is
        except SystemExit as request:
            self._status = self._exit_status(request)
        except LaneExit:
            pass  # the run is over
        except ROSException as error:
            # In wall-clock time rospy's sleep does not raise the first: a loop that polls is_shutdown() just ends.
            # In simulated time the reader has run its cell again, and is not told that the node could not go on.
            is_interrupt = isinstance(error, ROSInterruptException)
            if not (self._asked if self.scheduler.simulated else is_interrupt):
                self._failed(error)
        except KeyboardInterrupt as error:
            if self._asked:
                self._status = INTERRUPTED
            else:
                self._failed(error)
        except BaseException as error:
            self._failed(error)

    def _exit_status(self, request: SystemExit) -> int:
        code = request.code
        if code is None:
            return 0
        if isinstance(code, int):
            return code & 0xFF
        self.context.get_own("stderr").write(f"{code}\n")
        return 1

    def _failed(self, error: BaseException) -> None:
        self._status = 1
        context = self.context
        sys_shim = context.importer.private.get("sys")
        hook = None if sys_shim is None else vars(sys_shim).get("excepthook")
        if hook is not None and hook is not sys.excepthook:
            try:
                hook(type(error), error, error.__traceback__)
                return
            except Exception as second:
                context.get_own("stderr").write(f"Error in sys.excepthook:\n{user_traceback(second)}")
        context.get_own("stderr").write(user_traceback(error))

    def _finish(self) -> None:
        """End like a Python program: wait for threads, then run ``atexit``; then shut the node down."""
        context = self.context
        try:
            while context.threads.at_end:
                context.threads.at_end.pop()()
            self._wait_for_threads()
        except (LaneExit, KeyboardInterrupt):
            pass
        context.run_exit_calls()
        context.run_shutdown("the script has ended")

    def _wait_for_threads(self) -> None:
        threads = self.context.threads
        while True:
            waited_for = [thread for thread in threads.alive() if thread is not threads.main and not thread.daemon]
            if not waited_for:
                return
            waited_for[0].join()

    # -- its end -------------------------------------------------------------------------------------------------

    def _main_ended(self) -> None:
        """End its threads and discard it; a real thread that does not end is not awaited for long."""
        context = self.context
        if context.ended and self._forced is None:
            return
        context.end()
        if context.other_threads():
            end = self.scheduler.now_ns() + round(END_GRACE_S * 1e9)
            self.scheduler.call_at(end, lambda: self._close(context))
        else:
            self._close(context)

    def _close(self, context: ScriptContext) -> None:
        if context is not self._context or not self._running:
            return
        with context.put_aside():
            context.close()
        if self.spec.source is not None:
            forget_lines(context.filename)
        status = self._status or (INTERRUPTED if context.was_cut_short else 0)
        self._conclude(status if self._forced is None else self._forced)

    def ask_to_end(self, reason: str) -> bool:
        """Make its client library shut the node down; return False if it has none."""
        context = self.context
        if not context.at_shutdown:
            return False
        self._asked = True
        self.scheduler.spawn(f"{self.name} shutdown", lambda: context.run_shutdown(reason), context=context)
        return True

    def interrupt(self, reason: str, *, in_place: bool = False) -> bool:
        """Interrupt it like Ctrl-C: call its handler, raise ``KeyboardInterrupt``, or let rospy shut its node down."""
        delivered = self.context.deliver(signal.SIGINT, in_place=in_place)
        self._asked |= delivered
        return self.ask_to_end(reason) or delivered

    def throw_out(self) -> None:
        """Force the script out of its blocking call; its ``atexit`` functions run."""
        self.context.raise_in_main(LaneExit("the run is over"))

    def signal_itself(self, signum: signal.Signals, *, in_place: bool = True) -> None:
        """Handle a signal that the script sent to itself: its handler is called before this returns, or in a lane."""
        self.ended_itself = True
        self._signal(signum, in_place=in_place)
        self.ended_itself = not self._running or self.context.ended

    def leave(self, returncode: int) -> None:
        """End at once at the script's request, like ``os._exit``."""
        self.ended_itself = True
        self.end_now(returncode)

    def _signal(self, signum: signal.Signals, *, in_place: bool = False) -> None:
        context = self.context
        if signum == signal.SIGINT:
            self.interrupt("signal-2", in_place=in_place)
        elif not context.deliver(signum, in_place=in_place) and context.handlers.get(signum) is not signal.SIG_IGN:
            if signum == signal.SIGTERM and (context.at_shutdown or context.node is not None):  # handled by rospy
                self.ask_to_end("signal-15")
            elif signum.name not in _IGNORED_BY_DEFAULT:
                self.end_now(-signum)

    def end_now(self, returncode: int) -> None:
        """Kill it, with this return code."""
        context = self.context
        self._forced = returncode
        context.at_shutdown.clear()
        context.exit_calls.clear()
        context.threads.at_end.clear()
        context.end()
        if context.node is not None:
            context.node.shutdown(f"{self.name} was killed", hooks=False)
        if context.main_lane is not None:
            context.main_lane.kill()
        if self.scheduler.current().context is context:  # it ends itself
            context.check()
