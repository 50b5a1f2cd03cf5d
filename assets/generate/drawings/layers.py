"""Where ROS is: above the operating systems of several computers, and below the programs that are a robot."""

from __future__ import annotations

from rosmini.viz.layout import Rect

from .sheet import Sheet

WIDTH = 640.0
GAP = 12.0
COLUMN = (WIDTH - 3 * GAP) / 2
COMPUTERS = (
    ("A laptop", ("RViz", "teleoperation"), "Linux", "screen, keyboard, wireless"),
    ("The robot's computer", ("navigation", "laser", "motors"), "Linux", "laser scanner, motors, wireless"),
)
ROS = (
    "ROS",
    "Master · topics, services, parameters · client libraries",
    "message types · packages · tools · conventions",
)


def layers() -> str:
    """Two computers as columns of layers, with ROS across both."""
    return layers_sheet().svg("Where ROS stands", _alt())


def layers_sheet() -> Sheet:
    """The drawing of the layers."""
    sheet = Sheet(WIDTH, 330)
    for at, (name, nodes, system, hardware) in enumerate(COMPUTERS):
        left = GAP + at * (COLUMN + GAP)
        sheet.box(Rect(left, 6, COLUMN, 318), "group-fill", "group-line", corner=10)
        sheet.words(name, left + COLUMN / 2, 26, colour="muted", anchor="middle")
        width = (COLUMN - GAP * (len(nodes) + 1)) / len(nodes)
        for place, node in enumerate(nodes):
            rect = Rect(left + GAP + place * (width + GAP), 38, width, 40)
            sheet.box(rect, "node-fill", "node-line", corner=20, lines=(node,))
        sheet.box(Rect(left + GAP, 210, COLUMN - 2 * GAP, 46), "page", "line", lines=(system, "an operating system"))
        sheet.box(Rect(left + GAP, 266, COLUMN - 2 * GAP, 46), "page", "line", lines=("Hardware", hardware))
    sheet.box(Rect(2 * GAP, 98, WIDTH - 4 * GAP, 92), "topic-fill", "topic-line", lines=ROS, bold=True)
    return sheet


def _alt() -> str:
    told = " ".join(
        f"{name}: hardware ({hardware}), above it {system}, an operating system; at the top the nodes "
        f"{', '.join(nodes)}."
        for name, nodes, system, hardware in COMPUTERS
    )
    return (
        "Two computers drawn as columns of layers. "
        f"{told} Between operating system and nodes, across both computers, lies ROS: {'; '.join(ROS[1:])}."
    )
