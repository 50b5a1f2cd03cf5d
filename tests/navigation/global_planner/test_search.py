"""global_planner's searches."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rosmini.navigation.global_planner.search import GlobalAStar, GlobalDijkstra, a_star_table, dijkstra_table
from rosmini.navigation.nav_core import PlanningFailure
from rosmini.navigation.navfn.wave import HIGH

from ..grids import crossed, fixed_point, grids, shortest

between = st.floats(-0.49, 0.49)


def test_costs_are_weighed_as_in_global_planner():
    table = dijkstra_table(allow_unknown=True)
    assert [table[c] for c in (0, 10, 67, 68, 251, 252, 253, 254, 255)] == [
        *(50, 80, 251, 252, 252, 252),
        *(np.inf, np.inf, 252),
    ]
    assert dijkstra_table(allow_unknown=False, lethal_cost=100, neutral_cost=66, cost_factor=0.5)[40] == 86


def test_a_star_does_not_take_high_costs_for_low_ones():
    """The original adds in 8 bits: 206 + 50 is 0 there."""
    table = a_star_table(allow_unknown=True)
    assert [table[c] for c in (0, 205, 206, 252, 253)] == [50, 255, 256, 302, np.inf]
    assert table[255] == 305


@given(grids(), between, between)
def test_without_interpolation_potentials_are_those_of_scipy(grid, dx, dy):
    costs, start, goal = grid
    search = GlobalDijkstra(costs, start, goal, quadratic=False, precise=False, outline=False, full=True)
    search.expand()
    entering = dijkstra_table(allow_unknown=True)[costs]
    np.testing.assert_array_equal(search.potential, shortest(entering, {start: 0.0}))
    x, y = start[0] + dx, start[1] + dy
    search = GlobalDijkstra(costs, (x, y), goal, quadratic=False, outline=False, full=True)
    height, width = costs.shape
    seeds = {
        (column, row): 50 * np.hypot(column - x, row - y)
        for row in {int(np.floor(y)), int(np.ceil(y))}
        for column in {int(np.floor(x)), int(np.ceil(x))}
        if 0 <= row < height and 0 <= column < width and np.isfinite(entering[row, column])
    }
    # The one across the corner, if the two beside the start's own are blocked, is behind them.
    seeds = {
        (column, row): cost
        for (column, row), cost in seeds.items()
        if (column, start[1]) in seeds or (start[0], row) in seeds
    }
    search.expand()
    np.testing.assert_allclose(search.potential, shortest(entering, seeds), rtol=1e-6, atol=1e-3)


@given(grids())
def test_potentials_are_at_most_3_5_percent_above_the_fixed_point(grid):
    costs, start, goal = grid
    search = GlobalDijkstra(costs, start, goal, precise=False, outline=False, full=True)
    search.expand()
    exact = fixed_point(dijkstra_table(allow_unknown=True)[costs], {start: 0.0})
    assert np.array_equal(exact < HIGH, search.reached)
    excess = search.potential[search.reached] / np.maximum(exact[search.reached], 1.0)
    assert excess.max() <= 1.035
    assert excess[exact[search.reached] > 0].min(initial=1.0) >= 1 - 1e-6


def shut_in():
    """The start touches the rest of the grid at the corner of its cell alone."""
    costs = np.zeros((11, 5), np.uint8)
    costs[0, [0, 2]] = costs[1, 1] = 254
    return costs, (1, 0), (3, 10)


@given(grids(), *[st.booleans()] * 4, between, between)
@example(shut_in(), False, False, False, True, 0.25, 0.25)
def test_a_path_begins_and_ends_where_it_should_and_crosses_nothing(
    grid, a_star, quadratic, grid_path, precise, dx, dy
):
    costs, start, goal = grid
    if not precise:
        dx = dy = 0
    begin, end = (start[0] + dx, start[1] + dy), (goal[0] - dx, goal[1] + dy)
    options = {"quadratic": quadratic, "grid_path": grid_path, "precise": precise, "outline": False}
    search = (GlobalAStar if a_star else GlobalDijkstra)(costs, begin, end, **options)
    table = dijkstra_table(allow_unknown=True)
    if shortest(table[costs], {start: 0.0})[goal[1], goal[0]] >= HIGH:
        with pytest.raises(PlanningFailure):
            search.path()
        return
    path = search.path()
    assert tuple(path[0]) == pytest.approx(begin) and tuple(path[-1]) == pytest.approx(end)
    assert all(np.isfinite(table[costs[row, column]]) for column, row in crossed(path))


@given(grids())
def test_a_star_is_never_cheaper_than_the_optimum(grid):
    costs, start, goal = grid
    search = GlobalAStar(costs, start, goal, quadratic=False, precise=False, outline=False)
    search.expand()
    optimum = shortest(a_star_table(allow_unknown=True)[costs], {start: 0.0})
    assert search.arrived == (optimum[goal[1], goal[0]] < HIGH)
    assert (search.potential >= optimum - 1e-3)[search.reached].all()


@given(grids(), st.integers(1, 40))
def test_a_star_in_steps_is_the_same_search(grid, count):
    costs, start, goal = grid
    whole, steps = GlobalAStar(costs, start, goal), GlobalAStar(costs, start, goal)
    whole.expand()
    before = 0
    while not steps.expand(count):
        assert steps.expanded == before + count
        before = steps.expanded
    assert np.array_equal(steps.potential, whole.potential)
    assert (steps.arrived, steps.expanded) == (whole.arrived, whole.expanded)


def test_on_an_empty_grid_a_star_takes_few_cells():
    costs = np.zeros((100, 100), np.uint8)
    a_star, dijkstra = GlobalAStar(costs, (10, 10), (90, 90)), GlobalDijkstra(costs, (10, 10), (90, 90))
    assert (a_star.expand(), dijkstra.expand()) == (True, True)
    assert a_star.expanded < dijkstra.expanded / 10
    path = GlobalDijkstra(costs, (10, 10), (90, 90)).path()
    assert np.hypot(*np.diff(path, axis=0).T).sum() == pytest.approx(80 * 2**0.5, rel=0.01)
