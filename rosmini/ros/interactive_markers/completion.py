"""Defaults that RViz adds to incomplete interactive markers: handles, sizes, orientations, names.

The default handles are arrows along the axis of a control and rings around it. They are as wide as the marker's
``scale``, and red, green or blue for an axis nearest to x, y or z (http://wiki.ros.org/rviz/Tutorials, "Interactive
Markers: Getting Started").
"""

from __future__ import annotations

import itertools
import math
from typing import Any

from rosmini.core.tf.rigid import rigid, rotate
from rosmini.msgs import message_class

ColorRGBA = message_class("std_msgs/ColorRGBA")
InteractiveMarkerControl = message_class("visualization_msgs/InteractiveMarkerControl")
Marker = message_class("visualization_msgs/Marker")
Point = message_class("geometry_msgs/Point")
Quaternion = message_class("geometry_msgs/Quaternion")
Vector3 = message_class("geometry_msgs/Vector3")

_STEPS = 36
_INNER, _OUTER = 0.5, 0.65
"""Inner and outer radius of a ring, as fractions of the marker's scale."""
_SHADE = 0.6
"""Brightness factor of every second segment of a ring that rotates its marker."""
_RINGS = (
    InteractiveMarkerControl.MOVE_PLANE,
    InteractiveMarkerControl.ROTATE_AXIS,
    InteractiveMarkerControl.MOVE_ROTATE,
)


def auto_complete(marker: Any, *, transparent: bool = True) -> None:
    """Complete a ``visualization_msgs/InteractiveMarker`` in place, as RViz does before drawing it.

    A scale of 0 becomes 1 m; a zero quaternion becomes no rotation, others are normalised; controls without markers
    get the handles of their interaction mode; sizes of 0 become 1 m; controls with the same name are renamed. A
    marker without controls is not changed: it shows nothing. Handles are half transparent, or, without ``transparent``,
    opaque.
    """
    if not marker.controls:
        return
    marker.scale = marker.scale or 1.0
    marker.pose.orientation = _orientation(marker.pose.orientation)
    numbers = itertools.count()
    for control in marker.controls:
        _complete_control(marker, control, numbers, 0.5 if transparent else 1.0)
    names: set[str] = set()
    suffixes = itertools.count()
    for control in marker.controls:
        while control.name in names:
            control.name = f"{control.name}_u{next(suffixes)}"
        names.add(control.name)


def title_control(marker: Any) -> Any:
    """Return the control that shows the description of an interactive marker above it."""
    size = marker.scale * 0.15
    text = Marker(type=Marker.TEXT_VIEW_FACING, scale=Vector3(size, size, size), text=marker.description)
    text.color = ColorRGBA(1.0, 1.0, 1.0, 1.0)
    text.pose.position.z = marker.scale * 1.4
    control = InteractiveMarkerControl(
        orientation_mode=InteractiveMarkerControl.VIEW_FACING, always_visible=True, markers=[text]
    )
    _complete_control(marker, control, itertools.count())
    return control


def _complete_control(marker: Any, control: Any, numbers: itertools.count[int], alpha: float = 1.0) -> None:
    mode = control.interaction_mode
    control.orientation = _orientation(control.orientation, normalise=False)
    if not control.markers:
        if mode == InteractiveMarkerControl.MOVE_AXIS:
            control.markers = [_arrow(marker.scale, control, alpha, sign) for sign in (1.0, -1.0)]
        elif mode in _RINGS:
            control.markers = [_ring(marker.scale, control, alpha)]
        elif mode == InteractiveMarkerControl.MENU:
            control.orientation_mode = InteractiveMarkerControl.VIEW_FACING
            control.independent_marker_orientation = False
            control.markers = [_menu_text(marker.scale, control.description)]
    for shape in control.markers:
        shape.scale = Vector3(*((size or 1.0) for size in (shape.scale.x, shape.scale.y, shape.scale.z)))
        shape.pose.orientation = _orientation(shape.pose.orientation)
        shape.ns, shape.id = marker.name, next(numbers)


def _orientation(quaternion: Any, *, normalise: bool = True) -> Any:
    """Return a normalised quaternion; no rotation for zeros."""
    values = (quaternion.x, quaternion.y, quaternion.z, quaternion.w)
    length = math.hypot(*values)
    if length == 0:
        return Quaternion(0.0, 0.0, 0.0, 1.0)
    return Quaternion(*(value / length for value in values)) if normalise else quaternion


def _color(control: Any, alpha: float) -> Any:
    """Return the colour for the axis: x is red, y green, z blue."""
    q = _orientation(control.orientation)
    axis = [abs(float(value)) for value in rotate(rigid((0, 0, 0), (q.x, q.y, q.z, q.w)), (1.0, 0.0, 0.0))]
    longest = max(axis)
    return ColorRGBA(*(value / longest for value in axis), alpha)


def _arrow(scale: float, control: Any, alpha: float, direction: float) -> Any:
    arrow = Marker(type=Marker.ARROW, color=_color(control, alpha))
    arrow.pose.orientation = control.orientation
    arrow.scale = Vector3(0.15 * scale, 0.25 * scale, 0.2 * scale)
    arrow.points = [Point(direction * scale * at, 0.0, 0.0) for at in (0.5, 0.9)]
    return arrow


def _ring(scale: float, control: Any, alpha: float) -> Any:
    """Return a ring around the x axis: plain to move, striped to rotate, toothed for both."""
    base = _color(control, alpha)
    ring = Marker(type=Marker.TRIANGLE_LIST, color=base, scale=Vector3(scale, scale, scale))
    ring.pose.orientation = control.orientation
    angles = [math.tau * step / _STEPS for step in range(_STEPS)]
    inner, outer = ([(r * math.cos(a), r * math.sin(a)) for a in angles] for r in (_INNER, _OUTER))
    dark, opaque = _shaded(base, _SHADE), _shaded(base, 1.0)
    points: list[tuple[float, float]] = []
    for i in range(_STEPS):
        j, k = (i + 1) % _STEPS, (i + 2) % _STEPS
        if control.interaction_mode == InteractiveMarkerControl.ROTATE_AXIS:
            points += [inner[i], outer[j], inner[j], inner[j], outer[j], outer[k]]
            ring.colors += [opaque if i % 2 else dark] * 2
        elif control.interaction_mode == InteractiveMarkerControl.MOVE_PLANE:
            points += [inner[i], outer[i], inner[j], outer[i], outer[j], inner[j]]
        elif i % 2 == 0:
            points += [inner[i], outer[j], inner[j], inner[j], outer[j], inner[k]]
            points += [outer[i], outer[j], inner[i], outer[j], outer[k], inner[k]]
            ring.colors += [dark, dark, base, base]
    ring.points = [Point(0.0, y, z) for y, z in points]
    return ring


def _shaded(color: Any, share: float) -> Any:
    return ColorRGBA(color.r * share, color.g * share, color.b * share, 1.0)


def _menu_text(scale: float, text: str) -> Any:
    size = 0.25 * scale
    shown = Marker(type=Marker.TEXT_VIEW_FACING, scale=Vector3(size, size, size), text=text)
    shown.color = ColorRGBA(1.0, 1.0, 1.0, 1.0)
    shown.pose.position = Point(-0.1 * size, 0.0, 1.2 * scale - 0.1 * size)
    return shown
