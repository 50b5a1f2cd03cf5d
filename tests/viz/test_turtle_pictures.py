"""The picture of a turtlesim's window."""

import xml.etree.ElementTree as ET

import pytest

from rosmini.sim.turtlesim.frame import Frame
from rosmini.sim.turtlesim.turtle import STEP_S
from rosmini.viz.turtle_pictures import chains, turtle_picture
from rosmini.viz.view import ViewError


def drawn():
    frame = Frame()
    turtle, other = frame.spawn(2.0, 3.0, 0.5), frame.spawn(8.0, 8.0, -2.0)
    other.set_pen(0, 0, 0, 0, 1)
    for update in range(100):
        if update == 30:
            turtle.set_pen(255, 0, 0, 5, 0)
        turtle.command(2.0, 0.0, 1.0 if update > 60 else 0.0)
        frame.step(update * STEP_S)
    return frame


def test_its_text_says_where_the_turtles_are_and_what_was_drawn():
    picture = turtle_picture(drawn(), title="Figure 1: Two turtles")
    assert picture.text == (
        "Figure 1: Two turtles: 2 turtles, 100 strokes on rgb(69, 86, 255)\n"
        "turtle1: pose (4.55, 4.83, 64.4 deg), pen rgb(255, 0, 0), 5 px\n"
        "turtle2: pose (8.00, 8.00, -114.6 deg), pen up"
    )
    assert picture.alt.startswith("A window of turtlesim: 2 turtles, 100 strokes")
    assert picture.caption == "Figure 1: Two turtles"


def test_it_is_well_formed_and_small():
    svg = turtle_picture(drawn()).svg
    assert svg is not None
    root = ET.fromstring(svg)
    paths = [each for each in root.iter("{http://www.w3.org/2000/svg}path") if each.get("stroke")]
    assert [(each.get("stroke"), each.get("stroke-width")) for each in paths] == [("#b3b8ff", "3"), ("#ff0000", "5")]
    assert paths[0].get("d", "").count("L") == 1  # thirty strokes in one straight line
    assert len(svg) < 8000


def test_strokes_that_follow_one_another_are_joined():
    first, second = chains(drawn().paper.strokes())
    assert (len(first[1]), len(second[1])) == (31, 71)
    assert first[1][-1] == second[1][0]


def test_many_turtles_are_counted():
    frame = Frame()
    for _ in range(15):
        frame.spawn(1.0, 1.0, 0.0)
    lines = turtle_picture(frame).text.splitlines()
    assert len(lines) == 14
    assert lines[-1] == "and 3 more"


def test_a_size_that_is_none():
    with pytest.raises(ViewError, match="positive"):
        turtle_picture(Frame(), size=0.0)
