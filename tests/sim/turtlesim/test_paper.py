"""Strokes and the image that the colour sensor looks at."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rosmini.sim.turtlesim import paper as module
from rosmini.sim.turtlesim.paper import BACKGROUND, SIZE, Paper, Pen

RED = Pen((255, 0, 0), 3)
anywhere = st.floats(-1e40, 1e40) | st.floats(-20, SIZE + 20)


def painted(paper):
    """Columns and rows that are not background."""
    image = np.frombuffer(paper.image(), np.uint8).reshape(SIZE, SIZE, 3)
    return {(int(column), int(row)) for row, column in np.argwhere((image != paper.background).any(axis=2))}


def test_a_line_of_three_pixels_has_square_caps():
    paper = Paper()
    paper.line((10.0, 20.0), (14.0, 20.0), RED)
    assert painted(paper) == {(column, row) for column in range(9, 16) for row in (19, 20, 21)}


QT = {
    (3.3, 4.6, 19.8, 9.1, 1): """
        ...##
        .....###
        ........####
        ............####
        ................###
        ...................#""",
    (3.3, 4.6, 19.8, 9.1, 3): """
        ..###
        ..#######
        .###########
        .....###########
        ........############
        ............##########
        ................#####
        ...................##""",
    (7.7, 1.2, 4.4, 9.5, 1): """
        .......#
        .......#
        ......#
        ......#
        ......#
        .....#
        .....#
        ....#
        ....#""",
    (7.7, 1.2, 4.4, 9.5, 2): """
        .......##
        ......###
        ......##
        ......##
        .....##
        .....##
        .....##
        ....##
        ....##
        ...##
        ....#""",
    (5.0, 5.0, 15.0, 5.0, 3): """
        ....#############
        ....#############
        ....#############""",
}
"""What QPainter of Qt 5.15 paints with a pen of a width: the rows that are not empty."""


@pytest.mark.parametrize("line", QT, ids=str)
def test_pixels_are_those_that_qt_paints(line):
    *ends, width = line
    paper = Paper()
    paper.line((ends[0], ends[1]), (ends[2], ends[3]), Pen((255, 0, 0), width))
    top = min(row for _, row in painted(paper))
    qt = {(x, top + y) for y, row in enumerate(QT[line].split()) for x, each in enumerate(row) if each == "#"}
    assert len(painted(paper) ^ qt) <= (width > 1)  # a corner may fall on the other side of a pixel's middle


@example((2.0**63, 0.0), (2.0**63, 0.0), 1)
@given(st.tuples(anywhere, anywhere), st.tuples(anywhere, anywhere), st.integers(1, 255))
def test_any_line_can_be_painted(start, end, width):
    paper = Paper()
    paper.line(start, end, Pen((255, 255, 255), width))
    for x, y in (start, end):
        inside = 0 <= x <= SIZE - 1 and 0 <= y <= SIZE - 1
        is_near = max(map(abs, (*start, *end))) < 1e4
        if width >= 3 and inside and is_near:  # a thin one may lie beside the sensor
            assert paper.pixel(x, y) == (255, 255, 255)
    assert paper.pixel(*start) in (BACKGROUND, (255, 255, 255))


def test_later_strokes_cover_earlier_ones_and_clearing_takes_all():
    paper = Paper()
    paper.line((10.0, 10.0), (20.0, 10.0), RED)
    assert paper.pixel(15, 10) == (255, 0, 0)
    paper.line((15.0, 5.0), (15.0, 15.0), Pen((0, 255, 0), 3))
    assert (paper.pixel(15, 10), paper.pixel(12, 10)) == ((0, 255, 0), (255, 0, 0))
    paper.clear((1, 1, 1))
    assert paper.pixel(15, 10) == (1, 1, 1)
    assert (paper.count, paper.clears, list(paper.strokes())) == (0, 1, [])


def test_old_strokes_stay_in_the_image_alone(monkeypatch):
    monkeypatch.setattr(module, "MAX_STROKES", 10)
    paper = Paper()
    for index in range(25):
        paper.line((10.0 * index, 10.0), (10.0 * index, 10.0), RED)
    assert paper.count == 25
    assert len(list(paper.strokes())) == paper.count - paper.first <= 10
    assert all(paper.pixel(10.0 * index, 10.0) == (255, 0, 0) for index in range(25))
