"""The same calls to a real rosmaster and to ours: every answer must be equal."""

import os
import threading
from xmlrpc.client import Fault, ServerProxy
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from rosmini.core.graph.master import Master
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.io_thread import IoThread
from rosmini.ros.net.master_server import MasterServer

from ..processes import wait_until
from .conftest import need_ros, rosmaster

A, B = "/a", "/ns/b"


class Recorder:
    """What the Master told other nodes; addresses are replaced by their last part, which is the same on both sides."""

    def __init__(self) -> None:
        self.heard: list[tuple] = []

    def publisher_update(self, caller_api, topic, uris) -> None:
        self.heard.append((caller_api, "publisherUpdate", topic, uris))

    def param_update(self, caller_api, key, value) -> None:
        self.heard.append((caller_api, "paramUpdate", key, value))

    def shutdown(self, caller_api, reason) -> None:
        self.heard.append((caller_api, "shutdown", reason))

    def registrations_changed(self) -> None:
        pass


class SlaveServer:
    """Three real slave servers that record what the real Master calls."""

    def __init__(self) -> None:
        self.heard: list[tuple] = []
        self.servers = [SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False) for _ in range(3)]
        self.uris = [f"http://127.0.0.1:{server.server_address[1]}/" for server in self.servers]
        for server, uri in zip(self.servers, self.uris, strict=True):
            for method in ("publisherUpdate", "paramUpdate", "shutdown"):
                server.register_function(self._recorder(uri, method), method)
            threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()

    def _recorder(self, uri, method):
        def record(_master, *arguments):
            self.heard.append((uri, method, *arguments))
            return [1, "", 0]

        return record

    def close(self) -> None:
        for server in self.servers:
            server.shutdown()
            server.server_close()


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    need_ros("rosmaster")
    slaves = SlaveServer()
    try:
        with rosmaster(tmp_path_factory.mktemp("ros")) as found, ServerProxy(found["ROS_MASTER_URI"]) as proxy:
            yield proxy, slaves
    finally:
        slaves.close()


