"""Gazebo's own Master is a server of names, and data goes past it."""

from __future__ import annotations

import pytest

from rosmini import Graph
from rosmini.graph.master import Master
from rosmini.sim.gazebo import GazeboError, GazeboMaster, TransportNode
from rosmini.sim.gazebo.msgs import Time, WorldStatistics, quaternion
from rosmini.sim.gazebo.server import GazeboServer


def stats(seconds: float) -> WorldStatistics:
    return WorldStatistics(Time.of(seconds), Time(), Time.of(seconds), False, round(seconds * 1000), 2)


@pytest.fixture
def master(graph: Graph) -> GazeboMaster:
    return GazeboMaster(graph, "http://localhost:11345", "/gazebo", "default")


def test_the_order_of_publisher_and_subscriber_does_not_matter(graph: Graph, master: GazeboMaster) -> None:
    server, client = TransportNode(master, "server"), TransportNode(master, "client")
    early: list[WorldStatistics] = []
    late: list[WorldStatistics] = []
    client.subscribe("~/world_stats", early.append)
    publisher = server.advertise("~/world_stats", WorldStatistics)
    client.subscribe("/gazebo/default/world_stats", late.append)
    graph.run(0.0)
    publisher.publish(stats(1.5))
    graph.run(0.0)
    assert early == late == [stats(1.5)]


def test_the_master_tells_who_publishes_and_who_hears(master: GazeboMaster) -> None:
    server, client = TransportNode(master, "server"), TransportNode(master, "client")
    server.advertise("~/world_stats", WorldStatistics)
    client.subscribe("~/world_stats", print)
    info = master.info("/gazebo/default/world_stats")
    assert info.type == "gazebo.msgs.WorldStatistics"
    assert (info.publishers, info.subscribers) == (("server",), ("client",))
    assert info.publisher_addresses == ("127.0.0.1:49152",)
    assert info.subscriber_addresses == ("127.0.0.1:49153",)
    assert master.topics() == {"/gazebo/default/world_stats": "gazebo.msgs.WorldStatistics"}
    with pytest.raises(GazeboError, match="did you mean"):
        master.info("/gazebo/default/world_stat")


def test_it_is_a_master_as_ros_has_one_and_knows_nothing_of_ross(graph: Graph, master: GazeboMaster) -> None:
    server = TransportNode(master, "server")
    server.advertise("~/world_stats", WorldStatistics)
    assert isinstance(master, Master)
    assert master.getSystemState("/me")[2] == [[["/gazebo/default/world_stats", ["127.0.0.1:49152"]]], [], []]
    assert master.lookupNode("/me", "/rosout")[0] == -1
    assert "/gazebo/default/world_stats" not in dict(graph.master.getTopicTypes("/me")[2])


def test_what_is_published_does_not_go_through_the_master(graph: Graph, master: GazeboMaster) -> None:
    server, client = TransportNode(master, "server"), TransportNode(master, "client")
    heard: list[WorldStatistics] = []
    publisher = server.advertise("~/world_stats", WorldStatistics)
    client.subscribe("~/world_stats", heard.append)
    master.__dict__.clear()  # a Master that is gone
    publisher.publish(stats(2.0))
    graph.run(0.0)
    assert len(heard) == 1


def test_who_left_hears_no_more(graph: Graph, master: GazeboMaster) -> None:
    server, client = TransportNode(master, "server"), TransportNode(master, "client")
    heard: list[WorldStatistics] = []
    publisher = server.advertise("~/world_stats", WorldStatistics)
    client.subscribe("~/world_stats", heard.append)
    client.close()
    client.close()
    assert not publisher.heard
    publisher.publish(stats(2.0))
    graph.run(0.0)
    assert not heard
    server.close()
    assert master.topics() == {}


def test_a_publisher_that_comes_back_is_heard_again(graph: Graph, master: GazeboMaster) -> None:
    server, client = TransportNode(master, "server"), TransportNode(master, "client")
    heard: list[Time] = []
    client.subscribe("~/time", heard.append)
    for second in range(2):
        publisher = server.advertise("~/time", Time)
        graph.run(0.0)
        publisher.publish(Time(second))
        publisher.close()
        graph.run(0.0)
    assert heard == [Time(0), Time(1)]


def test_types_have_to_agree(master: GazeboMaster) -> None:
    node = TransportNode(master, "a")
    publisher = node.advertise("~/time", Time)
    with pytest.raises(GazeboError, match=r"is a topic of gazebo\.msgs\.Time"):
        publisher.publish(stats(0.0))  # type: ignore[arg-type]
    with pytest.raises(GazeboError, match=r"a publishes /gazebo/default/time as gazebo\.msgs\.Time"):
        TransportNode(master, "b").advertise("~/time", WorldStatistics)


def test_names_of_worlds_and_models_make_names_of_topics(graph: Graph) -> None:
    node = TransportNode(GazeboMaster(graph, "http://localhost:11345", "/gazebo", "my world"), "server")
    node.advertise("~/a robot/arm::link/scan", Time)
    assert list(node.master.topics()) == ["/gazebo/my_world/a_robot/arm/link/scan"]


def test_messages_print_as_gz_prints_them() -> None:
    text = str(stats(1.25)).splitlines()
    assert text[:4] == ["sim_time {", "  sec: 1", "  nsec: 250000000", "}"]
    assert "paused: false" in text
    assert text[-1] == "model_count: 2"


def test_quaternions_of_single_turns() -> None:
    half = 0.5**0.5
    assert quaternion(0, 0, 3.141592653589793 / 2) == pytest.approx((0, 0, half, half))
    assert quaternion(3.141592653589793 / 2, 0, 0) == pytest.approx((half, 0, 0, half))


def test_two_servers_cannot_have_one_address(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    first = GazeboServer(graph.node("gazebo"), "empty")
    with pytest.raises(GazeboError, match=r"Address already in use.*GAZEBO_MASTER_URI"):
        GazeboServer(graph.node("gazebo2"), "empty")
    monkeypatch.setenv("GAZEBO_MASTER_URI", "http://localhost:11346")
    GazeboServer(graph.node("gazebo3"), "empty")
    monkeypatch.delenv("GAZEBO_MASTER_URI")
    first.node.shutdown("enough")
    GazeboServer(graph.node("gazebo4"), "empty")
