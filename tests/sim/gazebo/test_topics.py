"""Gazebo's own Master lists programs and topics, apart from ROS."""

from __future__ import annotations

import pytest

from rosmini import Graph
from rosmini.sim.gazebo import GazeboError, GazeboMaster
from rosmini.sim.gazebo.server import GazeboServer
from rosmini.sim.gazebo.topics import WorldStatistics


@pytest.fixture
def master(graph: Graph) -> GazeboMaster:
    return GazeboServer(graph.node("gazebo"), "empty").master


def test_the_master_lists_publishers_and_subscribers(master: GazeboMaster) -> None:
    master.join("gzclient")
    info = master.info("/gazebo/empty/world_stats")
    assert info.type == "gazebo.msgs.WorldStatistics"
    assert (info.publishers, info.subscribers) == (("gzserver",), ("gzclient",))
    assert info.publisher_addresses == ("127.0.0.1:49152",)
    assert info.subscriber_addresses == ("127.0.0.1:49153",)
    assert master.info(master.resolve("~/request")).publishers == ("gzserver", "gzclient")
    with pytest.raises(GazeboError, match="did you mean"):
        master.info("/gazebo/empty/world_stat")
    master.leave("gzclient")
    master.leave("gzclient")
    assert master.info("/gazebo/empty/world_stats").subscribers == ()


def test_ros_does_not_know_the_topics(graph: Graph, master: GazeboMaster) -> None:
    assert "/gazebo/empty/world_stats" in master.topics()
    assert "/gazebo/empty/world_stats" not in dict(graph.master.getTopicTypes("/me")[2])


def test_a_space_in_the_name_of_a_world_is_an_underscore(graph: Graph) -> None:
    world = '<sdf version="1.6"><world name="my world"/></sdf>'
    from rosmini.sim import sdf

    master = GazeboServer(graph.node("gazebo"), world=sdf.load(world).worlds[0]).master
    assert "/gazebo/my_world/factory" in master.topics()
    assert master.resolve("~/factory") == "/gazebo/my_world/factory"


def test_statistics_print_as_gazebo_prints_them() -> None:
    text = str(WorldStatistics(1.25, 1.25, False, 1250, 2)).splitlines()
    assert text[:4] == ["sim_time {", "  sec: 1", "  nsec: 250000000", "}"]
    assert "paused: false" in text
    assert text[-1] == "model_count: 2"


def test_two_servers_cannot_have_one_address(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    first = GazeboServer(graph.node("gazebo"), "empty")
    with pytest.raises(GazeboError, match=r"Address already in use.*GAZEBO_MASTER_URI"):
        GazeboServer(graph.node("gazebo2"), "empty")
    monkeypatch.setenv("GAZEBO_MASTER_URI", "http://localhost:11346")
    GazeboServer(graph.node("gazebo3"), "empty")
    monkeypatch.delenv("GAZEBO_MASTER_URI")
    first.node.shutdown("enough")
    GazeboServer(graph.node("gazebo4"), "empty")