def calls(one: str, two: str, three: str) -> list[tuple]:
    """The sequence of calls; ``one`` to ``three`` are slave addresses."""
    service, moved = "rosrpc://127.0.0.1:5001", "rosrpc://127.0.0.1:5002"
    bad_names = [("/a b",), ("http://x",), ("",), (5,), ("/",)]
    return [
        # nothing there
        ("getSystemState", A), ("getTopicTypes", A), ("getPublishedTopics", A, ""), ("getParamNames", A),
        ("lookupNode", A, "nope"), ("lookupNode", B, "nope"), ("lookupNode", A, "/"), ("lookupService", A, "s"),
        ("unregisterPublisher", A, "/t", one), ("unregisterSubscriber", A, "/t", one),
        ("unregisterService", A, "/s", service),
        # topics
        ("registerSubscriber", A, "/t", "*", one), ("getTopicTypes", A), ("unregisterService", A, "/s", service),
        ("registerPublisher", B, "t", "*", two), ("getTopicTypes", A), ("getPublishedTopics", A, ""),
        ("registerPublisher", B, "/t", "std_msgs/String", two), ("registerPublisher", B, "/t", "*", two),
        ("registerSubscriber", B, "/t", "std_msgs/Int8", two), ("registerSubscriber", A, "/u", "std_msgs/Int8", one),
        ("registerPublisher", B, "~p", "std_msgs/Bool", two), ("registerPublisher", A, "/t", "std_msgs/Float32", one),
        ("getSystemState", A), ("getTopicTypes", B), ("getPublishedTopics", A, "/"), ("getPublishedTopics", A, "ns"),
        ("getPublishedTopics", B, "b"), ("getPublishedTopics", A, "/n"), ("getPublishedTopics", A, 7),
        ("lookupNode", A, A), ("lookupNode", B, "b"), ("lookupNode", A, "ns/b/"),
        ("unregisterPublisher", A, "/t", two), ("unregisterPublisher", A, "/t", one),
        ("unregisterPublisher", A, "/t", one),
        ("unregisterSubscriber", A, "/u", one), ("unregisterSubscriber", A, "/u", one), ("getSystemState", A),
        # services
        ("registerService", A, "/s", service, one), ("lookupService", B, "/s"),
        ("registerService", B, "/s", moved, two),
        ("lookupService", B, "/s"), ("unregisterService", A, "/s", service), ("unregisterService", "/zz", "/s", moved),
        ("registerService", B, "~q", moved, two), ("getSystemState", A), ("unregisterService", B, "/s", moved),
        ("unregisterService", B, "/s", moved), ("lookupService", A, "/s"), ("unregisterService", B, "/none", moved),
        # parameters
        ("setParam", A, "/x", 1), ("setParam", A, "y", [1, [2.5, "z"], True]),
        ("setParam", B, "~g", {"k": 1, "m": {"n": "o"}}),
        ("getParam", A, "/x"), ("getParam", B, "y"), ("getParam", A, "/y"), ("getParam", A, "/ns"),
        ("getParam", A, "/"),
        ("getParam", A, "/x/y"), ("getParam", A, "/none"), ("hasParam", B, "~g/m"), ("hasParam", B, "/x/y"),
        ("getParamNames", A), ("setParam", A, "/ns/b/g", {"only": 1}), ("getParamNames", A), ("setParam", A, "/x/y", 2),
        ("getParam", A, "/x"), ("setParam", A, "/", 5), ("setParam", A, "/empty", {}), ("getParamNames", A),
        ("getParam", A, "/empty"), ("setParam", A, "//d//e/", "v"), ("getParam", A, "/d"), ("deleteParam", A, "/x/y"),
        ("deleteParam", A, "/x/y"), ("deleteParam", A, "/none/at/all"), ("deleteParam", A, "/"), ("getParam", A, "/x"),
        ("setParam", A, "", 1), ("setParam", A, 5, 1), ("getParam", A, ""), ("hasParam", A, ""),
        ("deleteParam", A, 3.5),
        ("setParam", A, "/big", 2**31 - 1), ("getParam", A, "/big"), ("setParam", A, "/raw", {"a/b": 1}),
        ("getParam", A, "/raw/a/b"), ("getParamNames", A), ("deleteParam", A, "/raw"),
        # search
        ("setParam", A, "/ns/r/arm", 1), ("setParam", A, "/r/base", 2), ("searchParam", "/ns/b/c", "r"),
        ("searchParam", "/ns/b/c", "r/leg/x"), ("searchParam", "/other", "r/base"), ("searchParam", "/ns/b", "none"),
        ("searchParam", "/ns/b", "/r/base"), ("searchParam", "/ns/b", "/r/none"), ("searchParam", "/ns/b", "~r"),
        ("searchParam", "ns", "r"), ("searchParam", "/ns/b", "g"), ("searchParam", "/ns/b", ""),
        ("searchParam", "/", "r"),
        ("searchParam", "/ns/", "r"), ("searchParam", "/ns/b", "/"),
        # subscriptions to parameters, and what each change tells whom
        ("subscribeParam", A, one, "/w/v"), ("subscribeParam", B, two, "/w"), ("subscribeParam", B, two, "/w/v/deep"),
        ("setParam", A, "/w/v", 3), ("setParam", "/c", "/w/v", 4),
        ("setParam", "/c", "/w", {"v": {"deep": 1}, "other": 2}),
        ("setParam", A, "/w", {"v": 5}), ("setParam", B, "/w/v", {"x": 1}), ("setParam", "/c", "/wide", 1),
        ("deleteParam", A, "/w/v"), ("deleteParam", A, "/w"), ("subscribeParam", B, two, "/ns/r"),
        ("subscribeParam", A, one, "/"),
        ("setParam", "/c", "/q", 1), ("unsubscribeParam", A, one, "/"), ("unsubscribeParam", A, one, "/"),
        ("setParam", "/c", "/q", 2), ("setParam", "/c", "/ns/r/arm", 9), ("subscribeParam", A, "no uri", "/w"),
        ("unsubscribeParam", A, one, ""),
        # a second node of the same name
        ("registerPublisher", B, "/taken", "std_msgs/String", two),
        ("registerPublisher", B, "/taken", "std_msgs/String", three),
        ("getSystemState", A), ("lookupNode", A, B), ("lookupService", A, "/ns/b/q"), ("setParam", "/c", "/w/v", 1),
        ("unregisterPublisher", B, "/taken", two), ("unregisterPublisher", B, "/taken", three), ("lookupNode", A, B),
        # wrong arguments
        ("getUri",), ("getUri", A, 1), ("getPid",), ("getSystemState", 5), ("getSystemState",), ("getTopicTypes", A, 1),
        ("registerPublisher", A, "/t", "std_msgs/String"), ("registerPublisher", 5, "/t", "std_msgs/String", one),
        ("registerPublisher", A, "/t", "String", one), ("registerPublisher", A, "/t", "a/b/c", one),
        ("registerPublisher", A, "/t", "", one), ("registerPublisher", A, "/t", 5, one),
        ("registerPublisher", A, "/t", "std_msgs/String", "x"), ("registerPublisher", A, "/t", "std_msgs/String", 5),
        ("registerSubscriber", A, "/t", "std_msgs/String", ""), ("registerService", A, "/s", "x", one),
        ("registerService", A, "/s", service, ""), ("setParam", A, "/x"), ("hasParam", A), ("searchParam", A, 5),
        *[("registerSubscriber", A, *name, "std_msgs/String", one) for name in bad_names],
        *[("unregisterPublisher", A, *name, one) for name in bad_names],
        *[("lookupService", A, *name) for name in bad_names],
        *[("lookupNode", A, *name) for name in bad_names],
        ("getSystemState", "no slash"), ("registerPublisher", "plain", "rel", "std_msgs/String", three),
        ("getSystemState", A),
    ]  # fmt: skip


