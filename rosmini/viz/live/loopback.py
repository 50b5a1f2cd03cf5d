"""Serve a widget's page on loopback without Jupyter, for a terminal session.

A few HTTP requests replace Jupyter's widget protocol: the page fetches its scripts and data, receives the kernel's
messages as server-sent events, and sends its own by POST. The server listens on loopback only, on a free port, under
an unguessable path. A request must name this host and port, so that no other page in the browser
can talk to the server, and no other page can frame this one.
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
MAX_BYTES = 64_000
"""Maximum length of a page's message [bytes]."""
MAX_DIGITS = 12
"""Maximum number of digits accepted in `Content-Length`."""
MAX_WAITING = 200
"""Maximum number of messages queued for a page; a slower page is disconnected and starts again."""
MAX_CONNECTIONS = 32
"""Maximum number of connections of a server, each with a thread. A browser opens six."""
SILENCE_S = 10.0
"""Keep-alive interval [s]: a silent page is sent an empty line, which fails if the page has gone."""
END_S = 2.0

HEADERS = {
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "frame-ancestors 'none'; base-uri 'none'; form-action 'none'; object-src 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}
"""Headers of each response: no other page may frame this one or learn its address."""

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
    """The widget that a page server serves: :class:`~rosmini.viz.live.page_link.PageWidget`."""

    sink: Any
    """Receives the messages to the page in place of Jupyter."""

    @property
    def script(self) -> str:
        """JavaScript module of the page."""

    @property
    def state(self) -> dict[str, Any]:
        """Initial data of the page."""

    def hear(self, content: dict[str, Any]) -> None:
        """Receive a message from the page."""


class PageServer:
    """Serve the page of a widget until closed.

    >>> with PageServer(widget, title="RViz") as server:  # doctest: +SKIP
    ...     print(server.url)
    http://127.0.0.1:43210/9jL0.../

    Args:
        widget: the widget; its messages go to all open pages.
        title: title of the page.
        port: port to listen on; 0 for a free one.

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
        widget.sink = self._send
        self._thread.start()

    @property
    def port(self) -> int:
        """Port on which the server listens."""
        return int(self._server.server_address[1])

    @property
    def url(self) -> str:
        """Address of the page."""
        return f"http://{LOOPBACK}:{self.port}/{self.token}/"

    def close(self) -> None:
        """Close the server and notify the open pages. Calling it again has no effect."""
        self.widget.sink = None
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
        encoded = [base64.b64encode(each).decode() for each in buffers or ()]
        event = json.dumps({"content": content, "buffers": encoded}, default=packed)
        with self._lock:
            for page in list(self._pages):
                try:
                    page.put_nowait(event)
                except queue.Full:
                    self._pages.discard(page)  # its thread then ends the connection
                    _drain(page)

    # -- from the pages, each in a thread of the server -----------------------------------------------------------

    def add_page(self) -> queue.Queue[str | None]:
        """Register a page that has started to listen, and return its queue."""
        page: queue.Queue[str | None] = queue.Queue(MAX_WAITING)
        with self._lock:
            self._pages.add(page)
        return page

    def remove_page(self, page: queue.Queue[str | None]) -> None:
        """Remove a page."""
        with self._lock:
            self._pages.discard(page)


def open_window(server: PageServer, name: str) -> None:
    """Print the address of a node's window, and open it in a browser if there is a screen.

    This bypasses the log because roslaunch writes a node's log to a file.
    """
    out, err = sys.__stdout__, sys.__stderr__
    is_redirected = err is None or not err.isatty()
    stream = sys.stdout if is_redirected and out is not None and out.isatty() else sys.stderr
    print(f"{name}: its window is the page {server.url}", file=stream, flush=True)
    if has_screen():
        webbrowser.open(server.url)


def has_screen() -> bool:
    """Return True if a browser can open a window; without a screen, a text browser would take over the terminal."""
    return sys.platform in ("darwin", "win32") or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY")))


def _drain(page: queue.Queue[str | None]) -> None:
    with suppress(queue.Empty):
        while True:
            page.get_nowait()
    page.put_nowait(None)


def packed(value: Any) -> dict[str, str]:
    """Return bytes encoded as base64; the `default` of `json.dumps`."""
    if isinstance(value, bytes | bytearray | memoryview):
        return {"base64": base64.b64encode(value).decode()}
    raise TypeError(f"a page is sent {type(value).__name__}, which JSON does not have")


class _Server(ThreadingHTTPServer):
    """An HTTP server that limits connections by closing the oldest one that has not presented the token."""

    daemon_threads = True
    block_on_close = False
    request_queue_size = 128

    def __init__(self, *words: Any) -> None:
        self._free = threading.BoundedSemaphore(MAX_CONNECTIONS)
        self._lock = threading.Lock()
        self._untrusted: dict[Any, None] = {}
        """Connections that have not presented the token, oldest first."""
        super().__init__(*words)

    def process_request(self, request: Any, client_address: Any) -> None:
        """Handle a connection in a thread, or close it if all others have presented the token."""
        if not self._free.acquire(blocking=False):
            with self._lock:
                oldest = next(iter(self._untrusted), None)
            if oldest is not None:
                self.trust(oldest)
                with suppress(OSError):  # it may have just ended
                    oldest.shutdown(socket.SHUT_RDWR)
            if oldest is None or not self._free.acquire(timeout=END_S):
                self.shutdown_request(request)
                return
        with self._lock:
            self._untrusted[request] = None
        super().process_request(request, client_address)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Handle a connection until it ends."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self.trust(request)
            self._free.release()

    def trust(self, connection: Any) -> None:
        """Mark a connection as having presented the token."""
        with self._lock:
            self._untrusted.pop(connection, None)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Suppress the report of a broken connection, because the terminal belongs to the tool."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    """Handles the requests of a page."""

    server: _Server
    protocol_version = "HTTP/1.1"
    timeout = 60.0

    def __init__(self, *words: Any, pages: PageServer) -> None:
        self.pages = pages
        super().__init__(*words)

    def log_message(self, format: str, *args: Any) -> None:  # the base class's name for it
        """Suppress the access log, because the terminal belongs to the tool."""

    def _checked_path(self) -> str | None:
        """Return the path below the token; send an error and return None if the request is not from our page."""
        hosts = {f"{name}:{self.pages.port}" for name in (LOOPBACK, "localhost")}
        origin = self.headers.get("Origin")
        is_ours = self.headers.get("Host") in hosts and (origin is None or origin.removeprefix("http://") in hosts)
        root, _, rest = self.path.removeprefix("/").partition("/")
        if not is_ours or not secrets.compare_digest(root.encode(), self.pages.token.encode()):
            self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there is nothing here\n")
            return None
        self.server.trust(self.request)
        return rest

    def do_GET(self) -> None:
        """Send the page, its module, its data or the stream of events."""
        match self._checked_path():
            case "":
                page = PAGE.format(title=escape(self.pages.title))
                self._answer(HTTPStatus.OK, "text/html; charset=utf-8", page.encode())
            case "page.js":
                text = self.pages.widget.script
                self._answer(HTTPStatus.OK, "text/javascript; charset=utf-8", text.encode())
            case "data.json":
                data = json.dumps(self.pages.widget.state, default=packed)
                self._answer(HTTPStatus.OK, "application/json", data.encode())
            case "events":
                self._events()
            case None:
                pass
            case _:
                self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there is nothing here\n")

    def do_POST(self) -> None:
        """Receive a message from the page."""
        rest = self._checked_path()
        if rest is None:
            return
        length = self._length()
        is_json = self.headers.get("Content-Type", "").partition(";")[0] == "application/json"
        if rest != "say" or not is_json or length is None or length > MAX_BYTES:
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
        """Return the length of the request's body; None if the header is not a number."""
        text = self.headers.get("Content-Length", "")
        is_number = text.isascii() and text.isdecimal() and len(text) <= MAX_DIGITS
        return int(text) if is_number else None

    def end_headers(self) -> None:
        """Send the headers, including those that keep other pages out."""
        for name, value in HEADERS.items():
            self.send_header(name, value)
        super().end_headers()

    def _events(self) -> None:
        """Send messages until the page disconnects or the server closes."""
        page = self.pages.add_page()
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
            self.pages.remove_page(page)

    def _answer(self, status: HTTPStatus, kind: str, body: bytes) -> None:
        if status not in (HTTPStatus.OK, HTTPStatus.NO_CONTENT):
            self.close_connection = True  # further input is not read
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        with suppress(OSError):
            self.wfile.write(body)
