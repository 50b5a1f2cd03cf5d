"""A stage to explore on."""

from __future__ import annotations

import pytest

from rosmini.core.graph import Graph
from tests.navigation.exploring import Stage


@pytest.fixture
def stage():
    with Graph(strict=False) as graph:
        yield Stage(graph)
