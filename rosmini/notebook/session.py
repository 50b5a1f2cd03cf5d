"""What one notebook has besides its variables: a graph in simulated time, a package, and what its cells started."""

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
from rosmini.viz.book_form import book_form

from .book_text import BookErrors, book_text
from .output import CellSink, TypedFeed
from .package import NotebookPackage
from .places import Places, ShownStream
from .runs import Runs
from .terminal import Terminals

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.ros.scripts.streams import ScriptOutput
    from rosmini.sim.logo import Logo

_ATTRIBUTE = "rosmini_session"


class Session:
    """The ROS side of one notebook; an attribute of its IPython shell.

    The notebook's graph is the default graph. It does not raise what a callback of a script lets out: that is logged,
    as in ROS.
    """

    runs: Runs
    """What runs in the graph."""

    def __init__(self, shell: Any) -> None:
        self.shell = shell
        self.package = NotebookPackage()
        self._places = Places(self.package.workspace.parent)
        self.terminals = Terminals(shell, self.look)
        self.sink = CellSink(self._in_cell, self._several_speak)
        self._cell = contextvars.copy_context()
        self._process = os.getpid()
        self._thread = threading.get_ident()
        self.begin()

    @property
    def graph(self) -> Graph:
        """The graph on which all commands of the notebook act."""
        graph = default_graph()
        if graph is not self.runs.graph:  # the reader has chosen another
            self.runs = Runs(graph, self.say)
        return graph

    def begin(self) -> None:
        """End the graph with all that runs in it, and begin with a new one at the same time and with the same seed."""
        try:
            self._end_graph()
        finally:
            graph = Graph(strict=False)
            graph.notebook = True
            graph.record()  # %roswhy asks about what was, and nobody knows before what that will be
            set_default_graph(graph)
            self.runs = Runs(graph, self.say)
            self.logos: dict[tuple[str, ...], Logo] = {}
            """The interpreters of ``%%logo`` cells, by the names of their turtles."""

    def logo(self, names: tuple[str, ...], make: Callable[[], Logo]) -> Logo:
        """Return the interpreter that drives these turtles in this graph, made now if there is none."""
        if names not in self.logos:
            self.logos[names] = make()
        return self.logos[names]

    def _end_graph(self) -> None:
        """Shut all nodes down; what they print meanwhile went to terminals of theirs, and is not shown."""
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
        """End the graph and remove the package. Only in the process that began; a fork of it owns nothing."""
        if os.getpid() == self._process:
            try:
                self._end_graph()
            finally:
                self.terminals.close()
                self.package.close()

    # -- cells ---------------------------------------------------------------------------------------------------

    def require_main(self, what: str) -> None:
        """Raise ``RosminiError`` in a subshell of the kernel, where widgets and consoles ask, and no node can begin."""
        if threading.get_ident() != self._thread:
            raise RosminiError(f"{what} works in the notebook itself, not in a subshell of its kernel")

    def begin_cell(self, *_: object) -> None:
        """Note that another cell runs: the caller's."""
        self.sink.begin_cell()
        self.look()

    def look(self) -> None:
        """Note where the caller's output goes, and where its reader types."""
        self._cell = contextvars.copy_context()
        self.sink.look()

    def say(self, text: str) -> None:
        """Print a line of the notebook's own into the cell."""
        self.sink.say(text)

    def warn(self, text: str) -> None:
        """Print what is amiss: into the cell, in order, also where a terminal writes what is said into a file."""
        if isinstance(sys.stderr, ShownStream):
            print(text, file=sys.stderr)
        else:
            self.say(text)

    def raising(self) -> BookErrors:
        """Return what gives errors of ours the book's form on their way into a cell, where cells have that."""
        return BookErrors(self._in_cell)

    def typed(self, advice: str) -> TypedFeed:
        """Return standard input from the reader, who types below the cell; ``advice`` is for where nobody can."""
        return TypedFeed(self._ask, advice)

    def _ask(self, ask: Callable[[], str]) -> str:
        script = current_script(self.graph.scheduler)
        with nullcontext() if script is None else script.put_aside():
            return self._cell.copy().run(ask)

    def _several_speak(self, speaker: ScriptOutput) -> bool:
        return self.runs.several_speak(speaker)

    def _in_cell(self, text: str) -> str:
        return book_text(text, self._places) if book_form() else text


def begin_session(shell: Any) -> Session:
    """Return the session of an IPython shell, made now if it has none."""
    if vars(shell).get(_ATTRIBUTE) is None:
        vars(shell)[_ATTRIBUTE] = Session(shell)
    return session_of(shell)


def session_of(shell: Any) -> Session:
    """Return the session of an IPython shell. Raises ``RosminiError`` where ``%load_ext rosmini`` has not run."""
    found: Session | None = vars(shell).get(_ATTRIBUTE)
    if found is None:
        raise RosminiError("this notebook has no graph: begin it with %load_ext rosmini")
    return found


def end_session(shell: Any) -> None:
    """End the session of an IPython shell, if it has one."""
    found: Session | None = vars(shell).pop(_ATTRIBUTE, None)
    if found is not None:
        found.end()
