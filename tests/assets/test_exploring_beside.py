"""One TurtleBot3 explores while another is driven by keys."""

from __future__ import annotations

import io
import math

import pytest

from rosmini import Graph
from rosmini.core.geometry.poses import compose, inverse
from rosmini.core.packages import PackageIndex
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch
from rosmini.ros.scripts import ScriptSpec, run_scripts


def quiet():
    return {"stdout": io.StringIO(), "stderr": io.StringIO()}


@pytest.fixture
def graph():
    with Graph(strict=False) as graph:
        yield graph


BESIDE = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="world" value="room"/>
    <rosparam param="robots">
      - {name: tb3_0, model: burger, x: 0.0, y: 0.0}
      - {name: tb3_1, model: burger, x: 2.9, y: 0.6, yaw: 1.5708}
    </rosparam>
  </node>
  <group ns="tb3_0">
    <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
      <arg name="model" value="burger"/> <arg name="multi_robot_name" value="tb3_0"/>
    </include>
    <include file="$(find turtlebot3_navigation)/launch/move_base.launch">
      <arg name="model" value="burger"/> <arg name="cmd_vel_topic" value="cmd_vel"/>
      <arg name="careful" value="true"/>
      <arg name="global_frame" value="tb3_0/map"/> <arg name="odom_frame" value="tb3_0/odom"/>
      <arg name="base_frame" value="tb3_0/base_footprint"/> <arg name="laser_frame" value="tb3_0/base_scan"/>
    </include>
    <include file="$(find explore_lite)/launch/explore.launch">
      <arg name="robot_base_frame" value="tb3_0/base_footprint"/>
    </include>
  </group>
  <include file="$(find turtlebot3_gazebo)/launch/multi_turtlebot3_slam.launch">
    <arg name="ns" value="tb3_0"/>
  </include>
  <param name="tb3_0/turtlebot3_slam_gmapping/particles" value="3"/>
</launch>
"""


def test_one_is_driven_by_keys_while_the_other_explores(graph, tmp_path):
    file = tmp_path / "beside.launch"
    file.write_text(BESIDE, encoding="utf-8")
    roslaunch(str(file), graph=graph, console=quiet())
    maps, touched, ways = [], [], []
    node = graph.node("tester")
    node.subscriber("/tb3_0/map", message_class("nav_msgs/OccupancyGrid"), maps.append)
    graph.run(2.0)
    engine = graph.nodes["/simulator"].program.engine
    before = {name: engine.pose(name) for name in ("tb3_0", "tb3_1")}
    seen = sum(cell >= 0 for cell in maps[-1].data)

    def look(_):
        touched.extend(engine.touching("tb3_0"))
        ways.append(compose(inverse(before["tb3_1"]), engine.pose("tb3_1")))

    node.timer(0.1, look)
    path = PackageIndex().find_executable("turtlebot3_teleop", "turtlebot3_teleop_key").path
    keys = [(1, "w" * 10), (6, "s"), (7, "x" * 10), (12, "s"), (15, "\x03")]
    run_scripts([ScriptSpec(str(path), ("__ns:=tb3_1",))], graph=graph, stdin=keys, stdout=io.StringIO())
    # Ten keys in a second are 0.1 m/s after two: in 5 s it drives 0.4 m ahead, and then back.
    assert max(x for x, _, _ in ways) == pytest.approx(0.4, abs=0.05)
    assert ways[-1] == pytest.approx((0.0, 0.0, 0.0), abs=0.05)
    assert math.dist(before["tb3_0"][:2], engine.pose("tb3_0")[:2]) > 1.0
    assert sum(cell >= 0 for cell in maps[-1].data) > 1.3 * seen
    assert touched == []
