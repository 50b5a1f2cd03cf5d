"""Topic statistics: rospy's own code is given the arrivals of a run of ours, and has to publish the same.

Skipped where there is no rospy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs.geometry_msgs.msg import PointStamped
from rosmini.msgs.rosgraph_msgs.msg import TopicStatistics

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

PEER = Path(__file__).with_name("statistics_peer.py")


@pytest.mark.ros
@pytest.mark.parametrize("busy", [0.0, 0.12, 0.004])
def test_statistics_are_those_of_rospy(busy: float) -> None:
    need_ros(modules="rospy")
    arrivals: list[tuple[int, int, int]] = []
    ours: list[Any] = []
    random = Random(1)
    with Graph() as graph:
        listener, talker = graph.node("listener"), graph.node("talker")
        listener.set_param("/enable_statistics", True)
        graph.node("statistics").subscriber("/statistics", TopicStatistics, ours.append)

        def take(message: Any) -> None:
            arrivals.append((listener.now().to_nsec(), message.header.stamp.to_nsec(), message.header.seq))
            listener.sleep(busy)

        listener.subscriber("chatter", PointStamped, take, queue_size=1)
        publisher = talker.publisher("chatter", PointStamped)
        publisher.wait_for_subscribers()

        def talk() -> None:
            for pause in (0.05, 0.002, 1.5):
                for _ in range(40):
                    message = PointStamped()
                    message.header.stamp = talker.now()
                    publisher.publish(message)
                    talker.sleep(pause * random.uniform(0.8, 1.2))

        talker.spawn("talk", talk)
        graph.run(80)
    answer = run([SYSTEM_PYTHON, str(PEER)], stdin=json.dumps(arrivals), check=True)
    real = json.loads(answer.stdout.splitlines()[-1])
    assert len(real) > 5
    for theirs, mine in zip(real[1:], ours[len(ours) - len(real) + 1 :], strict=True):
        for name, value in theirs.items():
            got = getattr(mine, name)
            # rospy rounds squares of seconds to nanoseconds
            tolerance = 40_000 if "stddev" in name else 1000
            assert (got if isinstance(got, int) else got.to_nsec()) == pytest.approx(value, abs=tolerance), name
