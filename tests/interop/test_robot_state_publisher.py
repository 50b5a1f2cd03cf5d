"""One description and joint states for the real robot_state_publisher and for ours: the same transforms."""

from __future__ import annotations

import json
import xmlrpc.client
from pathlib import Path

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.graph import Graph
from rosmini.core.tf import TransformListener
from rosmini.msgs.sensor_msgs.msg import JointState
from rosmini.sim.urdf.xacro import expand

from ..conftest import nightly
from ..processes import run, start
from .conftest import SYSTEM_PYTHON, need_ros, rosmaster

PEER = Path(__file__).with_name("robot_state_publisher_peer.py")
REAL = Path("/usr/lib/robot_state_publisher/robot_state_publisher")

pytestmark = pytest.mark.ros

ARM = """<robot name="arm"><link name="a"/><link name="b"/><link name="c"/>
<link name="d"/><link name="e"/><link name="f"/>
<joint name="turn" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1 -2 3" rpy="0.3 -1.1 2.5"/>
<axis xyz="1 2 -3"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0 1" rpy="3 0.2 -3"/>
<axis xyz="-1 1 0.5"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="same" type="continuous"><parent link="c"/><child link="d"/><axis xyz="0 1 0"/>
<mimic joint="turn" multiplier="-2.5" offset="0.7"/></joint>
<joint name="plane" type="planar"><parent link="d"/><child link="e"/>
<origin xyz="0 1 0" rpy="0 0 1"/><axis xyz="0 0 1"/></joint>
<joint name="weld" type="fixed"><parent link="e"/><child link="f"/>
<origin xyz="1 0 0" rpy="1.5708 0 0"/></joint></robot>"""

CASES = {
    "arm": (ARM, {"turn": 1.234, "slide": -0.75}),
    "waffle": (None, {"wheel_left_joint": 100.5, "wheel_right_joint": -7.25}),
}


@pytest.fixture(scope="module")
def master(tmp_path_factory):
    """A real rosmaster of its own."""
    need_ros("rosmaster", REAL, modules="rospy")
    with (
        rosmaster(tmp_path_factory.mktemp("ros")) as found,
        xmlrpc.client.ServerProxy(found["ROS_MASTER_URI"]) as proxy,
    ):
        yield proxy, found


def description(name):
    text = CASES[name][0]
    return text or expand(f"package://turtlebot3_description/urdf/turtlebot3_{name}.urdf.xacro")


def ours(name):
    """Parent, whether it is static, and the transform of each frame that ours tells of."""
    with Graph() as graph:
        graph.node("setter").set_param("/robot_description", description(name))
        graph.node("setter").set_param("/tf_prefix", "one")
        buffer = TransformListener(graph.node("looker")).buffer
        rosrun("robot_state_publisher", "robot_state_publisher", graph=graph).instance()
        joints = CASES[name][1]
        publisher = graph.node("joints").publisher("joint_states", JointState, queue_size=1)
        graph.run(0.1)
        message = JointState(name=list(joints), position=list(joints.values()))
        message.header.stamp = graph.now()
        publisher.publish(message)
        graph.run(0.1)
        return {
            frame: [edge.newest.parent, edge.static, list(buffer.tree.lookup(edge.newest.parent, frame).transform)]
            for frame, edge in buffer.tree.edges.items()
        }


@pytest.mark.parametrize("name", ["arm", *nightly("waffle")])
def test_the_same_transforms(master, name):
    proxy, env = master
    expected = ours(name)
    proxy.setParam("/test", "/robot_description", description(name))
    proxy.setParam("/test", "/tf_prefix", "one")
    with start([REAL], env=env):
        arguments = json.dumps(CASES[name][1]), json.dumps(sorted(expected))
        done = run([SYSTEM_PYTHON, PEER, *arguments], env=env)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert set(found) == set(expected)
    for frame, (parent, static, numbers) in expected.items():
        assert found[frame][:2] == [parent, static]
        theirs, own = np.array(found[frame][2]), np.array(numbers)
        assert np.allclose(theirs[:3], own[:3], atol=1e-12)
        # A quaternion and its negative are the same turn.
        assert abs(float(theirs[3:] @ own[3:])) == pytest.approx(1, abs=1e-12)
