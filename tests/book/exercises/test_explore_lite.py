"""The chapter explore_lite: its cells show what the text says."""

from __future__ import annotations

import re

from .conftest import printed


def test_it_ends_by_itself_as_the_text_says(cells):
    assert "Exploration stopped." in printed(cells, "%roslaunch explore_lite")


def test_the_kitchen_is_cheapest_and_the_store_room_nearest(cells):
    costs = re.findall(r"([\d.]+) m away: cost (\S+)", printed(cells, "def cost"))
    assert min(costs, key=lambda one: float(one[1])) == costs[0]
    assert min(float(distance) for distance, _ in costs) == 1.3
    best = printed(cells, "best = min").strip().splitlines()
    assert "2.1 m away" in best[0]
    assert "1.3 m away" in best[-1]


def test_a_cancelled_robot_stops(cells):
    assert "\n0.0\n" in printed(cells, "%rosnode kill /explore")
