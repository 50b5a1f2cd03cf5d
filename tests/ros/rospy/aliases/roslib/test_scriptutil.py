"""The Master and names for old scripts, and what rostest asks."""

from __future__ import annotations

from rosmini.msgs.std_msgs.msg import String
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases import rostest
from rosmini.ros.rospy.aliases.roslib import names, scriptutil


def test_names_and_the_master(sim_programs):
    def main():
        rospy.init_node("main")
        rospy.Publisher("news", String, queue_size=1)
        found = [scriptutil.script_resolve_name("me", name) for name in ("/a", "~a", "a", "")]
        state = scriptutil.get_master().getSystemState("/me")
        return found, state[0], dict(state[2][0])["/news"]

    assert sim_programs(main) == (["/a", "/me/a", "/a", "/"], 1, ["/main"])
    assert not names.is_legal_resource_name(None)
    assert not names.is_legal_resource_base_name(None)


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
