"""What goes wrong on purpose: the same on each run, where it was asked for, and nowhere else."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini import Graph
from rosmini.core.errors import ROSException, RosminiError, ServiceException
from rosmini.core.graph.observers.faults import FaultError
from rosmini.msgs.std_msgs.msg import Int32, UInt8MultiArray
from rosmini.msgs.std_srvs.srv import Trigger


@pytest.fixture
def graph():
    with Graph() as graph:
        yield graph


def count(graph, *, to=("listener",), messages=50, period=0.1):
    """A node that counts aloud, and what each listener hears of it, with the time of that."""
    heard = {name: [] for name in to}
    for name in to:
        node = graph.node(name)
        node.subscriber(
            "count",
            Int32,
            lambda message, name=name: heard[name].append((message.data, round(graph.now().to_sec() - 1000, 3))),
        )
    counter = graph.node("counter")
    publisher = counter.publisher("count", Int32)
    publisher.wait_for_subscribers(len(to))

    def run():
        for number in range(messages):
            publisher.publish(number)
            counter.sleep(period)

    return heard, lambda: (counter.run(run), graph.run(messages * period + 5))


def numbers(heard):
    return [number for number, _ in heard]


def test_messages_are_lost_the_same_ones_on_each_run():
    def run(seed):
        with Graph() as graph:
            heard, go = count(graph)
            fault = graph.faults.disturb("/count", lose=0.3, seed=seed)
            go()
            assert (fault.messages, fault.lost) == (50, 50 - len(heard["listener"]))
            return numbers(heard["listener"])

    assert run(1) == run(1)
    assert run(1) != run(2)
    assert 20 < len(run(1)) < 50


def test_one_subscriber_only_and_chance_does_not_depend_on_the_others():
    def run(*listeners, to=""):
        with Graph() as graph:
            heard, go = count(graph, to=listeners)
            graph.faults.disturb("/count", to=to, lose=0.5)
            go()
            return {name: numbers(found) for name, found in heard.items()}

    alone = run("a")
    both = run("a", "b")
    assert both["a"] == alone["a"]
    assert both["a"] != both["b"]
    one = run("a", "b", to="/b")
    assert one["a"] == list(range(50))
    assert 0 < len(one["b"]) < 50


def test_a_fault_for_one_node_adds_to_that_of_the_topic(graph):
    heard, go = count(graph, to=("a", "b"))
    graph.faults.disturb("/count", lose=0.5)
    graph.faults.disturb("/count", to="/b", delay=0.2)
    go()
    assert 10 < len(heard["b"]) < 40
    assert all(time == round(number * 0.1 + 0.2, 3) for number, time in heard["b"])


def test_with_jitter_they_overtake_one_another_and_all_arrive(graph):
    heard, go = count(graph)
    graph.faults.disturb("/count", jitter=0.5)
    go()
    found = numbers(heard["listener"])
    assert sorted(found) == list(range(50))
    assert found != sorted(found)


def test_doubled_messages_are_two_messages(graph):
    graph.node("talker")
    kept = []
    graph.node("listener").subscriber("bytes", UInt8MultiArray, kept.append)
    publisher = graph.nodes["/talker"].publisher("bytes", UInt8MultiArray)
    publisher.wait_for_subscribers()
    graph.faults.disturb("/bytes", double=1)
    publisher.publish(UInt8MultiArray(data=b"abc"))
    graph.run(0.1)
    first, second = kept
    assert first == second
    assert first is not second
    assert first.layout is not second.layout


def test_it_ends_and_what_was_late_still_comes(graph):
    heard, go = count(graph, messages=10)
    graph.faults.disturb("/count", delay=0.25)
    graph.scheduler.call_at(graph.scheduler.now_ns() + 450_000_000, graph.faults.clear)
    go()
    assert sorted(numbers(heard["listener"])) == list(range(10))
    assert heard["listener"][-1] == (9, pytest.approx(0.9))
    assert (4, pytest.approx(0.65)) in heard["listener"]
    assert graph.faults.lines() == []


def test_connections_that_come_later_have_it_too(graph):
    _, go = count(graph)
    graph.faults.disturb("/count", lose=1)
    late = []
    graph.node("late").subscriber("count", Int32, late.append)
    go()
    assert late == []


@given(
    lose=st.floats(0, 1), double=st.floats(0, 1), delay=st.floats(0, 2), jitter=st.floats(0.001, 2), seed=st.integers(0)
)
def test_every_message_arrives_once_or_twice_or_is_lost(lose, double, delay, jitter, seed):
    with Graph(rosout=False) as graph:
        heard, go = count(graph, messages=20)
        fault = graph.faults.disturb("/count", lose=lose, double=double, delay=delay, jitter=jitter, seed=seed % 2**63)
        go()
        found = numbers(heard["listener"])
        assert fault.messages == 20
        assert len(found) == 20 - fault.lost + fault.doubled
        assert len(set(found)) == 20 - fault.lost
        for number, time in heard["listener"]:
            assert number * 0.1 + delay - 0.002 <= time <= number * 0.1 + delay + jitter + 0.002


def test_a_killed_node_takes_nothing_back(graph):
    heard, go = count(graph)
    hooks = []
    counter = graph.nodes["/counter"]
    counter.on_shutdown(lambda: hooks.append(1))
    graph.scheduler.call_at(graph.scheduler.now_ns() + 1_050_000_000, lambda: graph.faults.kill("/counter"))
    go()
    assert numbers(heard["listener"]) == list(range(11))
    assert hooks == []
    assert graph.unreachable == ("/counter",)
    assert dict(graph.ask_as("/me").ask("getSystemState")[0])["/count"] == ["/counter"]


def test_a_service_is_cut_off_also_while_it_is_called(graph):
    server = graph.node("server")
    server.service("it", Trigger, lambda _: (server.sleep(1), (True, ""))[1])
    client = graph.node("client")
    call = client.service_client("it", Trigger)
    graph.faults.cut("/it")
    with pytest.raises(ServiceException, match="cut off on purpose"):
        call()
    assert graph.faults.lines() == ["/it: cut off"]
    graph.faults.clear("/it")
    assert call().success
    graph.scheduler.call_at(graph.scheduler.now_ns() + 500_000_000, lambda: graph.faults.cut("/it"))
    with pytest.raises(ServiceException, match="cut off on purpose"):
        call()


def test_who_waits_for_a_service_waits_until_it_answers(graph):
    server, client = graph.node("server"), graph.node("client")
    server.service("add", Trigger, lambda _: (True, ""))
    graph.faults.cut("/add")
    with pytest.raises(ROSException, match=r"after 2 s while .*nobody answers at rosrpc://"):
        client.wait_for_service("add", timeout=2.0)
    graph.scheduler.call_at(graph.scheduler.now_ns() + 10**9, lambda: graph.faults.clear("/add"))
    client.wait_for_service("add", timeout=2.0)
    graph.faults.kill("/server")
    with pytest.raises(ROSException, match="nobody answers"):
        client.wait_for_service("add", timeout=2.0)


def test_clocks_jump_and_loops_go_on(graph):
    node, other = graph.node("node"), graph.node("other")
    times = []

    def loop():
        rate = node.rate(2)
        while True:
            times.append(node.now().to_sec() - 1000)
            rate.sleep()

    node.run(loop)
    ticks = []
    node.timer(0.5, lambda _: ticks.append(1))
    graph.run(1.1)
    graph.faults.jump(-5, "/node")
    graph.run(2)
    assert other.now() == graph.now()
    assert node.now().to_sec() == pytest.approx(graph.now().to_sec() - 5)
    assert times[:3] == pytest.approx([0, 0.5, 1])
    assert len(times) >= 6
    assert len(ticks) >= 5
    graph.faults.jump(2)
    assert "/node: " in graph.faults.lines()[0] and " -3 s " in graph.faults.lines()[0]
    assert other.now().to_sec() == pytest.approx(graph.now().to_sec() + 2)
    graph.faults.clear()
    assert node.now() == other.now() == graph.now()


def test_names_that_nobody_knows_are_answered_with_the_nearest(graph):
    count(graph)
    with pytest.raises(FaultError, match=r"no topic /cont: .*/count"):
        graph.faults.disturb("/cont", lose=1)
    with pytest.raises(FaultError, match=r"no subscriber of /count /listner: .*/listener"):
        graph.faults.disturb("/count", to="/listner", lose=1)
    with pytest.raises(FaultError, match=r"no node of this process /conter: .*/counter"):
        graph.faults.kill("/conter")
    with pytest.raises(FaultError, match=r"no service /counter/get_logger: .*/counter/get_loggers"):
        graph.faults.cut("/counter/get_logger")
    graph.faults.disturb("/count", lose=1)
    with pytest.raises(FaultError, match=r"/cont has no fault. .*/count"):
        graph.faults.clear("/cont")


@pytest.mark.parametrize(
    "wrong", [{}, {"lose": 1.1}, {"double": -0.1}, {"delay": -1}, {"jitter": float("nan")}, {"lose": float("nan")}]
)
def test_what_makes_no_sense_is_refused(graph, wrong):
    count(graph)
    with pytest.raises(RosminiError):
        graph.faults.disturb("/count", **wrong)
    assert graph.faults.lines() == []


def test_a_node_on_clock_has_no_clock_of_its_own(graph):
    graph.ask_as("/me").ask("setParam", "/use_sim_time", True)
    graph.node("node")
    with pytest.raises(FaultError, match="follows /clock"):
        graph.faults.jump(1, "/node")


def test_a_lost_message_is_recorded_as_lost(graph):
    recording = graph.record()
    _, go = count(graph, messages=2)
    graph.faults.disturb("/count", lose=1)
    go()
    assert [what for *_, what, _ in recording.calls("/count")][-2:] == ["/count: 0 (lost)", "/count: 1 (lost)"]
