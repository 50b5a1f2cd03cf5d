"""The node: roll and pitch of what an IMU says, without its heading."""

from __future__ import annotations

import pytest

from rosmini import rosrun
from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer, TransformListener
from rosmini.core.tf.messages import transform_of
from rosmini.core.tf.rigid import from_rpy, rpy
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch


@pytest.fixture
def graph():
    with Graph(seed=4) as graph:
        yield graph


def say(graph, topic, orientation):
    node = graph.node("unit")
    publisher = node.publisher(topic, message_class("sensor_msgs/Imu"), queue_size=5)
    buffer = TransformListener(node, Buffer(node)).buffer
    heard = []
    node.subscriber("/rosout", message_class("rosgraph_msgs/Log"), heard.append)
    graph.run(0.2)
    message = message_class("sensor_msgs/Imu")()
    message.header.stamp = node.now()
    q = message.orientation
    q.x, q.y, q.z, q.w = orientation
    publisher.publish(message)
    graph.run(0.2)
    return buffer, [log.msg for log in heard]


def test_roll_and_pitch_without_the_heading(graph):
    roslaunch("hector_imu_attitude_to_tf", "example.launch", graph=graph)
    buffer, _ = say(graph, "imu", from_rpy((0, 0, 0), 0.1, -0.2, 1.3)[3:])
    found = transform_of(buffer.lookup_transform("base_stabilized", "base_link"))
    assert rpy(found) == pytest.approx((0.1, -0.2, 0.0))
    assert found[:3] == (0.0, 0.0, 0.0)


def test_its_defaults_and_an_attitude_that_is_none(graph):
    rosrun("hector_imu_attitude_to_tf", "imu_attitude_to_tf_node", graph=graph).instance()
    buffer, said = say(graph, "imu_topic", (0.0, 0.0, 0.0, 0.0))
    assert any("is ignored" in text for text in said)
    assert not buffer.can_transform("base_stabilized_frame", "base_frame")
