"""The Master and names for old scripts, and what rostest asks."""

from __future__ import annotations

from rosmini.msgs.std_msgs.msg import String
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases import rostest


def test_who_publishes_and_subscribes(sim_programs):
    def main():
        rospy.init_node("main")
        rospy.Publisher("news", String, queue_size=1)
        rospy.Subscriber("orders", String)
        return [
            [ask(topic, node) for topic, node in (("/news", "/main"), ("/orders", "/main"), ("/news", "/other"))]
            for ask in (rostest.is_publisher, rostest.is_subscriber)
        ]

    assert sim_programs(main) == [[True, False, False], [False, True, False]]
