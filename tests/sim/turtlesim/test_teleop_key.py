"""`turtlesim/turtle_teleop_key`: arrow keys to velocities, with the real one's text."""

import io

import pytest

from rosmini import Graph, rosrun

UP, DOWN, RIGHT, LEFT = "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D"
HEAD = "Reading from keyboard\n---------------------------\nUse arrow keys to move the turtle. 'q' to quit.\n"


def drive(keys, seconds, *arguments):
    out = io.StringIO()
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        teleop = rosrun("turtlesim", "turtle_teleop_key", *arguments, graph=graph, stdin=keys, stdout=out, prefix="")
        graph.run(seconds)
        return sim, out.getvalue(), teleop.poll()


def test_keys_at_their_times_and_q():
    sim, out, status = drive([(1.0, UP), (3.0, LEFT), (5.0, "x" + DOWN), (7.0, RIGHT), (7.2, "q")], 10.0)
    turtle = sim.turtles["turtle1"]
    assert (out, status) == (HEAD, 0)
    assert turtle.theta == pytest.approx(0.0, abs=1e-9)
    start = 5.544445
    assert turtle.x == pytest.approx(start + 2.016 * (1 - -0.4304), abs=0.01)  # back along a heading of 115.5 deg
    assert turtle.y == pytest.approx(start - 2.016 * 0.9026, abs=0.01)


def test_keys_given_at_once_come_one_a_second():
    sim, _, status = drive("AAC", 10.0, "_unused:=1")
    turtle = sim.turtles["turtle1"]
    assert turtle.x == pytest.approx(5.544445 + 4.0, abs=0.05)
    assert turtle.theta == pytest.approx(-2.016)
    assert status == 0


def test_without_a_keyboard_the_node_stays():
    _, out, status = drive("", 5.0)
    assert (out, status) == (HEAD, None)


def test_its_speeds_are_parameters():
    out = io.StringIO()
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        sim.node.set_param("/scale_linear", 0.5)
        rosrun("turtlesim", "turtle_teleop_key", graph=graph, stdin=UP, stdout=out, prefix="")
        graph.run(3.0)
        assert sim.turtles["turtle1"].x == pytest.approx(5.544445 + 0.504)
