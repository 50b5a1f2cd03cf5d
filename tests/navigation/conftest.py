"""Fixtures of navigation's tests."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from rosmini.core.graph import Graph, Node

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture
def graph() -> Iterator[Graph]:
    """A graph in simulated time."""
    with Graph() as made:
        yield made


@pytest.fixture
def node(graph: Graph) -> Node:
    """The node of move_base, for plugins."""
    return graph.node("move_base")
