"""Turtles of one window, without a graph."""

import json

import pytest

from rosmini.sim.turtlesim.frame import Frame
from rosmini.sim.turtlesim.turtle import STEP_S


def test_a_canvas_gets_what_is_new():
    frame = Frame((1, 2, 3))
    turtle = frame.spawn(1.0, 1.0, 0.0)
    turtle.command(1.0, 0.0, 0.0)
    frame.step(0.0)
    frame.step(STEP_S)
    state = frame.state()
    assert json.loads(json.dumps(state)) == state
    assert (state["size"], state["metre"], state["background"], state["next"]) == (500, 45.0, [1, 2, 3], 2)
    assert state["strokes"] == [
        [45.72, 454.0, 45.0, 454.0, 179, 184, 255, 3], [46.44, 454.0, 45.72, 454.0, 179, 184, 255, 3],
    ]  # fmt: skip
    (seen,) = state["turtles"]
    assert (seen["name"], seen["x"], seen["y"], seen["pen"], seen["pen_on"]) == (
        "turtle1", 46.44, 454.0, [179, 184, 255, 3], True,
    )  # fmt: skip
    assert seen["pose"] == pytest.approx([1.032, 1.0, 0.0])
    frame.step(2 * STEP_S)
    later = frame.state(state["next"], state["clears"])
    assert (later["first"], len(later["strokes"]), later["next"]) == (2, 1, 3)
    frame.paper.clear()
    frame.step(3 * STEP_S)
    fresh = frame.state(later["next"], later["clears"])
    assert (fresh["first"], len(fresh["strokes"]), fresh["clears"]) == (0, 1, 1)
