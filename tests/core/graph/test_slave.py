"""The slave API and the registration, step by step, beside what real ROS answered (wire_xmlrpc_tcpros.txt)."""

from __future__ import annotations

import os
import threading
from types import SimpleNamespace
from typing import Any

import pytest

from rosmini.core.errors import TransportException, TransportInitError
from rosmini.core.graph import Graph
from rosmini.core.graph.connection import QueuedSender
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import SetBool
from rosmini.ros.net.tcp_transport import TcpTransport
from rosmini.ros.net.xmlrpc_text import XmlRpcFault

from ...processes import PATIENCE
from .conftest import settle, until

MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"


def call(graph: Graph, node: str, method: str, *arguments: Any) -> Any:
    """Call a node's slave API across the transport."""
    uri = graph.master.lookupNode("/test", node)[2]
    return graph.transport.call(uri, method, "/test", *arguments)


@pytest.fixture
def talking(graph: Graph) -> Graph:
    """A graph with /talker and /listener, connected, and one message sent."""
    heard: list[Any] = []
    graph.node("listener").subscriber("chatter", String, heard.append)
    publisher = graph.node("talker").publisher("chatter", String)
    publisher.wait_for_subscribers()
    publisher.publish("x")
    until(graph, lambda: heard)
    settle(graph)
    return graph


def test_each_method_answers_as_in_ros(talking: Graph) -> None:
    offers = talking.transport.offers(talking.master.lookupNode("/test", "/listener")[2])
    protocol = offers[0][0]
    assert call(talking, "/talker", "getMasterUri") == [1, talking.master_uri, talking.master_uri]
    assert call(talking, "/talker", "getPid") == [1, "", os.getpid()]
    assert call(talking, "/talker", "getSubscriptions") == [1, "subscriptions", []]
    assert call(talking, "/talker", "getPublications") == [
        1,
        "publications",
        [["/rosout", "rosgraph_msgs/Log"], ["/chatter", "std_msgs/String"]],
    ]
    assert call(talking, "/listener", "getSubscriptions") == [1, "subscriptions", [["/chatter", "std_msgs/String"]]]
    assert call(talking, "/talker", "requestTopic", "/nope", offers) == [-1, "Not a publisher of [/nope]", []]
    assert call(talking, "/talker", "requestTopic", "/chatter", [["UDPROS"]]) == [
        0,
        "no supported protocol implementations",
        [],
    ]
    code, status, parameters = call(talking, "/talker", "requestTopic", "/chatter", [["UDPROS"], *offers])
    assert (code, status.startswith("ready on "), parameters[0]) == (1, True, protocol)
    assert call(talking, "/talker", "paramUpdate", "/nothing", 1) == [-1, "not subscribed", 0]
    assert call(talking, "/talker", "publisherUpdate", "/nothing", []) == [1, "", 0]


def test_bad_arguments_get_code_minus_1_as_from_rospy(talking: Graph) -> None:
    node = talking.nodes["/listener"]
    for method, *arguments in (
        ("getPid",),
        ("getPid", 1),
        ("getPid", "/test", "more"),
        ("paramUpdate", "/test", 1, 1),
        ("paramUpdate", "/test", "", 1),
        ("publisherUpdate", "/test", "", ["http://here:1/"]),
        ("publisherUpdate", "/test", "/", ["http://here:1/"]),
        ("publisherUpdate", "/test", "/a b", ["http://here:1/"]),
        ("publisherUpdate", "/test", "/chatter", "http://here:1/"),
        ("publisherUpdate", "/test", "/chatter", ["http://here:1/", 2]),
        ("publisherUpdate", "/test", "/chatter", ["here"]),
        ("requestTopic", "/test", "/chatter", []),
        ("requestTopic", "/test", "/chatter", [1]),
        ("requestTopic", "/test", "/chatter", [[]]),
    ):
        code, status, _ = node.slave_call(method, *arguments)
        assert code == -1, (method, arguments)
        assert status
    assert call(talking, "/listener", "getName") == [1, "", "/listener"]
    assert call(talking, "/listener", "getUri") == [1, "", node.uri]


