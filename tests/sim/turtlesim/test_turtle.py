"""One turtle: its update is that of turtlesim 0.10.2, number by number."""

import contextlib
import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rosmini.sim.turtlesim.paper import Paper, Pen
from rosmini.sim.turtlesim.turtle import LIMIT, START, STEP_S, Turtle, TurtleError, single

anything = st.floats(allow_nan=True, allow_infinity=True)


def run(turtle, updates, paper=None, start=0):
    """The bumps against walls in so many updates."""
    paper = paper or Paper()
    bumps = []
    for update in range(start, start + updates):
        bump = turtle.move(update * STEP_S, paper)
        turtle.draw(paper)
        bumps += [bump] if bump else []
    return bumps


def test_the_recorded_turn():
    """What `rostopic echo` of the real one printed after a Twist of 2 m/s and 1.8 rad/s (transcript `turtlesim`)."""
    turtle = Turtle("turtle1", *START)
    turtle.teleport_absolute(1.0, 1.0, 0.0)
    run(turtle, 1)
    turtle.command(2.0, 0.0, 1.8)
    run(turtle, 200, start=1)
    assert (single(turtle.x), single(turtle.y), single(turtle.theta)) == (
        2.0583717823028564, 2.394545078277588, 1.8143999576568604,
    )  # fmt: skip
    assert turtle.linear_velocity == turtle.angular_velocity == 0.0


def test_walls_on_all_sides():
    for theta, x, y in ((0.0, LIMIT, 5.0), (math.pi / 2, 5.0, LIMIT), (3.1415, 0.0, 5.0), (-1.5707, 5.0, 0.0)):
        turtle = Turtle("t", 5.0, 5.0, theta)
        turtle.command(10.0, 0.0, 0.0)
        assert run(turtle, 60)
        assert (turtle.x, turtle.y) == pytest.approx((x, y), abs=2e-3)
    turtle = Turtle("t", 30.0, 5.0, 0.0)
    assert run(turtle, 1) == [(30.0, pytest.approx(LIMIT - 5.0))]
    assert turtle.x == LIMIT


def test_teleports_draw_lines_while_the_pen_is_down():
    paper, turtle = Paper(), Turtle("t", 1.0, 1.0, 0.0)
    turtle.teleport_relative(2.0, math.pi / 2)
    run(turtle, 1, paper)
    assert (turtle.x, turtle.y, turtle.theta) == pytest.approx((1.0, 3.0, math.pi / 2))
    turtle.set_pen(9, 9, 9, 9, 1)
    turtle.teleport_absolute(5.0, 5.0, 1.0)
    run(turtle, 1, paper)
    assert paper.count == 1
    assert (turtle.pen_on, turtle.pen) == (False, Pen())
    turtle.set_pen(1, 2, 3, 0, 0)
    assert (turtle.pen_on, turtle.pen) == (True, Pen((1, 2, 3), 1))


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_none_are_refused(wrong):
    turtle = Turtle("t", 1.0, 1.0, 0.0)
    for ask in (
        lambda: turtle.command(wrong, 0.0, 0.0),
        lambda: turtle.teleport_absolute(1.0, wrong, 0.0),
        lambda: turtle.teleport_relative(1.0, wrong),
        lambda: Turtle("u", 1.0, wrong, 0.0),
    ):
        with pytest.raises(TurtleError, match="finite"):
            ask()
    assert not run(turtle, 5)
    assert (turtle.x, turtle.y) == pytest.approx((1.0, 1.0))


@given(st.lists(st.tuples(anything, anything, anything), max_size=5))
@example([(0.0, 1e308, 1e308)])  # two turns at the same update, whose sum is infinite
@example([(1e307, 1e307, 0.0)])  # an infinite number of pixels
def test_it_stays_inside_whatever_it_is_told(asked):
    turtle, paper = Turtle("t", *START), Paper()
    for update, (a, b, c) in enumerate(asked):
        for ask in (turtle.command, turtle.teleport_absolute, lambda x, y, _: turtle.teleport_relative(x, y)):
            with contextlib.suppress(TurtleError):
                ask(a, b, c)
        run(turtle, 1, paper, start=update)
        assert 0.0 <= turtle.x <= LIMIT and 0.0 <= turtle.y <= LIMIT and abs(turtle.theta) <= 3.1416
        single(turtle.linear_velocity)
        paper.pixel(*turtle.pixel)
