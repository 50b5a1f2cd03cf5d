"""A laser scan from the robot's point of view: the hits around it, and the range of each beam over its angle."""

from __future__ import annotations

import math
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from rosmini.core.geometry.poses import compose
from rosmini.sim.models import BURGER, RobotModel
from rosmini.viz.beams import Beams, Floats, beams_of
from rosmini.viz.figures import WIDTH, add_axes, blank_figure, house_style, say, set_ticks, step_of, ticks
from rosmini.viz.rounding import degrees, fixed, snap
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.view import Picture, matplotlib_picture
from rosmini.viz.world_drawing import draw_dots, draw_robot, draw_scan, draw_strokes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIDE = 264.0
"""Width and height of the round view [px]."""
EDGE, FLANK = 24.0, 40.0
"""Space above and below it, and on each side of it, for the labels [px]."""


GROUND = MappingProxyType({"facecolor": LIGHT["page"], "alpha": 0.75, "edgecolor": "none", "pad": 1.0})
"""Background of labels in front of other things."""


def scan_picture(
    scan: Any, *, model: RobotModel | None = None, title: str | None = None, width: float = WIDTH
) -> Picture:
    """Draw a scan twice: around the robot, with ahead at the top, and as ranges over angles, with the left on the left.

    Args:
        scan: a `sensor_msgs/LaserScan`, or ranges [m], where beam i has the direction 2 pi i / beams from ahead.
        model: the robot with the laser; by default the TurtleBot3 Burger. Only its drawing depends on it.
        title: a caption under the picture, and the first words of its text form.
        width: width of the picture [CSS px].

    Raises:
        ViewError: the scan is invalid, or the numbers of its angles and ranges do not match.

    """
    beams = beams_of(scan)
    model = model or BURGER
    name = title or ("scan" if not beams.frame else f"scan in {beams.frame}")
    text = f"{name}: {beams.text()}"
    around = beams.around()
    if around:
        text += f"\nbeams {around}"
    clause = beams.clause()
    alt = f"A laser scan around the robot: {clause}. {around[:1].upper()}{around[1:]}{'.' if around else ''}"
    with house_style():
        figure = blank_figure(width, SIDE + 2 * EDGE)
        _around(figure, beams, model)
        _over_angles(figure, beams, width)
        return matplotlib_picture(figure, text=text, alt=alt.strip(), form="svg", caption=title)


def _around(figure: Figure, beams: Beams, model: RobotModel) -> None:
    radius = _radius(beams)
    axes = add_axes(figure, FLANK, EDGE, SIDE, SIDE)
    axes.set(xlim=(-radius, radius), ylim=(-radius, radius), xticks=[], yticks=[])
    step = step_of(radius, 4)
    for ring in ticks(step, radius, step):
        _ring(axes, ring)
    scale = SIDE / (2 * radius)
    up = (0.0, 0.0, math.pi / 2)
    draw_scan(axes, replace(beams, range_max=radius), up, scale)
    mount = model.laser.mount
    draw_robot(axes, model, compose(up, (-mount[0], -mount[1], 0.0)), scale)
    _mark_nearest(axes, beams)
    gap = 6.0 / scale
    for words, x, y, across, along in (
        ("ahead", 0.0, radius + gap, "center", "bottom"),
        ("left", -radius - gap, 0.0, "right", "center"),
        ("behind", 0.0, -radius - gap, "center", "top"),
        ("right", radius + gap, 0.0, "left", "center"),
    ):
        axes.text(x, y, words, ha=across, va=along, color=LIGHT["muted"], size=LABEL_SIZE)


def _ring(axes: Axes, ring: float) -> None:
    from matplotlib.patches import Circle

    axes.add_artist(
        Circle(
            (0, 0), ring, fill=False, edgecolor=LIGHT["group-line"], alpha=0.6, linewidth=1.0, zorder=1.0, clip_on=False
        )
    )  # fmt: skip
    diagonal = float(snap(ring * math.sqrt(0.5)))
    axes.text(
        diagonal,
        -diagonal,
        f"{say([ring])[0]} m",
        color=LIGHT["muted"],
        size=LABEL_SIZE - 1,
        ha="center",
        va="center",
        zorder=6.0,
        bbox=dict(GROUND),
    )


