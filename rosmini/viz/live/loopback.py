"""A widget's page without Jupyter: served on loopback, for a terminal session.

A few requests do what Jupyter does for a widget: the page's scripts and data, what the kernel's side sends as
server-sent events, and what the page says by POST. The server listens on loopback only, at a port of the system's
choice, under a path that nobody can guess; a request must name this host and port, so that no other page in the
browser can speak to it, and the page cannot be shown inside another one.
"""

from __future__ import annotations

import base64
import json
import os
import queue
import secrets
import socket
import sys
import threading
import webbrowser
from contextlib import suppress
from functools import partial
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import TracebackType
from typing import Any, Protocol, Self

from rosmini.viz.svg import escape

LOOPBACK = "127.0.0.1"
MOST_BYTES = 64_000
"""Longest message of a page."""
MOST_DIGITS = 12
"""Longest `Content-Length` that is read, in digits."""
MOST_WAITING = 200
"""How many messages wait for a page; a slower one is dropped, and begins again."""
MOST_CONNECTIONS = 32
"""How many connections, each with a thread, a server has at most. A browser opens six."""
SILENCE_S = 10.0
"""After this time without a message a page is sent an empty line, which fails if the page has gone."""
END_S = 2.0

HEADERS = {
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "frame-ancestors 'none'; base-uri 'none'; form-action 'none'; object-src 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}
"""What each answer has: no other page may frame the page, and none learns its address."""

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title><link rel="icon" href="data:,">
<style>:root{{color-scheme:light dark}}body{{margin:12px;font-family:sans-serif}}</style></head>
<body><main id="page"></main><p id="link" role="status"></p>
<script type="module">
import app from "./page.js";
const bytes = (text) => new DataView(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
const told = (key, value) => (value && typeof value === "object" && "base64" in value ? bytes(value.base64) : value);
const state = {{ data: JSON.parse(await (await fetch("./data.json")).text(), told) }};
const heard = new Set();
const model = {{
  get: (name) => state[name],
  on: (name, callback) => name === "msg:custom" && heard.add(callback),
  off: (name, callback) => heard.delete(callback),
  send(content) {{
    // One after the other: of two requests at a time the later may come first, and a stop would end what came after it.
    said = said.then(() => fetch("./say", {{
      method: "POST", headers: {{ "Content-Type": "application/json" }}, body: JSON.stringify(content),
    }})).then((answer) => answer.ok || refused(answer)).catch(() => gone());
  }},
}};
let said = Promise.resolve();
const link = document.getElementById("link");
const gone = () => {{ link.textContent = "The program behind this page has ended, or does not answer."; }};
const refused = ({{ status }}) => {{ link.textContent = `The program behind this page refused it (${{status}}).`; }};
const events = new EventSource("./events");
events.onopen = () => {{ link.textContent = ""; model.send({{ type: "hello" }}); }};
events.onerror = gone;
events.onmessage = ({{ data }}) => {{
  const {{ content, buffers }} = JSON.parse(data);
  for (const callback of [...heard]) callback(content, buffers.map(bytes));
}};
document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
app.render({{ model, el: document.getElementById("page") }});
</script></body></html>
"""


class Served(Protocol):
    """A widget, as it is served: :class:`~rosmini.viz.live.page_link.PageWidget`."""

    elsewhere: Any
    """Takes what is sent to the page, in place of Jupyter."""

    @property
    def script(self) -> str:
        """Its page's module."""

    @property
    def state(self) -> dict[str, Any]:
        """What its page knows at the beginning."""

    def hear(self, content: dict[str, Any]) -> None:
        """Take what its page says."""


class PageServer:
    """Serves the page of a widget until it is closed.

    >>> with PageServer(widget, title="RViz") as server:  # doctest: +SKIP
    ...     print(server.url)
    http://127.0.0.1:43210/9jL0.../

    Args:
        widget: the widget; what it sends goes to all pages that are open.
        title: of the page.
        port: 0 for one that is free.

    Raises:
        OSError: the port is in use.

    """

    def __init__(self, widget: Served, *, title: str, port: int = 0) -> None:
        self.widget = widget
        self.title = title
        self.token = secrets.token_urlsafe(16)
        self._pages: set[queue.Queue[str | None]] = set()
        self._lock = threading.Lock()
        self._server = _Server((LOOPBACK, port), partial(_Handler, pages=self))
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(0.1,), name="rosmini page", daemon=True
        )
        widget.elsewhere = self._send
        self._thread.start()

    @property
    def port(self) -> int:
        """Where it listens."""
        return int(self._server.server_address[1])

    @property
    def url(self) -> str:
        """The page's address."""
        return f"http://{LOOPBACK}:{self.port}/{self.token}/"

    def close(self) -> None:
        """End it; pages that are open are told. Harmless when repeated."""
        self.widget.elsewhere = None
        with self._lock:
            for page in self._pages:
                with suppress(queue.Full):
                    page.put_nowait(None)
            self._pages.clear()
        self._server.shutdown()
        self._server.server_close()
        self._thread.join(END_S)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    # -- to the pages, from the graph's thread -------------------------------------------------------------------

    def _send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        packed = [base64.b64encode(each).decode() for each in buffers or ()]
        event = json.dumps({"content": content, "buffers": packed}, default=_packed)
        with self._lock:
            for page in list(self._pages):
                try:
                    page.put_nowait(event)
                except queue.Full:
                    self._pages.discard(page)  # its thread finds nothing more, and ends the connection
                    _drain(page)

    # -- from the pages, each in a thread of the server's ---------------------------------------------------------

    def opened(self) -> queue.Queue[str | None]:
        """Take a page that listens from now on."""
        page: queue.Queue[str | None] = queue.Queue(MOST_WAITING)
        with self._lock:
            self._pages.add(page)
        return page

    def left(self, page: queue.Queue[str | None]) -> None:
        """Forget a page."""
        with self._lock:
            self._pages.discard(page)


def open_window(server: PageServer, name: str) -> None:
    """Say in the terminal where the window of a node is, and open it in a browser where there is a screen.

    Not by the log: roslaunch writes what a node logs into a file.
    """
    out, err = sys.__stdout__, sys.__stderr__
    is_redirected = err is None or not err.isatty()
    stream = sys.stdout if is_redirected and out is not None and out.isatty() else sys.stderr
    print(f"{name}: its window is the page {server.url}", file=stream, flush=True)
    if has_screen():
        webbrowser.open(server.url)


def has_screen() -> bool:
    """Return whether a browser has somewhere to appear; without a screen a text browser would take the terminal."""
    return sys.platform in ("darwin", "win32") or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY")))


def _drain(page: queue.Queue[str | None]) -> None:
    with suppress(queue.Empty):
        while True:
            page.get_nowait()
    page.put_nowait(None)


def _packed(value: Any) -> dict[str, str]:
    """Bytes, as JSON has them."""
    if isinstance(value, bytes | bytearray | memoryview):
        return {"base64": base64.b64encode(value).decode()}
    raise TypeError(f"a page is sent {type(value).__name__}, which JSON does not have")


class _Server(ThreadingHTTPServer):
    """Has a bounded number of connections: for a new one, it closes the oldest that has not shown the token."""

    daemon_threads = True
    block_on_close = False
    request_queue_size = 128

    def __init__(self, *words: Any) -> None:
        self._free = threading.BoundedSemaphore(MOST_CONNECTIONS)
        self._lock = threading.Lock()
        self._strangers: dict[Any, None] = {}
        """The connections that have not shown the token, the oldest first."""
        super().__init__(*words)

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer a connection in a thread, or close it if all others have shown the token."""
        if not self._free.acquire(blocking=False):
            with self._lock:
                oldest = next(iter(self._strangers), None)
            if oldest is not None:
                self.known(oldest)
                with suppress(OSError):  # it may have ended in this moment
                    oldest.shutdown(socket.SHUT_RDWR)
            if oldest is None or not self._free.acquire(timeout=END_S):
                self.shutdown_request(request)
                return
        with self._lock:
            self._strangers[request] = None
        super().process_request(request, client_address)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Answer a connection until it ends."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self.known(request)
            self._free.release()

    def known(self, connection: Any) -> None:
        """Take a connection off those that have not shown the token."""
        with self._lock:
            self._strangers.pop(connection, None)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of a connection that broke; a terminal belongs to the tool."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    """Answers a page."""

    server: _Server
    protocol_version = "HTTP/1.1"
    timeout = 60.0

    def __init__(self, *words: Any, pages: PageServer) -> None:
        self.pages = pages
        super().__init__(*words)

    def log_message(self, format: str, *args: Any) -> None:  # the base class's name for it
        """Say nothing: a terminal belongs to the tool."""

    def _asked(self) -> str | None:
        """What is asked for under the token; None, and an answer, where the request is not from a page of ours."""
        hosts = {f"{name}:{self.pages.port}" for name in (LOOPBACK, "localhost")}
        origin = self.headers.get("Origin")
        is_ours = self.headers.get("Host") in hosts and (
            origin is None or origin.removeprefix("http://") in hosts
        )
        root, _, rest = self.path.removeprefix("/").partition("/")
        if not is_ours or not secrets.compare_digest(root.encode(), self.pages.token.encode()):
            self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there is nothing here\n")
            return None
        self.server.known(self.request)
        return rest

    def do_GET(self) -> None:
        """Send the page, its module, its data, or what happens."""
        match self._asked():
            case "":
                page = PAGE.format(title=escape(self.pages.title))
                self._answer(HTTPStatus.OK, "text/html; charset=utf-8", page.encode())
            case "page.js":
                text = self.pages.widget.script
                self._answer(HTTPStatus.OK, "text/javascript; charset=utf-8", text.encode())
            case "data.json":
                data = json.dumps(self.pages.widget.state, default=_packed)
                self._answer(HTTPStatus.OK, "application/json", data.encode())
            case "events":
                self._events()
            case None:
                pass
            case _:
                self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there is nothing here\n")

    def do_POST(self) -> None:
        """Take what a page says."""
        rest = self._asked()
        if rest is None:
            return
        length = self._length()
        is_json = self.headers.get("Content-Type", "").partition(";")[0] == "application/json"
        if rest != "say" or not is_json or length is None or length > MOST_BYTES:
            self._answer(HTTPStatus.BAD_REQUEST, "text/plain", b"a page says a short message, as JSON\n")
            return
        try:
            content = json.loads(self.rfile.read(length))
        except (ValueError, RecursionError):
            content = None
        if not isinstance(content, dict):
            self._answer(HTTPStatus.BAD_REQUEST, "text/plain", b"a page says a mapping\n")
            return
        self.pages.widget.hear(content)
        self._answer(HTTPStatus.NO_CONTENT, "text/plain", b"")

    def _length(self) -> int | None:
        """Return the length of the request's body; None if it is not given as a number."""
        text = self.headers.get("Content-Length", "")
        is_number = text.isascii() and text.isdecimal() and len(text) <= MOST_DIGITS
        return int(text) if is_number else None

    def end_headers(self) -> None:
        """Send the headers, and with each answer those that keep other pages out."""
        for name, value in HEADERS.items():
            self.send_header(name, value)
        super().end_headers()

    def _events(self) -> None:
        """Send what there is to say until the page or the server has gone."""
        page = self.pages.opened()
        self.close_connection = True
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", "text/event-stream")
        self.end_headers()
        try:
            while True:
                try:
                    event = page.get(timeout=SILENCE_S)
                except queue.Empty:
                    event = ""
                if event is None:
                    return
                self.wfile.write(f"data: {event}\n\n".encode() if event else b":\n\n")
        except OSError:
            return  # the page was closed
        finally:
            self.pages.left(page)

    def _answer(self, status: HTTPStatus, kind: str, body: bytes) -> None:
        if status not in (HTTPStatus.OK, HTTPStatus.NO_CONTENT):
            self.close_connection = True  # what it may still send is not read
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        with suppress(OSError):
            self.wfile.write(body)
