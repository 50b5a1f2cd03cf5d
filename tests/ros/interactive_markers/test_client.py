"""The client: which markers it knows after updates, gaps, and a silence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import InteractiveMarkerClient, InteractiveMarkerServer

from .conftest import marker

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

Init = message_class("visualization_msgs/InteractiveMarkerInit")
Update = message_class("visualization_msgs/InteractiveMarkerUpdate")
Pose = message_class("geometry_msgs/Pose")


def update(number: int, *names: str, **fields: Any) -> Any:
    return Update(server_id="s", seq_num=number, type=Update.UPDATE, markers=[marker(name) for name in names], **fields)


def init(number: int, *names: str) -> Any:
    return Init(server_id="s", seq_num=number, markers=[marker(name) for name in names])


@pytest.fixture
def client() -> InteractiveMarkerClient:
    return InteractiveMarkerClient()


def test_updates_before_the_full_message_wait_for_it(client: InteractiveMarkerClient) -> None:
    for number in (4, 5, 6):
        assert client.update(update(number, f"m{number}"), 0) == set()
    state = client.servers["s"]
    assert state.text(0) == (True, "Waiting for init message.")
    assert client.init(init(5, "m4", "m5"), 0) == {"m4", "m5", "m6"}
    assert (sorted(state.markers), state.seq_num) == (["m4", "m5", "m6"], 6)
    assert state.text(0) == (True, "Initialization complete.")


def test_erase_and_move(client: InteractiveMarkerClient) -> None:
    client.init(init(0, "a", "b"), 0)
    assert client.update(update(1, erases=["a"]), 0) == {"a"}
    assert list(client.servers["s"].markers) == ["b"]
    moved = message_class("visualization_msgs/InteractiveMarkerPose")(name="b")
    moved.pose.position.x = 2.0
    client.update(update(2, poses=[moved]), 0)
    assert client.servers["s"].markers["b"].pose.position.x == 2.0
    client.update(update(3, poses=[message_class("visualization_msgs/InteractiveMarkerPose")(name="z")]), 0)
    assert client.servers["s"].text(0) == (False, "Pose received for non-existing marker 'z'")


@pytest.mark.parametrize("wrong", [update(3, "b"), update(1, "b"), Update(server_id="s", seq_num=2)])
def test_after_a_gap_all_is_asked_for_again(client: InteractiveMarkerClient, wrong: Any) -> None:
    client.init(init(1, "a"), 0)
    assert client.update(wrong, 0) == {"a"}
    state = client.servers["s"]
    is_well, text = state.text(0)
    assert not is_well
    assert text.startswith("Sequence number of update is out of order. Expected: ")
    assert state.markers == {}
    client.init(init(9, "c"), 0)
    assert (list(state.markers), state.text(0)[0]) == (["c"], True)


def test_a_silent_server_is_named(client: InteractiveMarkerClient) -> None:
    client.init(init(1), 0)
    client.update(Update(server_id="s", seq_num=1), 1_000_000_000)
    assert client.servers["s"].text(2_500_000_000)[0]
    assert client.servers["s"].text(4_500_000_000) == (False, "No update received for 4 seconds.")


def test_it_follows_a_server_however_late_it_comes(graph: Graph, client: InteractiveMarkerClient) -> None:
    server = InteractiveMarkerServer(graph.node("node"), "basic")
    server.insert(marker("a"))
    server.applyChanges()
    rviz = graph.node("rviz")
    rviz.subscriber("basic/update", Update, lambda message: client.update(message, 0))
    rviz.subscriber("basic/update_full", Init, lambda message: client.init(message, 0))
    graph.run(0.1)
    for name in ("b", "c"):
        server.insert(marker(name))
        server.applyChanges()
    server.erase("a")
    server.applyChanges()
    graph.run(2.0)
    assert sorted(client.servers["/node"].markers) == ["b", "c"]
    assert client.servers["/node"].problem == ""
