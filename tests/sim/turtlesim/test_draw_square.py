"""`turtlesim/draw_square` drives round a square."""

import pytest

from rosmini import Graph, rosrun


def test_the_square_closes():
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
