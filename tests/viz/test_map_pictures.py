"""Maps from above: their text form, and that a reader of any page sees the same map."""

import base64
import io
import math
import re

import numpy as np
import pytest
from PIL import Image

from rosmini.core.maps import GridMap
from rosmini.viz.view import ViewError

CELLS = np.array([[0, 100, -1, 0], [0, 0, 0, 0]], dtype=np.int8)


def image_of(svg):
    """The image in a picture, and its matrix."""
    found = re.search(r'<image href="data:image/gif;base64,([^"]+)"[^>]*transform="matrix\(([^)]+)\)"', svg)
    assert found is not None
    return Image.open(io.BytesIO(base64.b64decode(found[1]))), [float(n) for n in found[2].split()]


def test_what_it_says():
    grid = GridMap(CELLS, 0.5, (1.0, -2.0, 0.0))
    picture = grid.show(
        title="Figure 1: A map", robot=(1.5, -1.5, math.pi / 2), points=[(2.0, -1.5)], path=[(1, -2), (2, -2)]
    )
    assert picture.text == (
        "Figure 1: A map: 4 x 2 cells of 0.5 m, 2.00 x 1.00 m, origin (1.00, -2.00, 0.0 deg)\n"
        "free 75.0 %, occupied 12.5 %, unknown 12.5 %\n"
        "path: 1.00 m\n"
        "points: (2.00, -1.50)\n"
        "robot: pose (1.50, -1.50, 90.0 deg)"
    )
    assert picture.alt.startswith("A map from above: 4 by 2 cells of 0.5 m, 2.00 by 1.00 m")
    assert "On it: path: 1.00 m; points: (2.00, -1.50); robot: pose" in picture.alt
    assert picture.caption == "Figure 1: A map"


def test_each_cell_is_where_it_belongs():
    """Whatever the origin: the image's matrix sends each cell to where the axes have it."""
    straight = GridMap(CELLS, 0.5, (1.0, -2.0, 0.0)).show().svg
    image, (a, b, c, d, e, _) = image_of(straight)
    pixels = np.asarray(image.convert("RGB"))
    assert pixels[0].tolist() == [[255] * 3, [0] * 3, [0x70, 0x89, 0x86], [255] * 3]
    assert (a > 0, b, c, d < 0) == (True, 0, 0, True)
    assert a / 4 == pytest.approx(-d / 2, rel=1e-4)  # square cells
    _, (a, b, c, d, e2, _) = image_of(GridMap(CELLS, 0.5, (1.0, -2.0, math.pi / 2)).show().svg)
    # x of the map is up now, and y to the left
    assert (abs(a) < 1e-6, b < 0, c < 0, abs(d) < 1e-6) == (True, True, True, True)
    assert e2 > e


def test_a_large_map_is_thinned_and_keeps_its_walls():
    cells = np.zeros((3000, 3000), dtype=np.int8)
    cells[:, 1501] = 100
    picture = GridMap(cells, 0.05, (0.0, 0.0, 0.0)).show()
    image, _ = image_of(picture.svg)
    assert max(image.size) < 1500
    assert np.asarray(image.convert("L"))[5].min() == 0
    assert len(picture.svg) < 100_000


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"robot": (1, 2)}, "the robot's pose must be x"),
        ({"points": [(1, 2, 3, 4)]}, "points must be an array"),
        ({"path": [(1, math.nan)]}, r"the path\[0\] is"),
        ({"size": (10, 10)}, "the size of a picture"),
    ],
)
def test_what_cannot_be_drawn_is_told(options, said):
    with pytest.raises(ViewError, match=said):
        GridMap(CELLS, 0.5, (0.0, 0.0, 0.0)).show(**options)


def test_only_maps_are_drawn():
    from rosmini.viz.map_pictures import map_picture

    with pytest.raises(ViewError, match="a map must be a GridMap, not a ndarray: use load_map"):
        map_picture(CELLS)
