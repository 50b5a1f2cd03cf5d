"""How fast the robot is."""

from __future__ import annotations

import math

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.navigation.base_local_planner.following import OdometryHelper


@pytest.fixture
def told():
    """A helper, and a function that publishes odometry."""
    with Graph() as graph:
        helper = OdometryHelper(graph.node("move_base"))
        publisher = graph.node("robot").publisher("/odom", message_class("nav_msgs/Odometry"), queue_size=1)

        publisher.wait_for_subscribers()

        def tell(x, theta):
            message = message_class("nav_msgs/Odometry")()
            message.twist.twist.linear.x, message.twist.twist.angular.z = x, theta
            publisher.publish(message)
            graph.run(0.01)
            return helper.velocity.tolist()

        yield tell


def test_the_last_velocity_holds(told):
    assert told(0.2, -0.5) == [0.2, 0.0, -0.5]
    assert told(0.1, 0.0) == [0.1, 0.0, 0.0]


def test_what_is_no_number_is_told_once_and_left_out(told, capsys):
    told(0.2, 0.0)
    assert told(math.nan, 0.0) == [0.2, 0.0, 0.0]
    assert told(0.1, math.inf) == [0.2, 0.0, 0.0]
    assert capsys.readouterr().err.count("not finite") == 1
