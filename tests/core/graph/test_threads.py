"""Real threads in wall time: they publish, subscribe, call services and wait, while the main program drives."""

from __future__ import annotations

import io
import threading
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import ROSException
from rosmini.core.graph import Graph
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
from rosmini.msgs.std_msgs.msg import Int32, String
from tests.core.graph.byte_transport import ByteTransport

from ...processes import PATIENCE
from .conftest import KINDS, WALL_RATE, close, make, until

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@pytest.fixture(params=[kind for kind in KINDS if kind.endswith("wall")])
def graph(request: pytest.FixtureRequest) -> Iterator[Graph]:
    """A graph in wall time."""
    graph = make(request.param)
    yield graph
    close(graph)


def in_thread(graph: Graph, work: Callable[[], object]) -> list[Any]:
    """Run ``work`` in a thread, drive the graph until it is done, and return its results (a value or an error)."""
    result: list[Any] = []

    def target() -> None:
        try:
            result.append(work())
        except Exception as error:
            result.append(error)

    thread = threading.Thread(target=target, daemon=True)
    graph.scheduler.call_soon(thread.start)
    until(graph, lambda: result)
    thread.join()
    return result


def start(graph: Graph, workers: list[threading.Thread]) -> None:
    """Start threads while the main program drives the graph."""
    for worker in workers:
        worker.daemon = True
        graph.scheduler.call_soon(worker.start)
    until(graph, lambda: all(worker.ident for worker in workers))


def test_a_thread_publishes_in_order(graph: Graph) -> None:
    heard: list[int] = []
    graph.node("listener").subscriber("n", Int32, lambda message: heard.append(message.data))
    publisher = graph.node("talker").publisher("n", Int32, queue_size=None)

    def work() -> None:
        publisher.wait_for_subscribers()
        for number in range(200):
            publisher.publish(number)

    assert in_thread(graph, work) == [None]
    until(graph, lambda: len(heard) == 200)
    assert heard == list(range(200))


def test_a_thread_may_do_all_that_a_node_does(graph: Graph) -> None:
    server = graph.node("server")
    server.service("add", AddTwoInts, lambda request: request.a + request.b)

    def work() -> list[Any]:
        node = graph.node("made_in_a_thread")
        node.wait_for_service("add")
        total = node.service_client("add", AddTwoInts)(1, 2).sum
        node.set_param("p", total)
        heard: list[str] = []
        subscriber = node.subscriber("t", String, lambda message: heard.append(message.data))
        publisher = node.publisher("t", String, latch=True)
        publisher.publish("hello")
        message = node.wait_for_message("t", String, timeout=1000.0)
        start = node.now()
        node.sleep(2.0)
        slept = (node.now() - start).to_sec()
        subscriber.unregister()
        value = node.get_param("p")
        node.shutdown("done")
        return [total, message.data, slept >= 2.0, value, heard, node.is_shutdown()]

    assert in_thread(graph, work) == [[3, "hello", True, 3, ["hello"], True]]


def test_errors_reach_the_thread(graph: Graph) -> None:
    node = graph.node("node")
    (error,) = in_thread(graph, lambda: node.wait_for_message("never", String, timeout=1.0))
    assert isinstance(error, ROSException)
    assert "nobody publishes it" in str(error)


def test_threads_may_spin_and_end_with_their_node(graph: Graph) -> None:
    node, ended = graph.node("node"), []

    def work() -> None:
        node.spin()
        ended.append(node.shutdown_reason)

    spinners = [threading.Thread(target=work) for _ in range(3)]
    start(graph, spinners)
    assert ended == []
    node.shutdown("enough")
    until(graph, lambda: len(ended) == 3)
    for spinner in spinners:
        spinner.join(PATIENCE)
    assert ended == ["enough"] * 3


def test_several_threads_call_one_service_at_once(graph: Graph) -> None:
    server = graph.node("server")

    def handler(request: Any) -> int:
        server.sleep(1.0)
        return request.a + request.b

    server.service("add", AddTwoInts, handler)
    node, sums = graph.node("client"), []
    workers = [
        threading.Thread(
            target=lambda number=number: sums.append(node.service_client("add", AddTwoInts)(number, 1).sum)
        )
        for number in range(8)
    ]
    start(graph, workers)
    until(graph, lambda: len(sums) == 8)
    for worker in workers:
        worker.join(PATIENCE)
    assert sorted(sums) == list(range(1, 9))


def test_a_thread_may_drive_a_graph_that_nobody_else_drives() -> None:
    results: list[Any] = []

    def work() -> None:
        with Graph() as graph:
            heard: list[str] = []
            graph.node("listener").subscriber("t", String, lambda message: heard.append(message.data))
            publisher = graph.node("talker").publisher("t", String)
            publisher.wait_for_subscribers()
            publisher.publish("x")
            graph.run(1.0)
            results.append(heard)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join(PATIENCE)
    assert results == [["x"]]


