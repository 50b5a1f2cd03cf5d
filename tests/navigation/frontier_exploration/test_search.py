"""Frontiers on grids drawn by hand, and against a slow search that follows the definition."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.frontier_exploration.search import Blacklist, find_frontiers, frontier_cells

COSTS = {".": 0, "?": 255, "#": 254, "i": 253, "o": 100}


def grid(text, resolution=1.0):
    """A grid from rows of characters, the uppermost first."""
    rows = [[COSTS[one] for one in line] for line in text.split()]
    return Costmap2D.of(np.array(rows, dtype=np.uint8)[::-1], resolution)


def cells(frontier):
    return {(int(mx), int(my)) for mx, my in frontier.cells}


def test_an_opening_and_a_corner():
    found = find_frontiers(
        grid("""
        ######
        #...??
        #...#?
        #....?
        ####.#
        ????.?
        """),
        1.5,
        4.5,
    )
    assert {frozenset(cells(one)) for one in found} == {
        frozenset({(4, 4)}),
        frozenset({(5, 2)}),
        frozenset({(3, 0)}),
        frozenset({(5, 0)}),
    }


def test_its_measures():
    one, *others = find_frontiers(grid("?????\n.....\n.....", 0.5), 0.25, 0.25)
    assert not others
    assert one.size == 5
    assert one.initial == (0.25, 1.25), "the search meets first what is straight ahead"
    assert one.middle == (1.25, 1.25)
    assert one.min_distance == pytest.approx(1.0)
    assert one.centroid == pytest.approx((1.25, 1.25))
    assert one.points[0].tolist() == [0.25, 1.25]


def test_cells_that_touch_at_corners_are_one_frontier():
    (one,) = find_frontiers(grid("?..\n.?.\n..?"), 0.5, 0.5)
    assert cells(one) == {(0, 2), (1, 1), (2, 0)}


def test_what_nothing_leads_to_is_not_found():
    walled = grid("..#..?\n..#..?")
    assert find_frontiers(walled, 0.5, 0.5) == []
    assert [cells(one) for one in find_frontiers(walled, 4.5, 0.5)] == [{(5, 0), (5, 1)}]


def test_where_the_centre_of_the_robot_may_be_is_passed():
    assert [cells(one) for one in find_frontiers(grid("..o..?"), 0.5, 0.5)] == [{(5, 0)}]
    assert find_frontiers(grid("..i..?"), 0.5, 0.5) == []


def test_a_robot_beside_a_free_cell_that_is_shut_in_finds_the_way_out():
    """Between the legs of a chair: of the office's floor three tenths were seen when the exploration was finished."""
    (one,) = find_frontiers(
        grid("""
        ioioo...
        o.ooo..?
        ioioo...
        """),
        2.5,
        1.5,
    )
    assert cells(one) == {(7, 1)}


def test_what_is_only_beside_costs_is_no_frontier():
    assert find_frontiers(grid("..o?"), 0.5, 0.5) == []


def test_a_robot_on_a_cell_where_it_cannot_be_begins_at_the_nearest_where_it_can():
    (one,) = find_frontiers(grid("####\n##.?"), 0.5, 1.5)
    assert one.initial == (3.5, 0.5)


def test_nothing_free_nothing_unknown_and_outside():
    assert find_frontiers(grid("???"), 0.5, 0.5) == []
    assert find_frontiers(grid("..."), 0.5, 0.5) == []
    with pytest.raises(IndexError, match=r"the robot, at \(9\.00, 0\.50\), is outside"):
        find_frontiers(grid("..?"), 9.0, 0.5)


def slow(costs, start):
    """The definition, cell by cell: a queue over open cells, and of each unknown cell met its neighbours."""
    height, width = costs.shape
    inside = lambda x, y: 0 <= x < width and 0 <= y < height
    sides = [(-1, 0), (1, 0), (0, -1), (0, 1)]
    corners = [*sides, (-1, -1), (-1, 1), (1, -1), (1, 1)]

    def is_frontier(x, y):
        return costs[y, x] == 255 and any(inside(x + dx, y + dy) and costs[y + dy, x + dx] == 0 for dx, dy in sides)

    queue, seen, marked, found = deque([start]), {start}, set(), []
    while queue:
        x, y = queue.popleft()
        for dx, dy in sides:
            next_cell = x + dx, y + dy
            if not inside(*next_cell):
                continue
            if costs[next_cell[1], next_cell[0]] < 253:
                if next_cell not in seen:
                    seen.add(next_cell)
                    queue.append(next_cell)
            elif is_frontier(*next_cell) and next_cell not in marked:
                group, waiting = [next_cell], deque([next_cell])
                marked.add(next_cell)
                while waiting:
                    a, b = waiting.popleft()
                    for ex, ey in corners:
                        other = a + ex, b + ey
                        if inside(*other) and is_frontier(*other) and other not in marked:
                            marked.add(other)
                            group.append(other)
                            waiting.append(other)
                found.append(group)
    return found


@given(arrays(np.uint8, (9, 11), elements=st.sampled_from([0, 0, 0, 255, 254, 253, 30])), st.data())
def test_it_finds_what_the_definition_says_in_the_same_order(costs, data):
    open_cells = np.argwhere(costs < 253)
    if not len(open_cells):
        return
    y, x = open_cells[data.draw(st.integers(0, len(open_cells) - 1))].tolist()
    found = find_frontiers(Costmap2D.of(costs), x + 0.5, y + 0.5)
    wanted = slow(costs, (x, y))
    assert [set(map(tuple, one.cells.tolist())) for one in found] == [set(group) for group in wanted]
    assert [tuple(one.cells[0].tolist()) for one in found] == [group[0] for group in wanted]
    together = frontier_cells(costs)
    assert all(together[my, mx] for one in found for mx, my in one.cells)


def test_given_up_means_next_to_it_too():
    once = Blacklist([(1.0, 2.0)])
    assert once.count((1.24, 1.76), 0.05) == 1
    assert not once.is_given_up((1.24, 1.76), 0.05), "it is tried again"
    given_up = Blacklist([(1.0, 2.0)] * 2)
    assert given_up.is_given_up((1.24, 1.76), 0.05)
    assert not given_up.is_given_up((1.26, 2.0), 0.05)
    assert not given_up.is_given_up((1.0, 2.26), 0.05)
    assert not Blacklist().is_given_up((0.0, 0.0), 0.05)
