"""The end of nodes and graphs: hooks, blocked calls, duplicate names, order, and what is left of a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import CallbackError, ROSException, ROSInterruptException
from rosmini.msgs.std_msgs.msg import Empty as EmptyMessage
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Empty

from .conftest import LONG, settle, until

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Graph, Node


# -- hooks -------------------------------------------------------------------------------------------------------


def test_hooks_run_in_order_and_may_still_publish(graph: Graph) -> None:
    heard: list[str] = []
    graph.node("listener").subscriber("t", String, lambda message: heard.append(message.data))
    node = graph.node("talker")
    publisher = node.publisher("t", String)
    publisher.wait_for_subscribers()
    order: list[str] = []

    def hook(name: str) -> None:
        order.append(f"{name}, shut down: {node.is_shutdown()}, {node.shutdown_reason}")
        publisher.publish(name)

    node.on_shutdown(lambda: hook("first"))
    node.on_shutdown(lambda: hook("second"))
    node.shutdown("enough")
    until(graph, lambda: len(heard) == 2)
    assert heard == ["first", "second"]
    assert order == ["first, shut down: False, enough", "second, shut down: False, enough"]
    assert node.is_shutdown()
    assert node.shutdown_reason == "enough"
    node.shutdown("again")
    assert len(order) == 2
    assert node.shutdown_reason == "enough"


def test_a_publisher_that_leaves_between_its_two_answers_is_no_error(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It says how to connect, leaves, and refuses the connection: the subscriber says nothing and tries no more."""
    publisher = graph.node("talker").publisher("t", String)
    connect = graph.transport.connect_topic
    refusals: list[str] = []

    def connect_late(caller: str, parameters: Any, header: Any, receiver: Any) -> Any:
        if header["topic"] != "/t":
            return connect(caller, parameters, header, receiver)
        publisher.unregister()
        try:
            return connect(caller, parameters, header, receiver)
        except Exception as error:
            refusals.append(str(error))
            raise

    monkeypatch.setattr(graph.transport, "connect_topic", connect_late)
    listener = graph.node("listener")
    listener.subscriber("t", String, print)
    until(graph, lambda: refusals)
    settle(graph)
    assert len(refusals) == 1


def test_a_hook_may_block(graph: Graph) -> None:
    node = graph.node("node")
    before = graph.now()
    node.on_shutdown(lambda: node.sleep(2.0))
    node.shutdown()
    assert (graph.now() - before).to_sec() >= 2.0
    assert node.is_shutdown()


def test_a_hook_that_fails_is_reported_and_the_others_run(graph: Graph) -> None:
    node, order = graph.node("node"), []

    def bad() -> None:
        raise ValueError("broken hook")

    node.on_shutdown(bad)
    node.on_shutdown(lambda: order.append("second"))
    with pytest.raises(CallbackError, match="broken hook"):
        node.shutdown()
    assert order == ["second"]
    assert node.is_shutdown()
    assert "/node" not in graph.nodes


# -- blocked calls -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "block",
    [
        lambda node: node.sleep(1e6),
        lambda node: node.rate(1e-6).sleep(),
        lambda node: node.wait_for_message("never", String),
        lambda node: node.wait_for_service("never"),
        lambda node: node.publisher("never", String).wait_for_subscribers(),
    ],
    ids=["sleep", "rate", "message", "service", "subscribers"],
)
def test_a_blocked_call_ends_when_its_node_is_shut_down(graph: Graph, block: Callable[[Node], None]) -> None:
    node, ended = graph.node("node"), []

    def main() -> None:
        try:
            block(node)
        except ROSInterruptException as error:
            ended.append(str(error))

    lane = node.run(main)
    until(graph, lambda: lane.waiting_for is not None)
    node.shutdown("enough")
    until(graph, lambda: ended)
    assert len(ended) == 1 and "/node " in ended[0] and ended[0].endswith(": enough")


def test_spin_returns_when_the_node_is_shut_down(graph: Graph) -> None:
    node, ended = graph.node("node"), []

    def main() -> None:
        node.spin()
        ended.append(node.is_shutdown())

    node.run(main)
    node.run(main)
    settle(graph)
    node.shutdown()
    until(graph, lambda: len(ended) == 2)
    assert ended == [True, True]
    node.spin()


def test_an_interrupt_that_a_lane_lets_out_is_no_error(graph: Graph) -> None:
    node = graph.node("node")
    lane = node.run(lambda: node.sleep(1e6))
    timer = node.timer(1.0, lambda _: node.sleep(1e6))
    until(graph, lambda: [wait.reason for wait in graph.scheduler.waiting()].count("time to pass") == 2)
    graph.run(1.5)
    node.shutdown()
    settle(graph)
    assert lane.idle
    assert not timer.is_alive()


