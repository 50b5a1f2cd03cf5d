"""Points of clouds: errors, and the kinds of data that a message may have."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.core.errors import MessageException
from rosmini.msgs.sensor_msgs.msg import PointCloud2, PointField
from rosmini.msgs.std_msgs.msg import Header, String
from rosmini.ros.rospy.aliases import point_cloud2 as pc2

POINTS = [(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)]


@pytest.mark.parametrize("kind", [bytes, list, lambda data: np.frombuffer(data, np.uint8)])
def test_data_of_any_kind(kind):
    cloud = pc2.create_cloud_xyz32(Header(), POINTS)
    cloud.data = kind(cloud.data)
    assert list(pc2.read_points(cloud)) == POINTS
    assert pc2.read_points_list(cloud)[1].y == 5.0


def test_what_is_no_cloud():
    with pytest.raises(MessageException, match="std_msgs/String is not a sensor_msgs/PointCloud2"):
        pc2.read_points(String())


def test_a_cloud_that_is_shorter_than_it_says():
    cloud = pc2.create_cloud_xyz32(Header(), POINTS)
    cloud.width = 3
    with pytest.raises(MessageException, match=r"point \(2, 0\) .* 24 bytes"):
        list(pc2.read_points(cloud))


@pytest.mark.parametrize(
    ("field", "message"),
    [
        (PointField("x", 0, 9, 1), "unknown data type 9"),
        (PointField("x", 0, 8, 2**32 - 1), "outside of its data"),
        (PointField("x", 2**32 - 1, 8, 1), "outside of its data"),
    ],
)
def test_fields_that_cannot_be(field, message):
    cloud = PointCloud2(fields=[field], width=1, height=1, point_step=8, row_step=8, data=bytes(8))
    with pytest.raises(MessageException, match=message):
        list(pc2.read_points(cloud))


@pytest.mark.parametrize("point", [(1, 2), (1, 2, "x"), (1, 2, 1e300)])
def test_a_point_that_does_not_fit(point):
    with pytest.raises(MessageException, match="does not fit the fields x, y, z"):
        pc2.create_cloud_xyz32(Header(), [point])
