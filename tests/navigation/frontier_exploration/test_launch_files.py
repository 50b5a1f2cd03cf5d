"""Exploration as the report's chapter 9 starts it, by launch files, from the first scan until it ends by itself."""

from __future__ import annotations

import io

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.core.maps import GridMap, save_map
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch

LAUNCH = """<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="world" value="{world}"/> <param name="model" value="burger"/> <param name="board" value="false"/>
    <param name="x" value="-1.0"/> <param name="y" value="-0.7"/>
  </node>
  {more}
</launch>"""
STACK = """
  <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch"/>
  <include file="$(find turtlebot3_slam)/launch/turtlebot3_gmapping.launch"/>
  <include file="$(find turtlebot3_navigation)/launch/move_base.launch"/>
"""
AREA = ((-1.3, -1.1), (3.3, -1.1), (3.3, 2.5), (-1.3, 2.5), (-1.3, -1.0), (0.5, 0.5))
"""Clicks around the flat, in a map that begins where the robot stands."""
SETTINGS = {"particles": 5, "linearUpdate": 0.3, "xmin": -2.0, "xmax": 2.0, "ymin": -2.0, "ymax": 2.0}


@pytest.fixture
def graph(monkeypatch):
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    with Graph(strict=False, seed=2) as graph:
        yield graph


class Trial:
    """A robot in the lower left of a flat of 4 m x 3 m: two rooms with a door between."""

    def __init__(self, graph, folder, more):
        cells = np.full((60, 80), 100, dtype=np.int8)
        cells[1:-1, 1:-1] = 0
        cells[:36, 39:41] = 100
        file, _ = save_map(GridMap(cells, 0.05, (-2.0, -1.5, 0.0), folder / "flat.yaml"), folder / "flat")
        self.graph, self.free = graph, int((cells == 0).sum())
        self.logs, self.maps = [], []
        ear = graph.node("ear")
        ear.subscriber("/rosout", message_class("rosgraph_msgs/Log"), self.logs.append)
        ear.subscriber("/map", message_class("nav_msgs/OccupancyGrid"), self.maps.append)
        self.clicks = ear.publisher("/clicked_point", message_class("geometry_msgs/PointStamped"))
        self.folder = folder
        self.launch("first.launch", LAUNCH.format(world=file, more=more))

    def launch(self, name, text):
        file = self.folder / name
        file.write_text(text, encoding="utf-8")
        said = io.StringIO()
        roslaunch(str(file), graph=self.graph, console={"stdout": said, "stderr": said})

    def click(self, *points):
        for x, y in points:
            message = message_class("geometry_msgs/PointStamped")()
            message.header.frame_id, message.point.x, message.point.y = "map", x, y
            self.clicks.publish(message)
            self.graph.run(0.2)

    def said(self, text):
        return [log.msg for log in self.logs if text in log.msg]

    def run(self, text, limit=200):
        """Let time pass until somebody says this."""
        for _ in range(limit):
            self.graph.run(1.0)
            if self.said(text):
                return True
        return False

    @property
    def share(self):
        """Of the flat's free cells, how many are in the map."""
        return (np.asarray(self.maps[-1].data) == 0).sum() / self.free


def with_settings(text):
    return text + "".join(
        f'<param name="/turtlebot3_slam_gmapping/{name}" value="{value}"/>' for name, value in SETTINGS.items()
    )


@pytest.mark.nightly  # chapter 72 does it at each commit
def test_explore_lite_ends_by_itself(graph, tmp_path):
    lite = '<include file="$(find explore_lite)/launch/explore.launch"/>'
    trial = Trial(graph, tmp_path, with_settings(STACK + lite))
    assert trial.run("Exploration stopped.")
    assert trial.share > 0.95
    assert graph.nodes["/explore"].program.sent >= 1


@pytest.mark.nightly
def test_frontier_exploration_ends_by_itself_and_the_older_nodes_are_ended(graph, tmp_path):
    trial = Trial(graph, tmp_path, with_settings(STACK))
    graph.run(3.0)
    older = {name: graph.nodes[name] for name in ("/move_base", "/turtlebot3_slam_gmapping")}
    again = '<arg name="slam_methods" value="frontier_exploration"/><arg name="open_rviz" value="false"/>'
    file = "$(find turtlebot3_slam)/launch/turtlebot3_slam.launch"
    trial.launch("second.launch", with_settings(f'<launch><include file="{file}">{again}</include>') + "</launch>")
    graph.run(6.0)
    for name, node in older.items():
        assert node.is_shutdown(), "the Master lets the newer of two nodes of one name live"
        assert graph.nodes[name] is not node
    assert trial.said("Request for map failed; trying again..."), "amcl waits for a map that nobody serves"
    trial.click(*AREA)
    assert trial.run("Finished exploring room"), trial.said("Failed")
    assert trial.share > 0.9
