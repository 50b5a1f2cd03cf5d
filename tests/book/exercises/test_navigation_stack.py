"""The chapter The Navigation Stack: what its cells say."""

from __future__ import annotations

from .conftest import printed


def test_the_robot_arrives(cells):
    assert "Goal reached." in printed(cells, "def on_result(result)")
    off, accepted = map(float, printed(cells, "base_pose_ground_truth").replace(" m from the goal", "").split())
    assert off < accepted


def test_the_stack_has_its_parts(cells):
    listed = printed(cells, "%rosnode list")
    assert all(f"/{name}\n" in listed for name in ("map_server", "move_base", "fake_localization"))
    depends, _, installed = printed(cells, "%rospack plugins").partition("std_srvs")
    assert "navfn" in depends
    assert "dwa_local_planner" not in depends
    assert "dwa_local_planner" in installed