def test_the_bus_lists_each_connection(talking: Graph) -> None:
    protocol = talking.transport.transports[0].protocol
    code, status, rows = call(talking, "/talker", "getBusInfo")
    assert (code, status) == (1, "bus info")
    assert [row[1:6] for row in rows if row[4] == "/chatter"] == [["/listener", "o", protocol, "/chatter", True]]
    (row,) = call(talking, "/listener", "getBusInfo")[2][1:] or [None]
    assert row[1] == talking.master.lookupNode("/test", "/talker")[2]
    assert row[2:6] == ["i", protocol, "/chatter", True]
    code, status, (published, subscribed, services) = call(talking, "/talker", "getBusStats")
    assert (code, status, subscribed, services) == (1, "", [], [])
    ((number, _, sent, connected, dropped),) = {topic: links for topic, _, links in published}["/chatter"]
    assert (sent, connected, dropped) == (1, True, 0)
    assert isinstance(number, int)
    ((topic, links),) = call(talking, "/listener", "getBusStats")[2][1]
    on_a_wire = isinstance(talking.transport.transports[0], TcpTransport)
    assert (topic, [link[1:] for link in links]) == ("/chatter", [[9 if on_a_wire else 0, 0, True]])


def test_an_unknown_method_and_wrong_arguments_are_answered_with_an_error(talking: Graph) -> None:
    if isinstance(talking.transport.transports[0], TcpTransport):  # as rospy: a fault of XML-RPC
        with pytest.raises(XmlRpcFault, match='method "bogus" is not supported'):
            call(talking, "/talker", "bogus")
    else:
        code, status, _ = call(talking, "/talker", "bogus")
        assert code == -1
        assert 'method "bogus" is not supported' in status
    assert call(talking, "/talker", "requestTopic")[0] == -1
    assert call(talking, "/talker", "getPid", "too", "many")[0] == -1


def test_nobody_answers_for_a_node_that_has_gone(talking: Graph) -> None:
    uri = talking.master.lookupNode("/test", "/talker")[2]
    talking.nodes["/talker"].shutdown()
    with pytest.raises(TransportException, match="it has been shut down"):
        talking.transport.call(uri, "getPid", "/test")


@pytest.mark.parametrize(
    ("header", "text"),
    [
        (
            {"topic": "/chatter", "type": "std_msgs/String", "md5sum": "deadbeef"},
            (
                f"Client [/wire] wants topic [/chatter] to have datatype/md5sum [std_msgs/String/deadbeef], "
                f"but our version has [std_msgs/String/{MD5}] Dropping connection."
            ),
        ),
        (
            {"topic": "/nope", "type": "std_msgs/String", "md5sum": MD5},
            (
                "[/talker] is not a publisher of [/nope]. Topics are "
                "[['/rosout', 'rosgraph_msgs/Log'], ['/chatter', 'std_msgs/String']]"
            ),
        ),
        ({"topic": "/chatter", "type": "std_msgs/String"}, "Missing required 'md5sum' field"),
    ],
)
def test_a_bad_header_of_a_subscriber_is_refused_in_ross_words(
    talking: Graph, capsys: pytest.CaptureFixture[str], header: dict[str, str], text: str
) -> None:
    sender = QueuedSender(talking.scheduler, SimpleNamespace(header={}), "/wire")  # type: ignore[arg-type]
    with pytest.raises(TransportInitError) as caught:
        talking.nodes["/talker"].accept_subscriber({"callerid": "/wire", **header}, sender)
    assert str(caught.value) == text
    capsys.readouterr()


@pytest.mark.parametrize("header", [{"type": "*", "md5sum": "*"}, {"md5sum": MD5}])
def test_wildcards_are_welcome(talking: Graph, header: dict[str, str]) -> None:
    talker = talking.nodes["/talker"]
    sender = QueuedSender(talking.scheduler, SimpleNamespace(header={}), "/wire")  # type: ignore[arg-type]
    answer = talker.accept_subscriber({"callerid": "/wire", "topic": "/chatter", **header}, sender)
    assert list(answer) == ["callerid", "latching", "md5sum", "message_definition", "topic", "type"]
    assert answer["message_definition"] == "string data\n"
    sender.drop()
    assert len(talker.publications["/chatter"].senders) == 1


