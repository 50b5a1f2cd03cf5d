"""Chapter 74: what it says of the three graphs holds."""

from __future__ import annotations

import pytest

from .conftest import all_printed


@pytest.fixture(scope="module")
def figures(cells):
    return [
        "".join(output.data.get("text/plain", ""))
        for cell in cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if output.output_type != "stream"
    ]


def test_the_robot_arrived_on_a_map_that_grew(figures):
    assert "/map: 1 message" not in figures[0]
    assert "/map: " in figures[0]
    assert "/move_base/NavfnROS/plan: " in figures[0]


def test_what_the_explorer_and_the_teleoperation_add(figures):
    assert "4 nodes" in figures[1]
    _, new = figures[2].split("new: ")
    assert new.startswith("/amcl, /explore_client, /explore_server, ")
    assert "-> /cmd_vel ->" not in new
    assert figures[3].endswith(
        "new: /turtlebot3_teleop_keyboard, /turtlebot3_teleop_keyboard -> /cmd_vel -> /simulator"
    )


def test_the_master_says_why_the_older_nodes_ended(cells):
    said = all_printed(cells)
    for name in ("turtlebot3_slam_gmapping", "move_base"):
        assert f"[/{name}] Reason: new node registered with same name" in said
