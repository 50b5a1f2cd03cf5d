"""What ROS consists of: four things that are of use together."""

from __future__ import annotations

from rosmini.viz.layout import Rect
from rosmini.viz.style import LABEL_SIZE

from .sheet import LINE, Sheet

PARTS = (
    ("Plumbing", "messages from program to program", ("nodes, Master", "topics, services", "parameters")),
    ("Tools", "to see and to steer what runs", ("rostopic, rosnode", "roslaunch, rosbag", "RViz, rqt")),
    ("Capabilities", "what robots are able to do", ("drivers, frames", "maps, localisation", "navigation")),
    ("Ecosystem", "those who make it and share it", ("packages, distributions", "documentation", "people")),
)
SIDE = (290.0, 132.0)
GAP = 44.0


def parts() -> str:
    """Four boxes with a plus sign between them."""
    return parts_sheet().svg("What ROS consists of", _alt())


def parts_sheet() -> Sheet:
    """The drawing of the parts."""
    width, height = SIDE
    sheet = Sheet(2 * width + GAP + 8, 2 * height + GAP + 8)
    for at, (name, what, examples) in enumerate(PARTS):
        x = 4 + (at % 2) * (width + GAP)
        y = 4 + (at // 2) * (height + GAP)
        kind = "topic" if at % 2 == 0 else "node"
        sheet.box(Rect(x, y, width, height), f"{kind}-fill", f"{kind}-line", corner=10)
        sheet.words(name, x + width / 2, y + 28, size=16, anchor="middle", bold=True)
        sheet.words(what, x + width / 2, y + 50, anchor="middle")
        for row, example in enumerate(examples):
            sheet.words(example, x + width / 2, y + 78 + row * LINE, size=LABEL_SIZE, colour="muted", anchor="middle")
    middle = 4 + width + GAP / 2
    for y in (4 + height / 2, 4 + height + GAP + height / 2):
        sheet.words("+", middle, y + 8, size=24, colour="muted", anchor="middle")
    sheet.words("+", middle, 4 + height + GAP / 2 + 8, size=24, colour="muted", anchor="middle")
    return sheet


def _alt() -> str:
    told = " ".join(f"{name}: {what} ({'; '.join(examples)})." for name, what, examples in PARTS)
    return f"Four boxes joined by plus signs. {told}"
