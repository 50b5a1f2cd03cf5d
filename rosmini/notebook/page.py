"""The shell in which a page of the book runs its cells, in Pyodide. `book/static/run-worker.js` calls it."""

from __future__ import annotations

import asyncio
import builtins
import io
import json
import os
import re
import signal
import sys
from contextlib import suppress
from importlib import invalidate_caches
from importlib.abc import MetaPathFinder
from types import ModuleType
from typing import TYPE_CHECKING, Any

from IPython.core import pylabtools
from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import DisplayPublisher
from IPython.core.interactiveshell import InteractiveShell
from pyodide.ffi import JsException, run_sync

from rosmini.core.graph.notebook import Turn
from rosmini.viz.embed import PAGE, VARIABLE
from rosmini.viz.live.own_widget import OwnWidget

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Mapping

_COLOURS = re.compile(r"\x1b\[[0-9;]*m")


PACKAGES = {"numpy": "numpy", "PIL": "pillow", "matplotlib": "matplotlib"}
"""Modules of Pyodide's packages, which are loaded when they are first imported, and the names of these packages."""


def start(
    post: Callable[[str], object], ask: Callable[[str], Awaitable[str]], load: Callable[[str], Awaitable[object]]
) -> None:
    """Begin a session.

    Each output is posted as JSON: ``{"kind": "stream", "name": ..., "text": ...}``,
    ``{"kind": "data", "data": {MIME type: text}}`` or ``{"kind": "error", "text": ...}``; so is what a live view tells
    its page: ``{"kind": "tell", "id": ..., "content": ..., "buffers": ...}``. ``ask`` returns a promise of the line
    that ``input(prompt)`` returns, and ``load`` one that is settled when a package can be imported.
    """

    def send(**output: Any) -> None:
        post(json.dumps(output, default=str))

    def read_line(prompt: object = "") -> str:
        try:
            return str(run_sync(ask(str(prompt))))
        except JsException as error:  # the reader has stopped it
            raise KeyboardInterrupt from error

    os.environ[VARIABLE] = PAGE
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    vars(pylabtools)["backend2gui"] = {}  # matplotlib 3.8 imports it, and IPython 9 has it no more
    server = ModuleType("zmq")
    vars(server).update(Context=object, start_zmq_server_as_subprocess=None)
    sys.modules |= {"zmq": server, "meshcat.servers.zmqserver": server}  # meshcat imports them; no server starts here
    shell: Any = PageShell.instance()
    shell.history_manager.enabled = False
    shell.turn = Turn()
    shell.send = shell.display_pub.send = shell.displayhook.send = send
    OwnWidget.post = send
    builtins.input = read_line
    sys.meta_path.insert(0, PackageFinder(load))
    sys.stdout, sys.stderr = PageStream("stdout", send), PageStream("stderr", send)


def run(source: str) -> bool:
    """Run a cell; return whether it ended without an error. JavaScript calls this with ``callPromising``."""
    shell: Any = PageShell.instance()
    while shell.turn.is_taken:
        run_sync(asyncio.sleep(0))
    with shell.turn:
        return bool(shell.run_cell(source, store_history=True).success)


def stop() -> None:
    """End the cell that runs, as soon as graph time passes in it."""
    with suppress(KeyboardInterrupt):  # nothing runs that could end
        signal.raise_signal(signal.SIGINT)


def hear(number: int, text: str) -> None:
    """Take a message, in JSON, from the page of a live view."""
    OwnWidget.opened[number].hear(json.loads(text))


class PackageFinder(MetaPathFinder):
    """Loads Pyodide's packages when they are first imported."""

    def __init__(self, load: Callable[[str], Awaitable[object]]) -> None:
        self._load = load
        self._packages = dict(PACKAGES)

    def find_spec(self, name: str, path: object = None, target: object = None) -> None:  # noqa: ARG002
        """Load the package that has a module; the other finders then find it."""
        package = self._packages.get(name)
        if package is None:
            return
        try:
            run_sync(self._load(package))
        except JsException as error:
            msg = f"the package {package} could not be loaded, or its content has changed ({error.message})"
            raise ImportError(msg) from None
        del self._packages[name]
        invalidate_caches()


class PageStream(io.TextIOBase):
    """Standard output or error of the page."""

    encoding = "utf-8"

    def __init__(self, name: str, send: Callable[..., None]) -> None:
        super().__init__()
        self.name = name
        self._send = send

    def write(self, text: str) -> int:
        """Post a text."""
        if shown := _COLOURS.sub("", text):
            self._send(kind="stream", name=self.name, text=shown)
        return len(text)


class PageDisplayHook(DisplayHook):
    """Posts the value of a cell."""

    send: Callable[..., None]

    def write_output_prompt(self) -> None:
        """Post nothing: the page has no prompts."""

    def write_format_data(self, format_dict: Mapping[str, Any], md_dict: object = None) -> None:  # noqa: ARG002
        """Post the value in all its forms."""
        self.send(kind="data", data=dict(format_dict))

    def finish_displayhook(self) -> None:
        """Post nothing more."""


class PageDisplayPublisher(DisplayPublisher):
    """Posts what a cell displays."""

    send: Callable[..., None]

    def publish(self, data: Mapping[str, Any], *_: object, **__: object) -> None:
        """Post something in all its forms."""
        self.send(kind="data", data=dict(data))


class PageShell(InteractiveShell):
    """IPython without a terminal and without files."""

    send: Callable[..., None]
    turn: Turn
    displayhook_class = PageDisplayHook
    display_pub_class = PageDisplayPublisher

    def init_virtualenv(self) -> None:
        """Do nothing: a page has no virtual environment."""

    def enable_gui(self, gui: object = None) -> None:
        """Do nothing: there are no windows."""

    def _showtraceback(self, etype: object, evalue: object, stb: list[str]) -> None:  # noqa: ARG002
        self.send(kind="error", text=_COLOURS.sub("", "\n".join(stb)))
