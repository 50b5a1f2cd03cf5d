"""Parameters and the Master as scripts see them."""

from __future__ import annotations

from xmlrpc.client import Binary

import pytest

from rosmini.core.errors import ParameterError
from rosmini.msgs.std_msgs.msg import Header, String
from rosmini.msgs.std_srvs.srv import SetBool
from rosmini.ros import rospy
from rosmini.ros.rospy.aliases import genpy, rosgraph, roslib


def test_parameters_work_before_init_node_and_after(programs):
    def main():
        rospy.set_param("rate", 10)
        rospy.set_param("~rate", 20)
        early = rospy.get_param("rate"), rospy.get_param("/unnamed/rate")
        rospy.init_node("main")
        rospy.set_param("~tree", {"a": 1, "b": {"c": [1, 2.5, "x"]}})
        assert rospy.get_param("~tree/b/c") == [1, 2.5, "x"]
        assert rospy.get_param("/main") == {"tree": {"a": 1, "b": {"c": [1, 2.5, "x"]}}}
        assert rospy.get_param_cached("rate") == 10
        assert rospy.get_param("nothing", None) is None
        assert rospy.has_param("~tree")
        assert not rospy.has_param("tree")
        assert "/main/tree/a" in rospy.get_param_names()
        assert rospy.search_param("rate") == "/rate"
        assert rospy.search_param("nothing") is None
        rospy.delete_param("~tree")
        for missing in (lambda: rospy.delete_param("~tree"), lambda: rospy.get_param("~tree")):
            with pytest.raises(KeyError, match="/main/tree"):
                missing()
        with pytest.raises(ParameterError):
            rospy.set_param("bad", object())
        return early

    assert programs(main) == (10, 20)


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


def test_rosgraph(programs):
    def main():
        rospy.init_node("main")
        master = rosgraph.Master("/tool")
        assert rosgraph.is_master_online()
        assert master.is_online()
        assert ["/rosout", ["/main"]] in [list(pair) for pair in master.getSystemState()[0]]
        with pytest.raises(rosgraph.MasterError, match="nobody"):
            master.lookupNode("nobody")
        assert rosgraph.get_master_uri() == master.master_uri
        return rosgraph.myargv(["a", "b:=c"]), rosgraph.names.anonymous_name("x") != rosgraph.names.anonymous_name("x")

    assert programs(main) == (["a"], True)


def test_names():
    names = rosgraph.names
    assert names.ns_join("/a", "b") == "/a/b"
    assert names.namespace("/a/b") == "/a/"
    assert names.make_global_ns("a") == "/a/"
    assert names.resolve_name("x", "/a/node", {"/a/x": "/y"}) == "/y"
    assert (names.is_legal_name("a b"), names.is_legal_name("~a/b"), names.is_legal_base_name("a/b")) == (
        False,
        True,
        False,
    )
    assert names.load_mappings(["a:=b", "_p:=1", "__name:=n", "c"]) == {"a": "b", "__name": "n"}


def test_genpy_and_roslib():
    roslib.load_manifest("anything")
    assert roslib.message.get_message_class("std_msgs/String") is String
    assert genpy.message.get_service_class("std_srvs/SetBool") is SetBool
    assert genpy.message.get_message_class("std_msgs/Nothing") is None
    assert genpy.message.get_message_class("nothing_msgs/Nothing") is None
    assert isinstance(String(), genpy.Message)
    assert roslib.packages.get_pkg_dir("std_msgs").endswith("std_msgs")
    assert roslib.packages.get_pkg_dir("no_such_package", required=False) is None
    with pytest.raises(roslib.packages.InvalidROSPkgException):
        roslib.packages.get_pkg_dir("no_such_package")


def test_filling_messages():
    fill = genpy.message.fill_message_args
    message = genpy.message.get_message_class("geometry_msgs/PoseStamped")()
    fill(
        message,
        [{"header": {"stamp": "now", "frame_id": "map"}, "pose": {"position": [1, 2, 3]}}],
        {"now": genpy.Time(7)},
    )
    assert (message.header.stamp, message.header.frame_id, message.pose.position.z) == (genpy.Time(7), "map", 3)
    fill(message, ["auto", [[4, 5, 6], [0, 0, 0, 1]]], {"auto": Header(stamp=genpy.Time(9))})
    assert message.header.stamp == genpy.Time(9)
    assert message.pose.position.x == 4
    header = Header()
    fill(header, [3, {"secs": 1, "nsecs": 2}, "odom"])
    assert (header.seq, header.stamp, header.frame_id) == (3, genpy.Time(1, 2), "odom")
    path = genpy.message.get_message_class("nav_msgs/Path")()
    fill(path, {"poses": [{"header": {"frame_id": "map"}}]})
    assert path.poses[0].header.frame_id == "map"
    for bad in ({"nothing": 1}, [1], [1, 2, 3, 4], 5):
        with pytest.raises((genpy.MessageException, ValueError)):
            fill(Header(), bad)
    assert genpy.message.get_printable_message_args(header) == "seq stamp frame_id"


def test_bytes_come_as_rospy_gives_them(sim_programs):
    def main():
        rospy.set_param("/model", Binary(b"\x00\xff"))
        found = rospy.get_param("/model")
        return type(found), found.data, rospy.get_param("/")["model"].data

    assert sim_programs(main) == (Binary, b"\x00\xff", b"\x00\xff")
