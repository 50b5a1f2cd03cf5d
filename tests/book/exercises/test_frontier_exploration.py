"""The chapter Frontier exploration: the robot stops exploring by itself, as the text says."""

from __future__ import annotations

from .conftest import printed


def test_it_ends_by_itself_as_the_text_says(cells):
    assert "Finished exploring room" in printed(cells, "rosmini.wait(45)")
    assert printed(cells, "ask = rospy").strip() == "No valid frontiers found, exploration complete"


def test_frontiers_by_hand(cells):
    assert printed(cells, "def is_frontier").count("F") == 4
    assert "cells around" in printed(cells, "find_frontiers(before")


def test_a_polygon_whose_edges_cross_is_refused(cells):
    assert "Not a valid polygon, restarting: the edges after vertices 1 and 3" in printed(cells, "(2, 2), (2, 0)")
