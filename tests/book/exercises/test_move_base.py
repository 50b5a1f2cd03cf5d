"""The chapter move_base: what the text says of the stuck robot is what its cells print."""

from __future__ import annotations

from .conftest import printed


def test_goals_end_as_the_text_says(cells):
    assert printed(cells, "on_feedback").endswith("arrived: False\n2 PREEMPTED\n")
    assert printed(cells, "clicks =").startswith("PREEMPTED\n")
    assert "Failed to find a valid plan. Even after executing recovery behaviors." in printed(cells, "def watch")
    assert printed(cells, "before = costmap").strip() == "Goal reached."
    assert printed(cells, "changed =").strip() == "my_planners/Manhattan\nGoal reached."


def test_the_recoveries_run_in_the_order_of_the_text(figures):
    stuck, helped = figures[5], figures[8]
    names = [line.partition(" s: ")[2] for line in stuck.splitlines() if " s: " in line]
    assert names == ["conservative_reset", "rotate_recovery", "aggressive_reset", "rotate_recovery"]
    assert [line.partition(" s: ")[2] for line in helped.splitlines() if " s: " in line] == ["conservative_reset"]


def test_a_goal_in_a_wall_has_a_plan_with_tolerance_only(cells):
    *_, wall, near = printed(cells, "def length").strip().splitlines()
    assert wall.endswith(" 0.0 m")
    assert not near.endswith(" 0.0 m")
