"""The session of a notebook: a graph in simulated time, a package, and the programs that its cells started."""

from __future__ import annotations

import contextvars
import io
import os
import sys
import threading
from contextlib import nullcontext, redirect_stderr, redirect_stdout
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph, default_graph, set_default_graph
from rosmini.ros.scripts import current_script
from rosmini.viz.embed import book_form

from .output import CellSink, TypedFeed
from .package import NotebookPackage
from .places import BookErrors, Places, ShownStream, book_text
from .runs import Runs
from .terminal import Terminals

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.ros.scripts.streams import ScriptOutput
    from rosmini.sim.logo import Logo
    from rosmini.sim.recorder import Recorder
    from rosmini.sim.turtlesim.tape import Tape
    from rosmini.viz.rviz.tools import Tools

_ATTRIBUTE = "rosmini_session"


class Session:
    """The ROS side of one notebook; an attribute of its IPython shell.

    The notebook's graph is the default graph. It does not raise errors from callbacks of scripts, but logs them,
    as in ROS.
    """

    runs: Runs
    """The runs in the graph."""

    def __init__(self, shell: Any) -> None:
        self.shell = shell
        self.package = NotebookPackage()
        self._places = Places(self.package.workspace.parent)
        self.terminals = Terminals(shell, self.attach)
        self.sink = CellSink(self._in_cell, self._several_print)
        self._cell = contextvars.copy_context()
        self._process = os.getpid()
        self._thread = threading.get_ident()
        self.begin()

    @property
    def graph(self) -> Graph:
        """The graph for all commands of the notebook."""
        graph = default_graph()
        if graph is not self.runs.graph:  # the reader has chosen a different graph
            self.runs = Runs(graph, self.say)
        return graph

    def begin(self) -> None:
        """End the graph and everything in it, and start a new one with the same time and seed."""
        try:
            self._end_graph()
        finally:
            graph = Graph(strict=False)
            graph.notebook = True
            graph.record()  # %roswhy asks about the past
            set_default_graph(graph)
            self.runs = Runs(graph, self.say)
            self.logos: dict[tuple[str, ...], Logo] = {}
            """Interpreters of ``%%logo`` cells, by the names of their turtles."""
            self.recorders: list[Recorder | Tape] = []
            """Recorders of the last ``%record``."""
            self.rviz: dict[tuple[str | None, str | None], Tools] = {}
            """Tools of RViz for ``%click``, by configuration file and fixed frame."""

    def logo(self, names: tuple[str, ...], make: Callable[[], Logo]) -> Logo:
        """Return the interpreter for these turtles in this graph; make one if there is none yet."""
        if names not in self.logos:
            self.logos[names] = make()
        return self.logos[names]

    def _end_graph(self) -> None:
        """Shut all nodes down, and discard what they print meanwhile."""
        ended = set_default_graph(None)
        if ended is None:
            return
        nowhere = io.StringIO()
        self.sink.mute(muted=True)
        try:
            with redirect_stdout(nowhere), redirect_stderr(nowhere):
                ended.shutdown("roscore ends")
        finally:
            self.sink.mute(muted=False)

    def end(self) -> None:
        """End the graph and remove the package. A fork of the process does nothing, since it owns neither."""
        if os.getpid() == self._process:
            try:
                self._end_graph()
            finally:
                self.terminals.close()
                self.package.close()

    # -- cells ---------------------------------------------------------------------------------------------------

    def require_main(self, what: str) -> None:
        """Raise ``RosminiError`` in a subshell of the kernel (for widgets and consoles), which cannot start nodes."""
        if threading.get_ident() != self._thread:
            raise RosminiError(f"{what} works in the notebook itself, not in a subshell of its kernel")

    def begin_cell(self, *_: object) -> None:
        """Send output to the cell of the caller, which has just started."""
        self.sink.begin_cell()
        self.attach()

    def attach(self) -> None:
        """Send output to the caller's cell, and read input there."""
        self._cell = contextvars.copy_context()
        self.sink.attach()

    def say(self, text: str) -> None:
        """Print a line of the notebook itself into the cell."""
        self.sink.say(text)

    def warn(self, text: str) -> None:
        """Print a warning into the cell, in order, even if a terminal redirects its output to a file."""
        if isinstance(sys.stderr, ShownStream):
            print(text, file=sys.stderr)
        else:
            self.say(text)

    def raising(self) -> BookErrors:
        """Return a context that gives rosmini's errors the book's form, if the notebook uses it."""
        return BookErrors(self._in_cell)

    def typed(self, advice: str) -> TypedFeed:
        """Return standard input that the reader types below the cell; ``advice`` is shown where this is impossible."""
        return TypedFeed(self._ask, advice)

    def _ask(self, ask: Callable[[], str]) -> str:
        script = current_script(self.graph.scheduler)
        with nullcontext() if script is None else script.put_aside():
            return self._cell.copy().run(ask)

    def _several_print(self, speaker: ScriptOutput) -> bool:
        return self.runs.several_print(speaker)

    def _in_cell(self, text: str) -> str:
        return book_text(text, self._places) if book_form() else text


def begin_session(shell: Any) -> Session:
    """Return the session of an IPython shell; make one if it has none."""
    if vars(shell).get(_ATTRIBUTE) is None:
        vars(shell)[_ATTRIBUTE] = Session(shell)
    return session_of(shell)


def session_of(shell: Any) -> Session:
    """Return the session of an IPython shell. Raises ``RosminiError`` if ``%load_ext rosmini`` has not run."""
    found: Session | None = vars(shell).get(_ATTRIBUTE)
    if found is None:
        raise RosminiError("this notebook has no graph: begin it with %load_ext rosmini")
    return found


def end_session(shell: Any) -> None:
    """End the session of an IPython shell, if it has one."""
    found: Session | None = vars(shell).pop(_ATTRIBUTE, None)
    if found is not None:
        found.end()