def _mark_nearest(axes: Axes, beams: Beams) -> None:
    nearest = beams.nearest()
    if nearest is not None:
        ahead, left = snap(beams.points()[nearest])
        _encircle(axes, -float(left), float(ahead))


def _encircle(axes: Axes, x: float, y: float) -> None:
    axes.plot(
        [x],
        [y],
        "o",
        markersize=10.0,
        markerfacecolor="none",
        markeredgecolor=LIGHT["ink"],
        markeredgewidth=1.5,
        zorder=8.0,
        clip_on=False,
    )


def _over_angles(figure: Figure, beams: Beams, width: float) -> None:
    left, bottom = SIDE + 2 * FLANK + 50.0, 44.0
    axes = add_axes(figure, left, EDGE, width - left - 26.0, SIDE + EDGE - bottom)
    angles = np.array([float(degrees(a, 3)) for a in beams.angles])
    top = _radius(beams)
    low, high = _field(angles)
    step = 90.0 if high - low > 180 else 45.0 if high - low > 90 else 15.0
    marks = ticks(low, high, step)
    words = {180: "behind", 90: "left", 0: "ahead", -90: "right", -180: "behind"}
    labels = [f"{label}°\n{words.get(round(at), '')}" for label, at in zip(say(marks), marks, strict=True)]
    axes.set(xlim=(high, low), ylim=(0.0, top), ylabel="range [m]")
    axes.set_xticks(marks, labels=labels)
    set_ticks(axes.yaxis, 0.0, top, step_of(top, 5))
    draw_dots(axes, np.column_stack([angles, snap(beams.ranges)])[beams.hits], "vermilion", 2.8)
    missed = angles[~beams.hits]
    if len(missed):
        ends = [np.column_stack([missed, np.full(len(missed), y * top)]) for y in (1.0, 0.98)]
        draw_strokes(axes, np.stack(ends, axis=1), "muted", 1.0)
        middle = (float(missed[len(missed) // 2]), top)
        _say_at(axes, "no hit", middle, 4, "bottom")
    nearest = beams.nearest()
    if nearest is not None:
        spot = (float(angles[nearest]), float(snap(beams.ranges[nearest])))
        _encircle(axes, *spot)
        # there is nothing below the nearest hit
        below = spot[1] > 0.12 * top
        _say_at(
            axes,
            f"nearest {fixed(beams.ranges[nearest], 2)} m",
            (min(max(spot[0], low + 0.2 * (high - low)), high - 0.2 * (high - low)), spot[1]),
            -9 if below else 9,
            "top" if below else "bottom",
        )


def _say_at(axes: Axes, words: str, spot: tuple[float, float], above: float, along: Literal["top", "bottom"]) -> None:
    axes.annotate(
        words,
        spot,
        (0, above),
        textcoords="offset points",
        ha="center",
        va=along,
        color=LIGHT["ink"],
        bbox=dict(GROUND),
        zorder=9.0,
    )


ALONE = 15.0
"""Extent of the axis to either side of a single beam ahead [deg]."""


def _field(angles: Floats) -> tuple[float, float]:
    """Return the range of angles of the axis [deg]: all beams, and ahead."""
    low, high = min(angles.min(), 0.0), max(angles.max(), 0.0)
    if low == high:
        return (-ALONE, ALONE)
    return (-180.0, 180.0) if high - low > 300 else (float(low), float(high))


def _radius(beams: Beams) -> float:
    """Return the radius of the picture [m]: the furthest hit, or the laser's maximum range if a beam hits nothing."""
    if not beams.hits.all():
        return beams.range_max
    furthest = float(beams.ranges.max())
    step = step_of(furthest, 8)
    return math.ceil(furthest / step - 0.0137) * step
