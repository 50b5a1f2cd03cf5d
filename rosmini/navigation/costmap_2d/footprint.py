"""Footprints: the robot's outline seen from above, as vertices (n, 2) [m] in its base frame."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import ParameterError, shown
from rosmini.core.geometry.poses import Pose, transform_points

Footprint = NDArray[np.float64]

CIRCLE_VERTICES = 16
"""Number of vertices in the polygon that approximates a round robot."""

EXAMPLE = "[[x1, y1], [x2, y2], [x3, y3], ...] in metres, at least three points"


def footprint_from_radius(radius: float) -> Footprint:
    """Return a regular polygon with 16 vertices on a circle of this radius [m]; its inscribed radius is 0.98 of it."""
    angles = np.arange(CIRCLE_VERTICES) * math.tau / CIRCLE_VERTICES
    return np.stack([np.cos(angles) * radius, np.sin(angles) * radius], axis=-1)


def footprint_from_list(points: Any, name: str) -> Footprint:
    """Return a footprint made from a list of pairs of numbers; `name` is the parameter's name in error messages.

    Raises `ParameterError` for anything else, for fewer than three points and for numbers that are not finite.
    """
    if not isinstance(points, (list, tuple)) or len(points) < 3:
        count = f"a list of {len(points)} points" if isinstance(points, (list, tuple)) else shown(points)
        raise ParameterError(
            f"parameter {name} is {count}: You must specify at least three points for the robot footprint, as {EXAMPLE}"
        )
    for number, point in enumerate(points):
        if not isinstance(point, (list, tuple)) or len(point) != 2:
            raise ParameterError(
                f"parameter {name}[{number}] is {shown(point)}: Points in the footprint specification must be pairs of "
                f"numbers, {EXAMPLE}"
            )
        for value in point:
            if not _is_finite(value):
                raise ParameterError(
                    f"parameter {name}[{number}] is {shown(point)}: Values in the footprint specification must be "
                    f"numbers, found {shown(value)}"
                )
    return np.array(points, dtype=np.float64)


def _is_finite(value: Any) -> bool:
    """Return whether a value is a finite number."""
    try:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # an integer too large for a float
        return False


def footprint_from_text(text: str, name: str) -> Footprint:
    """Return the footprint in a text such as `[[0.1, 0.1], [0.1, -0.1], [-0.1, -0.1]]`, parsed as by costmap_2d.

    Commas and spaces are both separators, and `.5`, `1.` and `+1` are valid numbers. Raises `ParameterError`, which
    contains the parameter's `name`, for a text of another form.
    """
    points: list[list[float]] = []
    point: list[float] = []
    depth = 0
    for match in _TOKEN.finditer(text):
        word = match[0]
        if word == "[":
            depth, point = depth + 1, []
        elif word == "]":
            depth -= 1
            if depth == 1:
                points.append(point)
        elif match["number"] and depth == 2:
            point.append(float(word))
        else:
            raise _parse_error(text, name, f"{word!r} is not a number inside two brackets")
        if not 0 <= depth <= 2:
            raise _parse_error(text, name, "more ']' than '['" if depth < 0 else "more than two brackets are open")
    if depth:
        raise _parse_error(text, name, "a ']' is missing")
    return footprint_from_list(points, name)


_TOKEN = re.compile(r"(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|[^\s,]")


def _parse_error(text: str, name: str, problem: str) -> ParameterError:
    return ParameterError(
        f"Error parsing footprint parameter {name}: {problem}. The footprint string was {text!r:.200}; it must be "
        f"{EXAMPLE}"
    )


def footprint_text(footprint: Footprint) -> str:
    """Return a footprint as the text of a parameter."""
    return "[" + ",".join(f"[{x:g},{y:g}]" for x, y in footprint) + "]"


def padded(footprint: Footprint, padding: float) -> Footprint:
    """Return a footprint with every vertex moved away from both axes by `padding` [m]; a coordinate of 0 stays 0."""
    grown: Footprint = footprint + np.sign(footprint) * padding
    return grown


def radii(footprint: Footprint) -> tuple[float, float]:
    """Return the inscribed and the circumscribed radius [m].

    They are the smallest and largest distance from the origin to the outline; infinity and 0 below three vertices.
    """
    if len(footprint) < 3:
        return math.inf, 0.0
    ends = np.roll(footprint, -1, axis=0)
    edges = ends - footprint
    lengths2 = (edges * edges).sum(axis=1)
    share = -(footprint * edges).sum(axis=1) / np.where(lengths2 > 0, lengths2, 1)
    nearest = footprint + np.clip(share, 0, 1)[:, None] * edges
    return (
        float(np.hypot(nearest[:, 0], nearest[:, 1]).min()),
        float(np.hypot(footprint[:, 0], footprint[:, 1]).max()),
    )


def placed(footprint: Footprint, pose: Pose) -> Footprint:
    """Return the footprint of a robot at a pose, in the frame of the pose."""
    return transform_points(pose, footprint)


def crossing(footprint: Footprint) -> tuple[int, int] | None:
    """Return the indices of the first vertices of two edges that cross, or None if the outline is simple."""
    count = len(footprint)
    for i in range(count):
        for j in range(i + 2, count):
            if (j + 1) % count != i and _cross(
                footprint[i], footprint[(i + 1) % count], footprint[j], footprint[(j + 1) % count]
            ):
                return i, j
    return None


def _cross(a: Sequence[float], b: Sequence[float], c: Sequence[float], d: Sequence[float]) -> bool:
    return _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0


def _side(a: Sequence[float], b: Sequence[float], p: Sequence[float]) -> float:
    return float((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]))


def points_of(polygon: Any) -> Footprint:
    """Return the vertices of a `geometry_msgs/Polygon`."""
    return np.array([(point.x, point.y) for point in polygon.points], dtype=np.float64).reshape(-1, 2)
