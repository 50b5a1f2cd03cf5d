"""Broadcasters, listeners and buffers on a graph."""

import struct

import numpy as np
import pytest

from rosmini.core.errors import ROSException
from rosmini.core.graph import Graph
from rosmini.core.tf import (
    ExtrapolationException,
    LookupException,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)
from rosmini.core.tf.broadcaster import resolve, tf_prefix
from rosmini.core.tf.messages import scan_points
from rosmini.core.time import Time
from rosmini.msgs import message_class


@pytest.fixture
def graph():
    with Graph() as graph:
        yield graph


@pytest.fixture
def moving(graph):
    """odom -> base, 1 m/s along x, at 20 Hz."""
    broadcaster = TransformBroadcaster(graph.node("robot"))
    start = graph.now().to_sec()
    broadcaster.node.timer(
        0.05, lambda event: broadcaster.send("odom", "base", (event.current_real.to_sec() - start, 0, 0))
    )
    return broadcaster


def listening(graph, name="looker"):
    node = graph.node(name)
    return TransformListener(node).buffer


def test_a_lookup_waits_for_what_comes(graph, moving):
    buffer = listening(graph)
    with pytest.raises(LookupException, match="No transform has been received"):
        buffer.lookup_transform("odom", "base")
    before = graph.now()
    found = buffer.lookup_transform("odom", "base", timeout=2.0)
    assert (found.header.frame_id, found.child_frame_id) == ("odom", "base")
    assert (graph.now() - before).to_sec() < 0.2
    later = graph.now()
    wanted = Time.from_sec(later.to_sec() + 0.52)
    assert not buffer.can_transform("odom", "base", wanted)
    first = buffer.lookup_transform("odom", "base", later, 1.0).transform.translation.x
    second = buffer.lookup_transform("odom", "base", wanted, 1.0).transform.translation.x
    assert second - first == pytest.approx(0.52, abs=1e-6)


def test_a_wait_that_is_in_vain(graph, moving):
    buffer = listening(graph)
    graph.run(0.5)
    before = graph.now()
    assert not buffer.wait_for_transform("odom", "nobody", timeout=0.5)
    assert (graph.now() - before).to_sec() == pytest.approx(0.5)
    answers, reason = buffer.can_transform("odom", "nobody", return_debug_tuple=True)
    assert not answers
    assert '"nobody"' in reason
    with pytest.raises(ExtrapolationException, match=r"from /robot\)"):
        buffer.lookup_transform("odom", "base", Time(1))


def test_static_transforms_reach_those_who_come_late(graph):
    broadcaster = StaticTransformBroadcaster(graph.node("calibration"))
    broadcaster.send("base", "laser", (0.1, 0, 0.2))
    graph.run(1)
    broadcaster.send("base", "camera", (0.3, 0, 0.2))
    graph.run(1)
    buffer = listening(graph)
    assert buffer.lookup_transform("laser", "camera", timeout=1).transform.translation.x == pytest.approx(0.2)
    assert buffer.can_transform("laser", "camera", Time(3))
    assert str(buffer) == "base\n|-- camera\n`-- laser"


def test_the_advanced_form_waits(graph, moving):
    buffer = listening(graph)
    graph.run(1)
    now = graph.now()
    then = Time.from_sec(now.to_sec() - 0.5)
    found = buffer.lookup_transform_full("base", now, "base", then, "odom", 1.0)
    assert found.transform.translation.x == pytest.approx(-0.5, abs=1e-6)
    assert not buffer.can_transform_full("base", now, "base", then, "map")


