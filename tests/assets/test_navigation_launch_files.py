"""The launch files for navigation: their nodes start and stay, a map or a goal comes, and what is wrong is one line."""

from __future__ import annotations

import math

import pytest

from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.introspection.nodes import kill
from rosmini.ros.launch import LaunchError, plan_of, roslaunch


@pytest.fixture
def graph():
    with Graph(strict=False) as graph:
        yield graph


@pytest.fixture
def model(monkeypatch):
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")


def hear(graph, topic, kind):
    heard = []
    graph.node("ear", anonymous=True).subscriber(topic, message_class(kind), heard.append)
    return heard


def send(graph, namespace, goal):
    """Send a goal (x, y, yaw) in the map; return what the results will be in."""
    node = graph.node("tester", anonymous=True)
    topic = f"{namespace}/move_base_simple/goal"
    goals = node.publisher(topic, message_class("geometry_msgs/PoseStamped"), queue_size=1)
    results = hear(graph, f"{namespace}/move_base/result", "move_base_msgs/MoveBaseActionResult")
    graph.run(0.2)
    goals.publish(pose_stamped("map", Time(0), goal))
    return results


def statuses(results):
    return [(one.status.status, one.status.text) for one in results]


REACHED = [(3, "Goal reached.")]


def test_an_erratic_maps_the_floor_on_its_way_to_a_goal(graph, capsys):
    launch = roslaunch("navigation_stage", "move_base_gmapping_5cm.launch", graph=graph)
    maps = hear(graph, "/map", "nav_msgs/OccupancyGrid")
    graph.run(3.0)
    assert [name for name, code in launch.state().codes if code is None] == [
        "/move_base_node", "/stageros", "/slam_gmapping", "/rviz",
    ]  # fmt: skip
    assert "To see RViz, run: %rviz -d package://navigation_stage/single_robot.rviz" in capsys.readouterr().out
    results = send(graph, "", (0.7, 0.0, 0.0))
    graph.run(10.0)
    assert statuses(results) == REACHED
    known = sum(cell >= 0 for cell in maps[-1].data) * 0.05**2
    assert known > 10.0  # m^2


def test_move_base_launched_once_more_takes_the_name_of_the_first(graph, capsys):
    """The report's second command, beside a launch file that includes it already."""
    first = roslaunch("navigation_stage", "move_base_gmapping_5cm.launch", graph=graph, open_rviz=False)
    graph.run(2.0)
    second = roslaunch("navigation_stage", "move_base.xml", graph=graph)
    graph.run(2.0)
    said = capsys.readouterr()
    assert "new node registered with same name" in said.out + said.err
    assert dict(first.state().codes)["/move_base_node"] is not None
    assert dict(second.state().codes)["/move_base_node"] is None


def test_an_erratic_finds_itself_and_its_goal_on_a_known_map(graph):
    roslaunch("navigation_stage", "move_base_amcl_5cm.launch", graph=graph, open_rviz=False)
    poses = hear(graph, "/amcl_pose", "geometry_msgs/PoseWithCovarianceStamped")
    graph.run(3.0)
    results = send(graph, "", (0.7, 0.0, 0.0))
    graph.run(10.0)
    assert statuses(results) == REACHED
    assert poses[-1].pose.pose.position.x == pytest.approx(0.7, abs=0.35)


def test_each_of_two_erratics_goes_to_a_goal_of_its_own(graph):
    roslaunch("navigation_stage", "move_base_multi_robot.launch", graph=graph, open_rviz=False)
    graph.run(3.0)
    results = [send(graph, "/robot_0", (0.7, 0.0, 0.0)), send(graph, "/robot_1", (4.3, 0.0, 3.14))]
    graph.run(10.0)
    assert [statuses(each) for each in results] == [REACHED, REACHED]


def test_of_two_robots_one_is_removed_on_its_way_and_one_loses_its_move_base(graph, monkeypatch):
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    node = graph.node("setter")
    for name, value in (("recovery_behavior_enabled", False), ("controller_patience", 1.0), ("planner_patience", 1.0)):
        node.set_param(f"/tb3_0/move_base/{name}", value)
    roslaunch("rosmini_sim", "multi_navigation.launch", graph=graph, open_rviz=False)
    for name in ("controller_patience", "planner_patience"):  # the file's are longer
        node.set_param(f"/tb3_0/move_base/{name}", 1.0)
    graph.run(2.0)
    first, second = (send(graph, "/tb3_0", (3.0, 1.0, 0.0)), send(graph, "/tb3_1", (-3.0, 1.0, 0.0)))
    logs = hear(graph, "/rosout", "rosgraph_msgs/Log")
    graph.run(3.0)
    simulator = graph.nodes["/simulator"].program
    engine = simulator.engine
    simulator.delete("tb3_0")
    there = engine.pose("tb3_1")
    graph.run(4.0)
    assert math.dist(there[:2], engine.pose("tb3_1")[:2]) > 0.5, "the other one drives on"
    assert not second
    graph.run(3.0)
    assert [status for status, _ in statuses(first)] == [4], "its move_base gives up"
    said = [log.msg for log in logs if log.name == "/tb3_0/move_base"]
    assert any("Costmap2DROS transform timeout" in text for text in said)
    assert kill(graph, ["/tb3_1/move_base"]) == (["/tb3_1/move_base"], [])
    graph.run(1.0)
    assert engine.velocity("tb3_1") == pytest.approx((0.0, 0.0, 0.0), abs=1e-3), "and it stands"
    assert statuses(second) == [(4, "Aborting on the goal because the node has been killed")]


