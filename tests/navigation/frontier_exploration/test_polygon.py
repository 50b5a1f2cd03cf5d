"""A polygon that is clicked."""

from __future__ import annotations

from rosmini.navigation.frontier_exploration.polygon import Selection, Step

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


def test_another_frame():
    selection = Selection()
    click(selection, *SQUARE[:2], frame="odom")
    assert selection.frame == "odom"
    assert selection.click("map", 1.0, 1.0) == (
        Step.REFUSED,
        "Frame mismatch, restarting polygon selection: 'map' after 'odom'",
    )
