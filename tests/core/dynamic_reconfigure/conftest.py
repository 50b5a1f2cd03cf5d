"""A graph in each clock, and a description in the form of a .cfg module's dictionary."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.graph import Graph

if TYPE_CHECKING:
    from collections.abc import Iterator


def number(name: str, kind: str = "double", **about: Any) -> dict[str, Any]:
    return {"name": name, "type": kind, "level": 1, "description": f"the {name}", **about}


TREE: dict[str, Any] = {
    "name": "Default",
    "parameters": [number("gain", default=1.5, min=0.0, max=10.0), number("mode", "str", level=4, default="slow")],
    "groups": [
        {
            "name": "Filter",
            "type": "collapse",
            "state": False,
            "parameters": [number("window", "int", level=2, default=5, min=1, max=99), number("on", "bool", level=8)],
            "groups": [{"name": "Deep", "parameters": [number("depth", level=16, min=-1.0)], "groups": []}],
        }
    ],
}


@pytest.fixture(params=[True, False], ids=["simulated", "wall"])
def graph(request: pytest.FixtureRequest) -> Iterator[Graph]:
    made = Graph(simulated=request.param, strict=False, rate=1.0 if request.param else 20.0)
    made.notebook = False
    yield made
    made.shutdown("the test is over")


@pytest.fixture
def sim() -> Iterator[Graph]:
    made = Graph(strict=False)
    made.notebook = False
    yield made
    made.shutdown("the test is over")
