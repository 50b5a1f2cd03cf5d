"""`rosmini roswtf` beside the real one, at one real Master with real nodes: ours names what that finds in the graph."""

from __future__ import annotations

import re
import sys
import xmlrpc.client

import pytest

from ..processes import run, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros

need_ros("roswtf", modules="rospy, std_msgs.msg")

NODE = """
import sys, rospy
from std_msgs.msg import String, Int32
rospy.init_node(sys.argv[1])
if sys.argv[1] == "talker":
    chatter = rospy.Publisher("chatter", String, queue_size=5)
    rospy.Subscriber("/num", Int32, print)
else:
    rospy.Subscriber("/chater", String, print)
    number = rospy.Publisher("/num", String, queue_size=5)
rospy.set_param("/ready_" + sys.argv[1], True)
rospy.spin()
"""


@pytest.mark.ros
def test_what_the_real_one_finds_ours_names(master: dict[str, str]) -> None:
    words = [SYSTEM_PYTHON, "-c", NODE]
    with (
        start([*words, "talker"], env=master) as talker,
        start([*words, "listener"], env=master) as listener,
        xmlrpc.client.ServerProxy(master["ROS_MASTER_URI"]) as server,
    ):
        for name, process in (("talker", talker), ("listener", listener)):
            wait_until(lambda n=name: server.hasParam("/test", f"/ready_{n}")[2], name, process)  # type: ignore[misc, index]
        server.setParam("/test", "/use_sim_time", True)
        real = run(["roswtf"], env=master).stdout
        ours = run([sys.executable, "-m", "rosmini", "roswtf"], env=master)
    assert "/use_sim_time is set but no publisher of /clock is present" in real
    assert "/use_sim_time is set but no publisher of /clock is present" in ours.stdout
    apart = re.findall(r"^ \* (\S+)->(\S+) \((\S+)\)$", real, re.MULTILINE)
    assert set(apart) <= {("/listener", "/talker", "/num")}  # rospy tries again and again
    assert " * /num:\n   std_msgs/Int32: /talker\n   std_msgs/String: /listener\n" in ours.stdout
    unheard = set(re.findall(r"^   \* (\S+)$", real.partition("subscriptions are unconnected")[2], re.MULTILINE))
    assert "/chater" in unheard
    assert " * /chater, to which /listener subscribes\n   did you mean /chatter?\n" in ours.stdout
    assert "Found 2 error(s)." in ours.stdout
