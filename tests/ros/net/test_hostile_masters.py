"""Masters that hang, are none, refuse or answer what no Master does: whoever asks learns it, and what to do."""

from __future__ import annotations

import sys
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import MasterUnreachable, ROSException
from rosmini.core.graph import Graph
from rosmini.core.graph.master import Master
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.net import connect, online, remote_master, watch
from rosmini.ros.net.io_thread import IoThread
from rosmini.ros.net.xmlrpc_server import XmlRpcServer

from ...processes import PATIENCE, free_port, run
from .hostile import RawServer, until
from .test_watch import Deaf

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


HTML = b"<!DOCTYPE html><html><body>It works!</body></html>"


def page(status: str) -> bytes:
    """A page of the web."""
    return f"HTTP/1.1 {status}\r\nContent-Type: text/html\r\nContent-Length: {len(HTML)}\r\n\r\n".encode() + HTML


class Pretender:
    """Answers as a Master should, or as it was told to."""

    def __init__(self, io: IoThread) -> None:
        self.master = Master("http://localhost/", Deaf())
        self.answers: dict[str, Any] = {}
        self.always: Any = None
        self.asked: list[str] = []
        self.hangs_at = ""
        """The method that is not answered, nor anything after it."""
        self.wakes = threading.Event()
        self.server = XmlRpcServer(io, self._answer)

    def _answer(self, method: str, arguments: tuple[Any, ...]) -> Any:
        self.asked.append(method)
        if method == self.hangs_at:
            self.wakes.wait()
        if self.always is not None:
            return self.always
        if method in self.answers:
            return self.answers[method]
        return getattr(self.master, method)(*arguments)


@pytest.fixture
def pretender() -> Iterator[Pretender]:
    """A Master that is none."""
    io = IoThread()
    made = Pretender(io)
    yield made
    made.wakes.set()
    made.server.close()
    io.close()


@contextmanager
def at(port: int) -> Iterator[Graph]:
    """A graph whose Master is at a port."""
    made = connect({"ROS_MASTER_URI": f"http://127.0.0.1:{port}"})
    yield made
    made.shutdown()


def in_lane(graph: Graph, task: Callable[[], Any]) -> list[Any]:
    """Start a task that may block; what it returns or raises comes into the list."""
    results: list[Any] = []

    def work() -> None:
        try:
            results.append(task())
        except Exception as error:
            results.append(error)

    graph.scheduler.spawn("task", work)
    return results


@pytest.mark.parametrize(
    ("method", "value"),
    [
        ("lookupNode", 5), ("lookupService", []), ("getUri", {}), ("getParamNames", ["/a", 1]),
        ("getTopicTypes", [["/a"]]), ("getPublishedTopics", {"/a": "std_msgs/String"}), ("getSystemState", []),
        ("getSystemState", [[], [], [["/a", "/node"]]]), ("registerPublisher", "http://127.0.0.1:1/"),
        ("registerSubscriber", [1]),
    ],
)  # fmt: skip
def test_a_value_of_another_type_is_no_masters(pretender: Pretender, method: str, value: Any) -> None:
    pretender.answers[method] = [1, "", value]
    with at(pretender.server.port) as graph, pytest.raises(MasterUnreachable, match="is not a ROS Master") as caught:
        graph.ask_as("/test").ask(method, *([] if method in ("getUri", "getSystemState") else ["/x"]))
    assert "Set ROS_MASTER_URI to the address that roscore shows" in str(caught.value)


@pytest.mark.parametrize("answer", [0, "", [], [1, 2], ["1", "", ""], [1, 5, ""], {"code": 1}, [[[[[]]]]]])
def test_what_is_no_triple_is_no_masters(pretender: Pretender, answer: Any) -> None:
    pretender.always = answer
    with at(pretender.server.port) as graph, pytest.raises(MasterUnreachable, match="is not a ROS Master"):
        graph.ask_as("/test").ask("getPid")


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (page("200 OK"), "is not a ROS Master.*web pages"),
        (page("404 Not Found"), "is not a ROS Master.*HTTP status 404"),
        (b"\x20\x00\x00\x00error=this is TCPROS\r\n\r\n", "is not a ROS Master"),
        (b"\x15\x03\x03\x00\x02\x02\x46\r\n\r\n", "is not a ROS Master"),
        (b"", "does not answer"),
    ],
)
def test_what_else_may_listen_there(answer: bytes, says: str) -> None:
    raw = RawServer(answer)
    with at(raw.port) as graph, pytest.raises(MasterUnreachable, match=says):
        graph.ask_as("/test").ask("getPid")
    raw.close()


def test_a_master_that_hangs_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remote_master, "TIMEOUT_S", 0.2)
    raw = RawServer()
    with at(raw.port) as graph, pytest.raises(MasterUnreachable, match=r"does not answer.* within 0\.2 s"):
        graph.ask_as("/test").ask("getPid")
    raw.close()


