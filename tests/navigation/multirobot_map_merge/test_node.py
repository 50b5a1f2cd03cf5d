"""The node: which robots it finds, what it publishes, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.errors import ParameterError
from rosmini.core.maps import GridMap
from rosmini.core.tf import TransformListener
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch
from rosmini.sim.worlds import world
from rosmini.sim.worlds.world_map import to_map

GRID = message_class("nav_msgs/OccupancyGrid")
RATES = ("_merging_rate:=2.0", "_discovery_rate:=2.0")


def place(graph, robot, x, y, yaw=0.0):
    for key, value in {"x": x, "y": y, "z": 0.0, "yaw": yaw}.items():
        graph.master.setParam("/test", f"/{robot}/map_merge/init_pose_{key}", value)


def draw(graph, topic, cells, resolution=1.0):
    grid = GridMap(np.array(cells, dtype=np.int8), resolution, (0.0, 0.0, 0.0))
    publisher = graph.node("mapper", anonymous=True).publisher(topic, GRID, latch=True)
    publisher.publish(grid.to_message("robot"))
    return publisher


def hear(graph, topic="/map"):
    heard = []
    graph.node("ear").subscriber(topic, GRID, heard.append)
    return heard


def test_the_maps_of_all_robots_with_a_pose_are_one(graph, capsys):
    place(graph, "tb3_0", 0.0, 0.0)
    place(graph, "tb3_1", 2.0, 0.0)
    for robot in ("tb3_0", "tb3_1", "lost"):
        draw(graph, f"/{robot}/map", [[0, 100]])
    heard = hear(graph)
    rosrun("multirobot_map_merge", "map_merge", *RATES, "_world_frame:=earth", graph=graph).instance()
    graph.run(2.0)
    merged = heard[-1]
    assert merged.header.frame_id == "earth"
    assert (merged.info.width, merged.info.height) == (4, 1)
    assert list(merged.data) == [0, 100, 0, 100]
    said = capsys.readouterr()
    assert "adding robot [/tb3_1] to system" in said.out
    assert said.err.count("Couldn't get initial position for robot [/lost]") == 1
    place(graph, "lost", 5.0, 0.0)  # it is known now
    graph.run(2.0)
    assert list(heard[-1].data) == [0, 100, 0, 100, -1, 0, 100]


def test_only_robots_of_the_namespace_and_the_topic_are_taken_and_never_the_result(graph):
    for robot in ("tb3_0", "other"):
        place(graph, robot, 0.0, 0.0)
        draw(graph, f"/{robot}/map", [[0]])
    draw(graph, "/tb3_0/costmap", [[100]])
    node = rosrun("multirobot_map_merge", "map_merge", *RATES, "_robot_namespace:=tb3", graph=graph).instance()
    graph.run(2.0)
    assert list(node.robots) == ["/tb3_0"]


def test_an_update_changes_a_part(graph):
    place(graph, "tb3_0", 0.0, 0.0)
    draw(graph, "/tb3_0/map", [[0, 0, 0], [0, 0, 0]])
    kind = message_class("map_msgs/OccupancyGridUpdate")
    updates = graph.node("updates").publisher("/tb3_0/map_updates", kind)
    heard = hear(graph)
    rosrun("multirobot_map_merge", "map_merge", *RATES, graph=graph).instance()
    graph.run(1.0)
    updates.publish(kind(x=1, y=1, width=2, height=1, data=[100, 50]))
    updates.publish(kind(x=2, y=1, width=2, height=1, data=[7, 7]))  # it does not fit
    graph.run(1.0)
    assert list(heard[-1].data) == [0, 0, 0, 0, 100, 50]


def test_unknown_poses_are_refused(graph):
    with pytest.raises(ParameterError, match="does not estimate start poses"):
        rosrun("multirobot_map_merge", "map_merge", "_known_init_poses:=false", graph=graph).instance()


ROBOT = """
  <group ns="{name}">
    <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
      <arg name="model" value="burger"/> <arg name="multi_robot_name" value="{name}"/>
    </include>
  </group>
  <include file="$(find turtlebot3_gazebo)/launch/multi_turtlebot3_slam.launch">
    <arg name="ns" value="{name}"/>
  </include>
"""


@pytest.mark.nightly
def test_two_maps_by_gmapping_in_one_world_are_one(graph, tmp_path):
    """By the launch files: two robots in the room, each maps what it sees from where it stands."""
    file = tmp_path / "two.launch"
    file.write_text(f"<launch>{''.join(ROBOT.format(name=name) for name in ('tb3_0', 'tb3_1'))}</launch>", "utf-8")
    robots = "[{name: tb3_0, x: 0.0, y: 0.0}, {name: tb3_1, x: 2.0, y: 1.5, yaw: 1.5708}]"
    rosrun("rosmini_sim", "simulator", "_world:=room", f"_robots:={robots}", graph=graph).instance()
    for robot in ("tb3_0", "tb3_1"):
        graph.master.setParam("/test", f"/{robot}/turtlebot3_slam_gmapping/particles", 5)
    roslaunch(file, graph=graph)
    at = {"second_tb3_x_pos": 2.0, "second_tb3_y_pos": 1.5}
    roslaunch("turtlebot3_gazebo", "multi_map_merge.launch", graph=graph, second_tb3_yaw=1.5708, **at)
    heard = hear(graph)
    graph.run(6.0)
    merged = GridMap.from_message(heard[-1])
    truth = to_map(world("room"))
    walls = [merged.map_to_world(mx, my) for my, mx in np.argwhere(merged.occupancy == 100)]
    near = [
        truth.occupied[cell[1] - 2 : cell[1] + 3, cell[0] - 2 : cell[0] + 3].any()
        for cell in (truth.world_to_map(*at) for at in walls)
        if cell is not None
    ]
    assert len(walls) > 200
    assert sum(near) > 0.9 * len(walls)
    ear = TransformListener(graph.node("frames")).buffer
    graph.run(1.0)
    assert ear.lookup_transform("map", "tb3_1/odom").transform.translation.x == pytest.approx(2.0, abs=0.1)
