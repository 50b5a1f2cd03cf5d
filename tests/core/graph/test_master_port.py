"""The one way to the Master: what a caller does while it takes its time, and when it does not answer."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from rosmini.core.errors import MasterUnreachable, ROSException, ServiceException
from rosmini.core.graph import Graph
from rosmini.core.graph.master_port import MasterPort
from rosmini.msgs import message_class, service_class

String = message_class("std_msgs/String")
Trigger = service_class("std_srvs/Trigger")


class SlowMaster(MasterPort):
    """Does what ``before`` and ``after`` say on the way to the Master and back, in the caller's lane."""

    def __init__(self, graph: Graph) -> None:
        self.behind, self.uri = graph.master, graph.master.uri
        self.before: Callable[[str, str], object] = lambda method, caller: None
        self.after: Callable[[str, str], object] = lambda method, caller: None
        self.calls: list[str] = []
        graph.master = self

    def call(self, method: str, caller_id: str, *arguments: Any) -> list[Any]:
        self.before(method, caller_id)
        self.calls.append(method)
        answer = self.behind.call(method, caller_id, *arguments)
        self.after(method, caller_id)
        return answer


def refuse(*_: Any) -> None:
    raise MasterUnreachable("the Master at http://there:11311/ does not answer")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph(rosout=False) as graph:
        yield graph


@pytest.fixture
def master(graph: Graph) -> SlowMaster:
    return SlowMaster(graph)


def test_the_port_has_the_methods_of_the_master_and_no_others(master: SlowMaster) -> None:
    assert master.lookupNode("/test", "/nobody")[0] == -1
    assert master.call("lookupNode", "/test", "/nobody")[0] == -1
    assert master.behind.call("_forget", "/test") == [-1, 'method "_forget" is not supported', 0]
    with pytest.raises(AttributeError, match="the Master has no method _forget"):
        master._forget


def test_an_answer_that_is_older_than_an_update_is_dropped(graph: Graph, master: SlowMaster) -> None:
    """The Master answers "nobody publishes"; then a publisher comes and is told of; then the answer arrives."""
    heard: list[Any] = []
    listener, talker = graph.node("listener"), graph.node("talker")

    def be_overtaken(method: str, caller: str) -> None:
        if (method, caller) == ("registerSubscriber", "/listener"):
            talker.publisher("chatter", String, latch=True).publish("x")
            graph.scheduler.sleep_until(graph.scheduler.now_ns() + 10**9)

    master.after = be_overtaken
    listener.run(lambda: listener.subscriber("chatter", String, heard.append))
    graph.run(3.0)
    assert [message.data for message in heard] == ["x"]
    assert listener.subscriptions["/chatter"].updates == 1


def test_a_topic_that_is_left_while_the_answer_is_under_way_is_left(graph: Graph, master: SlowMaster) -> None:
    node, talker = graph.node("node"), graph.node("talker")
    talker.publisher("chatter", String)
    master.before = lambda *_: graph.scheduler.sleep_until(graph.scheduler.now_ns() + 10**9)
    first = []
    node.run(lambda: first.append(node.subscriber("chatter", String)))
    node.run(lambda: node.subscriber("chatter", String).unregister())
    graph.run(5.0)
    assert [method for method in master.calls if "Subscriber" in method] == ["registerSubscriber"]
    node.run(first[0].unregister)
    graph.run(5.0)
    assert master.getSystemState("/test")[2][1] == []
    assert talker.publications["/chatter"].senders == {}


def test_the_calls_of_a_node_reach_the_master_in_their_order(graph: Graph, master: SlowMaster) -> None:
    node = graph.node("node")
    spans = iter([5, 1, 3, 2, 4] * 4)
    master.before = lambda *_: graph.scheduler.sleep_until(graph.scheduler.now_ns() + next(spans) * 10**9)
    arrived: list[str] = []
    asked = [f"/p{number}" for number in range(8)]
    for name in asked:
        node.run(lambda name=name: arrived.append((node.get_param(name, None), name)[1]))
    graph.run(60.0)
    assert arrived == asked


def test_a_lane_that_ends_while_it_waits_for_its_turn_holds_up_nobody(graph: Graph, master: SlowMaster) -> None:
    node = graph.node("node")
    master.before = lambda *_: graph.scheduler.sleep_until(graph.scheduler.now_ns() + 10**9)
    got: list[int] = []
    lanes = [node.run(lambda n=n: got.append(node.get_param(f"/p{n}", n))) for n in range(4)]
    graph.run(0.5)
    lanes[0].kill()
    lanes[2].kill()
    graph.run(10.0)
    assert got == [1, 3]


def test_a_registration_is_tried_until_the_master_answers(
    graph: Graph, master: SlowMaster, capsys: pytest.CaptureFixture[str]
) -> None:
    node = graph.node("node")
    master.before = refuse
    node.run(lambda: node.publisher("chatter", String))
    graph.run(1.0)
    assert master.behind.getSystemState("/test")[2][0] == [["/rosout", ["/node"]]]
    master.before = lambda *_: None
    graph.run(0.3)
    assert ["/chatter", ["/node"]] in master.getSystemState("/test")[2][0]
    said = capsys.readouterr().err
    assert said.count("Unable to register with master node [http://localhost:11311/]: master may not be running") == 1


