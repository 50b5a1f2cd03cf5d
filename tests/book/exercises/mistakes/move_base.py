"""Wrong answers to the exercises of the chapter move_base: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

PATROL = solution("move_base", "patrol")

COURIER = solution("move_base", "courier")


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


CLEAR, ROTATE = "clear_costmap_recovery/ClearCostmapRecovery", "rotate_recovery/RotateRecovery"


def _settings(*kinds: str, sides: tuple[float, ...] = (4.0, 1.0), layer: str = "[obstacle_layer]") -> Callable[[], str]:
    names = ["far", "near", "turn"][: len(kinds)]
    entries = ", ".join(f"{{name: {name}, type: {kind}}}" for name, kind in zip(names, kinds, strict=True))
    own = "".join(
        f"{name}: {{reset_distance: {side}, layer_names: {layer}}}\n" for name, side in zip(names, sides, strict=False)
    )
    return lambda: f"recovery_behaviors: [{entries}]\n{own}"


MISTAKES = {
    "patrol": [
        _but(PATROL, "    client.wait_for_result()\n", ""),
        _but(PATROL, "    goal.target_pose.pose.orientation.w = 1\n", ""),
        _but(PATROL, '    goal.target_pose.header.frame_id = "map"\n', ""),
        _but(PATROL, "(0.3, 0.9)", "(0.9, 0.3)"),
        _but(PATROL, "    client.wait_for_result()\n", "    client.wait_for_result()\nrospy.spin()\n"),
        _but(PATROL, "    client.send_goal(goal)\n", ""),
    ],
    "courier": [
        _but(COURIER, "    client.wait_for_result()\n", ""),
        _but(COURIER, "client.get_state() == actionlib.GoalStatus.SUCCEEDED", "client.wait_for_result()"),
        _but(COURIER, "client.get_goal_status_text()", '"failed"'),
        _but(COURIER, "get_goal_status_text())\n", "get_goal_status_text())\n        rospy.signal_shutdown('')\n"),
        _but(COURIER, "target_pose=pose", ""),
    ],
    "no_turning": [
        _settings(CLEAR, CLEAR, ROTATE),
        _settings(CLEAR),
        _settings(CLEAR, CLEAR, sides=(1.0, 4.0)),
        _settings(CLEAR, CLEAR, sides=(2.0, 0.5)),
        _settings(CLEAR, CLEAR, layer="[obstacles]"),
        lambda: "recovery_behaviors: [conservative_reset, aggressive_reset]",
        lambda: "recovery_behaviors: [",
        lambda: [CLEAR, CLEAR],
    ],
}
