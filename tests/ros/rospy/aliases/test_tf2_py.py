"""The buffer without a node, as scripts import it."""

from __future__ import annotations

import pytest

from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Duration, Time
from rosmini.ros.rospy.aliases.tf2_py import BufferCore, ExtrapolationException, LookupException, TransformException


@pytest.fixture
def buffer():
    buffer = BufferCore(Duration(5))
    for second in (1, 2, 8):
        buffer.set_transform(to_stamped("/map", "base", from_yaw(second, 0, 0), second * 10**9), "drive")
    buffer.set_transform_static(to_stamped("base", "laser", from_yaw(0, 1, 0), 0), "mount")
    return buffer


def test_the_methods_with_an_underscore(buffer):
    assert buffer._frameExists("laser")
    assert not buffer._frameExists("/laser")
    assert sorted(buffer._getFrameStrings()) == ["base", "laser", "map"]
    assert buffer._chain("map", Time(8), "laser", Time(8), "map") == ["laser", "base", "map"]
    assert '"map" -> "base"' in buffer._allFramesAsDot(Time(8))
    assert buffer._allFramesAsDot() == buffer.all_frames_as_dot()


def test_what_is_kept_and_what_is_asked(buffer):
    assert buffer.lookup_transform_core("map", "laser", Time()).transform.translation.x == 8
    assert buffer.can_transform_core("map", "laser", Time(8)) == (True, "")
    with pytest.raises(ExtrapolationException, match="into the past"):  # older than 5 s, so it is gone
        buffer.lookup_transform_core("map", "laser", Time(2))
    with pytest.raises(LookupException):
        buffer.lookup_transform_core("map", "camera", Time())
    buffer.clear()
    assert buffer.can_transform_core("base", "laser", Time())[0]
    with pytest.raises(TransformException):
        buffer.lookup_transform_core("map", "laser", Time())
