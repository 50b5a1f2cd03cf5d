"""The server of interactive markers: what it publishes, whom it listens to, what it calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import InteractiveMarkerServer

from .conftest import marker

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

Feedback = message_class("visualization_msgs/InteractiveMarkerFeedback")
Init = message_class("visualization_msgs/InteractiveMarkerInit")
Pose = message_class("geometry_msgs/Pose")
Update = message_class("visualization_msgs/InteractiveMarkerUpdate")


def pose(x: float) -> Any:
    made = Pose()
    made.position.x = x
    return made


class Rviz:
    """Hears what a server says, and answers as one of several users."""

    def __init__(self, graph: Graph, name: str = "rviz") -> None:
        node = graph.node(name)
        self.graph, self.name = graph, name
        self.updates: list[Any] = []
        self.inits: list[Any] = []
        node.subscriber("basic/update", Update, self.updates.append)
        node.subscriber("basic/update_full", Init, self.inits.append)
        self.publisher = node.publisher("basic/feedback", Feedback)
        graph.run(0.1)

    def says(self, event: int, name: str = "box", x: float = 0.0) -> None:
        self.publisher.publish(Feedback(client_id=self.name, marker_name=name, event_type=event, pose=pose(x)))
        self.graph.run(0.01)

    def changes(self) -> list[Any]:
        return [update for update in self.updates if update.type == Update.UPDATE]


@pytest.fixture
def server(graph: Graph) -> InteractiveMarkerServer:
    return InteractiveMarkerServer(graph.node("node"), "basic", "/one")


def test_changes_are_numbered_and_seen_when_they_are_applied(graph: Graph, server: InteractiveMarkerServer) -> None:
    rviz = Rviz(graph)
    server.insert(marker())
    graph.run(0.1)
    assert rviz.changes() == []
    server.applyChanges()
    server.setPose("box", pose(2.0))
    server.applyChanges()
    server.applyChanges()
    server.erase("box")
    server.applyChanges()
    graph.run(0.1)
    added, moved, erased = rviz.changes()
    assert [update.seq_num for update in (added, moved, erased)] == [1, 2, 3]
    assert added.server_id == "/node/one"
    assert [one.name for one in added.markers] == ["box"]
    assert [(one.name, one.pose.position.x, one.header.frame_id) for one in moved.poses] == [("box", 2, "base")]
    assert list(erased.erases) == ["box"]
    assert rviz.inits[-1].markers == []


def test_who_comes_later_gets_all_markers_as_of_a_number(graph: Graph, server: InteractiveMarkerServer) -> None:
    for number, name in enumerate("ab"):
        server.insert(marker(name, x=float(number)))
        server.applyChanges()
    server.insert(marker("not yet"))
    (init,) = Rviz(graph).inits
    assert (init.seq_num, [one.name for one in init.markers]) == (2, ["a", "b"])


def test_twice_a_second_it_says_that_it_lives(graph: Graph, server: InteractiveMarkerServer) -> None:
    server.insert(marker())
    server.applyChanges()
    rviz = Rviz(graph)
    graph.run(2.0)
    assert [(one.type, one.seq_num) for one in rviz.updates] == [(Update.KEEP_ALIVE, 1)] * 4


def test_feedback_moves_the_marker_and_calls_what_is_set_for_its_type(
    graph: Graph, server: InteractiveMarkerServer
) -> None:
    called: list[Any] = []
    server.insert(marker(), lambda one: called.append(("any", one.event_type, one.pose.position.x)))
    server.setCallback("box", lambda one: called.append(("click", one.client_id)), Feedback.BUTTON_CLICK)
    server.applyChanges()
    rviz = Rviz(graph)
    graph.run(1.0)
    rviz.says(Feedback.POSE_UPDATE, x=3.0)
    rviz.says(Feedback.BUTTON_CLICK)
    rviz.says(Feedback.MOUSE_UP, name="no such marker")
    assert called == [("any", Feedback.POSE_UPDATE, 3.0), ("click", "rviz")]
    assert server.get("box").pose.position.x == 3.0
    assert len(rviz.changes()) == 0
    server.applyChanges()
    server.setCallback("box", None, Feedback.BUTTON_CLICK)
    server.setCallback("box", None)
    rviz.says(Feedback.BUTTON_CLICK)
    assert len(called) == 2
    assert [one.name for one in rviz.changes()[0].poses] == ["box"]


def test_a_marker_in_use_is_not_taken_by_another_client(graph: Graph, server: InteractiveMarkerServer) -> None:
    called: list[str] = []
    server.insert(marker(), lambda one: called.append(one.client_id))
    server.applyChanges()
    one, other = Rviz(graph, "one"), Rviz(graph, "other")
    one.says(Feedback.MOUSE_DOWN)
    assert called == []
    graph.run(1.0)
    one.says(Feedback.MOUSE_DOWN)
    other.says(Feedback.MOUSE_DOWN)
    graph.run(0.9)
    one.says(Feedback.KEEP_ALIVE)
    graph.run(0.9)
    other.says(Feedback.MOUSE_DOWN)
    assert called == ["one", "one"]
    graph.run(1.0)
    other.says(Feedback.MOUSE_DOWN)
    assert called == ["one", "one", "other"]


def test_pose_of_a_stamped_marker_comes_with_the_header_of_the_feedback(
    graph: Graph, server: InteractiveMarkerServer
) -> None:
    fixed, follows = marker("fixed"), marker("follows")
    fixed.header.stamp = graph.now()
    for one in (fixed, follows):
        server.insert(one)
    server.applyChanges()
    graph.run(1.0)
    for name in ("fixed", "follows"):
        feedback = Feedback(client_id="", marker_name=name, event_type=Feedback.POSE_UPDATE)
        feedback.header.frame_id = "map"
        server.processFeedback(feedback)
    server.applyChanges()
    frames = [server.get(name).header.frame_id for name in ("fixed", "follows")]
    assert frames == ["map", "base"]


def test_what_is_not_there_is_answered_with_false(server: InteractiveMarkerServer) -> None:
    assert not server.setPose("box", pose(1.0))
    assert not server.erase("box")
    assert not server.setCallback("box", print)
    assert server.get("box") is None
    server.insert(marker())
    assert not server.setPose("box", pose(1.0))
    assert server.erase("box")
    assert not server.setPose("box", pose(1.0))
    server.applyChanges()
    assert server.get("box") is None


def test_clear_forgets_what_was_to_change_and_erases_the_rest(server: InteractiveMarkerServer) -> None:
    server.insert(marker("a"))
    server.applyChanges()
    server.insert(marker("b"))
    server.clear()
    assert server.get("a") is None
    assert server.get("b") is None
