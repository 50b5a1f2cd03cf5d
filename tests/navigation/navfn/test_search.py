"""navfn's potential and path."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.nav_core import GoalBlocked, NoPath, OutsideMap, PlanningFailure
from rosmini.navigation.nav_core.failures import StartBlocked
from rosmini.navigation.navfn.search import NavfnSearch, WaveSearch, navfn_table
from rosmini.navigation.navfn.wave import HIGH

from ..grids import crossed, fixed_point, grids, shortest


def test_costs_are_translated_as_in_navfn():
    table = navfn_table(allow_unknown=True)
    assert [table[c] for c in (0, 1, 99, 252, 253, 254, 255)] == [50, 50, 129, 251, np.inf, np.inf, 253]
    assert navfn_table(allow_unknown=False)[255] == np.inf


@given(grids())
def test_without_interpolation_potentials_are_those_of_scipy(grid):
    costs, start, goal = grid
    table = navfn_table(allow_unknown=True)
    search = WaveSearch(costs, table, start, goal, threshold=254, rise=100, full=True, quadratic=False)
    search.expand()
    np.testing.assert_array_equal(search.potential, shortest(table[costs], {start: 0.0}))


@given(grids())
def test_potentials_are_at_most_3_5_percent_above_the_fixed_point(grid):
    costs, start, goal = grid
    search = NavfnSearch(costs, start, goal, full=True, outline=False)
    search.expand()
    exact = fixed_point(navfn_table(allow_unknown=True)[costs], {start: 0.0})
    assert np.array_equal(exact < HIGH, search.reached)
    excess = search.potential[search.reached] / np.maximum(exact[search.reached], 1.0)
    assert excess.max() <= 1.035
    assert excess[exact[search.reached] > 0].min(initial=1.0) >= 1 - 1e-6


@given(grids(), st.booleans(), st.booleans())
def test_a_path_begins_and_ends_where_it_should_and_crosses_nothing(grid, a_star, allow_unknown):
    costs, start, goal = grid
    search = NavfnSearch(costs, start, goal, a_star=a_star, allow_unknown=allow_unknown, outline=False)
    joined = shortest(navfn_table(allow_unknown)[costs], {start: 0.0})[goal[1], goal[0]] < HIGH
    if not joined:
        with pytest.raises(PlanningFailure):
            search.path()
        return
    path = search.path()
    assert tuple(path[0]) == start and tuple(path[-1]) == goal
    passable = np.isfinite(navfn_table(allow_unknown)[costs])
    assert all(passable[row, column] for column, row in crossed(path))
    assert np.hypot(*np.diff(path, axis=0).T).max(initial=0.0) <= 2.2


@given(grids(), st.integers(1, 40), st.booleans())
def test_a_search_in_steps_is_the_same_search(grid, count, a_star):
    costs, start, goal = grid
    whole = NavfnSearch(costs, start, goal, a_star=a_star)
    whole.expand()
    steps = NavfnSearch(costs, start, goal, a_star=a_star)
    before = 0
    while not steps.expand(count):
        assert steps.expanded == before + count
        before = steps.expanded
    assert np.array_equal(steps.potential, whole.potential)
    assert (steps.arrived, steps.expanded) == (whole.arrived, whole.expanded)


def test_a_straight_corridor_has_the_potential_of_its_cells():
    costs = np.full((3, 12), 254, np.uint8)
    costs[1] = 0
    search = NavfnSearch(costs, (1, 1), (10, 1))
    assert search.path()[:, 1].tolist() == [1.0] * len(search.path())
    assert search.potential[1, 10] == 9 * 50


def test_a_maze_that_needs_more_rounds_than_the_original_allows_is_solved():
    costs = np.zeros((60, 60), np.uint8)
    for row in range(2, 58, 4):
        costs[row, :57] = 254
        costs[row + 2, 3:] = 254
    path = NavfnSearch(costs, (1, 1), (30, 58)).path()
    assert np.hypot(*np.diff(path, axis=0).T).sum() > 28 * 50


def failure(costs, start, goal, **options) -> PlanningFailure:
    with pytest.raises(PlanningFailure) as caught:
        NavfnSearch(np.array(costs, np.uint8), start, goal, **options).path()
    return caught.value


def test_each_failure_says_why_with_numbers():
    costs = np.zeros((10, 20), np.uint8)
    costs[:, 10] = 254
    costs[4, 15] = 253
    blocked = failure(costs, (3, 3), (15, 4))
    assert isinstance(blocked, GoalBlocked)
    assert "cost 253" in str(blocked) and blocked.numbers["goal_cost"] == 253
    assert blocked.numbers["nearest"] == (9, 4) and blocked.numbers["distance"] == 6
    apart = failure(costs, (3, 3), (16, 4))
    assert isinstance(apart, NoPath)
    assert apart.numbers["reachable"] == 8 * 9
    assert isinstance(failure(costs, (3, 3), (20, 4)), OutsideMap)
    costs[2:5, 2:5] = 254
    shut = failure(costs, (3, 3), (8, 8))
    assert isinstance(shut, StartBlocked) and "(3, 3)" in str(shut)


def test_the_start_may_stand_in_an_obstacle_and_the_costs_are_left_alone():
    costs = np.zeros((10, 10), np.uint8)
    costs[5, 5] = 254
    before = costs.copy()
    assert tuple(NavfnSearch(costs, (5, 5), (8, 8)).path()[0]) == (5, 5)
    assert np.array_equal(costs, before)


def test_a_path_does_not_slip_between_two_obstacles_that_touch_at_a_corner():
    costs = np.zeros((12, 12), np.uint8)
    costs[1:6, 5] = 254
    costs[6:10, 6] = 254
    path = NavfnSearch(costs, (2, 5), (9, 6)).path()
    gone = {(round(x), round(y)) for x, y in path}
    assert not {(5, 6), (6, 5)} <= gone
    assert all(costs[row, column] != 254 for column, row in crossed(path))
