"""`turtlesim/draw_square` drives round a square."""

from __future__ import annotations

import pytest

from rosmini import Graph, rosrun
from rosmini.sim.turtlesim.draw_square import Square


def test_it_goes_ahead_stops_turns_and_stops() -> None:
    square = Square()
    assert square.decide((1.0, 1.0, 0.0), 0.0, 0.0) == ((1.0, 0.0), ["New goal [3.000000 1.000000, 0.000000]"])
    assert square.decide((2.95, 1.0, 0.0), 1.0, 0.0) == ((0.0, 0.0), [])
    assert square.decide((2.97, 1.0, 0.0), 1.0, 0.0) == ((0.0, 0.0), [])
    command, log = square.decide((2.97, 1.0, 0.0), 0.0, 0.0)
    assert (command, log) == (None, ["Reached goal", "New goal [2.970000 1.000000, 1.570796]"])
    assert square.decide((2.97, 1.0, 0.1), 0.0, 0.4) == ((0.0, 0.4), [])
    assert square.decide((2.97, 1.0, 1.57), 0.0, 0.4) == ((0.0, 0.0), [])
    command, log = square.decide((2.97, 1.0, 1.5708), 0.0, 0.0)
    assert log[0] == "Reached goal"
    assert log[1].startswith("New goal [2.96999")


def test_the_square_closes() -> None:
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        sim.spawn(1.0, 1.0, 0.0)
        rosrun("turtlesim", "draw_square", graph=graph)
        graph.run(23.6)
        turtle = sim.turtles["turtle1"]
        assert list(sim.turtles) == ["turtle1"]  # it was reset
        assert (turtle.x, turtle.y) == pytest.approx((5.54, 5.54), abs=0.25)
        ends = [(stroke.x1, stroke.y1) for stroke in sim.frame.paper.strokes()]
        assert max(x for x, _ in ends) - min(x for x, _ in ends) == pytest.approx(90, abs=6)
        assert max(y for _, y in ends) - min(y for _, y in ends) == pytest.approx(90, abs=6)
