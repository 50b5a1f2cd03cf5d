"""A graph in simulated time, and markers to show."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Iterator

InteractiveMarker = message_class("visualization_msgs/InteractiveMarker")
InteractiveMarkerControl = message_class("visualization_msgs/InteractiveMarkerControl")


@pytest.fixture
def graph() -> Iterator[Graph]:
    made = Graph(strict=False)
    made.notebook = False
    yield made
    made.shutdown("the test is over")


def marker(name: str = "box", *modes: int, x: float = 0.0) -> Any:
    """A marker at (x, 0, 0) in the frame base with a control for each interaction mode."""
    made = InteractiveMarker(name=name, description=f"the {name}")
    made.header.frame_id = "base"
    made.pose.position.x = x
    made.controls = [InteractiveMarkerControl(interaction_mode=mode) for mode in modes]
    return made
