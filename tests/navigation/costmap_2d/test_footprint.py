"""Footprints: from parameters, their radii, and what is wrong with one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.errors import ParameterError
from rosmini.navigation.costmap_2d.footprint import (
    crossing,
    footprint_from_list,
    footprint_from_radius,
    footprint_from_text,
    footprint_text,
    padded,
    radii,
)

BURGER = [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]


def test_robotis_polygon_of_a_burger_has_an_inscribed_radius_of_4_cm():
    footprint = footprint_from_list(BURGER, "/move_base/local_costmap/footprint")
    inscribed, circumscribed = radii(footprint)
    assert inscribed == pytest.approx(0.041)
    assert circumscribed == pytest.approx(math.hypot(0.105, 0.105))
    assert radii(padded(footprint, 0.01))[0] == pytest.approx(0.051)


def test_a_radius_is_a_polygon_of_16_corners_whose_inscribed_radius_is_a_little_less():
    footprint = footprint_from_radius(0.105)
    assert footprint.shape == (16, 2)
    assert radii(footprint) == pytest.approx((0.105 * math.cos(math.pi / 16), 0.105))


def test_padding_moves_a_point_on_an_axis_along_it_only():
    grown = padded(np.array([[0.2, 0.0], [-0.1, 0.1]]), 0.01)
    assert grown == pytest.approx(np.array([[0.21, 0.0], [-0.11, 0.11]]))


def test_a_text_goes_there_and_back():
    footprint = footprint_from_text("[ [0.1, 0.2], [0.1, -0.2],[-0.3, 0] ]", "footprint")
    assert footprint_text(footprint) == "[[0.1,0.2],[0.1,-0.2],[-0.3,0]]"


@pytest.mark.parametrize(
    "text",
    [
        "[[.5, 1.], [+.5, -1e0], [-.5, 0]]",
        "[[0.5 1] [0.5 -1] [-0.5 0]]",
        "[[0.5, 1,], [0.5, -1,], [-0.5, 0,],]",
        "\t[[0.50,1.0],[0.5,-01.0],[-0.5,0]]",
    ],
)
def test_a_text_is_read_as_costmap_2d_reads_it(text):
    assert footprint_from_text(text, "footprint").tolist() == [[0.5, 1.0], [0.5, -1.0], [-0.5, 0.0]]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[0.1, 0.1], [0.1, -0.1]]", "a list of 2 points: You must specify at least three points"),
        ("[[0.1, 0.1], [0.1], [0, 0]]", r"\[1\] is \[0.1\]: Points in the footprint specification must be pairs"),
        ('[[0.1, 0.1], [0.1, "a"], [0, 0]]', "is not a number"),
        ("[[0.1, 0.1], [0.1, NaN], [0, 0]]", "'N' is not a number"),
        ("[[0.1, 0.1], [0.1, 0], [0, 0]]]", "more ']' than '\\['"),
        ("[[[0.1, 0.1], [0.1, 0], [0, 0]]]", "more than two brackets"),
        (f"[[0.1, 0.1], [0.1, 1{'0' * 400}], [0, 0]]", "must be numbers, found"),
        ("[[0.1, 0.1", "Error parsing footprint parameter /x/footprint"),
        ("0.3", "'0.3' is not a number inside two brackets"),
    ],
)
def test_what_is_no_footprint_is_refused(text, said):
    with pytest.raises(ParameterError, match=said):
        footprint_from_text(text, "/x/footprint")


def test_an_outline_that_crosses_itself_is_found():
    assert crossing(np.array(BURGER)) is None
    assert crossing(np.array([[0, 0], [1, 1], [1, 0], [0, 1]], dtype=float)) == (0, 2)


def test_without_three_points_nothing_is_inscribed():
    assert radii(np.zeros((0, 2))) == (math.inf, 0.0)
