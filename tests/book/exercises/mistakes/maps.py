"""Wrong answers to the exercises of the chapter Maps: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

HERE = solution("maps", "here")

KEEPOUT = """
import rospy
from nav_msgs.msg import OccupancyGrid


def on_map(grid):
    cells = list(grid.data)
    info = grid.info
    for my in range(info.height):
        for mx in range(info.width):
            x = info.origin.position.x + (mx + 0.5) * info.resolution
            y = info.origin.position.y + (my + 0.5) * info.resolution
            if 0 < x < 1 and 0 < y < 1:
                cells[my * info.width + mx] = 100
    grid.data = cells
    keepout.publish(grid)


rospy.init_node("keepout")
keepout = rospy.Publisher("keepout_map", OccupancyGrid, queue_size=1, latch=True)
rospy.Subscriber("map", OccupancyGrid, on_map)
rospy.spin()
"""

LIFT = solution("maps", "lift")


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


def _classify(
    *, flip: bool = True, negate: bool = True, strict: bool = True, wrap: bool = False, kind: Any = np.array
) -> Callable[[], Any]:
    def classify(pixels: Any, free: float, occupied: float, is_negated: int) -> Any:
        value = pixels[::-1] if flip else pixels
        p = (255 - value.astype(float)) / 255
        if is_negated and negate:
            p = 1 - p
        cells = np.full(p.shape, 0 if wrap else -1)
        cells[p < free if strict else p <= free] = 0
        cells[p > occupied if strict else p >= occupied] = 100
        return kind(cells)

    return lambda: classify


MISTAKES = {
    "here": [
        _but(HERE, "math.floor(", "int("),
        _but(HERE, "math.floor(", "round("),
        _but(HERE, " - info.origin.position.x", ""),
        _but(HERE, " - info.origin.position.y", ""),
        _but(HERE, "if 0 <= column < info.width and 0 <= row < info.height", "if True"),
        _but(HERE, "info.width and 0 <= row < info.height", "info.height and 0 <= row < info.width"),
        _but(HERE, "row * info.width + column", "column * info.height + row"),
        _but(HERE, "    else:\n        value.publish(-1)\n", ""),
    ],
    "classify": [
        _classify(flip=False),
        _classify(negate=False),
        _classify(strict=False),
        _classify(wrap=True),
        _classify(kind=list),
        lambda: lambda pixels, free, occupied, negate: np.zeros(3),
    ],
    "keepout": [
        _but(KEEPOUT, ", latch=True", ""),
        _but(KEEPOUT, "info.origin.position.x + ", ""),
        _but(KEEPOUT, "info.origin.position.y + ", ""),
        _but(KEEPOUT, "my * info.width + mx", "mx * info.height + my"),
        _but(KEEPOUT, "* info.resolution", "* 0.5"),
        _but(KEEPOUT, "(mx + 0.5)", "mx"),
        _but(KEEPOUT, "    grid.data = cells\n", ""),
        _but(KEEPOUT, "    grid.data = cells\n", "    grid.data = cells\n    info.origin.position.x = 0\n"),
        _but(KEEPOUT, "    keepout.publish(grid)\n", ""),
    ],
    "lift": [
        _but(LIFT, "change_map(message.data)", 'change_map("package://rosmini_sim/maps/house.yaml")'),
        _but(LIFT, "answer.result != answer.RESULT_SUCCESS", "False"),
        _but(LIFT, "answer.result != answer.RESULT_SUCCESS", "True"),
        _but(LIFT, ': %s", message.data', '"'),
        _but(LIFT, "rospy.logerr(", "raise RuntimeError("),
        _but(LIFT, "    if answer", "    rospy.signal_shutdown('done')\n    if answer"),
    ],
}
