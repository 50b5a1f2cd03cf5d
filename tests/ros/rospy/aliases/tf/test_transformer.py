"""The first API of tf without a node."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Duration, Time
from rosmini.msgs.geometry_msgs.msg import PoseStamped, Quaternion, QuaternionStamped
from rosmini.ros.rospy.aliases import tf2_geometry_msgs
from rosmini.ros.rospy.aliases.tf import Exception as TransformException
from rosmini.ros.rospy.aliases.tf import ExtrapolationException, Transformer, TransformerROS

SPEED, TURN = 0.5, 0.8


@pytest.fixture
def transformer():
    """A robot on a circle in odom, which is turned by 90 degrees in map; its arm is 0.3 m ahead."""
    transformer = Transformer(True, Duration(20))
    radius = SPEED / TURN
    for step in range(1001):
        yaw = TURN * step * 0.01
        pose = from_yaw(radius * math.sin(yaw), radius * (1 - math.cos(yaw)), yaw)
        transformer.setTransform(to_stamped("odom", "base", pose, 10**9 + step * 10**7))
        transformer.setTransform(to_stamped("map", "odom", from_yaw(5, 6, math.pi / 2), 10**9 + step * 10**7))
        transformer.setTransform(to_stamped("base", "arm", from_yaw(0.3, 0, 0), 10**9 + step * 10**7))
    return transformer


@pytest.mark.parametrize("seconds", [0, 3.0, 6.5])
def test_lookup_twist(transformer, seconds):
    linear, angular = transformer.lookupTwist("base", "odom", Time.from_sec(seconds), Duration(0.02))
    middle = (seconds or 10.99) - 1
    heading = TURN * middle
    expected = [SPEED * math.cos(heading), SPEED * math.sin(heading), 0]
    assert linear == pytest.approx(expected, abs=2e-3)
    assert angular == pytest.approx([0, 0, TURN], abs=1e-9)


def test_lookup_twist_full(transformer):
    when, interval = Time(4), Duration(0.02)
    heading = TURN * 3
    forwards = np.array([math.cos(heading), math.sin(heading), 0])
    aside = np.array([-math.sin(heading), math.cos(heading), 0])

    def twist(reference, point, frame):
        return transformer.lookupTwistFull("base", "odom", reference, point, frame, when, interval)

    # In odom's axes, of base's own origin: the same as lookupTwist.
    linear, angular = twist("odom", (0, 0, 0), "base")
    plain = transformer.lookupTwist("base", "odom", when, interval)
    assert (linear, angular) == (pytest.approx(plain[0]), pytest.approx(plain[1]))
    # In its own axes a robot with wheels drives straight ahead; its arm is swung around.
    linear, angular = twist("base", (0, 0, 0), "base")
    assert linear == pytest.approx([SPEED, 0, 0], abs=1e-5)
    assert angular == pytest.approx([0, 0, TURN])
    assert twist("base", (0, 0, 0), "arm")[0] == pytest.approx([SPEED, 0.3 * TURN, 0], abs=1e-5)
    assert twist("base", (0, 0.1, 0), "arm")[0] == pytest.approx([SPEED - 0.1 * TURN, 0.3 * TURN, 0], abs=1e-5)
    # In the axes of map all is turned by 90 degrees.
    linear, angular = twist("/map", (0, 0, 0), "arm")
    x, y, _ = SPEED * forwards + 0.3 * TURN * aside
    assert linear == pytest.approx([-y, x, 0], abs=1e-5)
    assert angular == pytest.approx([0, 0, TURN])
    with pytest.raises(ExtrapolationException):
        transformer.lookupTwistFull("base", "odom", "map", (0, 0, 0), "base", Time(50), interval)


@pytest.mark.parametrize(("seconds", "interval"), [(0, 15), (3, 5)])
def test_the_window_of_a_twist_does_not_begin_before_time_zero(seconds, interval):
    transformer = Transformer(True, Duration(20))
    for second in range(11):
        transformer.setTransform(to_stamped("odom", "base", from_yaw(second, 0, 0), max(second * 10**9, 10**5)))
    linear, _ = transformer.lookupTwist("base", "odom", Time(seconds), Duration(interval))
    assert linear == pytest.approx([1, 0, 0], abs=1e-3)
    with pytest.raises(ExtrapolationException):
        transformer.lookupTwist("base", "odom", Time(11), Duration(interval))


def test_a_root_frame_does_not_exist(transformer):
    assert not transformer.frameExists("map")
    assert not transformer.frameExists("/odom")
    assert transformer.frameExists("odom")
    assert transformer.getFrameStrings() == ["base", "odom", "arm"]


QUATERNIONS = {"a new pose": (0, 0, 0, 0), "almost zero": (1e-9, 0, 0, 0), "none": (0, 0, 0, 1)}


@pytest.mark.parametrize("quaternion", QUATERNIONS.values(), ids=QUATERNIONS)
def test_a_quaternion_of_length_zero_counts_as_no_rotation(sim, quaternion, capsys):
    transformer = TransformerROS()
    half = math.sqrt(0.5)
    stamped = to_stamped("map", "base", (1, 2, 3, 0, 0, half, half), 10**9)
    transformer.setTransform(stamped)
    pose, turn = PoseStamped(), QuaternionStamped()
    pose.header.frame_id = turn.header.frame_id = "base"
    pose.pose.position.x = 1
    pose.pose.orientation = turn.quaternion = Quaternion(*quaternion)
    found = transformer.transformPose("map", pose).pose
    assert found == tf2_geometry_msgs.do_transform_pose(pose, stamped).pose
    for orientation in (found.orientation, transformer.transformQuaternion("map", turn).quaternion):
        assert [getattr(orientation, part) for part in "xyzw"] == pytest.approx([0, 0, half, half])
    assert [getattr(found.position, axis) for axis in "xyz"] == pytest.approx([1, 3, 3])
    assert transformer.fromTranslationRotation((1, 2, 3), quaternion)[:3, :3] == pytest.approx(np.identity(3))
    warned = capsys.readouterr().err
    kinds = ("geometry_msgs/PoseStamped", "geometry_msgs/QuaternionStamped")
    assert [warned.count(kind) for kind in kinds] == ([0, 0] if quaternion[3] else [1, 1])


def test_only_a_transformer_that_others_fill_waits(transformer):
    """As in tf: without a thread that receives transforms, a wait could never end."""
    names = "odom", "base", Time(0), Duration(0.1)
    with pytest.raises(TransformException, match="dedicated thread"):
        transformer.waitForTransform(*names)
    with pytest.raises(TransformException, match="dedicated thread"):
        transformer.waitForTransformFull("map", Time(0), "base", Time(0), "odom", Duration(0.1))
    transformer.setUsingDedicatedThread(True)
    transformer.waitForTransform(*names)
