"""Searches as pictures: what they say, what is drawn, and what a page is given to step them."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.global_planner import GlobalAStar
from rosmini.navigation.navfn import NavfnSearch, show_steps
from rosmini.viz.search_pictures import search_picture
from rosmini.viz.search_steps import search_steps
from rosmini.viz.view import ViewError


def room() -> np.ndarray:
    costs = np.zeros((20, 30), np.uint8)
    costs[:14, 15] = 254
    costs[10:, 5] = 255
    return costs


def test_a_search_at_its_end_says_what_it_reached_and_how_long_the_path_is():
    search = NavfnSearch(room(), (3, 5), (25, 5))
    search.expand()
    view = search.show(title="Figure 1: A search")
    assert view.text.startswith("Figure 1: A search: ")
    assert f"{search.expanded} cells taken up" in view.text and "potential" in view.text
    assert view.svg.count("<image") == 1 and view.svg.count('class="rm-path"') == 1
    assert view.alt.startswith("A search on a grid, from above. ")


def test_one_on_its_way_says_how_many_cells_wait_and_has_no_path():
    search = NavfnSearch(room(), (3, 5), (25, 5))
    search.expand(60)
    view = search_picture(search)
    assert view.text.startswith("search: 60 cells taken up, ")
    assert view.text.endswith(f"{len(search.frontier)} waiting")
    assert "rm-path" not in view.svg.partition("</style>")[2]


def test_one_without_a_path_says_so():
    costs = room()
    costs[:, 15] = 254
    search = NavfnSearch(costs, (3, 5), (25, 5))
    search.expand()
    assert search.show().text.endswith("the goal not among them")


def test_parents_are_lines_and_too_many_of_them_are_refused():
    search = NavfnSearch(np.zeros((8, 9), np.uint8), (2, 2), (6, 6), full=True, outline=False)
    search.expand()
    assert search.show(parents=True).svg.partition('class="rm-parents"')[0].count("M") >= 8 * 9 - 1
    with pytest.raises(ViewError, match="parents of 10000 cells cannot be seen"):
        NavfnSearch(np.zeros((100, 100), np.uint8), (2, 2), (6, 6)).show(parents=True)


def test_searches_beside_each_other_are_recorded_by_how_many_cells_they_took_up():
    searches = {"Dijkstra": NavfnSearch(room(), (3, 5), (25, 5)), "A*": GlobalAStar(room(), (3, 5), (25, 5))}
    view = show_steps(searches, title="Figure 2: Beside each other")
    lines = view.text.split("\n")
    assert lines[0] == "Figure 2: Beside each other"
    assert lines[1].startswith(f"Dijkstra: {searches['Dijkstra'].expanded} cells taken up")
    assert lines[2].startswith(f"A*: {searches['A*'].expanded} cells taken up")
    data = view.data
    assert data["size"] == [30, 20] and data["frames"] * data["step"] >= searches["Dijkstra"].expanded
    for name, each in zip(searches, data["searches"], strict=True):
        when = np.frombuffer(each["when"], np.uint8).reshape(20, 30)[::-1]
        assert np.array_equal(when > 0, searches[name].reached)
        assert when[5, 3] == 1 and when.max() <= data["frames"] + 1
        # Cells nearer to the start appear earlier.
        assert when[5, 4] <= when[5, 10]
        assert each["path"][:2] == [3.0, 5.0] and each["path"][-2:] == [25.0, 5.0]
    again = {"Dijkstra": NavfnSearch(room(), (3, 5), (25, 5)), "A*": GlobalAStar(room(), (3, 5), (25, 5))}
    assert show_steps(again, title="Figure 2: Beside each other").html == view.html


def test_what_cannot_be_stepped_is_refused():
    begun = NavfnSearch(room(), (3, 5), (25, 5))
    begun.expand(5)
    with pytest.raises(ViewError, match="the search 'A' has begun"):
        search_steps({"A": begun})
    with pytest.raises(ViewError, match="grids of one size"):
        search_steps(
            {
                "A": NavfnSearch(room(), (3, 5), (25, 5)),
                "B": NavfnSearch(room()[:18], (3, 5), (25, 5)),
            }
        )
    with pytest.raises(ViewError, match="too large to be stepped"):
        search_steps({"A": NavfnSearch(np.zeros((200, 200), np.uint8), (3, 5), (25, 5))})
    with pytest.raises(ViewError, match="given by name"):
        search_steps({})
