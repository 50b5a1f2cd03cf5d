"""Wrong answers to the exercises of the chapter RViz: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

LASER = """
Visualization Manager:
  Global Options: {Fixed Frame: odom}
  Displays:
    - Class: rviz/LaserScan
      Name: Laser
      Topic: /scan
      Color Transformer: FlatColor
      Color: 0; 0; 255
      Size (m): 0.05
      Decay Time: 10
"""

FRIEND = """
Visualization Manager:
  Global Options: {Fixed Frame: odom}
  Displays:
    - {Class: rviz/LaserScan, Name: Laser, Topic: /scan}
    - {Class: rviz/Odometry, Name: Path, Topic: /odom, Covariance: {Value: false}}
    - {Class: rviz/TF, Name: Frames, Enabled: true}
"""

TRAIL = solution("rviz", "trail")


def _text(right: str, old: str, new: str) -> Callable[[], str]:
    assert old in right
    return lambda: right.replace(old, new)


def _script(old: str, new: str) -> Callable[[], Script]:
    assert old in TRAIL
    return lambda: Script("answer.py", TRAIL.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "properties": [
        dict,
        lambda: "FlatColor",
        lambda: "Visualization Manager: [",
        _text(LASER, "Visualization Manager", "Manager"),
        _text(LASER, "odom", "base_scan"),
        _text(LASER, "rviz/LaserScan", "rviz/Laser"),
        _text(LASER, "/scan", "/scans"),
        _text(LASER, "Color:", "Colour:"),
        _text(LASER, "0; 0; 255", "255; 0; 0"),
        _text(LASER, "FlatColor", "Intensity"),
        _text(LASER, "Decay Time: 10", "Decay Time: 1"),
        _text(LASER, "Decay Time: 10", "Style: Points"),
        _text(LASER, "      Size (m): 0.05\n", ""),
        _text(
            LASER, "    - Class: rviz/LaserScan", "    - {Class: rviz/Grid, Name: Grid}\n    - Class: rviz/LaserScan"
        ),
    ],
    "correct": [
        lambda: None,
        _text(FRIEND, "Frame: odom", "Frame: odon"),
        _text(FRIEND, "Frame: odom", "Frame: base_footprint"),
        _text(FRIEND, "/scan", "/scans"),
        _text(FRIEND, "/scan", "/odom"),
        _text(FRIEND, "/odom", "/imu"),
        _text(FRIEND, "true", "false"),
        _text(FRIEND, "    - {Class: rviz/TF, Name: Frames, Enabled: true}\n", ""),
    ],
    "trail": [
        _script("LINE_STRIP", "POINTS"),
        _script("0.03", "0.3"),
        _script(", line.color.a = 1.0, 1.0", " = 1.0"),
        _script("line.header = odom.header", "line.header.frame_id = 'map'"),
        _script("line.points.append(odom.pose.pose.position)", "line.points = [odom.pose.pose.position]"),
        _script("line.points.append(", "line.id += 1\n    line.points.append("),
        _script('"visualization_marker"', '"trail"'),
        _script("    markers.publish(line)\n", ""),
    ],
}
