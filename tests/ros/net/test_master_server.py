"""A Master that is served: what others get of it, and what is said where it cannot be."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import closing
from datetime import datetime
from functools import partial
from http.client import HTTPConnection
from typing import Any
from xmlrpc.client import Binary, Fault, ProtocolError, ServerProxy, dumps

import pytest

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.core.graph.master import Master
from rosmini.ros.net import master_server
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.io_thread import IoThread
from rosmini.ros.net.master_server import AddressInUse, MasterServer
from rosmini.ros.net.xmlrpc_client import XmlRpcClient

from ...processes import PATIENCE, free_port


@pytest.fixture
def io() -> Iterator[IoThread]:
    """The thread that reads and writes."""
    made = IoThread()
    yield made
    made.close()


def master_of(graph: Graph) -> Master:
    assert isinstance(graph.master, Master)
    return graph.master


def test_others_ask_the_master_of_a_graph_and_see_its_nodes(io: IoThread) -> None:
    with Graph() as graph:
        server = MasterServer(io, master_of(graph), addresses({}), 0)
        assert graph.master_uri == f"http://localhost:{server.port}/"
        talker = graph.node("talker")
        with ServerProxy(f"http://127.0.0.1:{server.port}") as proxy:
            found: Any = proxy.lookupNode("/test", "/talker")
            assert found == [1, "node api", talker.uri]
            own: Any = proxy.getUri("/test")
            assert own == [1, "", graph.master_uri]
        assert talker.slave_call("getMasterUri", "/test")[2] == graph.master_uri
        server.close()
        assert graph.master_uri == "http://localhost:11311/"


def test_it_answers_while_the_graph_stands_still_and_wakes_who_waits_in_it(io: IoThread) -> None:
    """What another process registers lets a node of a graph in simulated time go on."""
    with Graph(simulated=False) as graph:
        server = MasterServer(io, master_of(graph), addresses({}), 0)
        node = graph.node("waiting")
        with ServerProxy(f"http://127.0.0.1:{server.port}") as proxy:
            proxy.registerService("/far", "/far/start", "rosrpc://127.0.0.1:1", "http://127.0.0.1:2/")
        registered = partial(node.master.find, "lookupService", "/far/start")
        node.wait_for_master(lambda: registered() is not None, 60, "/far/start", lambda: "it is not there")
        server.close()


def test_texts_bytes_and_dates_are_kept_as_they_are(io: IoThread) -> None:
    with Graph() as graph:
        server = MasterServer(io, master_of(graph), addresses({}), 0)
        value = {"text": "größer <&>", "bytes": Binary(b"\0\1"), "when": datetime(2026, 1, 2, 3, 4, 5)}
        with ServerProxy(f"http://127.0.0.1:{server.port}", use_builtin_types=True) as proxy:
            set_to: Any = proxy.setParam("/test", "/all", value)
            assert set_to[0] == 1
            found: Any = proxy.getParam("/test", "/all")
            assert found[2] == {**value, "bytes": b"\0\1"}
        server.close()


@pytest.mark.parametrize("arguments", [(), (5,), ([{"methodName": 5}],), ([None],), (["text"],)])
def test_several_calls_that_make_no_sense_are_a_fault(io: IoThread, arguments: tuple[Any, ...]) -> None:
    with Graph(rosout=False) as graph:
        server = MasterServer(io, master_of(graph), addresses({}), 0)
        with ServerProxy(f"http://127.0.0.1:{server.port}", allow_none=True) as proxy:
            try:
                answers: Any = getattr(proxy, "system.multicall")(*arguments)
            except Fault:
                answers = []
            assert all("faultString" in answer for answer in answers)
        server.close()


def several(port: int, count: int, method: str, *arguments: Any) -> list[Any]:
    """Make the same call several times in one request. Raises ``Fault``."""
    with ServerProxy(f"http://127.0.0.1:{port}") as proxy:
        calls = [{"methodName": method, "params": list(arguments)}] * count
        answers: Any = getattr(proxy, "system.multicall")(calls)
        assert isinstance(answers, list)
        return answers


def test_too_many_calls_at_once_are_a_fault_and_none_is_made(io: IoThread, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(master_server, "MAX_CALLS", 5)
    calls: list[str] = []
    with Graph(rosout=False) as graph:
        server = MasterServer(io, master_of(graph), addresses({}), 0, on_call=lambda method, *_: calls.append(method))
        assert len(several(server.port, 5, "getPid", "/test")) == 5
        with pytest.raises(Fault, match="has 6 calls, at most 5"):
            several(server.port, 6, "getPid", "/test")
        assert len(calls) == 5
        server.close()


def test_calls_end_where_their_answers_exceed_the_limit(io: IoThread, monkeypatch: pytest.MonkeyPatch) -> None:
    """So a short request for a large parameter, a thousand times, costs no more than the limit."""
    monkeypatch.setattr(master_server, "MAX_BYTES", 100_000)
    calls: list[str] = []
    with Graph(rosout=False) as graph:
        master_of(graph).setParam("/test", "/large", "x" * 30_000)
        server = MasterServer(io, master_of(graph), addresses({}), 0, on_call=lambda method, *_: calls.append(method))
        assert len(several(server.port, 3, "getParam", "/test", "/large")) == 3
        with pytest.raises(Fault, match="exceed 100000 bytes: of its 1000 calls 4 were made"):
            several(server.port, 1000, "getParam", "/test", "/large")
        assert len(calls) == 3 + 4
        server.close()


def test_another_client_is_answered_between_the_calls_of_one(io: IoThread) -> None:
    count, before = 3_000, []
    with Graph(rosout=False, simulated=False) as graph:
        client = XmlRpcClient(io, graph.scheduler)
        made: list[str] = []

        async def ask() -> None:
            await client.request(graph.master_uri, "getParam", ("/other", "/rosdistro"))
            before.append(len(made))

        def watch(method: str, *_: Any) -> None:
            made.append(method)
            if len(made) == 10:
                io.start(ask())

        server = MasterServer(io, master_of(graph), addresses({}), 0, on_call=watch)
        assert len(several(server.port, count, "getPid", "/test")) == count
        assert len(before) == 1
        assert before[0] < count / 2
        server.close()


def test_a_refused_client_is_logged_once(io: IoThread) -> None:
    lines: list[str] = []
    with Graph(rosout=False) as graph:
        server = MasterServer(io, master_of(graph), addresses({}), 0, warn=lines.append)
        for _ in range(3):
            with (
                ServerProxy(f"http://127.0.0.1:{server.port}", headers=[("Origin", "http://x.example")]) as proxy,
                pytest.raises(ProtocolError),
            ):
                proxy.setParam("/test", "/a", 1)
        (line,) = lines
        assert "127.0.0.1" in line
        assert "http://x.example" in line
        assert master_of(graph).hasParam("/test", "/a")[2] is False
        server.close()


def test_the_host_in_the_masters_address_is_one_of_its_names(io: IoThread) -> None:
    with Graph(rosout=False) as graph:
        where = addresses({"ROS_MASTER_URI": "http://my-robot:11311", "ROS_IP": "127.0.0.1"})
        server = MasterServer(io, master_of(graph), where, 0)
        with closing(HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)) as connection:
            for host, status in (("my-robot:11311", 200), ("other:11311", 403)):
                headers = {"Host": host, "Content-Type": "text/xml"}
                connection.request("POST", "/", dumps(("/test",), "getPid"), headers)
                answer = connection.getresponse()
                assert (answer.status, bool(answer.read())) == (status, True)
        server.close()


def test_a_port_in_use_says_what_to_do(io: IoThread) -> None:
    with Graph() as graph, socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(AddressInUse, match=rf"port {port} .*`rosmini roscore -p {port + 1}`"):
            MasterServer(io, master_of(graph), addresses({}), port)
        assert graph.master_uri == "http://localhost:11311/"


def test_an_address_of_another_machine_says_what_to_do(io: IoThread) -> None:
    with Graph() as graph:
        where = addresses({})._replace(bind="192.0.2.1")  # of a network that is for documents only
        with pytest.raises(RosminiError, match=r"cannot listen at 192\.0\.2\.1.*ROS_IP"):
            MasterServer(io, master_of(graph), where, free_port())
