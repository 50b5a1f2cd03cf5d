"""Turtles of one window, without a graph."""

from __future__ import annotations

import json

import pytest

from rosmini.sim.turtlesim import Frame, TurtleError
from rosmini.sim.turtlesim.turtle import START, STEP_S


def test_names_are_given_in_order_and_not_twice() -> None:
    frame = Frame()
    assert [frame.spawn(*START).name for _ in range(2)] == ["turtle1", "turtle2"]
    frame.spawn(*START, "turtle3")
    assert frame.spawn(*START).name == "turtle4"
    frame.kill("turtle4")
    assert frame.spawn(*START).name == "turtle5"
    assert list(frame.turtles) == ["turtle1", "turtle2", "turtle3", "turtle5"]
    assert len(frame.reset()) == 4
    assert frame.spawn(*START).name == "turtle1"


def test_what_cannot_be_is_said() -> None:
    frame = Frame()
    frame.spawn(*START, "ann")
    with pytest.raises(TurtleError, match="there is a turtle ann already"):
        frame.spawn(*START, "ann")
    with pytest.raises(TurtleError, match="no turtle 'anne': did you mean ann"):
        frame.kill("anne")
    with pytest.raises(TurtleError, match="finite"):
        frame.spawn(float("nan"), 0.0, 0.0)
    assert list(frame.turtles) == ["ann"]
    assert frame.spawn(*START).name == "turtle1"  # what was refused got no number


def test_a_canvas_gets_what_is_new() -> None:
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
