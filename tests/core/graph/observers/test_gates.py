"""What happens to messages at a gate, without a graph around it."""

from __future__ import annotations

import pytest

from rosmini.core.graph.observers.faults import FaultError, Gate, Gates, TopicFault
from rosmini.core.graph.scheduler import Scheduler
from rosmini.msgs.std_msgs.msg import Int32


def passed(fault: TopicFault, count: int, peer: str = "/talker") -> list[int]:
    scheduler = Scheduler()
    found: list[int] = []
    Gate(fault, scheduler, "/listener").pass_on(
        [Int32(number) for number in range(count)], peer, lambda messages: found.extend(one.data for one in messages)
    )
    scheduler.run()
    return found


def test_the_strength_of_one_fault_does_not_change_another() -> None:
    lost = set(range(100)) - set(passed(TopicFault("/t", lose=0.3), 100))
    also_doubled = passed(TopicFault("/t", lose=0.3, double=0.5), 100)
    assert 10 < len(lost) < 50
    assert set(range(100)) - set(also_doubled) == lost
    assert set(passed(TopicFault("/t", lose=0.6), 100)) < set(range(100)) - lost


def test_each_publisher_has_chances_of_its_own() -> None:
    assert passed(TopicFault("/t", lose=0.5), 50, "/a") != passed(TopicFault("/t", lose=0.5), 50, "/b")


def test_a_fault_for_one_subscriber_adds_to_that_for_all() -> None:
    gates = Gates(Scheduler())
    assert gates.of("/t", "/a") == []
    gates.faults["/t", ""] = TopicFault("/t", lose=1)
    gates.faults["/t", "/a"] = TopicFault("/t", "/a", delay=1)
    kept: list[object] = []
    (far,) = gates.of("/t", "/b")
    assert len(gates.of("/t", "/a")) == 2
    far.pass_on([Int32(1)], "/p", kept.extend)
    assert kept == []
    assert gates.faults["/t", ""].lost == 1
    assert gates.faults["/t", "/a"].messages == 0


def test_a_fault_that_does_nothing_is_refused() -> None:
    with pytest.raises(FaultError, match="lose, double, delay or jitter"):
        TopicFault("/t")
