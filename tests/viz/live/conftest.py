"""A robot in the built-in room, without noise, and what arrives on its topic."""

import pytest

from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.simulator import Simulator


@pytest.fixture
def simulator(graph):
    graph.master.setParam("/test", "/simulator/noise", 0.0)
    return Simulator(graph.node("simulator"))


@pytest.fixture
def heard(graph):
    """What is published on /cmd_vel: time since now [s], linear and angular velocity."""
    start, found = graph.now(), []
    listener = graph.node("listener")

    def hear(twist):
        found.append((round((graph.now() - start).to_sec(), 6), twist.linear.x, twist.angular.z))

    listener.subscriber("/cmd_vel", Twist, hear)
    return found
