"""Tracebacks of scripts with only the user's frames."""

from __future__ import annotations

import linecache
import re
import sysconfig
import traceback
from pathlib import Path

from rosmini.core.errors import ScriptError

_PACKAGE = str(Path(__file__).resolve().parents[2])
_PYTHON = sysconfig.get_path("stdlib")

_PYTHON_2_NAMES = {
    "basestring": "str",
    "cmp": "(a > b) - (a < b)",
    "execfile": "exec(open(name).read())",
    "file": "open",
    "long": "int",
    "raw_input": "input",
    "reduce": "functools.reduce",
    "reload": "importlib.reload",
    "unichr": "chr",
    "unicode": "str",
    "xrange": "range",
}

_PYTHON_2_MODULES = {
    "ConfigParser": "configparser",
    "Queue": "queue",
    "StringIO": "io",
    "Tkinter": "tkinter",
    "cPickle": "pickle",
    "commands": "subprocess",
    "thread": "_thread",
    "urllib2": "urllib.request",
}


_SECOND_LOOP = (
    "asyncio.run() cannot be called from a running event loop",
    "Runner.run() cannot be called from a running event loop",
    "Cannot run the event loop while another loop is running",
    "This event loop is already running",
)
"""asyncio's messages when it is started in a thread in which it already runs."""


def user_traceback(error: BaseException) -> str:
    """Return the traceback of ``error`` as Python prints it, without frames inside rosmini.

    Line numbers and source lines are the user's. For a name that exists only in Python 2, a hint is added.
    """
    shown = traceback.TracebackException.from_exception(error)
    _strip(shown, error)
    return "".join(shown.format()) + _hint(error)


def _strip(shown: traceback.TracebackException, error: BaseException) -> None:
    """Remove rosmini's frames, including those in causes and groups."""
    if shown.stack is not None:
        shown.stack = traceback.StackSummary.from_list([frame for frame in shown.stack if not _ours(frame.filename)])
        if all(_pythons(frame.filename) for frame in shown.stack):  # called by frames of ours only
            shown.stack = None  # type: ignore[assignment]  # `format` leaves out the heading then
    if isinstance(error, ScriptError):  # its message says it all
        shown.__cause__ = shown.__context__ = None
    for part, source in ((shown.__cause__, error.__cause__), (shown.__context__, error.__context__)):
        if part is not None and source is not None:
            _strip(part, source)
    # A cause inside rosmini adds nothing to the error's own message.
    if shown.__cause__ is not None and not shown.__cause__.stack and not shown.__cause__.__cause__:
        shown.__cause__ = None
        shown.__suppress_context__ = True
    if isinstance(error, BaseExceptionGroup):
        for part, source in zip(shown.exceptions or (), error.exceptions, strict=False):
            _strip(part, source)


def _ours(filename: str) -> bool:
    return filename.startswith((_PACKAGE, "<frozen importlib", "<freeze of", "<thaw of"))


def _pythons(filename: str) -> bool:
    return filename.startswith(_PYTHON) and "site-packages" not in filename


_BARE_INPUT = re.compile(r"=\s*input\s*\(")
"""An input that is kept as text, and not converted to a number."""


def _reads_numbers_as_text(error: BaseException) -> bool:
    """Return True if a file in the traceback keeps the result of ``input()`` as Python 2 scripts do."""
    files = {frame.f_code.co_filename for frame, _ in traceback.walk_tb(error.__traceback__)}
    return any(
        _BARE_INPUT.search(line)
        for file in files
        if not _ours(file) and not _pythons(file)
        for line in linecache.getlines(file)
    )


def _hint(error: BaseException) -> str:
    if isinstance(error, NameError) and error.name in _PYTHON_2_NAMES:
        return f"({error.name} is Python 2; in Python 3 it is {_PYTHON_2_NAMES[error.name]})\n"
    if isinstance(error, ModuleNotFoundError) and error.name in _PYTHON_2_MODULES:
        return f"({error.name} is Python 2; in Python 3 it is {_PYTHON_2_MODULES[error.name]})\n"
    if isinstance(error, TypeError) and "str" in str(error) and _reads_numbers_as_text(error):
        return "(in Python 3 input() returns text, where Python 2 evaluated it: for a number write float(input(...)))\n"
    if isinstance(error, RuntimeError) and str(error) in _SECOND_LOOP:
        return (
            "(a notebook's kernel runs an event loop of its own in this thread, in which no second one can run, and "
            "no time of the graph would pass in it: let callbacks, a rospy.Timer or threading.Thread do several "
            "things at once; in a process of its own, `rosmini rosrun`, the script can use asyncio)\n"
        )
    return ""
