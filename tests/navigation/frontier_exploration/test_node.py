"""The server, with a base that jumps to its goals."""

from __future__ import annotations

import pytest

from rosmini import rosrun
from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.msgs import message_class

from ...conftest import nightly
from .test_plugin import LAYERS

SQUARE = ((0.1, 0.1), (3.8, 0.1), (3.8, 2.8), (0.1, 2.8))


class Exploration:
    """The node, and who sends it areas."""

    def __init__(self, stage, *, frequency=1.0, base=True):
        self.stage, self.graph = stage, stage.graph
        boundary = {"resize_to_boundary": False, "explore_clear_space": False}
        stage.node.set_param(
            "/explore_server/explore_costmap",
            {"plugins": LAYERS, "track_unknown_space": True, "robot_radius": 0.1, "explore_boundary": boundary},
        )
        if base:
            stage.base.start()
        self.server = rosrun(
            "frontier_exploration", "explore_server", f"_frequency:={frequency}", graph=self.graph
        ).instance()
        self.graph.run(1.0)
        self.client = SimpleActionClient(
            self.graph.node("user"), "explore_server", message_class("frontier_exploration/ExploreTaskAction")
        )
        self.graph.run(0.5)
        self.feedback = []

    def send(self, points=SQUARE, center=(1.0, 1.0)):
        goal = message_class("frontier_exploration/ExploreTaskGoal")()
        goal.explore_boundary.header.frame_id = goal.explore_center.header.frame_id = "map"
        corner = message_class("geometry_msgs/Point32")
        goal.explore_boundary.polygon.points = [corner(x=x, y=y) for x, y in points]
        goal.explore_center.point.x, goal.explore_center.point.y = center
        self.client.send_goal(goal, feedback_cb=self.feedback.append)

    def explore(self, limit=120.0, **area):
        self.send(**area)
        for _ in range(int(limit)):
            self.graph.run(1.0)
            if self.client.get_state() not in (Status.PENDING, Status.ACTIVE):
                break
        return self.client.get_state()


@pytest.mark.parametrize("frequency", [1.0, *nightly(0.0)])
def test_it_ends_when_no_frontier_is_left(stage, frequency):
    stage.know(0.5, 0.5, 1.6, 1.6)
    exploration = Exploration(stage, frequency=frequency)
    assert exploration.explore() is Status.SUCCEEDED
    assert stage.said("Finished exploring room")
    assert exploration.server.sent >= len(stage.goals) > 5
    inside = stage.cells[3:27, 3:37]
    assert (inside == 0).mean() > 0.95, "it has seen all of the area"
    assert all(0.1 <= x <= 3.9 and 0.1 <= y <= 2.9 for x, y in stage.goals)


def test_a_robot_outside_first_drives_to_the_point_inside(stage):
    stage.know(0.5, 0.5, 4.0, 2.0)
    stage.pose = (3.5, 1.0, 0.0)
    exploration = Exploration(stage)
    area = ((0.6, 0.6), (2.0, 0.6), (2.0, 2.4), (0.6, 2.4))
    assert exploration.explore(points=area, center=(1.5, 1.2)) is Status.SUCCEEDED
    assert stage.goals[0] == (1.5, 1.2)


def test_an_area_without_frontiers(stage):
    stage.know(0.0, 0.0, 4.0, 3.0)
    exploration = Exploration(stage)
    assert exploration.explore() is Status.ABORTED
    text = exploration.client.get_goal_status_text()
    assert text.startswith("Failed exploration: ")
    assert "No valid frontiers found" in text


def test_what_the_base_gives_up_is_tried_again_and_then_left_out(stage):
    stage.know(0.5, 0.0, 1.6, 3.0)
    stage.answer = "set_aborted"
    exploration = Exploration(stage, frequency=0.0)
    assert exploration.explore() is Status.ABORTED
    left, right = dict.fromkeys(stage.goals)
    assert stage.goals == [left, right, left, right]
    text = exploration.client.get_goal_status_text()
    assert text.startswith("Failed exploration: the robot is stuck at (1.05, 1.05); 2 were given up, at (")
    assert stage.said("Failed to move to (")
    assert not stage.said("Finished exploring room"), "a robot that got nowhere has not finished"
    stage.answer = "set_succeeded"
    assert exploration.explore() is Status.SUCCEEDED
    assert len(stage.goals) > 4, "a new area begins afresh"


