"""Images of cameras, from messages and from arrays."""

import io

import numpy as np
import pytest
from PIL import Image

from rosmini.msgs import message_class
from rosmini.sim.models import CameraModel
from rosmini.sim.sensors.rendering import develop, expose
from rosmini.sim.sensors.scene import Scene, parts_of
from rosmini.sim.worlds import world
from rosmini.viz import ViewError
from rosmini.viz.image_pictures import ENCODINGS, image_picture, pixels_of

COLOURS = np.array([[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (10, 20, 30)]], dtype=np.uint8)


def message(array, encoding, *, padding=0, big=False, frame="camera"):
    told = message_class("sensor_msgs/Image")()
    told.header.frame_id = frame
    told.height, told.width = array.shape[:2]
    rows = [row.tobytes() + b"\0" * padding for row in array]
    told.step, told.encoding, told.is_bigendian = len(rows[0]), encoding, int(big)
    told.data = b"".join(rows)
    return told


def png(view):
    return np.asarray(Image.open(io.BytesIO(view._images()["image/png"])))


@pytest.mark.parametrize(
    ("array", "encoding"),
    [
        (COLOURS, "rgb8"),
        (COLOURS[..., ::-1], "bgr8"),
        (np.dstack([COLOURS, np.full((2, 2), 9, np.uint8)]), "rgba8"),
        (np.dstack([COLOURS[..., ::-1], np.full((2, 2), 9, np.uint8)]), "bgra8"),
    ],
)
@pytest.mark.parametrize("padding", [0, 3])
def test_colours_are_read_whatever_their_order(array, encoding, padding):
    np.testing.assert_array_equal(pixels_of(message(array, encoding, padding=padding)), COLOURS)


def test_depths_are_metres_and_what_has_none_is_nan():
    metres = np.array([[1.5, np.inf, np.nan]], dtype=np.float32)
    np.testing.assert_array_equal(pixels_of(message(metres, "32FC1")), metres)
    millimetres = np.array([[1500, 0, 2]], dtype=np.uint16)
    np.testing.assert_allclose(pixels_of(message(millimetres, "16UC1")), [[1.5, np.nan, 0.002]])


def test_a_picture_shows_the_pixels():
    view = image_picture(message(COLOURS, "rgb8"), title="Eye")
    np.testing.assert_array_equal(png(view), COLOURS)
    assert view.text.splitlines()[0] == "Eye: 2 x 2 pixels, rgb8, in camera"
    assert view.caption == "Eye" and "2 by 2 pixels" in view.alt


def test_a_camera_in_the_room_is_said_in_words():
    camera = CameraModel("camera", (0.07, 0.0, 0.1), 160, 120, 1.09)
    light, depths = expose(camera, (0.0, 0.0, 0.0), Scene.of(parts_of(world("room").obstacles)))
    view = image_picture(develop(light))
    assert "upper half light blue, lower half light grey" in view.text
    deep = image_picture(depths, title="Depth")
    finite = depths[np.isfinite(depths)]
    assert f"from {finite.min():.2f} to {finite.max():.2f} m" in deep.text
    assert "% of the pixels" in deep.alt
    assert png(deep).shape[2] >= 3


def test_near_and_far_have_other_colours_and_nothing_is_grey():
    depths = np.full((120, 200), np.inf)
    depths[:60, :100], depths[:60, 100:] = 0.1, 3.0
    drawn = png(image_picture(depths, far=3.0)).astype(int)
    near, far, none = drawn[20, 20, :3], drawn[20, 170, :3], drawn[100, 100, :3]
    assert near[0] > 200 > far[0] and far[2] > near[2]
    assert none.max() - none.min() < 30


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_data_that_are_too_short_are_refused(encoding):
    told = message(COLOURS, encoding)
    told.step, told.data = (2 * ENCODINGS[encoding].channels * np.dtype(ENCODINGS[encoding].kind).itemsize, b"\0")
    with pytest.raises(ViewError, match="it has 1 bytes"):
        image_picture(told)


def test_an_unknown_encoding_is_named():
    with pytest.raises(ViewError, match=r"'rgb9'.*rgb8"):
        image_picture(message(COLOURS, "rgb9"))


def test_what_is_no_image_is_refused():
    with pytest.raises(ViewError, match="an array of bytes"):
        image_picture(np.zeros((2, 2, 2)))
