"""What an eye sees of primitives."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rosmini.viz.rviz import look_from, still
from rosmini.viz.rviz.clipping import rectangles
from rosmini.viz.rviz.primitives import Texture
from rosmini.viz.rviz.projection import Perspective
from rosmini.viz.view import ViewError

SLANT = np.array([(1.0, 0.0, 0.0), (0.0, 0.5**0.5, 0.5**0.5), (0.0, -(0.5**0.5), 0.5**0.5)])
DOWN = Perspective(np.array([0.0, -3.0, 3.0]), SLANT, 18**0.5, 241.4, (150.0, 100.0), 300.0, 200.0)


def areas(texture):
    """The area of each colour in the picture [px^2], by the shoelace formula."""
    found = {}
    for colour, outlines in rectangles(texture, DOWN, 700):
        x, y = (np.array([each[:, i] for each in outlines]) for i in (0, 1))
        twice = (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)
        found[tuple(np.round(colour * 255).astype(int).tolist())] = float(np.abs(twice).sum() / 2)
    return found


@given(arrays(np.uint8, (7, 9), elements=st.integers(0, 3)))
def test_a_maps_rectangles_cover_each_cell_that_is_not_clear_once(values):
    colours = np.array([(255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (0, 0, 0, 0)], dtype=np.uint8)
    grid = Texture(colours[values], (0.9, 0.7), np.eye(4))
    one = {}
    for y, x in np.ndindex(7, 9):
        pose = np.eye(4)
        pose[:2, 3] = (0.1 * x, 0.1 * y)
        for colour, area in areas(Texture(colours[values][y : y + 1, x : x + 1], (0.1, 0.1), pose)).items():
            one[colour] = one.get(colour, 0.0) + area
    assert areas(grid) == pytest.approx(one, abs=1e-6)


def test_a_view_that_orbits_is_drawn_with_perspective(stage):
    scene = stage.scene()
    scene.add("Grid", {"Plane Cell Count": 4})
    look_from(scene, "TopDownOrtho")
    flat = still(scene).svg
    look_from(scene, "Orbit")
    assert still(scene).svg != flat
    with pytest.raises(ViewError, match="Orbot"):
        look_from(scene, "Orbot")
    assert scene.view["Pitch"] > 0, "the view stays"
