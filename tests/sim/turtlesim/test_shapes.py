"""`turtle_actionlib`: the shape server draws regular polygons."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini import Graph, rosrun
from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.msgs import message_class
from rosmini.sim.turtlesim import TurtleError
from rosmini.sim.turtlesim.shapes import Polygon
from rosmini.sim.turtlesim.turtle import STEP_S

Action, Goal = (message_class(f"turtle_actionlib/Shape{kind}") for kind in ("Action", "Goal"))


def test_the_types_are_the_real_ones() -> None:
    assert Goal._md5sum == "3b9202ab7292cebe5a95ab2bf6b9c091"
    assert Action._md5sum == "d73b17d6237a925511f5d7727a1dc903"


@given(st.integers(3, 12), st.floats(0.1, 5.0), st.floats(-3.0, 3.0))
def test_it_comes_back_to_where_it_began(edges: int, radius: float, theta: float) -> None:
    polygon, pose, corners, driving = Polygon(edges, radius), (0.0, 0.0, theta), [], False
    for _ in range(20_000):
        command = polygon.steer(pose)
        if command is None:
            break
        v, w = command
        if driving and not v:
            corners.append(pose[:2])
        driving = v > 0
        turned = math.remainder(pose[2] + w * STEP_S, 2 * math.pi)
        x, y, _ = pose
        pose = (x + math.cos(turned) * v * STEP_S, y + math.sin(turned) * v * STEP_S, turned)
    assert len(corners) == edges
    assert pose[:2] == pytest.approx((0.0, 0.0), abs=1e-3 * radius + 1e-3)
    assert math.dist(corners[0], corners[1]) == pytest.approx(2 * radius * math.sin(math.pi / edges), abs=1e-3)
    assert polygon.apothem == pytest.approx(radius * math.cos(math.pi / edges))


@pytest.mark.parametrize(("edges", "radius"), [(2, 1.0), (-3, 1.0), (5, 0.0), (5, -1.0), (5, math.nan), (5, math.inf)])
def test_what_is_no_polygon(edges: int, radius: float) -> None:
    with pytest.raises(TurtleError, match="three edges at least"):
        Polygon(edges, radius)


def test_the_client_gets_its_pentagon(capfd: pytest.CaptureFixture[str]) -> None:
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        rosrun("turtle_actionlib", "shape_server", graph=graph)
        client = rosrun("turtle_actionlib", "shape_client", graph=graph)
        graph.run(30.0)
        turtle = sim.turtles["turtle1"]
        assert client.poll() == 0
        assert (turtle.x, turtle.y) == pytest.approx((5.544445, 5.544445), abs=1e-3)
    said = [line.partition("]: ")[2] for line in capfd.readouterr().out.splitlines()]
    assert said[2:] == [
        "Waiting for action server to start.",
        "Action server started, sending goal.",
        "/turtle_shape: Succeeded",
        "Action finished: SUCCEEDED",
    ]


def test_a_goal_that_is_none_is_aborted_and_a_cancelled_one_preempted() -> None:
    with Graph() as graph:
        rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        rosrun("turtle_actionlib", "shape_server", graph=graph).instance()
        client = SimpleActionClient(graph.node("asker"), "turtle_shape", Action)
        client.wait_for_server()
        client.send_goal(Goal(edges=1, radius=1.0))
        assert client.wait_for_result(5.0)
        assert client.get_state() == Status.ABORTED
        assert "three edges at least" in client.get_goal_status_text()
        client.send_goal(Goal(edges=4, radius=1.0))
        graph.run(2.0)
        client.cancel_goal()
        assert client.wait_for_result(5.0)
        assert client.get_state() == Status.PREEMPTED
        client.send_goal(Goal(edges=3, radius=0.5))
        assert client.wait_for_result(40.0)
        assert client.get_state() == Status.SUCCEEDED
        assert client.get_result().interior_angle == pytest.approx(math.pi / 3)