@pytest.mark.parametrize("transport", [LocalTransport, ByteTransport])
def test_the_parameter_server_bears_several_threads(transport: Any) -> None:
    graph = Graph(simulated=False, rate=WALL_RATE, transports=[transport])
    node, problems = graph.node("node"), []

    def work(number: int) -> None:
        try:
            for turn in range(100):
                node.set_param(f"/tree{number}/{turn}", turn)
                node.param_names()
                node.get_param("/")
        except Exception as error:
            problems.append(error)

    workers = [threading.Thread(target=work, args=(f"_{number}",)) for number in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(PATIENCE)
    assert problems == []
    assert len([name for name in node.param_names() if name.startswith("/tree")]) == 400
    close(graph)


def test_the_main_program_runs_beside_a_thread_that_drives() -> None:
    graph = Graph(simulated=False, rate=WALL_RATE)
    talker = graph.node("talker")
    seen: list[str] = []
    graph.node("listener").subscriber("chatter", String, lambda message: seen.append(message.data))
    publisher = talker.publisher("chatter", String)
    publisher.wait_for_subscribers()
    talker.timer(1.0, lambda event: publisher.publish("tick"))
    thread = threading.Thread(target=talker.spin)
    thread.start()
    while not graph.scheduler.driven:  # the thread has nothing else to do
        pass
    assert graph.run(20.0).reason == "time"
    assert graph.run(4000.0, until=lambda: len(seen) >= 30).reason == "condition"
    talker.shutdown("over")
    thread.join(PATIENCE)
    assert not thread.is_alive()
    graph.shutdown()


def test_in_simulated_time_a_thread_leaves_the_driving_to_who_made_the_graph() -> None:
    graph = Graph()
    node = graph.node("node")
    woke: list[float] = []

    def sleep() -> None:
        node.sleep(1.0)
        woke.append(node.now().to_sec())

    thread = threading.Thread(target=sleep)
    thread.start()
    graph.run(5.0, until=lambda: bool(woke))
    while thread.is_alive() and not woke:
        graph.run(1.0)
    thread.join(PATIENCE)
    assert woke
    assert graph.scheduler.is_scheduler_thread()
    graph.shutdown()


def test_a_thread_that_waits_for_a_driver_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rosmini.core.graph.lanes.PATIENCE_S", 0.01)
    said = io.StringIO()  # capsys may lose what is written while it is read
    monkeypatch.setattr("sys.stderr", said)
    graph = Graph()
    node = graph.node("node")
    thread = threading.Thread(target=lambda: node.sleep(1.0), name="camera")
    thread.start()
    while "\n" not in said.getvalue() and thread.is_alive():
        pass
    assert "camera waits for" in said.getvalue()
    assert "Call graph.run()" in said.getvalue()
    while thread.is_alive():
        graph.run(0.1)
    thread.join()
    graph.shutdown()


def test_a_look_from_another_thread_just_before_a_drive_does_not_stop_it(graph, monkeypatch):
    scheduler = graph.scheduler
    call_at, looks = scheduler.call_at, []

    def look_first(when_ns, callback):  # the last moment at which the hub is free to move to another thread
        monkeypatch.undo()
        looker = threading.Thread(target=lambda: looks.append(scheduler.run_in_scheduler(lambda: "seen")))
        looker.start()
        looker.join(PATIENCE)
        return call_at(when_ns, callback)

    monkeypatch.setattr(scheduler, "call_at", look_first)
    scheduler.sleep_until(scheduler.now_ns() + 10**8)
    assert looks == ["seen"]


def begin_to_drive(graph: Graph, thread: threading.Thread) -> None:
    """Start a thread, and wait until it drives."""
    thread.start()
    while not graph.scheduler.driven:
        pass


def test_who_is_about_to_sleep_while_a_thread_begins_to_drive_sleeps_beside_it(graph, monkeypatch):
    scheduler, node = graph.scheduler, graph.node("node")
    call_at, driver = scheduler.call_at, threading.Thread(target=node.spin)

    def begin_first(when_ns, callback):  # the last moment at which the hub is free to move to another thread
        monkeypatch.undo()
        begin_to_drive(graph, driver)
        return call_at(when_ns, callback)

    monkeypatch.setattr(scheduler, "call_at", begin_first)
    before = scheduler.now_ns()
    scheduler.sleep_until(before + 10**8)
    assert scheduler.now_ns() >= before + 10**8
    node.shutdown("over")
    driver.join(PATIENCE)
    assert not driver.is_alive()


def test_of_two_threads_that_begin_to_run_at_once_each_runs_until_its_own_condition(graph: Graph) -> None:
    asked: list[bool] = []
    ended: list[str] = []
    node = graph.node("node")
    driver = threading.Thread(target=lambda: (node.spin(), ended.append("spin")))

    def is_third_question() -> bool:
        if not asked:  # the last moment at which the hub is free to move to another thread
            begin_to_drive(graph, driver)
        asked.append(True)
        return len(asked) == 3

    assert graph.run(1000.0, until=is_third_question).reason == "condition"
    assert driver.is_alive()
    assert not ended
    node.shutdown("over")
    driver.join(PATIENCE)
    assert ended == ["spin"]


def test_a_call_from_another_thread_leaves_the_scheduler_in_its_thread(graph: Graph) -> None:
    node = graph.node("node")
    caller = threading.Thread(target=lambda: node.subscriber("chatter", String))
    caller.start()
    caller.join(PATIENCE)  # nobody drives: in wall time the call need not wait for that
    assert not caller.is_alive()
    assert graph.scheduler.is_scheduler_thread()
    assert "/chatter" in node.subscriptions


def test_a_run_goes_on_when_the_thread_that_drove_the_graph_has_stopped() -> None:
    graph = Graph(simulated=False)
    driving, enough = threading.Event(), threading.Event()

    def drives() -> bool:
        driving.set()
        return enough.is_set()

    driver = threading.Thread(target=lambda: graph.run(until=drives), daemon=True)
    graph.node("node").timer(0.001, lambda _: None)
    driver.start()
    assert driving.wait(PATIENCE)

    def is_driven_here() -> bool:
        enough.set()  # the other thread asks for us
        return threading.current_thread() is threading.main_thread()

    assert graph.run(PATIENCE, until=is_driven_here).reason == "condition"
    driver.join(PATIENCE)
    graph.shutdown()
