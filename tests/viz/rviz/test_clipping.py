"""What an eye sees of primitives."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rosmini.viz.rviz import look_from, still
from rosmini.viz.rviz.clipping import NEAR, clipped, rectangles
from rosmini.viz.rviz.primitives import Lines, Mesh, Points, Texture
from rosmini.viz.rviz.projection import Perspective
from rosmini.viz.view import ViewError

WHITE = np.ones(4)
AHEAD = np.array([(0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0)])
LEVEL = Perspective(np.array([0.0, 0.0, 1.0]), AHEAD, 5.0, 100.0, (150.0, 100.0), 300.0, 200.0)
SLANT = np.array([(1.0, 0.0, 0.0), (0.0, 0.5**0.5, 0.5**0.5), (0.0, -(0.5**0.5), 0.5**0.5)])
DOWN = Perspective(np.array([0.0, -3.0, 3.0]), SLANT, 18**0.5, 241.4, (150.0, 100.0), 300.0, 200.0)


def test_a_line_ends_where_it_passes_the_eye():
    line = clipped(Lines(np.array([(-4.0, 1.0, 1.0), (4.0, 1.0, 1.0), (5.0, 1.0, 1.0)]), WHITE), LEVEL)
    assert line.segments() == pytest.approx(np.array([[(NEAR, 1, 1), (4, 1, 1)], [(4, 1, 1), (5, 1, 1)]]))
    behind = clipped(Lines(np.array([(-4.0, 1.0, 1.0), (-1.0, 1.0, 1.0)]), WHITE), LEVEL)
    assert len(behind.segments()) == 0


def test_points_and_faces_behind_the_eye_are_left_out():
    at = np.array([(-1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 1.0, 0.0), (2.0, 0.0, 1.0)])
    assert clipped(Points(at, np.tile(WHITE, (4, 1)), 0.1), LEVEL).points.tolist() == at[1:].tolist()
    faces = np.array([(0, 1, 2), (1, 2, 3)])
    assert clipped(Mesh(at, faces, WHITE), LEVEL).faces.tolist() == [[1, 2, 3]]


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


def test_a_map_of_noise_takes_larger_cells():
    noise = np.random.default_rng(0).integers(0, 2, (200, 200)).astype(np.uint8)
    pixels = np.dstack([255 * noise] * 3 + [np.full_like(noise, 255)])
    found = list(rectangles(Texture(pixels, (2.0, 2.0), np.eye(4)), DOWN, 700))
    assert 100 < sum(len(outlines) for _, outlines in found) <= 700


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
