"""The launch and parameter files of `turtlebot3_navigation` and `navigation_stage`, in the shape of the real ones."""

import io

import pytest

from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.core.packages import assets_dir
from rosmini.core.time import Time
from rosmini.msgs.move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.launch import roslaunch

from ...conftest import nightly


def launch(graph, *files, seconds=3.0):
    said = io.StringIO()
    for package, file, arguments in files:
        roslaunch(package, file, graph=graph, console={"stdout": said, "stderr": said}, **arguments)
    graph.run(seconds)
    return said.getvalue()


def send(graph, x, y, yaw=0.0):
    client = SimpleActionClient(graph.node("client"), "move_base", MoveBaseAction)
    graph.run(0.5)
    client.send_goal(MoveBaseGoal(target_pose=pose_stamped("map", Time(), (x, y, yaw))))
    for _ in range(120):
        graph.run(0.5)
        if client.get_state() not in (Status.PENDING, Status.ACTIVE):
            break
    return client.get_state()


@pytest.mark.parametrize("model", ["waffle_pi", *nightly("waffle")])
def test_each_model_has_its_files(graph, model):
    house = str(assets_dir() / "ros/rosmini_sim/maps/house.yaml")
    where = {"map_file": house, "model": model, "localization": "fake_localization", "open_rviz": False}
    said = launch(
        graph,
        ("rosmini_sim", "simulator.launch", {"world": "house", "model": model}),
        ("turtlebot3_navigation", "turtlebot3_navigation.launch", where),
    )
    assert "has no parameter" not in said
    assert "will clear nothing" not in said
    assert "nobody reads" not in said
    move_base = graph.nodes["/move_base"].program
    assert 0.07 < move_base.local_costmap.inscribed_radius < 0.1
    assert send(graph, -2.0, 1.3) is Status.SUCCEEDED


def test_stage(graph):
    said = launch(graph, ("navigation_stage", "move_base_fake_localization_5cm.launch", {"open_rviz": False}))
    assert "has no parameter" not in said
    assert "will clear nothing" not in said
    move_base = graph.nodes["/move_base_node"].program
    assert [layer.name for layer in move_base.global_costmap.layers] == [
        "static_layer",
        "obstacle_layer",
        "inflation_layer",
    ]
    assert type(move_base.controller).plugin_name == "base_local_planner/TrajectoryPlannerROS"
    assert send(graph, 2.0, 0.0) is Status.SUCCEEDED
