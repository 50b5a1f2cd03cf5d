"""Pages of another origin against our servers on this machine: nothing that they send does anything, or is read."""

import threading
from contextlib import ExitStack, closing, contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from xmlrpc.client import ServerProxy, dumps

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.master_server import MasterServer
from rosmini.ros.net.network import network_of, tcp
from rosmini.viz.live.loopback import PageServer

from .conftest import FLAGS, launched

pytestmark = pytest.mark.browser

EVIL = "evil.example"

ATTACK = """async ([addresses, body]) => {
  const send = (address, options) => fetch(address, { method: "POST", body, ...options }).then(
    (answer) => answer.text(), (error) => `${error}`);
  const seen = [];
  for (const address of addresses) {
    for (const type of ["text/plain", "text/xml", "application/json", "application/x-www-form-urlencoded"]) {
      for (const mode of ["no-cors", "cors"]) {
        seen.push(await send(address, { mode, headers: { "Content-Type": type } }));
      }
    }
    seen.push(`${navigator.sendBeacon(address, body)}`);
    await new Promise((done) => {
      const frame = Object.assign(document.createElement("iframe"), { name: "sink", onload: done });
      const form = Object.assign(document.createElement("form"), {
        action: address, method: "POST", enctype: "text/plain", target: "sink" });
      form.append(Object.assign(document.createElement("textarea"), { name: body }));
      document.body.append(frame, form);
      form.submit();
    });
  }
  return seen.join("\\n");
}"""
"""Sends a body to each address in all ways that a page has; returns all that it can read."""


class Page(BaseHTTPRequestHandler):
    """The attacker's website: one empty page."""

    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<!DOCTYPE html><title>evil</title><body>")

    def log_message(self, *_):
        """Say nothing."""


@pytest.fixture(scope="module")
def evil(chromium):
    """A browser for which evil.example is this machine, and that leaves it to the servers to refuse."""
    flags = [f"--host-resolver-rules=MAP {EVIL} 127.0.0.1", "--disable-features=LocalNetworkAccessChecks"]
    browser = launched(chromium.browser_type, [*FLAGS, *flags])
    yield browser
    browser.close()


@pytest.fixture
def page(evil):
    """A page of the attacker's website."""
    with ThreadingHTTPServer(("127.0.0.1", 0), Page) as site, closing(evil.new_context()) as context:
        threading.Thread(target=site.serve_forever, daemon=True).start()
        opened = context.new_page()
        opened.goto(f"http://{EVIL}:{site.server_address[1]}/")
        yield opened
        site.shutdown()


@contextmanager
def rebound(page, port):
    """Another page whose origin has a server's own port: its name had another address when it was loaded."""
    other = page.context.new_page()
    address = f"http://{EVIL}:{port}/"
    other.route(address, lambda route: route.fulfill(content_type="text/html", body="<body>"), times=1)
    other.goto(address)
    yield other
    other.close()


@pytest.fixture
def served():
    """A Master and a node that listens to /cmd_vel, with the ports of both, and the refusals that were logged."""
    with ExitStack() as stack:
        graph = stack.enter_context(Graph(simulated=False, strict=False, transports=[tcp()]))
        refusals = []
        master = MasterServer(network_of(graph).io, graph.master, addresses({}), 0, warn=refusals.append)
        stack.callback(master.close)
        robot = graph.node("robot")
        robot.subscriber("cmd_vel", Twist, lambda _: None)
        graph.run(0.1)
        yield graph, {"master": master.port, "robot": int(robot.uri.rstrip("/").rpartition(":")[2])}, refusals


def test_no_page_sets_a_parameter_or_registers_a_publisher(page, served):
    graph, ports, refusals = served
    port = ports["master"]
    addresses_of_it = [f"http://{host}:{port}/RPC2" for host in ("127.0.0.1", "localhost", EVIL)]
    calls = [
        dumps(("/evil", "/pwned", 1), "setParam"),
        dumps(("/evil", "/cmd_vel", "geometry_msgs/Twist", "http://127.0.0.1:9/"), "registerPublisher"),
    ]
    for call in calls:
        assert "methodResponse" not in page.evaluate(ATTACK, [addresses_of_it, call])
        with rebound(page, port) as other:
            assert "methodResponse" not in other.evaluate(ATTACK, [["/RPC2"], call])
    assert graph.master.hasParam("/test", "/pwned")[2] is False
    assert "/cmd_vel" not in dict(graph.master.getSystemState("/test")[2][0])
    assert len(refusals) == 1  # so the requests did come
    with ServerProxy(f"http://127.0.0.1:{port}") as proxy:
        proxy.setParam("/test", "/pwned", 1)
    assert graph.master.hasParam("/test", "/pwned")[2] is True


def test_no_page_makes_a_node_connect_or_end_or_reads_what_it_does(page, served, capsys):
    graph, ports, _ = served
    port, robot = ports["robot"], graph.nodes["/robot"]
    addresses_of_it = [f"http://{host}:{port}/" for host in ("127.0.0.1", "localhost", EVIL)]
    calls = [
        dumps(("/evil", "/cmd_vel", ["http://127.0.0.1:9/"]), "publisherUpdate"),
        dumps(("/evil", "enough"), "shutdown"),
        dumps(("/evil",), "getBusInfo"),
    ]
    before = robot.subscriptions["/cmd_vel"].updates
    for call in calls:
        assert "methodResponse" not in page.evaluate(ATTACK, [addresses_of_it, call])
        with rebound(page, port) as other:
            assert "methodResponse" not in other.evaluate(ATTACK, [["/"], call])
    graph.run(0.1)
    assert graph.nodes["/robot"] is robot
    assert robot.subscriptions["/cmd_vel"].updates == before
    assert capsys.readouterr().err.count("/robot refused a request from 127.0.0.1") == 1


class Widget:
    """What a page server serves; its page says hello when it runs."""

    script = "export default { render() {} };"
    state = {"secret": "42"}
    sink = None

    def __init__(self):
        self.heard = []

    def hear(self, content):
        self.heard.append(content)


def test_no_page_speaks_to_a_page_server_or_reads_it_even_with_its_address(page):
    widget = Widget()
    with PageServer(widget, title="a page") as server:
        hosts = ("127.0.0.1", "localhost", EVIL)
        said = [f"http://{host}:{server.port}/{server.token}/say" for host in hosts]
        assert "42" not in page.evaluate(ATTACK, [said, '{"type": "hello"}'])
        with rebound(page, server.port) as other:
            for name in ("say", "data.json"):
                assert "42" not in other.evaluate(ATTACK, [[f"/{server.token}/{name}"], '{"type": "hello"}'])
            read = "address => fetch(address).then((answer) => answer.text(), (error) => `${error}`)"
            assert other.evaluate(read, f"/{server.token}/data.json") == "there is nothing here\n"
    assert widget.heard == []


def test_a_page_cannot_be_framed(page):
    """What is clicked in a frame that nobody sees would drive the robot."""
    widget = Widget()
    with PageServer(widget, title="a page") as server:
        frame = """(address) => new Promise((done) => document.body.append(
            Object.assign(document.createElement("iframe"), { src: address, onload: done })))"""
        page.evaluate(frame, server.url)
        page.frames[1].wait_for_function("location.href != 'about:blank'")
        assert [each.url for each in page.frames[1:]] == ["chrome-error://chromewebdata/"]
        assert widget.heard == []
        with page.expect_request(lambda request: request.method == "POST") as said:
            page.goto(server.url)
        assert said.value.response().status == 204
        assert widget.heard == [{"type": "hello"}]
