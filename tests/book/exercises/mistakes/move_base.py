"""Wrong answers to the exercises of the chapter move_base: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script
from rosmini.navigation.navfn.plugin import NavfnROS

if TYPE_CHECKING:
    from collections.abc import Callable

PATROL = """
import actionlib
import rospy
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal

rospy.init_node("patrol")
client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
client.wait_for_server()
for x, y in [(1, 0), (2, 1), (0, 2)]:
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.position.y = y
    goal.target_pose.pose.orientation.w = 1
    client.send_goal(goal)
    client.wait_for_result()
"""

COURIER = """
import actionlib
import rospy
from geometry_msgs.msg import PoseStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from std_msgs.msg import String


def on_place(pose):
    client.send_goal(MoveBaseGoal(target_pose=pose))
    client.wait_for_result()
    if client.get_state() == actionlib.GoalStatus.SUCCEEDED:
        report.publish("arrived")
    else:
        report.publish(client.get_goal_status_text())


rospy.init_node("courier")
report = rospy.Publisher("report", String, queue_size=10)
client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
client.wait_for_server()
rospy.Subscriber("places", PoseStamped, on_place)
rospy.spin()
"""


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


def _planner(
    *, side: float = 0.2, looks: bool = True, absolute: bool = False, last: bool = False, step: int = 1
) -> Callable[[], Any]:
    def made() -> type[NavfnROS]:
        class KeepRight(NavfnROS):
            def make_plan(self, start: Any, goal: Any, tolerance: float | None = None) -> Any:
                plan = list(super().make_plan(start, goal))[::step]
                points = [(p.pose.position.x, p.pose.position.y) for p in plan]
                ahead = points[1:] + ([(2 * points[-1][0] - points[-2][0], points[-1][1])] if last else [])
                for pose, (x, y), (u, v) in zip(plan, points, ahead, strict=False):
                    length = ((u - x) ** 2 + (v - y) ** 2) ** 0.5 or 1.0
                    right = (0.0, -1.0) if absolute else ((v - y) / length, -(u - x) / length)
                    x, y = x + side * right[0], y + side * right[1]
                    cell = self.costmap.grid.world_to_map(x, y)
                    if cell and (not looks or self.costmap.grid.cost(*cell) < 253):
                        pose.pose.position.x, pose.pose.position.y = x, y
                return plan

        return KeepRight

    return made


def _parameters(*kinds: str, sides: tuple[float, ...] = (4.0, 1.0), layer: Any = None) -> Callable[[], Any]:
    names = ["far", "near", "turn"][: len(kinds)]
    layers = ["obstacle_layer"] if layer is None else layer
    return lambda: {
        "recovery_behaviors": [{"name": name, "type": kind} for name, kind in zip(names, kinds, strict=True)],
        **{name: {"reset_distance": side, "layer_names": layers} for name, side in zip(names, sides, strict=False)},
    }


CLEAR, ROTATE = "clear_costmap_recovery/ClearCostmapRecovery", "rotate_recovery/RotateRecovery"

MISTAKES = {
    "patrol": [
        _but(PATROL, "    client.wait_for_result()\n", ""),
        _but(PATROL, "    goal.target_pose.pose.orientation.w = 1\n", ""),
        _but(PATROL, '    goal.target_pose.header.frame_id = "map"\n', ""),
        _but(PATROL, "(2, 1)", "(1, 2)"),
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
    "keep_right": [
        _planner(side=-0.2),
        _planner(side=0.1),
        _planner(looks=False),
        _planner(absolute=True),
        _planner(last=True),
        _planner(step=2),
        lambda: NavfnROS,
        lambda: dict,
    ],
    "no_turning": [
        _parameters(CLEAR, CLEAR, ROTATE),
        _parameters(CLEAR),
        _parameters(CLEAR, CLEAR, sides=(1.0, 4.0)),
        _parameters(CLEAR, CLEAR, sides=(2.0, 0.5)),
        _parameters(CLEAR, CLEAR, layer=["obstacles"]),
        lambda: {"recovery_behaviors": ["conservative_reset", "aggressive_reset"]},
        lambda: {
            "recovery_behaviors": [{"name": "far", "type": CLEAR}, {"name": "far", "type": CLEAR}],
            "far": {"reset_distance": 4.0, "layer_names": ["obstacle_layer"]},
        },
        lambda: [CLEAR, CLEAR],
    ],
}