def test_a_callback_may_shut_its_own_node_down(graph: Graph) -> None:
    node, heard = graph.node("node"), []

    def once(_: Any) -> None:
        heard.append(1)
        node.shutdown("heard enough")

    node.subscriber("t", EmptyMessage, once)
    publisher = graph.node("talker").publisher("t", EmptyMessage)
    publisher.wait_for_subscribers()
    publisher.publish()
    publisher.publish()
    until(graph, node.is_shutdown)
    settle(graph)
    assert heard == [1]
    assert publisher.num_connections() == 0


# -- afterwards --------------------------------------------------------------------------------------------------


def test_a_node_that_was_shut_down_says_so(graph: Graph) -> None:
    node = graph.node("node")
    publisher = node.publisher("t", String)
    subscriber = node.subscriber("t", String)
    node.shutdown("enough")
    with pytest.raises(ROSException, match=r"publish\(\) on /t after node /node was shut down \(enough\)"):
        publisher.publish("x")
    for attempt in (
        lambda: node.publisher("u", String),
        lambda: node.subscriber("u", String),
        lambda: node.service("u", Empty, lambda _: None),
    ):
        with pytest.raises(ROSException, match=r"/node was shut down: enough.*Make a new node"):
            attempt()
    for blocked in (
        lambda: node.sleep(1.0),
        lambda: node.sleep(0.0),
        lambda: node.wait_for_service("u"),
        lambda: node.rate(10).sleep(),
    ):
        with pytest.raises(ROSInterruptException, match="/node was shut down: enough"):
            blocked()
    assert publisher.num_connections() == 0
    publisher.unregister()
    subscriber.unregister()


# -- duplicate names ---------------------------------------------------------------------------------------------


def test_the_older_of_two_nodes_with_one_name_is_shut_down_with_a_reason(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    heard: list[str] = []
    publisher = graph.node("talker").publisher("t", String)
    old = graph.node("listener")
    old.subscriber("t", String, lambda message: heard.append(f"old {message.data}"))
    publisher.wait_for_subscribers()
    new = graph.node("listener")
    new.subscriber("t", String, lambda message: heard.append(f"new {message.data}"))
    until(graph, old.is_shutdown)
    settle(graph)
    assert old.shutdown_reason == "[/listener] Reason: new node registered with same name"
    assert not new.is_shutdown()
    assert graph.nodes["/listener"] is new
    said = capsys.readouterr().err
    assert "shutdown request: [/listener] Reason: new node registered with same name" in said
    assert "/listener was shut down because another node registered under its name" in said
    assert "anonymous=True" in said
    publisher.publish("hello")
    until(graph, lambda: heard)
    settle(graph)
    assert heard == ["new hello"]
    assert publisher.num_connections() == 1


def test_any_node_can_be_asked_to_shut_down_by_its_slave_api(graph: Graph) -> None:
    node, hooks = graph.node("node"), []
    node.on_shutdown(lambda: hooks.append(1))
    caller = graph.node("rosnode")
    uri = graph.master.lookupNode("/rosnode", "/node")[2]
    assert graph.transport.call(uri, "shutdown", caller.name, "user request") == [1, "shutdown", 0]
    until(graph, node.is_shutdown)
    assert node.shutdown_reason == "user request"
    assert hooks == [1]


# -- the graph's end ---------------------------------------------------------------------------------------------


def test_a_graph_shuts_its_nodes_down_newest_first(build: Callable[..., Graph]) -> None:
    order: list[str] = []
    with build() as graph:
        for name in ("one", "two", "three"):
            graph.node(name).on_shutdown(lambda name=name: order.append(name))
    assert order == ["three", "two", "one"]
    graph.shutdown()
    assert order == ["three", "two", "one"]


def test_shutting_down_while_everything_is_busy_leaves_nothing(build: Callable[..., Graph]) -> None:
    graph = build()
    for number in range(5):
        node = graph.node(f"node{number}")
        publisher = node.publisher("t", String, queue_size=None)
        node.timer(0.01, lambda _, publisher=publisher: publisher.publish("x"))
        node.subscriber("t", String, lambda _, node=node: node.sleep(0.05))
        node.service("s", Empty, lambda _, node=node: (node.sleep(1.0), [])[1])
        node.run(lambda node=node: node.service_client("s", Empty)())
    graph.run(1.0)


def test_a_lane_that_ignores_the_interrupt_is_ended_with_the_graph(graph: Graph) -> None:
    node = graph.node("stubborn")

    def main() -> None:
        while True:
            try:
                node.waiter("nothing at all").wait(int(LONG * 1e9))
            except Exception:
                continue

    node.run(main)
    settle(graph)


def test_the_masters_word_for_a_node_that_had_this_address_before_ends_nobody(graph: Graph) -> None:
    """The older of two nodes is dead, and its port has been given to a node of another name."""
    node = graph.node("simulator")
    slave = node.slave
    assert slave.call("shutdown", "/master", "[/talker] Reason: new node registered with same name")[0] == 1
    settle(graph)
    assert not node.is_shutdown()
    slave.call("shutdown", "/master", "[/simulator] Reason: new node registered with same name")
    until(graph, node.is_shutdown)
