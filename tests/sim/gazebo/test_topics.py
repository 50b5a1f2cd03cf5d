"""Gazebo's own Master lists programs and topics, apart from ROS."""

import pytest

from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.server import GazeboServer


@pytest.fixture
def master(graph):
    return GazeboServer(graph.node("gazebo"), "empty").master


def test_the_master_lists_publishers_and_subscribers(master):
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


def test_a_space_in_the_name_of_a_world_is_an_underscore(graph):
    world = '<sdf version="1.6"><world name="my world"/></sdf>'
    from rosmini.sim import sdf

    master = GazeboServer(graph.node("gazebo"), world=sdf.load(world).worlds[0]).master
    assert "/gazebo/my_world/factory" in master.topics()
    assert master.resolve("~/factory") == "/gazebo/my_world/factory"


def test_two_servers_cannot_have_one_address(graph, monkeypatch):
    first = GazeboServer(graph.node("gazebo"), "empty")
    with pytest.raises(GazeboError, match=r"Address already in use.*GAZEBO_MASTER_URI"):
        GazeboServer(graph.node("gazebo2"), "empty")
    monkeypatch.setenv("GAZEBO_MASTER_URI", "http://localhost:11346")
    GazeboServer(graph.node("gazebo3"), "empty")
    monkeypatch.delenv("GAZEBO_MASTER_URI")
    first.node.shutdown("enough")
    GazeboServer(graph.node("gazebo4"), "empty")
