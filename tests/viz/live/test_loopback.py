"""A widget's page on loopback: what goes both ways, who may ask, and how it ends."""

import contextlib
import http.client
import json
import socket
import threading
from contextlib import ExitStack
from urllib.parse import urlsplit

import pytest

from rosmini.viz.live.loopback import MAX_BYTES, MAX_CONNECTIONS, MAX_WAITING, PageServer

from ...processes import PATIENCE


class Widget:
    """What is served; it notes what its page says."""

    script = "export default { render() {} };"
    state = {"title": "A page", "scans": b"\x00\x01\xff"}

    def __init__(self):
        self.sink = None
        self.heard = []
        self.came = threading.Event()

    def hear(self, content):
        self.heard.append(content)
        self.came.set()


@pytest.fixture
def served():
    widget = Widget()
    with PageServer(widget, title="A <page>") as server:
        yield widget, server


def ask(server, path="", method="GET", body=None, token=None, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)
    headers = {name.replace("_", "-"): value for name, value in headers.items()}
    connection.request(method, f"/{token or server.token}/{path}", body, headers)
    answer = connection.getresponse()
    text = answer.read()
    connection.close()
    return answer.status, text


def say(server, content, **headers):
    return ask(server, "say", "POST", json.dumps(content), **{"Content_Type": "application/json", **headers})[0]


def test_the_page_its_module_and_its_data_are_served(served):
    widget, server = served
    parts = urlsplit(server.url)
    assert (parts.hostname, parts.port, parts.path) == ("127.0.0.1", server.port, f"/{server.token}/")
    status, page = ask(server)
    assert status == 200
    assert b"<title>A &lt;page&gt;</title>" in page
    assert ask(server, "page.js") == (200, widget.script.encode())
    assert json.loads(ask(server, "data.json")[1]) == {"title": "A page", "scans": {"base64": "AAH/"}}
    assert ask(server, "other")[0] == 404


def test_what_the_page_says_is_heard(served):
    widget, server = served
    assert say(server, {"type": "set", "key": "a"}) == 204
    assert widget.came.wait(PATIENCE)
    assert widget.heard == [{"type": "set", "key": "a"}]


def test_what_is_sent_reaches_each_page_with_its_buffers(served):
    widget, server = served
    answers = [listen(server) for _ in range(2)]
    widget.sink({"type": "frame", "at": b"\x01"}, [b"\xff\x00"])
    for answer in answers:
        event = json.loads(answer.readline().decode().removeprefix("data: "))
        assert event == {"content": {"type": "frame", "at": {"base64": "AQ=="}}, "buffers": ["/wA="]}
    server.close()
    for answer in answers:
        assert answer.read().strip() == b""


def listen(server):
    """A page that listens; it is known to the server when this returns."""
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)
    connection.request("GET", f"/{server.token}/events")
    return connection.getresponse()


def test_others_get_nothing(served):
    widget, server = served
    assert ask(server, token="guess")[0] == 404
    assert ask(server, Host="evil.example:80")[0] == 404
    assert ask(server, Origin="http://evil.example")[0] == 404
    assert ask(server, Origin=f"http://127.0.0.1:{server.port}")[0] == 200
    assert say(server, {"type": "set"}, Origin="http://evil.example") == 404
    assert say(server, {"type": "set"}, Content_Type="text/plain") == 400
    assert widget.heard == []


@pytest.mark.parametrize(
    ("body", "length"),
    [
        ("[]", None),
        ("{", None),
        ("[" * 30_000, None),
        ('"' + "x" * 70_000, None),
        ("{}", "9" * 30),
        ("{}", "0" * 12 + "9" * 11),
        ("{}", "-1"),
    ],
)
def test_what_is_no_message_is_refused(served, body, length):
    widget, server = served
    headers = {"Content_Type": "application/json"} | ({"Content_Length": length} if length else {})
    try:
        assert ask(server, "say", "POST", body, **headers)[0] == 400
    except ConnectionError:  # refused before all of it was read
        assert len(body) > MAX_BYTES or length
    assert widget.heard == []
    assert say(server, {}) == 204


def test_a_page_that_does_not_read_costs_no_more_than_its_queue(served):
    widget, server = served
    answer = listen(server)
    big = {"text": "x" * 500_000}
    for _ in range(MAX_WAITING + 60):
        widget.sink(big, None)
    with contextlib.suppress(http.client.IncompleteRead, ConnectionError):
        answer.read()  # to its end: the server has given this page up
    answer.close()
    assert ask(server)[0] == 200


def test_no_other_page_may_frame_it(served):
    _, server = served
    for path in ("", "data.json", "no-such-thing"):
        connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)
        connection.request("GET", f"/{server.token}/{path}")
        headers = connection.getresponse().headers
        connection.close()
        assert headers["X-Frame-Options"] == "DENY"
        assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]


def test_silent_connections_cost_a_bounded_number_of_threads_and_keep_nobody_out(served):
    _, server = served
    listener = listen(server)
    before = threading.active_count()
    with ExitStack() as stack:
        for _ in range(MAX_CONNECTIONS * 3):
            raw = stack.enter_context(socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE))
            raw.sendall(b"GET / HT")
        assert ask(server)[0] == 200
        assert threading.active_count() <= before + MAX_CONNECTIONS
        server.widget.sink({"type": "frame"}, None)
        assert any(b"frame" in line for line in listener)


def test_closing_ends_all_and_may_be_repeated():
    widget = Widget()
    server = PageServer(widget, title="x")
    answer = listen(server)
    server.close()
    server.close()
    assert answer.read() == b""
    assert widget.sink is None
    with pytest.raises(OSError):
        ask(server)
