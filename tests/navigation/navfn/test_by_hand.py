"""Searches made by hand, replayed: cells, costs, path, and what does not fit."""

from __future__ import annotations

import pytest

from rosmini.core.errors import RosminiError
from rosmini.navigation.nav_core import PlanningFailure
from rosmini.navigation.navfn import HandSearch

PRICE = {(x, y): 3 if x == 1 else 1 for x in range(4) for y in range(2) if (x, y) != (2, 0)}
"""Four columns of two cells; (2, 0) is a wall, and column 1 is dear."""
TAKEN = [(0, 0), (0, 1), (1, 0), (1, 1), (2, 1), (3, 1)]
COST = {(0, 0): 0, (0, 1): 1, (1, 0): 3, (1, 1): 4, (2, 1): 5, (3, 1): 6, (3, 0): 7}
PARENT = {(0, 1): (0, 0), (1, 0): (0, 0), (1, 1): (0, 1), (2, 1): (1, 1), (3, 1): (2, 1), (3, 0): (3, 1)}


def made(goal: tuple[int, int] = (3, 1), **changes: object) -> HandSearch:
    found = {"taken": TAKEN, "cost": COST, "parent": PARENT} | changes
    return HandSearch(PRICE, (0, 0), goal, **found)


def test_it_is_stepped_cell_by_cell():
    search = made()
    assert search.frontier.tolist() == [[0, 0]]
    assert not search.expand(2)
    assert search.expanded == 2
    assert search.potential[:, :2].tolist() == [[0, 3], [1, 4]]
    assert sorted(search.frontier.tolist()) == [[1, 0], [1, 1]]
    assert int(search.reached.sum()) == 4
    assert search.expand()
    assert search.arrived and search.expanded == 6


def test_the_path_goes_from_parent_to_parent():
    assert made().path().tolist() == [[0, 0], [0, 1], [1, 1], [2, 1], [3, 1]]


def test_one_without_the_goal_fails_as_others_do():
    search = made((3, 0), taken=TAKEN[:3], cost=dict(list(COST.items())[:4]))
    search.expand()
    assert search.finished and not search.arrived
    with pytest.raises(PlanningFailure):
        search.path()


def test_what_does_not_fit_is_refused():
    with pytest.raises(RosminiError, match=r"the cell \(9, 9\)"):
        made(taken=[*TAKEN, (9, 9)])
    with pytest.raises(RosminiError, match=r"the cell \(0, 1\)"):
        made(parent={})
    ring = PARENT | {(0, 1): (1, 1)}
    with pytest.raises(RosminiError, match="form a loop"):
        made(parent=ring, taken=TAKEN[::-1]).path()
