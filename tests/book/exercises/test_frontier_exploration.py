"""The chapter Frontier exploration: its cells show what the text says."""

from __future__ import annotations

from .conftest import printed


def test_it_ends_by_itself_as_the_text_says(cells):
    assert "Finished exploring room" in printed(cells, "%record")


def test_the_second_graph_has_the_clicks_and_the_polygon(figures):
    assert "/explore_client (not connected)" in figures[2]
    assert "/rviz -> /clicked_point" in figures[5]
    assert "/explore_client -> /exploration_polygon_marker" in figures[5]
    assert "/explore_client -> /explore_server/goal" in figures[5]


def test_frontiers_by_hand(cells):
    assert printed(cells, "def frontier_cells").count("F") == 4


def test_the_server_names_a_frontier(cells):
    assert 'frame_id: "map"' in printed(cells, "get_next_frontier")


def test_invalid_polygons_are_refused(cells):
    assert "Not a valid polygon, restarting: the edges after vertices 1 and 3" in printed(cells, '"Publish Point" 2 0')
    assert "Center not inside polygon" in printed(cells, '"Publish Point" 3 3')


def test_a_second_move_base_loses_the_goal(cells):
    said = printed(cells, "move_base.launch model:=burger\n%rosservice")
    assert "new node registered with same name" in said
    assert "Failed to move to" in said
