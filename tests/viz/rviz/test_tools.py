"""Tools publish what RViz publishes, from a script as from a hand."""

import math

import numpy as np
import pytest

from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.msgs.geometry_msgs.msg import PointStamped, PoseStamped, PoseWithCovarianceStamped
from rosmini.viz import ViewError
from rosmini.viz.rviz import Config
from rosmini.viz.rviz.primitives import DisplayError, Lines, Mesh
from rosmini.viz.rviz.tools import Tool, Tools, point


@pytest.fixture
def received(stage):
    """The tools of a new scene in the frame map, and what is heard of three topics."""
    messages = []
    listener = stage.graph.node("listener")
    for topic, kind in (
        ("/initialpose", PoseWithCovarianceStamped),
        ("/move_base_simple/goal", PoseStamped),
        ("/clicked_point", PointStamped),
    ):
        listener.subscriber(topic, kind, messages.append)
    tools = Tools(stage.scene())
    stage.graph.run(0.1)

    def after(name, *points):
        messages.clear()
        said = tools[name].drag(*points) if len(points) == 2 else tools[name].click(*points)
        now = stage.graph.now()
        stage.graph.run(0.1)
        (message,) = messages
        assert message.header.frame_id == "map"
        assert message.header.stamp == now
        return said, message

    return tools, after


def test_a_pose_estimate_has_the_squares_of_the_deviations(received):
    tools, after = received
    said, message = after("2D Pose Estimate", (1.0, 2.0), (1.0, 5.0))
    pose = message.pose.pose
    assert (pose.position.x, pose.position.y, pose.position.z) == (1.0, 2.0, 0.0)
    turned = pose.orientation
    assert yaw_from_quaternion(turned.x, turned.y, turned.z, turned.w) == pytest.approx(math.pi / 2)
    covariance = np.reshape(message.pose.covariance, (6, 6))
    assert np.diag(covariance) == pytest.approx([0.25, 0.25, 0, 0, 0, 0.06853891945200942])
    assert np.count_nonzero(covariance) == 3
    assert said == "Setting pose: 1.000 2.000 1.571 [frame=map]"
    tools["2D Pose Estimate"]["X std deviation"] = 0.1
    assert after("2D Pose Estimate", (1.0, 2.0))[1].pose.covariance[0] == pytest.approx(0.01)


def test_a_goal_lies_on_the_ground_and_a_click_heads_along_x(received):
    _, after = received
    said, goal = after("2D Nav Goal", (1.0, -2.0, 0.5), (0.0, -2.0, 0.5))
    assert (goal.pose.position.x, goal.pose.position.y, goal.pose.position.z) == (1.0, -2.0, 0.0)
    assert abs(goal.pose.orientation.z) == pytest.approx(1.0)
    assert said.startswith("Setting goal: Frame:map, Position(1.000, -2.000, 0.000), Orientation(0.000, 0.000, ")
    assert after("g", (3.0, 4.0))[1].pose.orientation.w == 1.0


def test_a_point_is_published_as_it_was_clicked_and_the_tool_is_put_away(received):
    tools, after = received
    tools.take("Publish Point")
    _, message = after("Publish Point", (0.5, 0.25, 1.5))
    assert (message.point.x, message.point.y, message.point.z) == (0.5, 0.25, 1.5)
    tools.finish()
    assert tools.current.label == "Interact"
    tools.take("u")["Single click"] = False
    after("rviz/PublishPoint", (0, 0))
    tools.finish()
    assert tools.current.label == "Publish Point"


def test_while_a_pose_is_dragged_an_arrow_points_where_it_heads(stage):
    goal = Tools(stage.scene())["2D Nav Goal"]
    goal.press(np.array([1.0, 0.0, 0.0]))
    assert list(goal.primitives()) == []
    goal.move(np.array([1.0, 3.0, 0.0]))
    (arrow,) = goal.primitives()
    assert isinstance(arrow, Mesh)
    assert arrow.placed[:, 1].max() == pytest.approx(2.5)
    goal.release(np.array([1.0, 3.0, 0.0]))
    assert list(goal.primitives()) == []


def test_measure_tells_the_distance_of_each_pair(stage):
    measure = Tools(stage.scene())["Measure"]
    assert measure.click((0, 0, 0)) == measure.hint
    assert measure.click((1, 2, 2)).startswith("[Length: 3m]")
    (line,) = measure.primitives()
    assert isinstance(line, Lines)
    assert measure.click((5, 5)) == measure.hint
    assert measure.length is None


def test_the_camera_focuses_and_moves(stage):
    scene = stage.scene(Config.parse(VIEW.format("Orbit")))
    tools = Tools(scene)
    tools["Focus Camera"].click((2.0, 1.0, 0.0))
    assert scene.view.viewpoint(scene.context).target == pytest.approx(np.array([2.0, 1.0, 0.0]))
    tools["Move Camera"].drag((0.0, 0.0), (1.0, 0.0))
    assert scene.view.viewpoint(scene.context).target == pytest.approx(np.array([1.0, 1.0, 0.0]))


VIEW = """
Visualization Manager:
  Views:
    Current: {{Class: rviz/{}, Target Frame: base}}
"""


@pytest.mark.parametrize("kind", ["Orbit", "TopDownOrtho"])
def test_each_view_can_look_at_a_point_though_its_frame_has_turned(stage, kind):
    scene = stage.scene(Config.parse(VIEW.format(kind)))
    stage.place("map", "base", (3.0, 1.0, 0.0), yaw=1.0)
    stage.graph.run(0.1)
    scene.update()
    scene.view.centre_on(np.array([-1.0, 2.0, 0.0]), scene.context)
    assert scene.view.viewpoint(scene.context).target == pytest.approx(np.array([-1.0, 2.0, 0.0]))


def test_a_file_names_the_topics_of_its_tools_and_what_is_unknown_is_left_out(stage):
    tree = Config()
    tree.manager["Tools"] = [{"Class": "rviz/SetGoal", "Topic": "/robot1/goal"}, {"Class": "other/Tool"}]
    scene = stage.scene(tree)
    (goal,) = Tools(scene)
    stage.graph.run(0.1)
    published = stage.graph.ask_as("/test").ask("getSystemState")[0]
    assert "/robot1/goal" in {topic for topic, nodes in published if scene.node.name in nodes}
    goal["Topic"] = "/robot2/goal"
    published = stage.graph.ask_as("/test").ask("getSystemState")[0]
    assert {"/robot2/goal"} == {topic for topic, nodes in published if "goal" in topic}
    assert goal.tree() == {"Class": "rviz/SetGoal", "Topic": "/robot2/goal"}
    assert "other/Tool" in scene.warning


def test_what_is_no_tool_or_no_point_is_named(stage):
    tools = Tools(stage.scene())
    with pytest.raises(ViewError, match="did you mean 2D Nav Goal"):
        tools["2D Nav Gaol"]
    for errors in ((1,), (1, 2, 3, 4), "ab", (math.nan, 0), None):
        with pytest.raises(DisplayError):
            point(errors)
    with pytest.raises(DisplayError, match="std deviation"):
        tools["2D Pose Estimate"]["Z std deviation"] = 1.0
    assert issubclass(type(tools.current), Tool)