def test_arguments_place_the_robot_and_amcl_agrees(model):
    plain = plan_of("rosmini_sim", "navigation.launch", localization="amcl")
    assert "/simulator/x" not in plain.settings
    assert plain.settings["/amcl/initial_pose_x"].value == -3.0
    placed = plan_of("rosmini_sim", "navigation.launch", localization="amcl", x=0, y=-1.5, yaw=0.5)
    for ours, theirs, value in (("x", "x", 0.0), ("y", "y", -1.5), ("yaw", "a", 0.5)):
        assert placed.settings[f"/simulator/{ours}"].value == value
        assert placed.settings[f"/amcl/initial_pose_{theirs}"].value == value


def test_a_map_and_no_way_back_are_arguments(model):
    plan = plan_of("turtlebot3_navigation", "turtlebot3_navigation.launch", map_file="/my.yaml", move_forward_only=True)
    assert plan.node("/map_server").args == "/my.yaml"
    assert plan.node("/amcl").type == "amcl"
    assert plan.settings["/move_base/DWAPlannerROS/min_vel_x"].value == 0.0
    of_many = plan_of("turtlebot3_navigation", "multi_turtlebot3_navigation.launch", ns="tb3_7")
    assert of_many.settings["/tb3_7/move_base/DWAPlannerROS/min_vel_x"].value == -0.1
    assert of_many.settings["/tb3_7/move_base/global_costmap/scan/sensor_frame"].value == "tb3_7/base_scan"


def test_one_of_many_robots_is_careful_unless_told_otherwise(model):
    files = "turtlebot3_navigation", "multi_turtlebot3_navigation.launch"
    careful, usual = plan_of(*files, ns="tb3_7"), plan_of(*files, ns="tb3_7", careful=False)
    assert careful.settings["/tb3_7/move_base/global_costmap/robot_radius"].value == 0.12
    assert "/tb3_7/move_base/global_costmap/robot_radius" not in usual.settings


def test_a_careful_robot_plans_for_a_disc_of_its_model(model):
    radii = {}
    for name in ("burger", "waffle", "waffle_pi"):
        plan = plan_of("turtlebot3_navigation", "turtlebot3_navigation.launch", model=name, careful=True)
        assert plan.settings["/move_base/global_costmap/footprint"].value == "[]"
        radii[name] = plan.settings["/move_base/global_costmap/robot_radius"].value
    assert radii == {"burger": 0.12, "waffle": 0.15, "waffle_pi": 0.15}
    plan = plan_of("turtlebot3_navigation", "turtlebot3_navigation.launch", careful=True, move_forward_only=True)
    assert plan.settings["/move_base/DWAPlannerROS/min_vel_x"].value == 0.0
    assert plan.settings["/move_base/last_reset/force_updating"].value is True


@pytest.mark.parametrize("files", [
    ("turtlebot3_navigation", "turtlebot3_navigation.launch"), ("turtlebot3_slam", "turtlebot3_slam.launch"),
    ("turtlebot3_bringup", "turtlebot3_model.launch"), ("turtlebot3_gazebo", "turtlebot3_world.launch"),
])  # fmt: skip
def test_without_a_model_one_line_says_what_to_do(files, monkeypatch):
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    with pytest.raises(LaunchError) as raised:
        plan_of(*files)
    assert "\n" not in str(raised.value)
    assert "'TURTLEBOT3_MODEL' is not set: export TURTLEBOT3_MODEL=" in str(raised.value)


@pytest.mark.parametrize(("method", "said"), [
    ("karto", "rosmini has no Karto: gmapping and hector_mapping make maps here"),
    ("cartographer", "rosmini has no Cartographer: gmapping and hector_mapping make maps here"),
])  # fmt: skip
def test_mappers_that_are_not_here_are_named(method, said, graph, model, capsys):
    launch = roslaunch("turtlebot3_slam", "turtlebot3_slam.launch", graph=graph, slam_methods=method)
    assert {node.package for node in launch.failed} <= {"slam_karto", "cartographer_ros"}
    assert said in capsys.readouterr().out


@pytest.mark.parametrize("files", [
    ("turtlebot3_navigation", "turtlebot3_navigation.launch"), ("turtlebot3_slam", "turtlebot3_slam.launch"),
    ("navigation_stage", "move_base_fake_localization_5cm.launch"),
])  # fmt: skip
def test_rviz_opens_unless_it_is_not_wanted_as_in_the_public_files(files, model):
    assert plan_of(*files).node("/rviz").package == "rviz"
    assert "/rviz" not in {node.name for node in plan_of(*files, open_rviz=False).nodes}


def test_a_method_that_nobody_knows_has_no_launch_file(model):
    with pytest.raises(LaunchError, match=r"turtlebot3_magic\.launch\] cannot be read: there is no such file"):
        plan_of("turtlebot3_slam", "turtlebot3_slam.launch", slam_methods="magic")


def test_a_program_is_no_launch_file():
    with pytest.raises(LaunchError, match=r"(?s)map_saver.*rosrun map_server map_saver"):
        plan_of("map_server", "map_saver")
