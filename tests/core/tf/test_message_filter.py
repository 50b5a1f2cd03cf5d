"""Messages that wait for their transform."""

from __future__ import annotations

import pytest

from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer
from rosmini.core.tf.message_filter import NO_FRAME, QUEUE_FULL, TOO_OLD, MessageFilter
from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import IDENTITY
from rosmini.core.time import Time
from rosmini.msgs import message_class


@pytest.fixture
def buffer():
    with Graph() as graph:
        yield Buffer(graph.node("listener"))


def tell(buffer, parent, child, seconds):
    buffer.set_transform(to_stamped(parent, child, IDENTITY, round(seconds * 1e9)))


def scan(seconds, frame="laser"):
    message = message_class("sensor_msgs/LaserScan")()
    message.header.frame_id, message.header.stamp = frame, Time.from_sec(seconds)
    return message


def stamps(messages):
    return [message.header.stamp.to_sec() for message in messages]


def test_a_message_is_handed_on_when_its_transform_comes(buffer):
    taken = []
    waiting = MessageFilter(buffer, ["odom"], taken.append)
    waiting.add(scan(1.0))
    waiting.add(scan(1.5))
    tell(buffer, "odom", "laser", 0.9)
    assert (taken, len(waiting)) == ([], 2)
    tell(buffer, "odom", "laser", 1.1)
    assert stamps(taken) == [1.0]
    tell(buffer, "odom", "laser", 2.0)
    assert stamps(taken) == [1.0, 1.5]
    waiting.add(scan(1.75))
    assert stamps(taken) == [1.0, 1.5, 1.75]


def test_it_waits_for_each_frame_and_for_the_tolerance(buffer):
    taken = []
    waiting = MessageFilter(buffer, ["map", "/base"], taken.append, tolerance=0.05)
    tell(buffer, "map", "laser", 0.0)
    tell(buffer, "base", "laser2", 0.0)
    waiting.add(scan(0.5))
    tell(buffer, "map", "laser", 0.5)
    tell(buffer, "base", "map", 0.0)
    tell(buffer, "base", "map", 0.6)
    assert taken == []
    tell(buffer, "map", "laser", 0.6)
    assert stamps(taken) == [0.5]


def test_the_oldest_goes_when_too_many_wait(buffer):
    failed = []
    waiting = MessageFilter(
        buffer, ["odom"], list, queue_size=2, failed=lambda m, why: failed.append((m.header.stamp.to_sec(), why))
    )
    for seconds in (1.0, 2.0, 3.0):
        waiting.add(scan(seconds))
    assert failed == [(1.0, QUEUE_FULL)]
    assert len(waiting) == 2


def test_what_no_transform_can_help_is_dropped_with_the_reason(buffer):
    failed = []
    waiting = MessageFilter(buffer, ["odom"], list, failed=lambda _, why: failed.append(why))
    tell(buffer, "odom", "laser", 5.0)
    tell(buffer, "odom", "laser", 5.1)
    waiting.add(scan(1.0))
    waiting.add(scan(6.0, frame=""))
    assert failed == [TOO_OLD, NO_FRAME]
    assert len(waiting) == 0


def test_a_closed_filter_hands_nothing_on(buffer):
    taken = []
    waiting = MessageFilter(buffer, ["odom"], taken.append)
    waiting.add(scan(1.0))
    waiting.close()
    tell(buffer, "odom", "laser", 0.0)
    tell(buffer, "odom", "laser", 2.0)
    assert taken == []
