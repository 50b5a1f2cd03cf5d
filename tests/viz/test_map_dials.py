"""The image of a map and what it means: what the picture says, and what it has no dials for."""

from __future__ import annotations

import base64

import numpy as np
import pytest
from PIL import Image

from rosmini.navigation.map_server import MapDataError, load_map, map_file
from rosmini.viz.map_dials import map_dials
from rosmini.viz.view import ViewError

YAML = """image: {image}
resolution: 0.05
origin: [0, 0, 0]
occupied_thresh: 0.65
free_thresh: 0.196
negate: 0
mode: {mode}
"""


@pytest.fixture
def write(tmp_path):
    def write(pixels, mode="trinary", image="map.png"):
        Image.fromarray(np.array(pixels, dtype=np.uint8)).save(tmp_path / "map.png")
        path = tmp_path / "map.yaml"
        path.write_text(YAML.format(image=image, mode=mode), encoding="utf-8")
        return path

    return write


def test_it_says_what_the_numbers_make_of_the_image(write):
    view = map_file(write([[0, 100, 200, 255], [255] * 4])).show(title="Figure 3: Dials")
    assert view.text == (
        "Figure 3: Dials: map.png, 4 x 2 pixels\n"
        "mode trinary, negate 0, free_thresh 0.196, occupied_thresh 0.65\n"
        "free 62.5 %, occupied 12.5 %, unknown 25.0 %"
    )
    assert "on the right the map it makes" in view.alt
    assert view.svg.count("<image") == 2
    assert base64.b64decode(base64.b64encode(view.data["greys"])) == bytes(
        [0, 100, 200, 255, 255, 255, 255, 255]
    )


def test_in_the_mode_scale_there_is_more_between(write):
    path = write([[0, 100, 200, 255]], mode="scale")
    assert "between 50.0 %" in map_file(path).show().text
    assert load_map(path).occupancy.tolist() == [[100, 89, 5, 0]]


def test_what_has_no_dials_is_told(write, tmp_path):
    with pytest.raises(ViewError, match=r"map\.png has 3 channels: only images in grey"):
        map_file(write(np.zeros((2, 2, 3)))).show()
    with pytest.raises(ViewError, match=r"map\.png has 300 x 2 pixels: with dials, 256 a side"):
        map_file(write(np.zeros((2, 300)))).show()
    with pytest.raises(MapDataError, match="which is not there"):
        map_file(write([[0]], image="none.png")).show()
    with pytest.raises(ViewError, match="not for a str"):
        map_dials("map.yaml")  # type: ignore[arg-type]
