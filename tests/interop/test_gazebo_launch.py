"""Real roslaunch reads our launch files as they are; what it makes of them runs on our graph."""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rosmini import Graph
from rosmini.msgs import message_class
from rosmini.ros.scripts import ScriptSpec, find, rosrun, run_scripts

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

ROOT = Path(__file__).resolve().parents[2]
PEER = Path(__file__).with_name("roslaunch_peer.py")
LAUNCH = ROOT / "assets" / "ros" / "turtlebot3_gazebo" / "launch"


@pytest.fixture(scope="module")
def real_roslaunch() -> None:
    need_ros(modules="roslaunch")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        yield made


def computed(launch: str, *arguments: str, model: str = "burger") -> dict[str, Any]:
    """What real roslaunch makes of a launch file.

    Our own xacro expands the descriptions, with the Python of this test.
    """
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {
        **os.environ,
        "PATH": path,
        "ROS_PACKAGE_PATH": str(ROOT / "assets" / "ros"),
        "TURTLEBOT3_MODEL": model,
    }
    done = run([SYSTEM_PYTHON, PEER, LAUNCH / launch, *arguments], env=environment, check=True)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def words(node: dict[str, Any]) -> tuple[str, ...]:
    """The command line that roslaunch gives to a node."""
    remaps = [f"{old}:={new}" for old, new in node["remaps"]]
    return (*shlex.split(node["args"]), *remaps, f"__name:={node['name']}", f"__ns:={node['namespace']}")


def start(graph: Graph, plan: dict[str, Any]) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Set the parameters and start all nodes but the teleoperations.

    Return the built-in ones' objects, and the teleoperations.
    """
    for name, value in plan["params"].items():
        graph.master.setParam("/roslaunch", name, value)
    objects, scripts, teleops = {}, [], []
    for node in plan["nodes"]:
        executable = find(f"{node['package']}/{node['type']}")
        if node["package"] == "turtlebot3_teleop":
            teleops.append(node)
        elif executable.path is None:
            handle = rosrun(node["package"], node["type"], *words(node), graph=graph)
            objects[node["namespace"] + node["name"]] = handle.instance()
        else:
            scripts.append(ScriptSpec(str(executable.path), words(node)))
    result = run_scripts(scripts, graph=graph, duration=10.0)
    assert (result.status, result.reason) == (0, "ended")
    return objects, teleops


def steer(graph: Graph, teleop: dict[str, Any], keys: str, seconds: float) -> None:
    """Press keys in a teleoperation, and let it end after so many seconds."""
    executable = find(f"{teleop['package']}/{teleop['type']}")
    pieces = [(0.5, keys), (seconds, "\x03")]
    result = run_scripts([ScriptSpec(str(executable.path), words(teleop))], graph=graph, stdin=pieces, duration=60.0)
    assert (result.status, result.reason) == (0, "ended")


@pytest.mark.usefixtures("real_roslaunch")
def test_two_robots_in_the_house_drive_and_see(graph: Graph) -> None:
    plan = computed("two_turtlebot3.launch")
    assert plan["params"]["/use_sim_time"] is True
    objects, teleops = start(graph, plan)
    server = objects["/gazebo"]
    assert set(server.world.models) >= {"tb3_0", "tb3_1"}
    assert [node["remaps"] for node in teleops] == [[["cmd_vel", "/tb3_0/cmd_vel"]], [["cmd_vel", "/tb3_1/cmd_vel"]]]

    ear = graph.node("ear")
    scans: dict[str, list[Any]] = {}
    frames: set[tuple[str, str]] = set()
    for robot in ("tb3_0", "tb3_1"):
        heard = scans[robot] = []
        ear.subscriber(f"/{robot}/scan", message_class("sensor_msgs/LaserScan"), heard.append)

    def note(message: Any) -> None:
        frames.update((each.header.frame_id, each.child_frame_id) for each in message.transforms)

    for topic in ("/tf", "/tf_static"):
        ear.subscriber(topic, message_class("tf2_msgs/TFMessage"), note)
    before = {robot: server.truth(robot) for robot in scans}
    steer(graph, teleops[0], "w" * 20, 4.0)
    after = {robot: server.truth(robot) for robot in scans}
    assert after["tb3_0"][0] > before["tb3_0"][0] + 0.3  # a namespace each: only the first one drove
    assert after["tb3_1"] == before["tb3_1"]
    steer(graph, teleops[1], "a" * 10, 3.0)
    assert server.truth("tb3_1")[2] > 0.5

    for robot, heard in scans.items():
        assert heard[-1].header.frame_id == f"{robot}/base_scan"
        assert min(heard[-1].ranges) < 3.5  # it sees the house, or the other one
        assert (f"{robot}/odom", f"{robot}/base_footprint") in frames
        assert (f"{robot}/base_link", f"{robot}/base_scan") in frames
        assert (f"{robot}/base_link", f"{robot}/wheel_left_link") in frames
    assert "tb3_0 at" in objects["/gazebo_gui"].text


@pytest.mark.usefixtures("real_roslaunch")
@pytest.mark.parametrize(
    ("launch", "model", "where"),
    [
        ("turtlebot3_empty_world.launch", "burger", (0.0, 0.0)),
        ("turtlebot3_world.launch", "waffle_pi", (-2.0, -0.5)),
        ("turtlebot3_house.launch", "waffle", (-3.0, 1.0)),
    ],
)
def test_the_worlds_of_turtlebot3_start(graph: Graph, launch: str, model: str, where: tuple[float, float]) -> None:
    objects, _ = start(graph, computed(launch, model=model))
    server = objects["/gazebo"]
    name = f"turtlebot3_{model}"
    assert server.truth(name)[:2] == pytest.approx(where, abs=1e-3)
    ear = graph.node("ear")
    heard: list[Any] = []
    ear.subscriber("/scan", message_class("sensor_msgs/LaserScan"), heard.append)
    graph.run(1.0)
    assert len(heard) in (4, 5)
    assert len(heard[-1].ranges) == 360


@pytest.mark.usefixtures("real_roslaunch")
def test_one_robot_in_the_house_with_other_arguments(graph: Graph) -> None:
    objects, _ = start(
        graph, computed("one_turtlebot3.launch", "model:=waffle", "first_tb3:=robby", "first_tb3_yaw:=1.0")
    )
    assert objects["/gazebo"].truth("robby") == pytest.approx((-3.0, 1.0, 1.0), abs=1e-6)
    assert ["/robby/scan", "sensor_msgs/LaserScan"] in graph.master.getTopicTypes("/x")[2]
