"""A drawing of the frames of a mobile robot on uneven ground, seen from the side (REP 105, REP 120)."""

from __future__ import annotations

import math
from typing import Any

from rosmini.viz.graph_drawing import MARGIN, rule, text
from rosmini.viz.metrics import text_width
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.svg import document, element, number

WIDTH, HEIGHT = 660.0, 300.0
PLANE = 232.0
"""y of the plane z = 0 of map and odom [px]."""
TILT = math.radians(16.0)
"""Pitch of the robot, nose up [rad]."""
AXIS, LONG_AXIS = 40.0, 84.0
"""Length of an axis, and of those in the robot's body [px]."""
BASE = (430.0, 138.0)
"""Origin of base_link [px]."""
ALT = (
    "A side view of a robot that climbs a slope, nose up. The frames map and odom are on a dashed level line, z = 0, "
    "at the left. base_footprint is on this line below the robot, with level axes. base_stabilized and base_link share "
    "their origin in the robot's body: the axes of base_stabilized are level, those of base_link are tilted with the "
    "robot. base_scan is on top of the robot and tilted in the same way."
)
COLOURS = {
    "red": "vermilion",
    "up": "blue",
    "ground": "group-line",
    "body": "node-line",
    "word": "ink",
    "faint": "line",
}


def frames_on_rough_ground() -> str:
    """Draw the frames of a robot that climbs a slope."""
    parts = [_ground(), _plane(), _robot()]
    scan = _tilted(BASE, (0.0, 62.0))
    for name, origin, tilt, length, dx, dy in (
        ("map", (60.0, PLANE), 0.0, AXIS, 0.0, 18.0),
        ("odom", (180.0, PLANE), 0.0, AXIS, 0.0, 18.0),
        ("base_footprint", (BASE[0], PLANE), 0.0, AXIS, 0.0, 18.0),
        ("base_stabilized", BASE, 0.0, LONG_AXIS, 142.0, 4.0),
        ("base_link", BASE, TILT, LONG_AXIS, 118.0, -24.0),
        ("base_scan", scan, TILT, AXIS, 82.0, -10.0),
    ):
        parts += [*_axes(origin, tilt, length), _word(name, origin[0] + dx, origin[1] + dy)]
    css = "".join(
        rule(f".fr-{kind}", **({"fill": colour} if kind == "word" else {"stroke": colour}))
        for kind, colour in COLOURS.items()
    )
    css += rule(".fr-solid", fill="node-fill", stroke="node-line") + rule(".fr-earth", fill="group-fill")
    css += ".rosmini-svg .fr-word{font-weight:600}"
    body = element("g", "".join(parts), transform=f"translate({number(MARGIN)},{number(MARGIN)})")
    title = "Frames of a robot on uneven ground"
    return document(
        body, width=WIDTH + 2 * MARGIN, height=HEIGHT + 2 * MARGIN, title=title, alt=ALT, css=css,
        colours=[*COLOURS.values(), "node-fill", "group-fill"],
    )  # fmt: skip


def _tilted(origin: tuple[float, float], offset: tuple[float, float]) -> tuple[float, float]:
    """Return the point that is `offset` (forwards, upwards) from `origin` in the robot's frame [px]."""
    ahead, up = offset
    cosine, sine = math.cos(TILT), math.sin(TILT)
    return origin[0] + ahead * cosine - up * sine, origin[1] - ahead * sine - up * cosine


def _axes(origin: tuple[float, float], tilt: float, length: float) -> list[str]:
    """Return a frame's axes x (to the right at no tilt) and z, with arrowheads."""
    drawn = []
    for angle, kind in ((tilt, "red"), (tilt + math.pi / 2, "up")):
        tip = (origin[0] + length * math.cos(angle), origin[1] - length * math.sin(angle))
        drawn.append(_line(origin, tip, kind, 2.6))
        for side in (-2.6, 2.6):
            end = (tip[0] + 8 * math.cos(angle + side), tip[1] - 8 * math.sin(angle + side))
            drawn.append(_line(tip, end, kind, 2.6))
    return drawn


def _ground() -> str:
    """Return the ground: level, then a slope below the wheels, then down again."""
    foot = _tilted(BASE, (0.0, -46.0))
    rise = math.tan(TILT)
    left, right = 330.0, 505.0
    points = [
        (0.0, PLANE), (foot[0] - (PLANE - foot[1]) / rise, PLANE), (right, foot[1] - (right - foot[0]) * rise),
        (575.0, 172.0), (WIDTH, 196.0),
    ]  # fmt: skip
    assert points[1][0] < left  # noqa: S101 - the wheels stand on the slope
    line = "M" + "L".join(f"{number(x)},{number(y)}" for x, y in points)
    earth = f"{line}L{number(WIDTH)},{number(HEIGHT)}L0,{number(HEIGHT)}Z"
    return element("path", d=earth, class_="fr-earth", fill=LIGHT["group-fill"]) + element(
        "path", d=line, fill="none", class_="fr-ground", stroke=LIGHT["group-line"], stroke_width=2
    )


def _plane() -> str:
    """Return the plane z = 0, and the vertical line from it to the robot."""
    return (
        _line((0.0, PLANE), (WIDTH, PLANE), "faint", 1.0, dash="5 4")
        + _line((BASE[0], PLANE), BASE, "faint", 1.0, dash="2 3")
        + _word("z = 0", WIDTH - 26, PLANE - 6)
    )


def _robot() -> str:
    """Return the tilted robot: a body, a mast with the laser, and two wheels."""
    turned = f"translate({number(BASE[0])},{number(BASE[1])}) rotate({number(-math.degrees(TILT))})"
    paint: dict[str, Any] = {
        "class_": "fr-solid",
        "fill": LIGHT["node-fill"],
        "stroke": LIGHT["node-line"],
        "stroke_width": 1.4,
    }
    shapes = [
        element("rect", x=-58, y=-22, width=116, height=44, rx=6, **paint),
        element("rect", x=-6, y=-54, width=12, height=32, **paint),
        element("rect", x=-20, y=-70, width=40, height=17, rx=4, **paint),
        *(element("circle", cx=x, cy=27, r=19, **paint) for x in (-36, 36)),
    ]
    return element("g", "".join(shapes), transform=turned)


def _line(
    start: tuple[float, float], end: tuple[float, float], kind: str, width: float, dash: str | None = None
) -> str:
    return element(
        "line", x1=start[0], y1=start[1], x2=end[0], y2=end[1], class_=f"fr-{kind}", stroke=LIGHT[COLOURS[kind]],
        stroke_width=width, stroke_linecap="round", stroke_dasharray=dash,
    )  # fmt: skip


def _word(words: str, x: float, y: float) -> str:
    """Return a frame's name, its middle at `x`, its baseline at `y`, kept within the drawing."""
    half = text_width(words, LABEL_SIZE) / 2 + 4
    return text(words, min(max(x, half), WIDTH - half), y, size=LABEL_SIZE + 1, kind="fr-word")
