"""Fixtures of the simulator's tests."""

import pytest

from rosmini.core.graph import Graph


@pytest.fixture
def graph():
    """A graph in simulated time."""
    with Graph() as made:
        yield made