def test_a_registration_that_the_master_refuses_leaves_nothing(graph: Graph, master: SlowMaster) -> None:
    node = graph.node("node")
    master.behind.registerPublisher = lambda *_: [-1, "not today", 0]  # type: ignore[attr-defined]
    with pytest.raises(ROSException, match="the Master refused registerPublisher of node /node: not today"):
        node.publisher("chatter", String)
    del master.behind.registerPublisher
    assert node.slave.getPublications("")[2] == [["/rosout", "rosgraph_msgs/Log"]]
    node.publisher("chatter", String)


def test_a_question_that_is_not_answered_raises_at_once(graph: Graph, master: SlowMaster) -> None:
    node = graph.node("node")
    master.before = refuse
    for ask in (
        lambda: node.get_param("speed", 1.0),
        lambda: node.set_param("speed", 1.0),
        lambda: node.has_param("speed"),
        node.param_names,
        lambda: graph.unreachable,
    ):
        with pytest.raises(MasterUnreachable, match="http://there:11311/ does not answer"):
            ask()
    with pytest.raises(ServiceException, match="unavailable: the Master at http://there:11311/ does not answer"):
        node.service_client("s", Trigger)()
    assert node.master.who_publishes("/chatter") == "the Master does not answer"
    master.before = lambda *_: None


def test_a_node_ends_although_the_master_does_not_answer(
    graph: Graph, master: SlowMaster, capsys: pytest.CaptureFixture[str]
) -> None:
    node = graph.node("node")
    for number in range(20):
        node.publisher(f"t{number}", String)
    master.before = refuse
    before = graph.now()
    node.shutdown()
    assert 1.5 <= (graph.now() - before).to_sec() <= 2.0
    assert capsys.readouterr().err.count("The registration stays there") == 1
    assert graph.nodes == {}


def test_a_node_that_never_reached_the_master_ends_at_once(
    graph: Graph, master: SlowMaster, capsys: pytest.CaptureFixture[str]
) -> None:
    master.before = refuse
    lane = graph.scheduler.spawn("start", lambda: graph.node("lonely").publisher("t", String))
    graph.run(0.5)
    before = graph.now()
    graph.nodes["/lonely"].shutdown()
    assert (graph.now() - before).to_sec() <= 0.2
    assert lane.waiter is None
    said = capsys.readouterr().err
    assert "Unable to register" in said
    assert "The registration stays there" not in said


def test_a_service_of_another_process_is_found_by_asking_again(
    graph: Graph, master: SlowMaster, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing tells this process of a registration elsewhere."""
    node = graph.node("node")
    monkeypatch.setattr(graph.transport, "probe_service", lambda uri, *_: {"callerid": uri})  # it answers

    def elsewhere() -> None:
        master.behind._notifier.registrations_changed = lambda: None  # type: ignore[attr-defined]
        master.behind.registerService("/far", "/s", "rosrpc://far:1", "http://far:2/")

    graph.scheduler.call_at(graph.scheduler.now_ns() + 1_230_000_000, elsewhere)
    before = graph.now()
    node.wait_for_service("/s", 5.0)
    assert 1.23 <= (graph.now() - before).to_sec() < 1.35
    with pytest.raises(ROSException, match=r"timeout exceeded after 0\.5 s"):
        node.wait_for_service("/other", 0.5)


def test_waiting_for_a_service_outlasts_a_master_that_is_away(graph: Graph, master: SlowMaster) -> None:
    node = graph.node("node")
    graph.node("server").service("/s", Trigger, lambda _: (True, ""))
    master.before = refuse

    def come_back() -> None:
        master.before = lambda *_: None

    graph.scheduler.call_at(graph.scheduler.now_ns() + 10**9, come_back)
    node.wait_for_service("/s", 5.0)


def test_a_graph_with_a_master_elsewhere_starts_nothing_of_roscore_s() -> None:
    class Elsewhere(MasterPort):
        uri = "http://robot:11311/"

        def __init__(self, behind: MasterPort) -> None:
            self.behind = behind
            self.asked: list[tuple[Any, ...]] = []

        def call(self, method: str, caller_id: str, *arguments: Any) -> list[Any]:
            self.asked.append((method, caller_id, *arguments))
            return self.behind.call(method, caller_id, *arguments)

    with Graph() as home, Graph(master=lambda _: Elsewhere(home.master)) as graph:
        assert graph.nodes == {}
        port = graph.master
        assert isinstance(port, Elsewhere)
        assert port.asked == []
        assert graph.master_uri == "http://robot:11311/"
        graph.node("talker")
        assert home.ask_as("/test").find("lookupNode", "/talker") == graph.nodes["/talker"].uri
