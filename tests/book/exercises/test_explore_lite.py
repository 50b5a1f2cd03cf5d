"""The chapter explore_lite: the robot stops exploring by itself, as the text says."""

from __future__ import annotations

from .conftest import printed


def test_it_ends_by_itself_as_the_text_says(cells):
    assert "Exploration stopped." in printed(cells, "rosmini.wait(34)")


def test_costs_as_the_text_says(cells):
    assert printed(cells, "def cost").strip().splitlines()[-1].endswith("-2.10")
    best = [line.rpartition(": ")[2] for line in printed(cells, "best = min").strip().splitlines()]
    assert best[0] == "a hall"
    assert best[-1] != "a hall"
