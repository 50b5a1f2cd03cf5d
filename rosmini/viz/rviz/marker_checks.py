"""Find errors in a `visualization_msgs/Marker`, in RViz's words (`checkMarkerMsg` of rviz 1.14).

A marker with an error is not drawn; a marker with a warning is drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from rosmini.msgs import message_class

from .display import Level
from .topic_display import LENGTH_TOLERANCE

Marker = message_class("visualization_msgs/Marker")

SHAPES = (Marker.CUBE, Marker.CYLINDER, Marker.SPHERE)
LINES = (Marker.LINE_STRIP, Marker.LINE_LIST)
SOLIDS = (Marker.CUBE_LIST, Marker.SPHERE_LIST, Marker.TRIANGLE_LIST)
LISTS = (*LINES, *SOLIDS, Marker.POINTS)
_ERROR, _WARN, _OK = Level.ERROR, Level.WARN, Level.OK

Finding = tuple[Level, str]


def check(marker: Any) -> tuple[Level, str]:
    """Return the severity of a marker's problems, and their description; empty if there are none."""
    if marker.type not in (Marker.ARROW, *SHAPES, *LISTS, Marker.TEXT_VIEW_FACING, Marker.MESH_RESOURCE):
        return _ERROR, f"Unknown marker type: {marker.type}"
    found = list(_findings(marker))
    level = max((each for each, _ in found), default=_OK)
    return level, "; ".join(text.rstrip(".") for _, text in found)


def _findings(marker: Any) -> Iterator[Finding]:
    position, scale, color = marker.pose.position, marker.scale, marker.color
    for name, values in (
        ("Position", (position.x, position.y, position.z)),
        ("Scale", (scale.x, scale.y, scale.z)),
        ("Color", (color.r, color.g, color.b, color.a)),
    ):
        if not all(map(math.isfinite, values)):
            yield _ERROR, f"{name} contains invalid floating point values (nans or infs)"
    if marker.type not in (Marker.POINTS, Marker.TEXT_VIEW_FACING):
        yield from _quaternion(marker.pose.orientation)
    yield from _scale(marker)
    yield from _points(marker)
    yield from _colours(marker)
    yield from _text(marker)
    yield from _mesh(marker)


def _quaternion(quaternion: Any) -> Iterator[Finding]:
    values = (quaternion.x, quaternion.y, quaternion.z, quaternion.w)
    length = math.hypot(*values)
    if not math.isfinite(length):
        yield _ERROR, "Orientation contains invalid floating point values (nans or infs)"
    elif length == 0:
        yield _OK, "Uninitialized quaternion, assuming identity."
    elif abs(length - 1) > LENGTH_TOLERANCE:
        yield _WARN, "Unnormalized quaternion in marker message."


def _scale(marker: Any) -> Iterator[Finding]:
    x, y, z = marker.scale.x, marker.scale.y, marker.scale.z
    kind = marker.type
    used: tuple[float, ...]
    if kind in LINES:
        used, text = (x,), "Width LINE_LIST or LINE_STRIP is 0.0 (scale.x)."
    elif kind == Marker.POINTS:
        used, text = (x, y), "Width and/or height of POINTS is 0.0 (scale.x, scale.y)."
    elif kind == Marker.TEXT_VIEW_FACING:
        used, text = (z,), "Text height of TEXT_VIEW_FACING is 0.0 (scale.z)."
    else:
        used, text = ((x, y) if kind == Marker.ARROW and x and y else (x, y, z), "Scale contains 0.0 in x, y or z.")
    if 0.0 in used:
        yield _WARN, text
    if any(value < 0 for value in used):
        yield _WARN, "Scale contains a negative number; its absolute value is drawn."


def _points(marker: Any) -> Iterator[Finding]:
    count, kind = len(marker.points), marker.type
    if kind == Marker.ARROW:
        if count not in (0, 2):
            yield _ERROR, "Number of points for an ARROW marker should be either 0 or 2."
    elif kind not in LISTS:
        if count:
            yield _WARN, "Non-empty points array is ignored."
    elif not count:
        yield _ERROR, "Points should not be empty for specified marker type."
    elif kind == Marker.TRIANGLE_LIST and count % 3:
        yield _ERROR, "Number of points should be a multiple of 3 for TRIANGLE_LIST marker."
    elif kind == Marker.LINE_LIST and count % 2:
        yield _ERROR, "Number of points should be a multiple of 2 for LINE_LIST marker."
    elif kind == Marker.LINE_STRIP and count < 2:
        yield _ERROR, "At least two points are required for a LINE_STRIP marker."


def _colours(marker: Any) -> Iterator[Finding]:
    count, color = len(marker.colors), marker.color
    if marker.type in LISTS and count:
        fits = (len(marker.points), len(marker.points) / 3 if marker.type == Marker.TRIANGLE_LIST else 0)
        if count not in fits:
            yield _ERROR, "Number of colors doesn't match number of points."
        return
    if count:
        yield _WARN, "Non-empty colors array is ignored."
    of_the_file = marker.type == Marker.MESH_RESOURCE and marker.mesh_use_embedded_materials
    if color.a == 0 and not (of_the_file and color.r == color.g == color.b == 0):
        yield _OK, "Marker is fully transparent (color.a is 0.0)."


def _text(marker: Any) -> Iterator[Finding]:
    if marker.type != Marker.TEXT_VIEW_FACING:
        if marker.text:
            yield _OK, "Non-empty text is ignored."
    elif not marker.text.strip():
        yield _ERROR, "Text is empty or only consists of whitespace."


def _mesh(marker: Any) -> Iterator[Finding]:
    if marker.type == Marker.MESH_RESOURCE:
        if not marker.mesh_resource:
            yield _ERROR, "Empty mesh_resource path."
    elif marker.mesh_resource:
        yield _OK, "Non-empty mesh_resource is ignored."
    elif marker.mesh_use_embedded_materials:
        yield _OK, "mesh_use_embedded_materials is ignored."