def test_what_is_in_a_frame_moves_to_another(graph):
    broadcaster = StaticTransformBroadcaster(graph.node("calibration"))
    broadcaster.send("map", "base", (1, 2, 3), (0, 0, 1, 1))  # a quarter turn to the left
    buffer = listening(graph)
    buffer.wait_for_transform("map", "base")

    def stamped(kind, **fields):
        message = message_class(kind)(**fields)
        message.header.frame_id = "base"
        return message

    ahead = {"x": 1.0, "y": 0.0, "z": 0.0}
    point = message_class("geometry_msgs/Point")(**ahead)
    point = buffer.transform(stamped("geometry_msgs/PointStamped", point=point), "map")
    assert point.header.frame_id == "map"
    assert (point.point.x, point.point.y, point.point.z) == pytest.approx((1, 3, 3))
    vector = message_class("geometry_msgs/Vector3")(**ahead)
    vector = buffer.transform(stamped("geometry_msgs/Vector3Stamped", vector=vector), "map")
    assert (vector.vector.x, vector.vector.y) == pytest.approx((0, 1))
    spread = [0.0] * 36
    spread[0] = 4.0  # along x of base, which is y of map
    pose = stamped("geometry_msgs/PoseWithCovarianceStamped")
    pose.pose.pose.orientation.w, pose.pose.covariance = 1.0, spread
    moved = buffer.transform(pose, "map")
    assert moved.pose.covariance[7] == pytest.approx(4)
    assert moved.pose.covariance[0] == pytest.approx(0)
    assert moved.pose.pose.position.x == pytest.approx(1)
    with pytest.raises(TransformException, match="std_msgs/String cannot be transformed"):
        from rosmini.core.tf.messages import transformed as move

        move(message_class("std_msgs/String")(), buffer.lookup_transform("map", "base"))


def test_clouds(graph):
    broadcaster = StaticTransformBroadcaster(graph.node("calibration"))
    broadcaster.send("map", "laser", (10, 0, 0))
    buffer = listening(graph)
    buffer.wait_for_transform("map", "laser")
    field = message_class("sensor_msgs/PointField")
    cloud = message_class("sensor_msgs/PointCloud2")(
        height=1,
        width=2,
        fields=[field(name=name, offset=4 * at, datatype=7, count=1) for at, name in enumerate(["x", "y", "z", "i"])],
        point_step=16,
        row_step=32,
        data=struct.pack("<8f", 1, 2, 3, 9, 4, 5, 6, 8),
    )
    cloud.header.frame_id = "laser"
    moved = buffer.transform(cloud, "map")
    assert struct.unpack("<8f", bytes(moved.data)) == (11, 2, 3, 9, 14, 5, 6, 8)
    cloud.fields = cloud.fields[1:]
    with pytest.raises(TransformException, match="fields y, z, i cannot be transformed"):
        buffer.transform(cloud, "map")


def test_a_scan_as_points(graph):
    scan = message_class("sensor_msgs/LaserScan")(
        angle_min=0.0, angle_increment=1.5707963267948966, range_min=0.1, range_max=3.5
    )
    scan.ranges = [1.0, 2.0, float("inf"), 9.0]
    assert scan_points(scan) == pytest.approx(np.array([[1, 0, 0], [0, 2, 0]]))


def test_prefixes(graph):
    graph.master.setParam("/lead", "/robot1/tf_prefix", "robot1_tf/")
    node = graph.node("talker", namespace="/robot1")
    assert tf_prefix(node) == "robot1_tf"
    assert tf_prefix(graph.node("other")) == ""
    StaticTransformBroadcaster(node, tf_prefix(node)).send("/map", "base")
    buffer = listening(graph)
    assert buffer.wait_for_transform("map", "robot1_tf/base")
    assert resolve("", "/odom") == "odom"


def test_a_node_that_ends_while_it_waits(graph):
    buffer = listening(graph)
    with pytest.raises((ROSException, KeyboardInterrupt)):
        buffer.node.timer(0.1, lambda event: buffer.node.shutdown("enough"), oneshot=True)
        buffer.wait_for_transform("a", "b", timeout=9)


def test_a_quaternion_of_length_zero_counts_as_no_rotation(graph, capsys):
    StaticTransformBroadcaster(graph.node("calibration")).send("map", "base", (1, 2, 3), (0, 0, 1, 1))
    buffer = listening(graph)
    buffer.wait_for_transform("map", "base")
    pose = message_class("geometry_msgs/PoseStamped")()
    pose.header.frame_id, pose.pose.position.x = "base", 1.0
    moved = [buffer.transform(pose, "map").pose for _ in range(2)][1]
    assert (moved.position.x, moved.position.y, moved.position.z) == pytest.approx((1, 3, 3))
    assert (moved.orientation.z, moved.orientation.w) == pytest.approx((0.5**0.5, 0.5**0.5))
    assert pose.pose.orientation.w == 0
    assert capsys.readouterr().err.count("orientation.w = 1") == 1
