"""A run of bodies and layers: what the page gets, how heavy it is, and in which words."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from rosmini.viz import ViewError
from rosmini.viz.replay.layers import Shape, Shapes, Stroke, Strokes
from rosmini.viz.replay.player import replay
from rosmini.viz.replay.run import BUDGET, Body, Run

from .unpacking import columns


def turtle(**more) -> Run:
    """A turtle that draws a square, and one that comes later."""
    corners = np.array([(5.5, 5.5), (7.5, 5.5), (7.5, 7.5), (5.5, 7.5), (5.5, 5.5)])
    times = np.arange(5.0) * 2
    headings = np.array([0.0, 0.5, 1.0, 1.5, 2.0]) * math.pi
    first = Body("turtle1", times, np.column_stack([corners, headings]), colour="green", trail=False)
    late = Body("turtle2", np.array([4.0]), np.array([(2.0, 2.0, 0.0)]), shown_from=4.0, shown_until=6.0)
    strokes = Strokes("/turtle1/pen", (Stroke(times, corners, "#b3b8ff", 3.0),))
    given = {"bounds": (0.0, 0.0, 11.09, 11.09), "background": "#4556ff", "frame": "the window"} | more
    return Run("turtlesim", 0.0, 8.0, (first, late), (strokes,), **given)


def test_bodies_and_strokes_reach_the_page():
    data = json.loads(json.dumps(turtle().data()))
    first, late = data["bodies"]
    assert columns(first["track"], 4)[1].tolist() == [2000, 7500, 5500, 15708]
    assert (first["trail"], late["from"], late["until"]) == (False, 4000, 6000)
    assert (data["start"], data["duration"], data["background"]) == (0, 8000, "#4556ff")
    assert data["bounds"] == [0.0, 0.0, 11.09, 11.09]
    assert data["layers"][0]["pens"] == [["#b3b8ff", 3.0, None, 5]]


def test_its_words_and_its_still_say_how_it_went():
    view = replay(turtle(), title="A square")
    assert view.text.splitlines() == [
        "A square: 8.0 s, in the frame the window",
        "turtle1: start (5.50, 5.50, 0.0 deg), end (5.50, 5.50, 0.0 deg), 8.00 m",
        "turtle2: start (2.00, 2.00, 0.0 deg), end (2.00, 2.00, 0.0 deg), 0.00 m",
        "/turtle1/pen: 1 stroke, 8.00 m",
    ]
    assert "turtle1: start" in view.alt and "/turtle1/pen" in view.alt
    assert view.still.svg.count("<path") == 2, "the stroke and turtle1: turtle2 has gone"
    assert "#b3b8ff" in view.still.svg and "#4556ff" in view.still.svg
    assert "rosmini-replay-layers.js" in view.html or "rosminiReplayLayers" in view.html
    assert view.html == replay(turtle(), title="A square").html


def test_without_bounds_everything_is_shown():
    x0, y0, x1, y1 = turtle(bounds=None).extent()
    assert x0 < 2.0 < 7.5 < x1
    assert y0 < 2.0 < 7.5 < y1
    alone = Run("r", 0.0, 1.0, (Body("b", np.array([0.0]), np.array([(1.0, 1.0, 0.0)])),)).extent()
    assert alone[2] - alone[0] >= 0.5


def test_a_heavy_run_is_thinned_with_a_word():
    rng = np.random.default_rng(0)
    items = tuple((Shape("arrows", rng.uniform(-3, 3, (300, 3))),) for _ in range(240))
    light = Shapes("/plan", np.array([0.0]), ((Shape("line", np.zeros((2, 2))),),))
    run = Run("heavy", 0.0, 120.0, layers=(Shapes("/particles", np.arange(240.0) / 2, items), light))
    data = run.data()
    assert len(json.dumps(data)) < BUDGET + 2000
    [note] = data["notes"]
    assert note.startswith("/particles is thinned, so that the page stays small: ")
    assert len(replay(run).html.encode()) < 300_000


def test_two_runs_stand_side_by_side():
    view = replay(turtle(), turtle(background=None), names=("before", "after"))
    assert [run["title"] for run in view.data["runs"]] == ["before", "after"]
    assert view.alt.startswith("2 runs side by side, by one clock.")
    assert "before: 8.0 s" in view.text and "after: 8.0 s" in view.text
    assert view.html.count("</desc>") == 2
    with pytest.raises(ViewError, match="as many names"):
        replay(turtle(), names=("a", "b"))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Run("r", 1.0, 0.0, turtle().bodies), "no valid time span"),
        (lambda: Run("r", 0.0, math.nan, turtle().bodies), "no valid time span"),
        (lambda: Run("r", 0.0, 1.0), "nothing to see"),
        (lambda: Body("b", np.array([0.0]), np.array([(math.nan, 0.0, 0.0)])), "finite"),
        (lambda: Body("b", np.empty(0), np.empty((0, 3))), "at least one"),
        (replay, "at least one run"),
        (lambda: replay(3), "not a int"),
        (lambda: replay("run.txt"), "not 'run.txt'"),
    ],
)
def test_what_is_no_run_is_refused(make, said):
    with pytest.raises(ViewError, match=said):
        make()
