"""Layers: what of plans, scans and strokes reaches the page, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.viz import ViewError
from rosmini.viz.replay.layers import MAX_POINTS, RANGE, Scans, Shape, Shapes, Stroke, Strokes, around

from .unpacking import columns, unpack


def test_shapes_reach_the_page_group_by_group():
    line = Shape("line", np.array([(0.0, 0.0), (0.5, 0.0), (1.0, 0.0)]), "green")
    arrows = Shape("arrows", np.array([(1.0, 2.0, 0.5), (3.0, 4.0, -0.5)]), "#102030")
    data = Shapes("/plan", np.array([1.0, 2.5]), ((line,), (line, arrows)), found=9).data()
    assert unpack(data["times"]).tolist() == [1000, 2500]
    assert unpack(data["counts"]).tolist() == [1, 2]
    assert data["colours"] == ["#102030", "green"]
    assert unpack(data["groups"]).reshape(-1, 3).tolist() == [[1, 1, 2], [1, 1, 2], [3, 0, 2]]
    assert columns(data["points"], 2).tolist() == [[0, 0], [100, 0], [0, 0], [100, 0], [100, 200], [300, 400]]
    assert unpack(data["headings"]).tolist() == [25, -25]


def test_a_hundred_thousand_points_become_few():
    points = np.random.default_rng(0).uniform(-5, 5, (100_000, 2))
    data = Shapes("/cloud", np.array([0.0]), ((Shape("points", points),),)).data()
    assert 100 < len(columns(data["points"], 2)) <= MAX_POINTS


def test_scans_are_rounded_to_two_centimetres_and_nothing_is_zero():
    ranges = np.array([[1.0, math.inf, 2.009, math.nan, -1.0]])
    scans = Scans("/scan", np.array([0.5]), np.array([(1.0, 2.0, 0.1)]), ranges, -1.0, 0.5, 3.5)
    data = scans.data()
    assert unpack(data["ranges"]).tolist() == [50, 0, 100, 0, 0]
    assert (data["unit"], data["beams"], data["start"], data["step"]) == (RANGE, 5, -1.0, 0.5)
    assert columns(data["poses"], 3).tolist() == [[1000, 2000, 1000]]


def test_a_straight_stroke_needs_its_ends_and_where_its_pace_changes():
    times = np.linspace(0.0, 10.0, 1001)
    steady = Stroke(times, np.column_stack([times, np.zeros(1001)]))
    halting = Stroke(times, np.column_stack([np.minimum(times, 5.0), np.zeros(1001)]), width=3.0, until=12.0)
    data = Strokes("/turtle1", (steady, halting)).data()
    assert data["pens"] == [["blue", 2.0, None, 2], ["blue", 3.0, 12000, 3]]
    assert columns(data["points"], 3).tolist() == [
        [0, 0, 0], [10000, 10000, 0], [0, 0, 0], [5000, 5000, 0], [10000, 5000, 0]
    ]  # fmt: skip


@pytest.mark.nightly
def test_strokes_of_a_hundred_thousand_points_are_thinned():
    angle = np.linspace(0.0, 200 * math.pi, 100_000)
    spiral = np.column_stack([angle * np.cos(angle), angle * np.sin(angle)]) / 100
    layer = Strokes("/turtle1", (Stroke(angle, spiral),))
    before = len(columns(layer.data()["points"], 3))
    assert before < 50_000
    assert len(columns(layer.thinner().thinner().data()["points"], 3)) < before


def test_words_say_how_much_there_is():
    line = Shape("line", np.array([(0.0, 0.0), (1.0, 0.0)]))
    text = Shapes("/p", np.array([1.0]), ((line,),), found=3).text()
    assert text.startswith("1 of 3 messages") and "2 points" in text
    stroke = Stroke(np.array([0.0, 1.0]), np.array([(0.0, 0.0), (0.0, 2.0)]))
    assert Strokes("/s", (stroke,)).text() == "1 stroke, 2.00 m"
    assert Strokes("/s", (stroke,)).bounds == (0.0, 0.0, 0.0, 2.0)
    assert around([]) is None


@pytest.mark.parametrize(
    "make",
    [
        lambda: Stroke(np.array([1.0, 0.0]), np.zeros((2, 2))),
        lambda: Stroke(np.array([0.0]), np.array([(math.nan, 0.0)])),
        lambda: Stroke(np.empty(0), np.empty((0, 2))),
        lambda: Shapes("/p", np.array([1.0, 0.0]), ((), ())),
        lambda: Shapes("/p", np.array([1.0]), ()),
        lambda: Scans("/s", np.array([0.0]), np.zeros((2, 3)), np.zeros((1, 4)), 0.0, 0.1, 1.0),
    ],
)
def test_parts_that_do_not_fit_are_refused(make):
    with pytest.raises(ViewError):
        make()
