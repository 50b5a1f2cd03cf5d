"""Context menus: entries below entries, boxes, what is hidden, and what is called."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import InteractiveMarkerException, InteractiveMarkerServer, MenuHandler

from .conftest import marker

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

Feedback = message_class("visualization_msgs/InteractiveMarkerFeedback")


@pytest.fixture
def server(graph: Graph) -> InteractiveMarkerServer:
    made = InteractiveMarkerServer(graph.node("node"), "basic")
    made.insert(marker("box"))
    made.applyChanges()
    return made


def lines(server: InteractiveMarkerServer) -> list[tuple[int, int, str]]:
    return [(one.id, one.parent_id, one.title) for one in server.get("box").menu_entries]


def test_a_tree_with_boxes_each_entry_before_those_below_it(server: InteractiveMarkerServer) -> None:
    menu = MenuHandler()
    launch = menu.insert("Launch")
    mode = menu.insert("Mode")
    fast = menu.insert("Fast", parent=mode)
    menu.insert("Now", parent=launch)
    assert menu.setCheckState(fast or 0, MenuHandler.CHECKED)
    assert menu.apply(server, "box")
    assert lines(server) == [(1, 0, "Launch"), (4, 1, "Now"), (2, 0, "Mode"), (3, 2, "[x] Fast")]
    menu.setCheckState(3, MenuHandler.UNCHECKED)
    menu.setVisible(1, visible=False)
    assert menu.reApply(server)
    assert lines(server) == [(2, 0, "Mode"), (3, 2, "[ ] Fast")]
    assert (menu.getTitle(3), menu.getCheckState(3)) == ("Fast", MenuHandler.UNCHECKED)


def test_the_entry_that_is_chosen_is_called(graph: Graph, server: InteractiveMarkerServer) -> None:
    called: list[Any] = []
    menu = MenuHandler()
    menu.insert("Quiet")
    menu.insert("Loud", callback=lambda feedback: called.append(feedback.menu_entry_id))
    menu.apply(server, "box")
    graph.run(1.5)
    for entry in (1, 2, 9):
        server.processFeedback(Feedback(marker_name="box", event_type=Feedback.MENU_SELECT, menu_entry_id=entry))
    assert called == [2]


def test_what_is_not_there_is_said(server: InteractiveMarkerServer) -> None:
    menu = MenuHandler()
    with pytest.raises(InteractiveMarkerException, match="no entry 7, below which 'Low' was to be"):
        menu.insert("Low", parent=7)
    assert not menu.setVisible(7, visible=True)
    assert not menu.setCheckState(7, MenuHandler.CHECKED)
    assert menu.getTitle(7) is None
    assert menu.getCheckState(7) is None
    assert not menu.apply(server, "no such marker")
    assert menu.apply(server, "box")
    server.erase("box")
    assert not menu.reApply(server)
    assert menu.reApply(server)
