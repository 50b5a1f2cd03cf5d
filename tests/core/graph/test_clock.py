"""Time: sleeping, Rate, Timer, /use_sim_time and /clock; on every transport and clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import ROSInterruptException, RosminiError, ROSTimeMovedBackwardsException
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.core.time import Duration, Time
from rosmini.msgs.rosgraph_msgs.msg import Clock
from rosmini.msgs.std_msgs.msg import String

from .conftest import settle, until

if TYPE_CHECKING:
    from rosmini.core.graph import Graph, Node, Publisher


def elapsed(graph: Graph, start: Time) -> float:
    """Seconds of graph time since ``start``."""
    return (graph.now() - start).to_sec()


def test_time_starts_neither_at_zero_nor_at_random(simulated: Graph) -> None:
    assert simulated.now() == Time(1000)
    assert simulated.node("node").now() == Time(1000)


@pytest.mark.parametrize("span", [2.5, Duration(2, 500_000_000)])
def test_sleeping_takes_its_time(graph: Graph, span: Any) -> None:
    node, start = graph.node("node"), graph.now()
    node.sleep(span)
    assert elapsed(graph, start) == 2.5 if graph.simulated else elapsed(graph, start) >= 2.5


@pytest.mark.parametrize("span", [0, 0.0, -1.0, Duration(-5), Duration(0)])
def test_sleeping_for_nothing_or_less_takes_no_time_and_lets_the_others_run(simulated: Graph, span: Any) -> None:
    node, start = simulated.node("node"), simulated.now()
    seen: list[int] = []
    simulated.scheduler.call_soon(lambda: seen.append(1))
    node.sleep(span)
    assert simulated.now() == start
    assert seen == [1]


# -- Rate --------------------------------------------------------------------------------------------------------


def test_a_rate_makes_up_for_what_a_turn_took(simulated: Graph) -> None:
    node, start = simulated.node("node"), simulated.now()
    rate = node.rate(2)
    turns = []
    for work in (0.1, 0.4, 0.0, 0.25):
        node.sleep(work)
        assert rate.remaining().to_sec() == pytest.approx(0.5 - work)
        rate.sleep()
        turns.append(elapsed(simulated, start))
    assert turns == [0.5, 1.0, 1.5, 2.0]


def test_a_rate_catches_up_after_one_long_turn_and_starts_afresh_after_a_very_long_one(simulated: Graph) -> None:
    node, start = simulated.node("node"), simulated.now()
    rate, turns = node.rate(1), []
    for work in (1.5, 0.0, 7.3, 0.0):
        node.sleep(work)
        rate.sleep()
        turns.append(round(elapsed(simulated, start), 9))
    assert turns == [1.5, 2.0, 9.3, 10.3]


def test_a_rate_can_be_reset_by_a_jump_back(graph: Graph) -> None:
    node, clock = on_topic_clock(graph)
    tell(graph, clock, 100.0, node)
    outcomes: list[str] = []

    def turn(reset: bool) -> None:
        try:
            node.rate(0.1, reset=reset).sleep()
            outcomes.append("went on")
        except ROSTimeMovedBackwardsException as error:
            outcomes.append(f"raised: {error.time}")

    node.run(lambda: turn(True))
    node.run(lambda: turn(False))
    until(graph, lambda: len([w for w in graph.scheduler.waiting() if "time to pass" in w.reason]) == 2)
    clock.publish(Time(50))
    until(graph, lambda: len(outcomes) == 2)
    assert sorted(outcomes) == ["raised: -50.0", "went on"]


@pytest.mark.parametrize("number", [0, -1])
def test_rates_and_periods_must_be_positive(simulated: Graph, number: float) -> None:
    node = simulated.node("node")
    for make in (node.rate, lambda period: node.timer(period, print)):
        with pytest.raises(RosminiError, match="positive"):
            make(number)
    with pytest.raises(RosminiError, match="positive"):
        node.rate(float("nan"))


# -- Timer -------------------------------------------------------------------------------------------------------


def test_a_timers_events_say_when_they_were_due_and_when_they_ran(simulated: Graph) -> None:
    node, events = simulated.node("node"), []

    def callback(event: Any) -> None:
        events.append(event)
        node.sleep(0.25)

    node.timer(1.0, callback)
    simulated.run(3.5)
    assert [event.current_expected for event in events] == [Time(1001), Time(1002), Time(1003)]
    assert [event.current_real for event in events] == [Time(1001), Time(1002), Time(1003)]
    assert [event.last_expected for event in events] == [None, Time(1001), Time(1002)]
    assert [event.last_real for event in events] == [None, Time(1001), Time(1002)]
    assert [event.last_duration for event in events] == [None, 0.25, 0.25]


def test_a_slow_callback_delays_and_nothing_is_made_up_for(simulated: Graph) -> None:
    node, times = simulated.node("node"), []

    def slow(event: Any) -> None:
        times.append(event.current_real.to_sec() - 1000)
        node.sleep(3.6 if len(times) == 1 else 0.0)

    node.timer(Duration(1), slow)
    simulated.run(8.0)
    assert [round(time, 3) for time in times] == [1.0, 4.6, 5.6, 6.6, 7.6]


def test_a_oneshot_timer_fires_once(graph: Graph) -> None:
    node, fired = graph.node("node"), []
    timer = node.timer(1.0, lambda _: fired.append(1), oneshot=True)
    assert timer.is_alive()
    until(graph, lambda: fired)
    graph.run(5.0)
    assert fired == [1]
    assert not timer.is_alive()


def test_a_timer_can_be_stopped_from_its_callback_and_from_outside(graph: Graph) -> None:
    node, fired = graph.node("node"), []

    def callback(_: Any) -> None:
        fired.append(1)
        if len(fired) == 2:
            timer.shutdown()

    timer = node.timer(1.0, callback)
    until(graph, lambda: len(fired) == 2)
    other = node.timer(1.0, lambda _: fired.append("other"))
    other.shutdown()
    graph.run(5.0)
    assert fired == [1, 1]
    assert not timer.is_alive()


def test_a_timer_ends_with_its_node_and_holds_no_time_up(graph: Graph) -> None:
    node, other, fired = graph.node("node"), graph.node("other"), []
    timer = node.timer(1.0, lambda _: fired.append(1))
    until(graph, lambda: fired)
    node.shutdown()
    late = node.timer(1.0, lambda _: fired.append("late"))
    kept = other.timer(5.0, lambda _: None)
    kept.shutdown()
    if graph.simulated:
        begin = graph.now()
        graph.run()  # nothing is due any more
        assert graph.now() == begin
    else:
        settle(graph)
    assert not timer.is_alive() and not late.is_alive() and not kept.is_alive()
    assert fired == [1]


def test_between_two_calls_nothing_of_a_timer_is_parked(simulated: Graph) -> None:
    node = simulated.node("node")
    node.timer(1.0, lambda _: node.sleep(0.5))
    assert simulated.run(1.75).waiting == ()
    assert [waiting.lane for waiting in simulated.run(0.5).waiting] == ["/node timer <lambda>"]


def test_a_jump_back_ends_a_timer_or_restarts_it(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    node, clock = on_topic_clock(graph)
    tell(graph, clock, 100.0, node)
    fired: list[Any] = []
    ended = node.timer(10.0, lambda _: fired.append("ended"))
    kept = node.timer(10.0, lambda event: fired.append(event.current_real.to_sec()), reset=True)
    settle(graph)
    for seconds in (50.0, 55.0, 60.0):
        tell(graph, clock, seconds, node)
        settle(graph)
    assert fired == [50.0, 60.0]
    assert not ended.is_alive()
    assert kept.is_alive()
    assert capsys.readouterr().err.count("reset=True") == 1


# -- /clock ------------------------------------------------------------------------------------------------------


def on_topic_clock(graph: Graph) -> tuple[Node, Publisher]:
    """A node that follows /clock, and who publishes it."""
    graph.master.setParam("/test", "/use_sim_time", True)
    clock = graph.node("clock").publisher("/clock", Clock, queue_size=None)
    node = graph.node("node")
    clock.wait_for_subscribers(2)
    return node, clock


def tell(graph: Graph, clock: Publisher, seconds: float, *nodes: Node) -> None:
    """Publish a time and wait until the nodes have heard it."""
    clock.publish(Time.from_sec(seconds))
    until(graph, lambda: all(node.now().to_sec() == seconds for node in nodes))


def test_a_sleep_before_the_first_clock_message_begins_with_it(graph: Graph) -> None:
    node, clock = on_topic_clock(graph)
    assert node.now() == Time(0)
    woken: list[float] = []

    def main() -> None:
        node.sleep(2.0)
        woken.append(node.now().to_sec())

    node.run(main)
    for seconds in (100.0, 101.0, 102.0):
        assert woken == []
        tell(graph, clock, seconds, node)
        settle(graph)
    assert woken == [102.0]


def test_timers_follow_clock(graph: Graph) -> None:
    node, clock = on_topic_clock(graph)
    tell(graph, clock, 10.0, node)
    fired: list[float] = []
    node.timer(1.0, lambda event: fired.append(event.current_real.to_sec()))
    settle(graph)
    for seconds in (10.5, 11.0, 11.5, 12.0):
        tell(graph, clock, seconds, node)
        settle(graph)
    assert fired == [11.0, 12.0]


def test_time_that_moves_backwards_ends_a_sleep(graph: Graph) -> None:
    node, clock = on_topic_clock(graph)
    tell(graph, clock, 10.0, node)
    caught: list[float] = []

    def main() -> None:
        try:
            node.sleep(5.0)
        except ROSTimeMovedBackwardsException as error:
            caught.append(error.time)

    node.run(main)
    settle(graph)
    tell(graph, clock, 4.0, node)
    until(graph, lambda: caught)
    assert caught == [-6.0]
    assert issubclass(ROSTimeMovedBackwardsException, ROSInterruptException)


def test_use_sim_time_without_a_clock_is_named_after_two_seconds(
    simulated: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    graph = simulated  # two seconds of wall time at the tests' rate are too short to be sure of
    graph.master.setParam("/test", "/use_sim_time", True)
    node = graph.node("node")
    node.run(lambda: node.sleep(1.0))
    graph.run(1.0)
    assert "/use_sim_time" not in capsys.readouterr().err
    graph.run(2.0)
    settle(graph)
    said = capsys.readouterr().err
    assert "/use_sim_time is true, but nothing arrives on /clock" in said
    assert "delete the parameter /use_sim_time" in said
    graph.run(5.0)
    assert "/use_sim_time" not in capsys.readouterr().err


def test_a_clock_in_time_silences_the_warning(simulated: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    graph = simulated
    node, clock = on_topic_clock(graph)
    tell(graph, clock, 1.0, node, graph.nodes["/clock"])
    graph.run(5.0)
    assert "nothing arrives on /clock" not in capsys.readouterr().err


def test_a_shutdown_ends_a_sleep_on_a_clock_that_stands_still(graph: Graph) -> None:
    node, clock = on_topic_clock(graph)
    tell(graph, clock, 10.0, node)
    ended: list[str] = []

    def main() -> None:
        try:
            node.sleep(5.0)
        except ROSInterruptException as error:
            ended.append(str(error))

    node.run(main)
    settle(graph)
    node.shutdown("enough")
    until(graph, lambda: ended)
    assert len(ended) == 1 and "/node " in ended[0] and ended[0].endswith(": enough")


def test_a_loop_that_cannot_keep_its_rate_lets_the_others_run(graph: Graph) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    heard: list[str] = []
    listener.subscriber("chatter", String, lambda message: heard.append(message.data))
    publisher = talker.publisher("chatter", String)
    publisher.wait_for_subscribers()
    counts: list[int] = []

    def hurry() -> None:
        for number in range(5):
            publisher.publish(str(number))
            talker.sleep(-1.0)  # what a rate does that is late
            talker.sleep(0.0)
            counts.append(len(heard))

    lane = talker.run(hurry)
    until(graph, lambda: lane.idle)
    settle(graph)
    assert heard == ["0", "1", "2", "3", "4"]
    if isinstance(graph.transport.transports[0], LocalTransport):  # on the other the bytes are under way
        assert counts == [1, 2, 3, 4, 5]
