"""The chapter Beyond: what it says of the graphs and drives holds."""

from __future__ import annotations

from rosmini.book import checks

from .conftest import all_printed


def test_a_topic_without_a_publisher_is_explained():
    """What the reader saw was a bare KeyError."""
    verdict = checks.find("drivers").grade(lambda state, topic: sorted(dict(state[0])[topic]))
    assert not verdict
    assert "no node publishes" in verdict.text
    assert "return an empty list" in verdict.text


def test_the_robot_arrived_on_a_map_that_grew(figures):
    assert "/map: 1 message" not in figures[1]
    assert "/map: " in figures[1]
    assert "/move_base/NavfnROS/plan: " in figures[1]


def test_what_the_explorer_and_the_teleoperation_add(figures):
    assert "5 nodes" in figures[4]
    _, new = figures[5].split("new: ")
    assert new.startswith("/amcl, /explore_client, /explore_server, ")
    assert "-> /cmd_vel ->" not in new
    assert figures[6].endswith("new: /turtlebot3_teleop_keyboard, /turtlebot3_teleop_keyboard -> /cmd_vel -> /gazebo")


def test_the_master_says_why_the_older_nodes_ended(cells):
    said = all_printed(cells)
    for name in ("turtlebot3_slam_gmapping", "move_base"):
        assert f"[/{name}] Reason: new node registered with same name" in said


def test_the_explorer_finished_after_the_person_had_driven(cells):
    assert "Finished exploring room" in all_printed(cells)
