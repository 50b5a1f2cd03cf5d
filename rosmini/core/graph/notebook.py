"""Access to the Jupyter kernel in which a graph runs. Not used outside notebooks."""

from __future__ import annotations

import asyncio
import contextvars
import sys
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, short_traceback

if TYPE_CHECKING:
    from .stacks import greenlet


def kernel_shell() -> Any:
    """Return IPython's shell when this process is a Jupyter kernel, else None."""
    shell = _shell() if "ipykernel" in sys.modules else None
    return shell if hasattr(shell, "kernel") else None


def _shell() -> Any:
    get_ipython = getattr(sys.modules.get("IPython"), "get_ipython", None)
    return None if get_ipython is None else get_ipython()


class Turn:
    """Taken while a cell or a slice of a live graph runs. On a page, promises would let one begin in another."""

    is_taken = False

    def __enter__(self) -> None:
        """Take it."""
        self.is_taken = True

    def __exit__(self, *_: object) -> None:
        """Give it back."""
        self.is_taken = False


def turn() -> Turn:
    """Return the turn of the page of the book (`rosmini.notebook.page`), which its cells take too, or a new one."""
    return getattr(_shell(), "turn", None) or Turn()


def has_reader() -> bool:
    """Return whether somebody can answer the cell that runs. Nobody can when nbconvert or papermill runs it."""
    shell = kernel_shell()
    return shell is not None and bool(shell.get_parent().get("content", {}).get("allow_stdin", True))


def mark_as_shown(result: object, shell: Any) -> None:
    """Keep IPython from showing a result again at the end of the cell that printed it; later cells show its text."""
    cell = shell.execution_count

    def display() -> None:
        if shell.execution_count != cell:
            del vars(result)["_ipython_display_"]
            print(result)

    vars(result)["_ipython_display_"] = display


def kernel_loop() -> asyncio.AbstractEventLoop:
    """Return the event loop of the kernel's main thread, or the running one. Raises ``RosminiError`` without one."""
    loop = getattr(getattr(getattr(kernel_shell(), "kernel", None), "io_loop", None), "asyncio_loop", None)
    if isinstance(loop, asyncio.AbstractEventLoop):
        return loop
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        msg = "a live graph needs an event loop, as a notebook has; in a program call graph.run() instead"
        raise RosminiError(msg) from None


_cell: contextvars.ContextVar[Any] = contextvars.ContextVar("rosmini_cell", default=None)
"""The header of the cell that receives the output of this context, if we have set it."""


class CellOutput:
    """Sends the output and the errors of lanes to the cell that drives the graph.

    The kernel finds a print's cell in context variables, and each greenlet has its own context. A worker starts
    with a copy of the driver's; a lane that was parked in an earlier cell keeps its own, because callbacks keep
    settings there too (``numpy.errstate``), and only changes the cell.
    """

    def __init__(self, shell: Any) -> None:
        self._shell = shell
        self._context = contextvars.Context()
        self._parent: Any = None
        self._outlets: tuple[Any, ...] = ()

    def begin(self) -> None:
        """Store the calling cell as the one that drives from now on."""
        self._parent = self._shell.get_parent()
        # Stored now: when a lane continues, sys.stdout may be its script's own.
        self._outlets = (sys.stdout, sys.stderr, self._shell.displayhook, self._shell.display_pub)
        self._context = contextvars.copy_context()
        self._context.run(_cell.set, self._parent)

    def use_driver_context(self, worker: greenlet) -> None:
        """Give a copy of the driver's context to an idle worker greenlet before it continues."""
        worker.gr_context = self._context.copy()

    def redirect_to_driving_cell(self) -> None:
        """Continue in a lane that was parked: its output now belongs to the driving cell."""
        if _cell.get() is not self._parent:
            _cell.set(self._parent)
            for outlet in self._outlets:
                assign = getattr(outlet, "set_thread_parent", None) or getattr(outlet, "set_parent", None)
                if assign is not None:
                    assign(self._parent)

    def shorten(self, error: BaseException) -> None:
        """Let IPython show ``error`` without rosmini's frames, as it shows rosmini's own errors."""
        if not isinstance(error, RosminiError):
            vars(error)["_render_traceback_"] = partial(short_traceback, error)
