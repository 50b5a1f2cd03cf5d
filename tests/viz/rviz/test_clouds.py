"""Point clouds as arrays: any fields, any byte order, and what does not fit."""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.msgs import message_class
from rosmini.viz.rviz.clouds import channels_of, read_cloud, unpacked
from rosmini.viz.rviz.primitives import DisplayError

PointCloud2 = message_class("sensor_msgs/PointCloud2")
PointField = message_class("sensor_msgs/PointField")

LAYOUT = "xyz"


def cloud(rows, *, big=False, width=None, **fields):
    """A cloud of x, y, z and intensity with 2 bytes between the points."""
    data = b"".join(struct.pack(">ffffxx" if big else "<ffffxx", *row) for row in rows)
    names = [PointField(name, 4 * i, 7, 1) for i, name in enumerate([*LAYOUT, "intensity"])]
    made = PointCloud2(
        height=1, width=len(rows) if width is None else width, fields=names, is_bigendian=big, point_step=18,
        row_step=18 * len(rows), data=data,
    )  # fmt: skip
    for name, value in fields.items():
        setattr(made, name, value)
    return made


numbers = st.floats(width=32)


@given(st.lists(st.tuples(numbers, numbers, numbers, numbers), max_size=9), st.booleans())
def test_points_that_are_finite_come_with_their_channels(rows, big):
    points, channels = channels_of(read_cloud(cloud(rows, big=big)))
    valid = [row for row in rows if np.isfinite(row[:3]).all()]
    np.testing.assert_array_equal(points, np.array(valid).reshape(-1, 4)[:, :3])
    np.testing.assert_array_equal(channels["intensity"], np.array(valid).reshape(-1, 4)[:, 3])


@pytest.mark.parametrize("kind", ["<f4", "<u4", ">i4", "<i4"])
def test_colours_are_packed_in_four_bytes_of_any_kind(kind):
    packed = np.array([0x00FF8000, 0x000000FF], np.uint32)
    stored = packed.view(kind[1:]).astype(kind)
    assert unpacked(stored) == pytest.approx(np.array([(1, 128 / 255, 0), (0, 0, 1)]))


WRONG = {
    "short": (cloud([(1, 2, 3, 4)], width=2), r"Data size \(18 bytes\) does not match width \(2\)"),
    "no x": (cloud([(1, 2, 3, 4)], fields=[PointField("y", 0, 7, 1)]), "No position transformer available"),
    "outside": (cloud([(1, 2, 3, 4)], fields=[PointField("x", 16, 7, 1)]), "ends at byte 20 of points of 18"),
    "type": (cloud([(1, 2, 3, 4)], fields=[PointField("x", 0, 99, 1)]), "unknown type 99"),
    "huge": (cloud([], width=4_000_000_000, height=4_000_000_000), "does not match"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_does_not_fit_is_named(name):
    bad, words = WRONG[name]
    with pytest.raises(DisplayError, match=words):
        channels_of(read_cloud(bad))


@given(
    st.binary(max_size=60),
    st.tuples(*[st.integers(0, 9)] * 3),
    st.lists(st.tuples(st.sampled_from([*LAYOUT, "rgb", ""]), st.integers(0, 40), st.integers(0, 9)), max_size=6),
)
def test_any_message_is_read_or_refused(data, sizes, fields):
    made = PointCloud2(data=data, width=sizes[0], height=sizes[1], point_step=sizes[2])
    made.fields = [PointField(*field, 1) for field in fields]
    try:
        points, _ = channels_of(read_cloud(made))
    except DisplayError:
        return
    assert len(points) <= sizes[0] * sizes[1]
