"""A polygon that is clicked."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.frontier_exploration.polygon import Selection, Step, contains, polygon_error

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]


def click(selection, *points, frame="map"):
    return [selection.click(frame, *point) for point in points]


def test_vertices_then_near_the_first_then_inside():
    selection = Selection()
    assert {step for step, _ in click(selection, *SQUARE)} == {Step.ADDED}
    ((step, text),) = click(selection, (0.2, -0.2))
    assert (step, text) == (Step.CLOSED, "Please select an initial point for exploration inside the polygon")
    assert click(selection, (1.0, 1.0)) == [(Step.COMPLETE, "Sending goal")]
    assert selection.polygon.tolist() == [list(point) for point in SQUARE]


def test_how_near_the_last_click_has_to_be():
    # A tenth of the mean length of the edges: 0.4 m in a square of 4 m.
    for x, step in ((0.39, Step.CLOSED), (0.41, Step.ADDED)):
        selection = Selection()
        click(selection, *SQUARE)
        assert click(selection, (x, 0.0))[0][0] is step


@pytest.mark.parametrize(
    ("points", "text"),
    [
        ([(0, 0), (1, 0), (0.01, 0)], "at least 3 are needed"),
        ([(0, 0), (4, 4), (4, 0), (0, 4), (0, 0.1)], "edges after vertices 1 and 3 of the polygon meet"),
        ([*SQUARE, (0, 0), (9, 9)], "Center not inside polygon, restarting"),
    ],
)
def test_faults_begin_again(points, text):
    selection = Selection()
    *_, (step, said) = click(selection, *points)
    assert step is Step.REFUSED
    assert text in said
    assert not selection.vertices
    assert not selection.is_closed


def test_another_frame():
    selection = Selection()
    click(selection, *SQUARE[:2], frame="odom")
    assert selection.frame == "odom"
    assert selection.click("map", 1.0, 1.0) == (
        Step.REFUSED,
        "Frame mismatch, restarting polygon selection: 'map' after 'odom'",
    )


def test_what_bounds_an_area():
    assert polygon_error(np.array(SQUARE)) is None
    assert "not finite" in polygon_error(np.array([*SQUARE, (np.nan, 1.0)]))
    assert contains(np.array(SQUARE), (1.0, 3.9))
    assert not contains(np.array(SQUARE), (1.0, 4.1))
