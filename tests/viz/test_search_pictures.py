"""Searches as pictures: what they say, and what is drawn."""

import numpy as np
import pytest

from rosmini.navigation.navfn import NavfnSearch
from rosmini.viz.search_pictures import search_picture
from rosmini.viz.view import ViewError


def room():
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
    with pytest.raises(ViewError, match="parents of 10000 cells would be too small"):
        NavfnSearch(np.zeros((100, 100), np.uint8), (2, 2), (6, 6)).show(parents=True)
