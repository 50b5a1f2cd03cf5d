"""The graph of which the tests of hostile peers want nothing but that it goes on."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import pytest

from rosmini.core.graph import Graph
from rosmini.ros.net.network import tcp

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture
def graph() -> Iterator[Graph]:
    """A graph whose nodes know only the network; it leaves no thread behind."""
    made = Graph(simulated=False, strict=False, transports=[tcp()])
    yield made
    made.shutdown("the test is over")
    assert not any(thread.name == "rosmini-net" for thread in threading.enumerate())
