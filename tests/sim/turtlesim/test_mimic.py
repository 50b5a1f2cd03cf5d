"""`turtlesim/mimic`: the second turtle does what the first does."""

import pytest

from rosmini import Graph, rosrun
from rosmini.msgs.geometry_msgs.msg import Twist


def test_the_second_turtle_follows():
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        sim.spawn(2.0, 2.0, 0.0)
        mimic = rosrun("turtlesim", "mimic", "input:=turtle1", "output:=turtle2", graph=graph)
        driver = graph.node("driver")
        publisher = driver.publisher("turtle1/cmd_vel", Twist)
        publisher.wait_for_subscribers()
        graph.run(0.1)
        twist = Twist()
        twist.linear.x, twist.angular.z = 1.0, 0.5
        publisher.publish(twist)
        graph.run(3.0)
        first, second = sim.turtles.values()
        assert mimic.node.name == "/turtle_mimic"
        assert first.theta == pytest.approx(0.504)
        assert second.theta == pytest.approx(first.theta, abs=0.05)
        assert second.x - 2.0 == pytest.approx(first.x - 5.544445, abs=0.05)
