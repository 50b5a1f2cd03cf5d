"""A graph that ends with the test."""

import pytest

from rosmini import Graph


@pytest.fixture
def graph():
    with Graph() as graph:
        yield graph
