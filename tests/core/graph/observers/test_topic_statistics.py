"""Statistics of a subscriber's connections, in simulated time."""

from __future__ import annotations

from typing import Any

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs.geometry_msgs.msg import PointStamped
from rosmini.msgs.rosgraph_msgs.msg import TopicStatistics
from rosmini.msgs.std_msgs.msg import String


def heard_in(graph: Graph, seconds: float, hz: float, message: Any, busy: float = 0.0) -> list[Any]:
    """The statistics of a listener that takes ``busy`` seconds for each message of a talker at ``hz``."""
    found: list[Any] = []
    graph.node("statistics_listener").subscriber("/statistics", TopicStatistics, found.append)
    listener, talker = graph.node("listener"), graph.node("talker")
    listener.subscriber("chatter", type(message), lambda _: listener.sleep(busy), queue_size=1)
    publisher = talker.publisher("chatter", type(message), queue_size=10)
    publisher.wait_for_subscribers()

    def tell(_: Any) -> None:
        if message._has_header:
            message.header.stamp = talker.now()
        publisher.publish(message)

    talker.timer(1 / hz, tell)
    graph.run(seconds)
    return found


@pytest.fixture
def enabled() -> Any:
    with Graph() as graph:
        graph.node("setter").set_param("/enable_statistics", True)
        yield graph


def test_without_the_parameter_nothing_is_published() -> None:
    with Graph() as graph:
        assert heard_in(graph, 5, 10, String("hello")) == []
        assert "/statistics" not in [name for name, _ in graph.node("other").master.ask("getPublishedTopics", "")]


def test_windows_name_the_connection_and_measure_traffic_and_period(enabled: Graph) -> None:
    found = heard_in(enabled, 20, 10, String("hello"))
    assert len(found) > 5
    for one in found[1:]:
        assert (one.topic, one.node_pub, one.node_sub) == ("/chatter", "/talker", "/listener")
        assert one.traffic == one.delivered_msgs * (4 + 4 + len("hello"))
        assert one.period_mean.to_sec() == one.period_max.to_sec() == pytest.approx(0.1)
        assert one.dropped_msgs == one.stamp_age_max.to_nsec() == one.period_stddev.to_nsec() == 0
    assert [one.window_stop for one in found[:-1]] == [one.window_start for one in found[1:]]


def test_a_slow_topic_gets_long_windows_as_far_as_the_parameter_allows(enabled: Graph) -> None:
    enabled.node("setter").set_param("/statistics_window_max_size", 8)
    found = heard_in(enabled, 60, 1, String("hello"))
    lengths = [(one.window_stop - one.window_start).to_sec() for one in found]
    assert lengths[-1] == max(lengths) == pytest.approx(9)  # the first message after 8 s ends the window


def test_a_busy_callback_shows_as_age_and_as_dropped_messages(enabled: Graph) -> None:
    last = heard_in(enabled, 20, 20, PointStamped(), busy=0.12)[-1]
    assert last.dropped_msgs > last.delivered_msgs / 2
    assert 0 < last.stamp_age_mean.to_sec() <= last.stamp_age_max.to_sec() < 0.12


def test_a_parameter_of_the_wrong_type_is_reported_and_replaced(
    enabled: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    enabled.node("setter").set_param("/statistics_window_min_elements", "many")
    assert heard_in(enabled, 5, 10, String("hello"))
    assert "/statistics_window_min_elements" in capsys.readouterr().err