@pytest.mark.parametrize("method", ["getPid", "setParam", "registerPublisher", "getPublishedTopics"])
def test_a_graph_that_a_hanging_master_keeps_from_joining_stays_offline(
    pretender: Pretender, monkeypatch: pytest.MonkeyPatch, method: str
) -> None:
    """It says so once it has waited for one answer, and goes on as before."""
    pretender.hangs_at = method
    asked: list[str] = []

    def patience(asks: str) -> float:
        asked.append(asks)
        return 0.2 if method in asked else PATIENCE

    monkeypatch.setattr(online, "patience", patience)
    heard: list[str] = []
    with Graph() as graph:
        graph.node("listener").subscriber("t", String, lambda message: heard.append(message.data))
        talker = graph.node("talker")
        publisher = talker.publisher("t", String)
        talker.set_param("/speed", 3)
        nodes = set(graph.nodes)
        with pytest.raises(MasterUnreachable, match=rf"does not answer {method} within 0\.2 s: it hangs"):
            graph.online(f"http://127.0.0.1:{pretender.server.port}")
        assert isinstance(graph.master, Master)
        assert set(graph.nodes) == nodes
        graph.run(0.5)
        publisher.publish("still here")
        graph.run(0.5)
        assert heard == ["still here"]
        assert graph.ask_as("/test").ask("lookupNode", "/talker") == talker.uri
        monkeypatch.undo()
        graph.online(f"http://127.0.0.1:{free_port()}")
        graph.offline()


@pytest.mark.parametrize("answer", [5, [1, "", 7], [1, "", {}], "hello"])
def test_a_node_waits_for_a_master_that_talks_sense(
    pretender: Pretender, answer: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    """It says so once, and registers as soon as it can."""
    pretender.always = answer
    with at(pretender.server.port) as graph:
        made = in_lane(graph, lambda: graph.node("patient"))
        until(graph, lambda: len(pretender.asked) > 5, "some attempts")
        pretender.always = None
        until(graph, lambda: made, "the node")
        assert pretender.master.lookupNode("/test", "/patient")[0] == 1
    assert capsys.readouterr().err.count("Unable to register with master node") == 1


def test_a_master_that_refuses_is_quoted(pretender: Pretender) -> None:
    pretender.answers["registerPublisher"] = [-1, "not in my house", 0]
    with at(pretender.server.port) as graph:
        made = in_lane(graph, lambda: graph.node("guest").publisher("/t", String))
        until(graph, lambda: made, "its end")
    assert isinstance(made[0], ROSException)
    assert "not in my house" in str(made[0])


def test_a_master_that_never_knows_a_node_is_not_told_all_the_time(
    pretender: Pretender, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(watch, "PERIOD_S", 0.01)
    with at(pretender.server.port) as graph:
        made = in_lane(graph, lambda: graph.node("stranger"))
        until(graph, lambda: made, "the node")
        pretender.answers["lookupNode"] = [-1, "who?", ""]
        before = pretender.asked.count("lookupNode")
        until(graph, lambda: pretender.asked.count("lookupNode") > before + 40, "forty looks")
        del pretender.answers["lookupNode"]
    assert 1 <= capsys.readouterr().err.count("has forgotten") <= 6


def test_a_master_that_talks_nonsense_for_a_while_is_told_once(
    pretender: Pretender, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(watch, "PERIOD_S", 0.01)
    said: list[str] = []

    def has_said(text: str) -> bool:
        said.append(capsys.readouterr().err)
        return text in "".join(said)

    with at(pretender.server.port) as graph:
        made = in_lane(graph, lambda: graph.node("patient"))
        until(graph, lambda: made, "the node")
        before = len(pretender.asked)
        pretender.always = [1, "", {}]
        until(graph, lambda: len(pretender.asked) > before + 20, "some looks")
        pretender.always = None
        until(graph, lambda: has_said("is back"), "the Master")
    assert "".join(said).count("does not answer any more") == 1


@pytest.mark.parametrize(
    ("uri", "says"),
    [
        ("localhost", "has the form http://host:port"),
        ("http://127.0.0.1:{port}", "Connection refused"),
        ("http://no-such-host.invalid:11311", "no-such-host.invalid"),
    ],
)
def test_a_tool_says_what_is_wrong_with_the_masters_address(uri: str, says: str) -> None:
    found = run(
        [sys.executable, "-m", "rosmini", "rostopic", "list"],
        env={"PATH": "/usr/bin:/bin", "ROS_MASTER_URI": uri.format(port=free_port())},
    )
    assert found.returncode == 1
    assert says in found.stderr
    assert "Traceback" not in found.stderr
    assert "ROS_MASTER_URI" in found.stderr
    assert len(found.stderr.splitlines()) <= 2
