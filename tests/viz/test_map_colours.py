"""Colours of maps and costmaps: RViz's, by the byte in a cell."""

import numpy as np
import pytest

from rosmini.viz.map_colours import colours_of, painted, scheme_of


@pytest.mark.parametrize(
    ("scheme", "cell", "colour"),
    [
        ("map", 0, (255, 255, 255, 255)),
        ("map", 50, (128, 128, 128, 255)),
        ("map", 100, (0, 0, 0, 255)),
        ("map", -1, (0x70, 0x89, 0x86, 255)),
        ("map", 101, (0, 255, 0, 255)),
        ("map", -2, (255, 255, 0, 255)),
        ("map", -128, (255, 0, 0, 255)),
        ("costmap", 0, (0, 0, 0, 0)),
        ("costmap", 1, (2, 0, 253, 255)),
        ("costmap", 98, (249, 0, 6, 255)),
        ("costmap", 99, (0, 255, 255, 255)),
        ("costmap", 100, (255, 0, 255, 255)),
        ("raw", -1, (255, 255, 255, 255)),
        ("raw", 7, (7, 7, 7, 255)),
        ("safe", 0, (0, 0, 0, 0)),
    ],
)
def test_cells_have_rviz_colours(scheme, cell, colour):
    assert painted(np.array([cell], dtype=np.int8), scheme).tolist() == [list(colour)]


def test_the_safe_ramp_grows_darker_and_marks_what_is_forbidden():
    table = colours_of("safe").astype(float)
    brightness = table[1:99, :3] @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(brightness) <= 1).all()
    assert brightness[0] - brightness[-1] > 100
    assert len({tuple(table[i]) for i in (0, 1, 98, 99, 100, 255)}) == 6


def test_costmaps_are_known_by_their_topic():
    assert scheme_of("/move_base/local_costmap/costmap") == "costmap"
    assert scheme_of("/map") == "map"
