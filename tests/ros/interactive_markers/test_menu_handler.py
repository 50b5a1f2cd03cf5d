"""What context menus answer for what is not there; `tests/interop/interactive_markers_peer.py` compares the rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from rosmini.ros.interactive_markers import InteractiveMarkerException, InteractiveMarkerServer, MenuHandler

from .conftest import marker

if TYPE_CHECKING:
    from rosmini.core.graph import Graph


@pytest.fixture
def server(graph: Graph) -> InteractiveMarkerServer:
    made = InteractiveMarkerServer(graph.node("node"), "basic")
    made.insert(marker("box"))
    made.applyChanges()
    return made


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
