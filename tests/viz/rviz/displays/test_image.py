"""Images in panes: encodings, ranges, and what cannot be shown."""

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.msgs import message_class
from rosmini.viz.rviz import still

ImageMessage = message_class("sensor_msgs/Image")


def image(data, encoding, width=2, height=1, **fields):
    step = fields.pop("step", len(data) // max(height, 1))
    return ImageMessage(width=width, height=height, encoding=encoding, step=step, data=data, **fields)


@pytest.fixture
def seen(stage, statuses):
    """Publish images, and return the pane and what is said."""
    scene, display = stage.display("Image", more={"Image Topic": "/image"})

    def see(*images, **properties):
        for name, value in properties.items():
            display[name.replace("_", " ")] = value
        for each in images:
            stage.publish("/image", each, "camera")
        panes = scene.update()[0].panes
        return (panes[0] if panes else None), statuses(display)

    see.scene = scene
    return see


COLOURS = {
    "rgb8": bytes([1, 2, 3, 4, 5, 6]),
    "bgr8": bytes([3, 2, 1, 6, 5, 4]),
    "8UC3": bytes([3, 2, 1, 6, 5, 4]),
    "rgba8": bytes([1, 2, 3, 0, 4, 5, 6, 255]),
    "bgra8": bytes([3, 2, 1, 0, 6, 5, 4, 255]),
    "8UC4": bytes([3, 2, 1, 0, 6, 5, 4, 255]),
}
GREYS = {"mono8": bytes([7, 9]), "8UC1": bytes([7, 9]), "bayer_rggb8": bytes([7, 9])}


@pytest.mark.parametrize("encoding", [*COLOURS, *GREYS])
def test_colours_and_greys_as_they_are(seen, encoding):
    data = COLOURS.get(encoding) or GREYS[encoding]
    pane, said = seen(image(data, encoding))
    expected = [[[1, 2, 3], [4, 5, 6]]] if encoding in COLOURS else [[[7] * 3, [9] * 3]]
    assert pane.pixels.tolist() == expected
    assert pane.text == f"2 x 1 pixels, {encoding}, in camera"
    assert said["Image"] == ("Ok", "1 images received")


RANGES = {"32FC1": "<3f", "16UC1": "<3H", "mono16": "<3H", "16SC1": "<3h"}


@pytest.mark.parametrize("encoding", RANGES)
def test_ranges_go_from_black_to_white(seen, encoding):
    data = struct.pack(RANGES[encoding], 100, 200, 300)
    pane, _ = seen(image(data, encoding, 3))
    assert pane.pixels[0, :, 0].tolist() == [0, 128, 255]
    pane, _ = seen(Normalize_Range=False, Min_Value=200.0, Max_Value=300.0)
    assert pane.pixels[0, :, 0].tolist() == [0, 0, 255]


def test_the_range_is_the_median_of_some_images_and_nan_is_black(seen):
    for far in (2.0, 2.0, 1000.0):
        pane, _ = seen(image(struct.pack("<3f", 0.0, math.nan, far), "32FC1", 3))
    assert pane.pixels[0, :, 0].tolist() == [0, 0, 255]
    pane, _ = seen(image(struct.pack("<3f", 0.0, 1.0, 2.0), "32FC1", 3))
    assert pane.pixels[0, 1, 0] == 128


WRONG = {
    "encoding": (image(b"123456", "jpeg9"), "Unsupported image encoding [jpeg9]"),
    "short": (image(b"123456", "rgb8", 2, 3), "needs 6 bytes a row"),
    "empty": (image(b"", "rgb8", 0, 0), "an image of 0 x 0 pixels cannot be drawn"),
    "huge": (image(b"", "rgb8", 100_000, 100_000), "an image of 100000 x 100000 pixels cannot be drawn"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_shown_is_said(seen, name):
    bad, text = WRONG[name]
    pane, said = seen(bad)
    assert pane is None
    assert text in " ".join(each for level, each in said.values() if level == "Error")
    assert text in still(seen.scene).text


def test_a_large_image_is_thinned_and_light_in_a_page(seen):
    rng = np.random.default_rng(2)
    pixels = np.clip(rng.normal(128, 20, (960, 1280, 3)) + np.arange(1280)[None, :, None] / 20, 0, 255)
    pane, _ = seen(image(pixels.astype(np.uint8).tobytes(), "rgb8", 1280, 960))
    assert pane.pixels.shape == (240, 320, 3)
    assert pane.text.startswith("1280 x 960 pixels")
    assert len(still(seen.scene).svg) < 150_000


@given(
    st.binary(max_size=64),
    st.sampled_from([*COLOURS, *GREYS, *RANGES, "", "x"]),
    st.integers(0, 5),
    st.integers(0, 5),
    st.integers(0, 30),
    st.integers(0, 1),
)
def test_whatever_comes_the_scene_stands(seen, data, encoding, width, height, step, big):
    _, said = seen(image(data, encoding, width, height, step=step, is_bigendian=big))
    assert "Display" not in said
