"""Drawings by Logo as players and pictures."""

import pytest

from rosmini.sim.logo import Logo
from rosmini.viz.logo_pictures import MAX_DURATION, logo_picture
from rosmini.viz.view import ViewError


def drawing(program):
    logo = Logo()
    logo.run(program)
    return logo.drawing


def test_what_it_says():
    view = drawing("repeat 4 [fd 100 rt 90]").show(title="Figure 1: a square")
    for part in ("4 lines, 400 steps", "turtle1 at [0 0], heading 0"):
        assert part in view.text and part in view.alt
    assert view.text.startswith("Figure 1: a square: ")


def run_of(view):
    return view.runs[0].source


def test_lines_grow_in_the_order_and_the_colours_of_the_program():
    run = run_of(logo_picture(drawing('fd 100 pu fd 50 pd setpc "red setpensize 5 rt 90 fd 100'), speed=100.0))
    (layer,) = run.layers
    first, second = layer.strokes
    assert (first.colour, first.width, second.colour, second.width) == ("#b3b8ff", 3.0, "#ff0000", 5.0)
    assert first.times.tolist() == [0.0, 1.0]
    assert second.times.tolist() == pytest.approx([1.5, 1.75, 2.75])
    assert run.background == "#4556ff"
    assert run.bounds == pytest.approx((0, 0, 499 / 45, 499 / 45))
    (body,) = run.bodies
    assert body.times.tolist() == pytest.approx([0.0, 1.0, 1.5, 1.75, 2.75])
    assert body.poses[-1, 2] == pytest.approx(0.0)


def test_a_long_drawing_is_drawn_faster_and_a_large_one_is_seen_whole():
    run = run_of(logo_picture(drawing("repeat 36 [fd 300 rt 170]")))
    assert run.duration == pytest.approx(MAX_DURATION)
    assert run.bounds is None


def test_a_speed_that_is_none():
    with pytest.raises(ViewError, match="speed above 0"):
        logo_picture(drawing("fd 10"), speed=0)
