"""`map_server/map_saver`: one map of a topic, into files."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.core.errors import UsageError
from rosmini.core.graph import Graph
from rosmini.core.maps import GridMap, load_map, save_map
from rosmini.msgs import message_class
from rosmini.navigation.map_server.node import MapServer
from rosmini.navigation.map_server.saver_node import MapSaver, SaverOptions
from rosmini.ros.scripts import rosrun

CELLS = np.array([[0, 100, -1], [30, 0, 70]], dtype=np.int8)
OccupancyGrid = message_class("nav_msgs/OccupancyGrid")


@pytest.fixture
def graph(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = Graph()
    made.said = []
    made.node("log").subscriber(
        "/rosout", message_class("rosgraph_msgs/Log"), lambda log: made.said.append((log.name, log.msg))
    )
    return made


def publish(graph, message, topic="/map"):
    graph.node("mapper").publisher(topic, OccupancyGrid, latch=True, queue_size=1).publish(message)
    graph.run(0.1)


def test_it_waits_for_a_map_writes_it_and_ends(graph, tmp_path):
    node = graph.node("map_saver")
    saver = MapSaver(node, "-f", "house")
    graph.run(5.0)
    assert node.shutdown_reason is None
    publish(graph, GridMap(CELLS, 0.05, (1.0, -2.0, 0.5)).to_message())
    assert node.shutdown_reason is not None
    assert [str(path) for path in saver.paths] == ["house.yaml", "house.pgm"]
    read = load_map(tmp_path / "house.yaml")
    assert read.occupancy.tolist() == [[0, 100, -1], [-1, 0, 100]]
    assert read.origin == (1.0, -2.0, 0.5)
    assert [text for name, text in graph.said if name == "/map_saver"] == [
        "Waiting for the map",
        "Received a 3 X 2 map @ 0.050 m/pix",
        "Writing map occupancy data to house.pgm",
        "Writing map occupancy data to house.yaml",
        "Done\n",
    ]


def test_it_is_started_as_in_a_terminal(graph, tmp_path):
    publish(graph, GridMap(CELLS, 0.05, (0.0, 0.0, 0.0)).to_message(), "/some/map")
    handle = rosrun("map_server", "map_saver", "--occ", "80", "--free", "35", "map:=/some/map", graph=graph)
    assert handle.wait(5.0) == 0
    assert load_map(tmp_path / "map.yaml").occupancy.tolist() == [[0, 100, -1], [0, 0, -1]]


def test_what_a_server_serves_is_saved_as_it_was(graph, tmp_path):
    yaml, image = save_map(GridMap(np.array([[0, 100], [-1, 0]], dtype=np.int8), 0.05, (1.0, -2.0, 0.5)), "one")
    MapServer(graph.node("map_server"), str(yaml))
    handle = rosrun("map_server", "map_saver", "-f", "two", graph=graph)
    assert handle.wait(5.0) == 0
    assert (tmp_path / "two.pgm").read_bytes() == image.read_bytes()
    assert (tmp_path / "two.yaml").read_text(encoding="utf-8") == yaml.read_text(encoding="utf-8").replace("one", "two")


def test_a_file_that_cannot_be_written_ends_it_with_a_reason(graph):
    publish(graph, GridMap(CELLS, 0.05, (0.0, 0.0, 0.0)).to_message())
    handle = rosrun("map_server", "map_saver", "-f", "nowhere/house", graph=graph)
    assert handle.wait(5.0) == 1
    assert any("Couldn't save map file to nowhere" in text for _, text in graph.said)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--occ 0", "threshold_occupied must be between 1 and 100, not 0"),
        ("--occ 101", "threshold_occupied must be between 1 and 100"),
        ("--free -1", "threshold_free must be between 0 and 100"),
        ("--occ 30 --free 30", "threshold_free must be smaller than threshold_occupied, and 30 is not below 30"),
        ("--occ many", "threshold_occupied is 'many'"),
        ("-f", "Usage:"),
        ("house", "Usage:"),
        ("-x house", "Usage:"),
    ],
)
def test_a_command_line_that_makes_no_sense_is_told(words, said):
    with pytest.raises(UsageError, match=said):
        SaverOptions.of(tuple(words.split()))
