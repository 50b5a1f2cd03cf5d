"""Lines of sight."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.viz.rviz.primitives import Mesh
from rosmini.viz.rviz.rays import depths, on_axis, on_plane, ray_from_above

EYE = np.array([0.0, -5.0, 5.0])
DOWN = np.array([0.0, 1.0, -1.0]) / np.sqrt(2)
X, Y, Z = np.eye(3)


def test_a_line_of_sight_meets_the_faces_before_the_eye_and_no_others():
    square = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], dtype=float)
    mesh = Mesh(np.vstack([square, square + (0, 0, 10)]), np.array([(0, 1, 2), (4, 5, 6)]), np.ones(4))
    assert depths(mesh, (EYE, DOWN)) == pytest.approx([5 * np.sqrt(2)])
    assert depths(mesh, (EYE, Y)) == []
    assert depths(mesh, (np.array([-0.9, 0.9, 5.0]), -Z)) == []  # beside the diagonal
    high = ray_from_above(np.array([0.5, -0.5, 0.0]))
    assert sorted(high[0][2] - each for each in depths(mesh, high)) == pytest.approx([0.0, 10.0])
    outside = ray_from_above(np.array([1.05, -0.5, 0.0]))
    assert depths(mesh, outside) == []
    assert len(depths(mesh, outside, edge=0.05)) == 2


def test_a_hand_is_where_its_line_of_sight_passes_an_axis_or_a_plane():
    origin = np.array([0.0, 0.0, 1.0])
    assert on_axis((EYE, DOWN), origin, Z) == pytest.approx([0.0, 0.0, 0.0])
    assert on_axis((EYE, DOWN), origin, X) == pytest.approx([0.0, 0.0, 1.0])
    assert on_axis((EYE, -Z), origin, Z) is None
    assert on_plane((EYE, DOWN), origin, Z) == pytest.approx([0.0, -1.0, 1.0])
    assert on_plane((EYE, DOWN), origin, X) is None
    assert on_plane((EYE, -DOWN), origin, Z) is None
