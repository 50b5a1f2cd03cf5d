"""Parameters and the Master as scripts see them."""

from __future__ import annotations

from xmlrpc.client import Binary

import pytest

from rosmini.msgs.std_msgs.msg import String
from rosmini.ros import rospy


def test_the_master_proxy(programs):
    def main():
        rospy.init_node("main")
        rospy.Publisher("t", String, queue_size=1)
        master = rospy.get_master()
        master["/x"] = 1
        assert master["/x"] == 1
        assert "/x" in master
        assert "/x" in list(master)
        del master["/x"]
        assert "/x" not in master
        with pytest.raises(AttributeError, match="nonsense"):
            master.nonsense()
        code, _, state = master.getSystemState()
        return code, dict(state[0])["/t"], master.lookupNode("/main")[2] == rospy.get_node_uri()

    assert programs(main) == (1, ["/main"], True)


def test_bytes_come_as_rospy_gives_them(sim_programs):
    def main():
        rospy.set_param("/model", Binary(b"\x00\xff"))
        found = rospy.get_param("/model")
        return type(found), found.data, rospy.get_param("/")["model"].data

    assert sim_programs(main) == (Binary, b"\x00\xff", b"\x00\xff")
