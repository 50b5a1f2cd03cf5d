"""The chapter Costmaps: its cells show what its text says of them."""

from __future__ import annotations

from .conftest import printed


def test_the_robot_goes_around_the_box_and_arrives(cells):
    assert "Goal reached" in printed(cells, 'house.drag("toy box", (-1.3')


def test_move_base_warns_of_the_footprint_when_it_starts(cells):
    assert "inscribed radius is 5.1 cm" in printed(cells, "from rosmini.book import check")


def test_each_layer_is_found_to_be_the_cause_of_a_cell(cells):
    near, box, wall = printed(cells, "costmap.explain(*cell)").split("cell (")[1:]
    assert "obstacle_layer: 0" in near
    assert "252 exp(-5 (0.250 - 0.051)) = 93" in near
    assert "static_layer: 0" in box
    assert "obstacle_layer: 254" in box
    assert "static_layer: 254" in wall
    assert "obstacle_layer: 0" in wall


def test_a_ghost_stays_until_it_is_cleared(cells):
    assert printed(cells, "ghost = ").splitlines() == ["before: 254", "after:  0"]
    count, _, rest = printed(cells, "np.isinf(behind)").partition(" of ")
    assert int(count) > 10
    assert rest.startswith("20")


def test_only_both_switches_keep_out_of_the_fog(cells):
    assert printed(cells, "allow_unknown=allowed").count("no path") == 1


def test_costs_are_published_as_the_text_says(cells):
    said = printed(cells, "message.data[")
    for cost, value in ((0, 0), (253, 99), (254, 100)):
        assert f"cost {cost} is published as {value}\n" in said
