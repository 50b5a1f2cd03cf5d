"""The client: an area from clicks."""

from __future__ import annotations

import pytest

from rosmini import rosrun
from rosmini.core.actionlib import SimpleActionServer
from rosmini.msgs import message_class

CLICKS = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.05, 0.1), (3.0, 1.0)]


@pytest.fixture
def clicks(stage):
    rosrun("frontier_exploration", "explore_client", graph=stage.graph).instance()
    publisher = stage.node.publisher("/clicked_point", message_class("geometry_msgs/PointStamped"))
    stage.markers = []
    stage.node.subscriber(
        "/exploration_polygon_marker", message_class("visualization_msgs/Marker"), stage.markers.append
    )
    stage.graph.run(0.5)

    def click(*points):
        for x, y in points:
            message = message_class("geometry_msgs/PointStamped")()
            message.header.frame_id, message.point.x, message.point.y = "map", x, y
            publisher.publish(message)
            stage.graph.run(0.3)

    return click


def last(stage):
    """The two newest markers: vertices and edges."""
    return stage.markers[-2:]


def test_it_shows_the_polygon_and_sends_it(stage, clicks):
    goals = []
    server = SimpleActionServer(
        stage.node,
        "explore_server",
        message_class("frontier_exploration/ExploreTaskAction"),
        execute_cb=lambda goal: (goals.append(goal), server.set_succeeded()),
        auto_start=False,
    )
    server.start()
    assert stage.said("Please use the 'Point' tool in Rviz", "/explore_client") or last(stage)
    assert [marker.action for marker in last(stage)] == [2, 2], "nothing to show is a deletion"
    clicks(*CLICKS[:3])
    vertices, edges = last(stage)
    assert (vertices.ns, vertices.type, edges.type) == ("explore_points", 7, 4)
    assert (vertices.color.b, vertices.color.r) == (1.0, 0.0)
    assert [(point.x, point.y) for point in edges.points] == CLICKS[:3]
    clicks(CLICKS[3])
    vertices, edges = last(stage)
    assert (edges.color.b, edges.color.r) == (0.0, 1.0)
    assert [(point.x, point.y) for point in edges.points] == [*CLICKS[:3], CLICKS[0]]
    clicks(CLICKS[4])
    stage.graph.run(1.0)
    (goal,) = goals
    assert [(corner.x, corner.y) for corner in goal.explore_boundary.polygon.points] == CLICKS[:3]
    assert (goal.explore_center.point.x, goal.explore_center.point.y) == CLICKS[4]
    assert goal.explore_boundary.header.frame_id == "map"


def test_without_a_server_it_says_so(stage, clicks):
    clicks(*CLICKS)
    stage.graph.run(6.0)
    assert stage.said("Waiting for the action server explore_server")


def test_faults_are_logged(stage, clicks):
    clicks((0.0, 0.0), (1.0, 0.0), (0.0, 0.0))
    assert stage.said("Not a valid polygon, restarting: a polygon of 2 vertices")
    clicks(*CLICKS[:4], (9.0, 9.0))
    assert stage.said("Center not inside polygon, restarting")