def test_a_service_with_another_md5_is_refused_in_ross_words(graph: Graph) -> None:
    server = graph.node("srv_server")
    server.service("set_bool", SetBool, lambda _: (True, ""))
    with pytest.raises(TransportInitError) as caught:
        server.accept_client({"callerid": "/wire", "service": "/set_bool", "md5sum": "bad"})
    assert str(caught.value) == f"request from [/wire]: md5sums do not match: [bad] vs. [{SetBool._md5sum}]"
    session = server.accept_client({"callerid": "/wire", "service": "/set_bool", "md5sum": "*"})
    assert session.header == {
        "callerid": "/srv_server",
        "md5sum": "09fb03525b03e7ea1fd3992bafd87e16",
        "service": "/set_bool",
        "type": "std_srvs/SetBool",
    }


def test_the_master_introduces_two_nodes_and_then_steps_aside(graph: Graph) -> None:
    heard: list[str] = []
    listener = graph.node("listener")
    subscriber = listener.subscriber("chatter", String, lambda message: heard.append(message.data))
    settle(graph)
    assert subscriber.num_connections() == 0
    assert ["/chatter", ["/listener"]] in graph.master.getSystemState("/test")[2][1]
    talker = graph.node("talker")
    publisher = talker.publisher("chatter", String)
    assert ["/chatter", ["/talker"]] in graph.master.getSystemState("/test")[2][0]
    assert ["/chatter", "std_msgs/String"] in graph.master.getTopicTypes("/test")[2]
    publisher.wait_for_subscribers()
    until(graph, lambda: subscriber.num_connections() == 1)  # on a wire the subscriber's end is the later one

    master, graph.master = graph.master, None  # type: ignore[assignment]
    try:
        for number in range(3):
            publisher.publish(str(number))
        until(graph, lambda: len(heard) == 3)
    finally:
        graph.master = master
    assert heard == ["0", "1", "2"]


# -- from the thread of a wire -----------------------------------------------------------------------------------


def test_a_thread_that_reads_a_wire_is_answered_while_a_callback_computes() -> None:
    graph = Graph()
    node, talker = graph.node("busy"), graph.node("talker")
    computing, answered = threading.Event(), threading.Event()
    answers: dict[str, Any] = {}

    def compute(_: Any) -> None:
        computing.set()
        assert answered.wait(PATIENCE)

    def ping() -> None:
        computing.wait(PATIENCE)
        call = node.slave_call
        for method in ("getPid", "getBusInfo", "getBusStats", "getPublications", "getSubscriptions", "getMasterUri"):
            answers[method] = call(method, "/wire")
        answers["requestTopic"] = call("requestTopic", "/wire", "/rosout", [["INPROC"]])
        answers["publisherUpdate"] = call("publisherUpdate", "/master", "/work", [])
        answers["bad"] = call("publisherUpdate", "/master", "/work", 7)
        answers["shutdown"] = call("shutdown", "/wire", "enough")
        answered.set()

    node.subscriber("work", String, compute)
    publisher = talker.publisher("work", String)
    publisher.wait_for_subscribers()
    publisher.publish("x")
    hub = graph.scheduler.thread
    thread = threading.Thread(target=ping)
    thread.start()
    graph.run(1.0)
    thread.join()
    assert graph.scheduler.thread == hub
    assert answers["getPid"] == [1, "", os.getpid()]
    rows = answers["getBusInfo"][2]
    assert [(row[2], row[4], row[5]) for row in rows] == [("o", "/rosout", True), ("i", "/work", True)]
    assert answers["getSubscriptions"][2] == [["/work", "std_msgs/String"]]
    assert answers["requestTopic"][0] == 1
    assert answers["bad"] == [-1, "ERROR: parameter [publishers] must be a list of URIs", -1]
    assert [answers[name] for name in ("publisherUpdate", "shutdown")] == [[1, "", 0], [1, "shutdown", 0]]
    # What they asked for happened in the hub's thread, after the callback.
    assert node.is_shutdown()
    assert node.shutdown_reason == "enough"
    graph.shutdown()


def test_a_node_publishes_nothing_from_when_it_closes_its_connections(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Subscribers that are cut off connect again at once: what is latched must not reach them twice."""
    node = graph.node("talker")
    node.publisher("chatter", String, latch=True)
    offers = graph.transport.offers(node.uri)
    answers: list[int] = []
    leave = node.master.unregister

    def unregister(*arguments: str, **options: Any) -> None:
        answers.append(node.slave.call("requestTopic", "/test", "/chatter", offers)[0])
        leave(*arguments, **options)

    monkeypatch.setattr(node.master, "unregister", unregister)
    node.shutdown()
    assert set(answers) == {-1}
