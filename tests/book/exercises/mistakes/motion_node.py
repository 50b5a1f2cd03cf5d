"""Wrong answers to the exercises of the chapter A node that moves: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

TURN = solution("motion_node", "turn")

WALL = solution("motion_node", "wall")

CORNERS = solution("motion_node", "corners")


def _script(text: str, old: str, new: str) -> Callable[[], Script]:
    assert old in text
    return lambda: Script("answer.py", text.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "turn": [
        _script(TURN, "angular.z = 0.5", "angular.z = -0.5"),
        _script(TURN, "math.pi / 2", "math.pi"),
        _script(TURN, "angular.z = 0.5", "angular.z = 1.0"),
        _script(TURN, "command.angular.z", "command.linear.x = command.angular.z"),
        _script(TURN, "while 0.5 * (rospy.Time.now() - start).to_sec() < math.pi / 2:", "while True:"),
        _script(TURN, "publisher.publish(Twist())", "pass"),
        _script(TURN, "    publisher.publish(command)\n    rate.sleep()", "    publisher.publish(command)"),
        _script(TURN, "math.pi / 2", "90"),
    ],
    "wall": [
        _script(WALL, "math.hypot(pose.x - before.x, pose.y - before.y)", "abs(pose.x - before.x)"),
        _script(WALL, "math.hypot(pose.x - before.x, pose.y - before.y) < 0.02", "pose.x > 11"),
        _script(WALL, "        break", "        pass"),
        _script(WALL, "< 0.02", "< 0.39"),
        _script(
            WALL, "math.hypot(pose.x - before.x, pose.y - before.y) < 0.02", "not 0.1 < pose.x < 11 or pose.y > 11"
        ),
        _script(WALL, "rospy.loginfo(", "print("),
        _script(WALL, "    publisher.publish(command)", "    pass"),
        _script(WALL, 'rospy.loginfo("wall")', "pass"),
        _script(WALL, "    before = pose", '    rospy.loginfo("wall")\n    before = pose'),
    ],
    "corners": [
        _script(CORNERS, "(8, 2), (8, 8), (2, 8)", "(8, 8), (8, 2), (2, 8)"),
        _script(CORNERS, ", (2, 8)", ""),
        _script(CORNERS, "math.atan2(y - pose", "math.atan2(pose"),
        _script(CORNERS, "> 0.05", "> 0.5"),
        _script(CORNERS, "6 * angle", "-6 * angle"),
        _script(CORNERS, "> 0.05", "> 0"),
    ],
}