def test_a_door_that_was_shut_is_tried_again(stage):
    stage.know(0.5, 0.0, 1.6, 3.0)
    stage.answer = "set_aborted"
    exploration = Exploration(stage, frequency=0.0)
    exploration.send()
    while len(stage.goals) < 2:
        exploration.graph.run(0.5)
    stage.answer = "set_succeeded"
    assert exploration.explore() is Status.SUCCEEDED
    assert exploration.client.get_goal_status_text() == "Finished exploring room"


def test_the_end_tells_what_was_given_up(stage):
    stage.know(0.5, 0.0, 1.6, 3.0)
    stage.refused = lambda x, _: x < 0.5
    exploration = Exploration(stage, frequency=0.0)
    assert exploration.explore() is Status.SUCCEEDED
    text = exploration.client.get_goal_status_text()
    assert text.startswith("Finished exploring room; 1 were given up, at (0.45, ")
    assert stage.said(text)


def test_between_two_that_are_near_by_turns_it_makes_up_its_mind(stage):
    """In a maze each of two is the nearer one as the crow flies while the robot drives to the other, for good."""
    stage.know(0.5, 0.0, 1.6, 3.0)
    stage.detour = lambda x, _: (1.35 if x < 1.0 else 0.75, 1.05, 0.0)
    exploration = Exploration(stage)
    exploration.send()
    for _ in range(60):
        exploration.graph.run(0.5)
        if len(set(stage.goals)) > 2:
            break
    assert len(set(stage.goals)) > 2, "it got to one of them, and beyond"
    assert 2 < len(stage.goals) < 12


def test_areas_that_are_none_and_then_one(stage):
    stage.know(0.5, 0.5, 1.6, 1.6)
    exploration = Exploration(stage)
    for points in (((1, 1), (2, 2)), ((1, 1), (2, 2), (2, 1), (1, 2)), ((50, 50), (51, 50), (51, 51))):
        assert exploration.explore(points=points) is Status.ABORTED
        assert "Failed to set region boundary: " in exploration.client.get_goal_status_text()
    assert exploration.explore() is Status.SUCCEEDED


def test_cancelled_and_replaced(stage):
    stage.know(0.5, 0.5, 1.6, 1.6)
    stage.answer = None
    exploration = Exploration(stage)
    exploration.send()
    exploration.graph.run(4.0)
    exploration.client.cancel_goal()
    exploration.graph.run(3.0)
    assert exploration.client.get_state() is Status.PREEMPTED
    assert not stage.base.is_active(), "the base stands, too"
    assert stage.said("Current exploration task cancelled")
    exploration.send()
    exploration.graph.run(3.0)
    stage.answer = "set_succeeded"
    assert exploration.explore() is Status.SUCCEEDED


def test_without_move_base_it_waits_and_says_so(stage):
    stage.know(0.5, 0.5, 1.6, 1.6)
    exploration = Exploration(stage, base=False)
    exploration.send()
    exploration.graph.run(8.0)
    assert stage.said("waits for the action server move_base")
    stage.base.start()
    exploration.graph.run(10.0)
    assert stage.goals


def test_a_robot_that_is_taken_away(stage):
    stage.know(0.5, 0.5, 1.6, 1.6)
    stage.answer = None
    exploration = Exploration(stage)
    exploration.send()
    exploration.graph.run(4.0)
    stage.timer.shutdown()
    exploration.graph.run(40.0)
    assert exploration.client.get_state() is Status.ABORTED
    assert "the robot's pose has been unknown for 30 s" in exploration.client.get_goal_status_text()
    assert not stage.base.is_active()


def test_feedback(stage):
    stage.know(0.5, 0.5, 1.6, 1.6)
    exploration = Exploration(stage)
    feedback = message_class("move_base_msgs/MoveBaseFeedback")()
    feedback.base_position.pose.position.x = 7.0
    stage.answer = None
    exploration.send()
    exploration.graph.run(3.0)
    stage.base.publish_feedback(feedback)
    exploration.graph.run(0.5)
    (told,) = exploration.feedback
    assert told.base_position.pose.position.x == 7.0
    p = told.next_frontier.pose.position
    assert (round(p.x, 3), round(p.y, 3)) == stage.goals[-1]
