"""The server of interactive markers on its topics; what it does call by call is compared with the real one's."""

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


@pytest.fixture
def server(graph: Graph) -> InteractiveMarkerServer:
    return InteractiveMarkerServer(graph.node("node"), "basic", "/one")


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
