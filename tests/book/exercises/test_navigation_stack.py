"""The chapter The Navigation Stack: what its cells say, and another right answer."""

from __future__ import annotations

from rosmini.book.checks import Status, find

from .conftest import printed


def test_the_robot_arrives(cells):
    assert "Goal reached." in printed(cells, "def tell(result)")
    assert "it is 0.1 m from the goal" in printed(cells, "run.pose_at")


def test_the_stack_has_its_parts(cells):
    listed = printed(cells, "%rosnode list")
    assert all(f"/{name}\n" in listed for name in ("map_server", "move_base", "fake_localization"))
    assert "navfn" in printed(cells, "%rospack plugins")


def test_a_length_may_be_added_up_in_a_loop():
    def length(poses):
        total = 0
        for number in range(1, len(poses)):
            a, b = poses[number - 1].pose.position, poses[number].pose.position
            total += ((a.x - b.x) ** 2 + (a.y - b.y) ** 2) ** 0.5
        return total

    assert find("length").grade(length).status is Status.RIGHT
