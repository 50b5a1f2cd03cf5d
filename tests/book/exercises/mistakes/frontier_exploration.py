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
for x, y in [(-2, -2), (2, -2), (2, 2), (-2, 2), (-2, -2), (0, 0)]:
    click = PointStamped()
    click.header.frame_id = "map"
    click.point.x, click.point.y = x, y
    clicks.publish(click)
    rospy.sleep(0.5)
"""

SURVEYOR = """
import rospy
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Float64


def on_map(grid):
    known = sum(value >= 0 for value in grid.data)
    area.publish(known * grid.info.resolution**2)


rospy.init_node("surveyor")
area = rospy.Publisher("known_area", Float64, queue_size=1)
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
        _but(CLICKER, "(-2, 2), (-2, -2)", "(-2, 2)"),
        _but(CLICKER, "(-2, -2), (0, 0)]", "(-2, -2)]"),
        _but(CLICKER, "(2, 2), (-2, 2)", "(-2, 2), (2, 2)"),
        _but(CLICKER, '"map"', '"odom"'),
        _but(CLICKER, "clicks.get_num_connections() == 0", "False"),
        _but(CLICKER, "x, y\n    clicks", "x / 2, y / 2\n    clicks"),
    ],
    "surveyor": [
        _but(SURVEYOR, ">= 0", "== 0"),
        _but(SURVEYOR, "**2", ""),
        _but(SURVEYOR, ">= 0", "< 0"),
        _but(SURVEYOR, "known * grid.info.resolution**2", "known * 0.0025"),
    ],
}
