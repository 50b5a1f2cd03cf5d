"""The node, with a base that jumps to its goals."""

from __future__ import annotations

import pytest

from rosmini import rosrun
from rosmini.msgs import message_class

GIVEN = {
    "costmap_topic": "map",
    "costmap_updates_topic": "map_updates",
    "planner_frequency": 2.0,
    "min_frontier_size": 0.2,
    "visualize": True,
}


@pytest.fixture
def explore(stage):
    def start(*, base=True, **parameters):
        if base:
            stage.base.start()
        stage.markers = []
        stage.node.subscriber(
            "/explore/frontiers", message_class("visualization_msgs/MarkerArray"), stage.markers.append
        )
        given = [f"_{name}:={value}" for name, value in {**GIVEN, **parameters}.items()]
        return rosrun("explore_lite", "explore", *given, graph=stage.graph).instance()

    return start


def run(stage, seconds=120):
    """Let it explore until it ends."""
    for _ in range(seconds):
        stage.graph.run(1.0)
        if stage.said("Exploration stopped."):
            return True
    return False


def test_it_ends_when_no_frontier_is_left(stage, explore):
    stage.know(0.0, 0.0, 1.6, 1.6)
    stage.sight = 1.2
    node = explore()
    assert run(stage)
    assert stage.said("No frontiers found, stopping.")
    assert (stage.cells == 0).mean() > 0.97
    assert not node.is_exploring
    assert node.sent >= len(stage.goals) > 2
    before = len(stage.goals)
    stage.graph.run(10.0)
    assert len(stage.goals) == before


def test_goals_that_are_aborted_are_given_up(stage, explore):
    stage.know(0.5, 0.5, 1.6, 1.6)
    stage.answer = "set_aborted"
    node = explore()
    assert run(stage, 60)
    assert stage.said("All frontiers traversed/tried out, stopping.")
    assert stage.said("1 frontiers were given up, at (")
    assert len(stage.goals) == len(node.blacklist.points) == 2, "all around is one frontier, and is tried again"
    reds = [marker for marker in stage.markers[-1].markers if marker.color.r == 1.0]
    assert len(reds) == 1


def test_a_goal_without_progress_is_given_up(stage, explore):
    stage.know(0.5, 0.5, 1.6, 1.6)
    stage.answer = None
    node = explore(progress_timeout=5.0)
    stage.graph.run(4.0)
    assert node.is_exploring
    stage.graph.run(12.0)
    assert not node.is_exploring
    assert [(round(x, 2), round(y, 2)) for x, y in node.blacklist.points] == [stage.goals[0]] * 2
    assert not stage.base.is_active(), "the goal is cancelled"


def test_markers(stage, explore):
    stage.know(0.5, 0.0, 1.6, 3.0)
    stage.answer = None
    explore()
    stage.graph.run(3.0)
    cells, ball, *more = stage.markers[-1].markers
    assert (cells.ns, cells.type, cells.id, ball.type, ball.id) == ("frontiers", 8, 0, 2, 1)
    assert len(cells.points) == 30
    assert len(more) == 2, "left and right"
    assert cells.color.b == 1.0
    assert ball.scale.x == pytest.approx(0.4)
    stage.know(0.0, 0.0, 1.6, 3.0)
    stage.graph.run(0.6)
    assert [marker.action for marker in stage.markers[-1].markers] == [0, 0, 2, 2]


def test_a_robot_that_is_taken_away_and_put_back(stage, explore):
    stage.know(0.5, 0.5, 1.6, 1.6)
    node = explore()
    stage.graph.run(1.0)
    stage.timer.shutdown()
    stage.graph.run(8.0)
    assert stage.said("Exploration waits for the robot's pose: Transform timeout")
    assert node.is_exploring


def test_without_move_base_it_waits_and_says_so(stage, explore):
    stage.know(0.5, 0.5, 1.6, 1.6)
    stage.node.timer(8.0, lambda _: stage.base.start(), oneshot=True)
    explore(base=False)
    stage.graph.run(0.1)
    assert stage.said("Still waiting for the action server move_base")
    stage.graph.run(4.0)
    assert stage.goals
