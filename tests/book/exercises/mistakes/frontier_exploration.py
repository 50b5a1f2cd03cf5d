"""Wrong answers to the exercises of the chapter Frontier exploration: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

CLICKER = """
import rospy
from geometry_msgs.msg import PointStamped

rospy.init_node("clicker")
clicks = rospy.Publisher("/clicked_point", PointStamped, queue_size=10)
while clicks.get_num_connections() == 0:
    rospy.sleep(0.1)
for x, y in [(-1.3, -1.3), (4.8, -1.3), (4.8, 3.3), (-1.3, 3.3), (-1.3, -1.3), (0.3, 0.2)]:
    click = PointStamped()
    click.header.frame_id = "map"
    click.point.x, click.point.y = x, y
    clicks.publish(click)
    rospy.sleep(0.5)
"""

ENOUGH = """
import rospy
from actionlib_msgs.msg import GoalID
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Float64


def on_map(grid):
    known = sum(value >= 0 for value in grid.data)
    square_metres = known * grid.info.resolution**2
    area.publish(square_metres)
    if square_metres >= enough:
        cancel.publish(GoalID())


rospy.init_node("surveyor")
enough = rospy.get_param("~enough", 12.0)
area = rospy.Publisher("known_area", Float64, queue_size=1)
cancel = rospy.Publisher("explore_server/cancel", GoalID, queue_size=1)
rospy.Subscriber("map", OccupancyGrid, on_map)
rospy.spin()
"""


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


def _sizes(*, corners: bool = True, rising: bool = False, destroys: bool = False) -> Callable[[], Any]:
    def made() -> Callable[[Any], list[int]]:
        def sizes(cells: Any) -> list[int]:
            left = cells if destroys else set(cells)
            found = []
            while left:
                waiting, count = [left.pop()], 0
                while waiting:
                    x, y = waiting.pop()
                    count += 1
                    steps = [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1) if corners or 0 in (a, b)]
                    near = {(x + a, y + b) for a, b in steps} & left
                    waiting += near
                    left -= near
                found.append(count)
            return sorted(found, reverse=not rising)

        return sizes

    return made


def _recursive() -> Any:
    def sizes(cells: Any) -> list[int]:
        left = set(cells)

        def grow(x: int, y: int) -> int:
            if (x, y) not in left:
                return 0
            left.remove((x, y))
            return 1 + sum(grow(x + a, y + b) for a in (-1, 0, 1) for b in (-1, 0, 1))

        return sorted((grow(*next(iter(left))) for _ in cells if left), reverse=True)

    return sizes


MISTAKES: dict[str, list[Callable[[], Any]]] = {
    "sizes": [_sizes(corners=False), _sizes(rising=True), _sizes(destroys=True), _recursive, lambda: len],
    "clicker": [
        _but(CLICKER, "(-1.3, 3.3), (-1.3, -1.3)", "(-1.3, 3.3)"),
        _but(CLICKER, "(-1.3, -1.3), (0.3, 0.2)]", "(-1.3, -1.3)]"),
        _but(CLICKER, "(4.8, 3.3), (-1.3, 3.3)", "(-1.3, 3.3), (4.8, 3.3)"),
        _but(CLICKER, '"map"', '"odom"'),
        _but(CLICKER, "clicks.get_num_connections() == 0", "False"),
        _but(CLICKER, "(0.3, 0.2)]", "(0.0, 2.2)]"),
    ],
    "enough": [
        _but(ENOUGH, "value >= 0", "value == 0"),
        _but(ENOUGH, "**2", ""),
        _but(ENOUGH, "known * grid.info.resolution**2", "known * 0.0025"),
        _but(ENOUGH, "square_metres >= enough", "square_metres >= 12"),
        _but(ENOUGH, "    if square_metres >= enough:\n        cancel.publish(GoalID())\n", ""),
        _but(ENOUGH, "cancel.publish(GoalID())", "rospy.signal_shutdown('enough')"),
    ],
}
