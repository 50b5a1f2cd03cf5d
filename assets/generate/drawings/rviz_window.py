"""A drawing of RViz's window, with numbers at its six parts."""

from __future__ import annotations

from rosmini.viz import style
from rosmini.viz.graph_drawing import box, text
from rosmini.viz.layout import Layout, Rect
from rosmini.viz.svg import element

from .concepts import diagram

WIDTH, HEIGHT = 620.0, 380.0
MENU, TOOLS = Rect(0.0, 0.0, WIDTH, 28.0), Rect(0.0, 28.0, WIDTH, 34.0)
DISPLAYS, SCENE, VIEWS = (
    Rect(0.0, 62.0, 170.0, 278.0),
    Rect(170.0, 62.0, 310.0, 278.0),
    Rect(480.0, 62.0, 140.0, 278.0),
)
TIME = Rect(0.0, 340.0, WIDTH, 40.0)
LISTED = (
    "Global Options", "   Fixed Frame   odom", "Global Status: Ok", "☑ Grid", "☑ LaserScan", "   Status: Ok",
    "   Topic   /scan", "☑ RobotModel", "   Status: Ok", "☐ TF", "", "[ Add ]  [ Remove ]",
)  # fmt: skip
VIEWED = ("Type: Orbit (rviz)", "Current View", "   Distance   1.2", "   Yaw        0.7", "   Pitch       0.45")
ALT = (
    "The window of RViz with six numbers. 1: the 3D view in the middle, with a grid, a robot and red points of a "
    "laser. 2: the panel Displays at the left, with the fixed frame, and Grid, LaserScan and RobotModel, which are "
    "ticked, and TF, which is not. 3: the menu bar at the top: File, Panels, Help. 4: the tools below it, from "
    "Interact to Publish Point. 5: the panel Views at the right, with the type Orbit and a distance of 1.2. 6: the "
    "panel Time at the bottom, with ROS Time, ROS Elapsed, Wall Time and Wall Elapsed."
)
TIMES = "ROS Time: 12.40   ROS Elapsed: 12.40   Wall Time: ...   Wall Elapsed: ...   [ Reset ]"
NUMBERS = ((190.0, 82.0), (16.0, 78.0), (16.0, 14.0), (16.0, 45.0), (496.0, 78.0), (16.0, 360.0))
"""The places of the numbers, in order."""


def rviz_window() -> str:
    """Draw the window of RViz with its six parts."""
    parts = [element("g", box(each, "group", 0.0), class_="ps-group") for each in (MENU, TOOLS, DISPLAYS, VIEWS, TIME)]
    parts += [_scene()]
    parts += [_line("File    Panels    Help", 34.0, 18.5)]
    parts += [_line("Interact   Move Camera   Select   Focus   Measure   2D Pose   2D Nav Goal   Publish", 34.0, 49.5)]
    parts += [_line(words, 12.0, 104.0 + 18.0 * i) for i, words in enumerate(LISTED) if words]
    parts += [_line(words, 492.0, 104.0 + 18.0 * i) for i, words in enumerate(VIEWED)]
    parts += [_line("Displays", 34.0, 82.0), _line("Views", 514.0, 82.0)]
    parts += [_line(TIMES, 34.0, 364.0)]
    parts += [_number(i, *place) for i, place in enumerate(NUMBERS, 1)]
    return diagram(parts, Layout(WIDTH, HEIGHT), "The window of RViz", ALT)


def _line(words: str, x: float, y: float) -> str:
    """Return a line of text, which keeps its spaces."""
    return text(words.replace(" ", "\u00a0"), x, y, size=style.LABEL_SIZE, anchor=None, kind="ps-name")


def _number(number: int, x: float, y: float) -> str:
    """Return a number in a circle, in the colours of the page."""
    circle = box(Rect(x - 10.0, y - 10.0, 20.0, 20.0), "topic", 10.0)
    return element("g", circle + text(str(number), x, y + 4.5, kind="ps-name"), class_="ps-topic")


def _scene() -> str:
    """Return the 3D view: a grid in perspective, a robot and points of its laser."""
    x0, y0, x1, y1 = SCENE.x, SCENE.y, SCENE.right, SCENE.bottom
    middle, horizon = (x0 + x1) / 2, y0 + 70.0
    made = [element("rect", x=x0, y=y0, width=x1 - x0, height=y1 - y0, fill="#303030")]
    grey: dict[str, str | float] = {"fill": "none", "stroke": "#a0a0a4", "stroke_width": 1.0}
    made += [
        element("path", d=f"M{middle + 16 * i},{horizon}L{middle + 30 * i},{y1 - 8}", **grey) for i in range(-5, 6)
    ]
    for i in range(6):
        depth = i * (i + 2) / 35
        half, y = 80 + 70 * depth, horizon + (y1 - 8 - horizon) * depth
        made.append(element("path", d=f"M{middle - half},{y:.1f}L{middle + half},{y:.1f}", **grey))
    made += [
        element("circle", cx=middle - 80 + 8 * i, cy=horizon + 4 + (i % 3), r=1.8, fill="#ff1900") for i in range(21)
    ]
    made.append(element("rect", x=middle - 24, y=y1 - 118, width=48, height=34, rx=4, fill="#c8ced4"))
    made.append(element("rect", x=middle - 16, y=y1 - 134, width=32, height=14, rx=3, fill="#8a949e"))
    made += [element("ellipse", cx=middle + dx, cy=y1 - 88, rx=7, ry=16, fill="#111111") for dx in (-27, 27)]
    return "".join(made)