@pytest.fixture
def served():
    """A Master of ours that is asked over XML-RPC, as the real one is."""
    io = IoThread()
    server = MasterServer(io, Master("http://127.0.0.1:11311/", Recorder()), addresses({}), 0)
    try:
        with ServerProxy(f"http://127.0.0.1:{server.port}") as proxy:
            yield proxy
    finally:
        server.close()
        io.close()


def test_every_answer_and_every_notification_is_the_real_ones(real, served) -> None:
    proxy, slaves = real
    recorder = Recorder()
    ours = Master("http://127.0.0.1:11311/", recorder)
    # rosmaster --core knows parameters of its own; ours starts with the same.
    code, _, given = proxy.getParam("/test", "/")
    assert code == 1
    assert ours.setParam("/test", "/", given) == [1, "parameter / set", 0]
    assert served.setParam("/test", "/", given) == [1, "parameter / set", 0]
    differences = []
    for number, (method, *arguments) in enumerate(calls(*slaves.uris)):
        expected = getattr(proxy, method)(*arguments)
        answer = getattr(ours, method)(*arguments)
        if answer != expected or type(answer[2]) is not type(expected[2]):
            differences.append((number, method, arguments, "real", expected, "ours", answer))
        answer = getattr(served, method)(*arguments)
        if answer != expected:
            differences.append((number, method, arguments, "real", expected, "ours over XML-RPC", answer))
        # The real Master sends what the value is by then, so let each notification arrive before the next change.
        wait_until(lambda: len(slaves.heard) >= len(recorder.heard), f"the notifications of {method}")
    assert differences == []
    # The real Master tells different nodes in parallel: only the order for each node is fixed.
    for uri in slaves.uris:
        assert [call for call in recorder.heard if call[0] == uri] == [call for call in slaves.heard if call[0] == uri]
    assert len(recorder.heard) > 20


def test_the_masters_own_facts(real) -> None:
    proxy, _ = real
    ours = Master("http://127.0.0.1:11311/", Recorder())
    assert ours.getUri("/a") == [1, "", "http://127.0.0.1:11311/"]
    assert ours.getPid("/a") == [1, "", os.getpid()]
    for method in ("getUri", "getPid"):
        code, status, value = getattr(proxy, method)("/a")
        own = getattr(ours, method)("/a")
        assert (code, status, type(value)) == (own[0], own[1], type(own[2]))


def fault(call) -> tuple[int, str]:
    with pytest.raises(Fault) as caught:
        call("/a")
    return caught.value.faultCode, caught.value.faultString


def test_what_is_no_call_of_the_master_gives_the_real_one_s_faults(real, served) -> None:
    for method in ("bogus", "_dispatch", "system.listMethods", "call"):
        expected, answer = (fault(getattr(to, method)) for to in (real[0], served))
        assert answer == expected


def test_several_calls_in_one_document_are_answered_as_by_the_real_one(real, served) -> None:
    wanted = [
        {"methodName": "setParam", "params": ["/a", "/several", [1, 2]]},
        {"methodName": "getParam", "params": ["/a", "/several"]},
        {"methodName": "bogus", "params": ["/a"]},
        {"methodName": "deleteParam", "params": ["/a", "/several"]},
    ]
    assert getattr(served, "system.multicall")(wanted) == getattr(real[0], "system.multicall")(wanted)
