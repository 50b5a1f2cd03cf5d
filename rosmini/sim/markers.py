"""Conversion of a world's obstacles to `visualization_msgs/Marker`s, which RViz can draw, and back.

Each simple part is a marker: a cube, a cylinder, a sphere, or, for a polygon, the closed line around its top, in its
own frame. The namespace is the obstacle's name, the ids count its parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.msgs import message_class

from .sensors.scene import rgb
from .shapes import Box, Compound, Cylinder, Polygon, Simple, Sphere, simple_parts
from .world import Obstacle

CUBE, SPHERE, CYLINDER, LINE_STRIP = 1, 2, 3, 4
ADD, DELETE = 0, 2

LINE_WIDTH = 0.02
"""Line width [m]."""


class MarkersError(RosminiError, ValueError):
    """A marker cannot be converted to an obstacle."""


class Markers:
    """Makes messages of obstacles, and remembers the published ones in order to delete those that are gone."""

    def __init__(self, frame: str = "map") -> None:
        self.frame = frame
        self._array = message_class("visualization_msgs/MarkerArray")
        self._marker = message_class("visualization_msgs/Marker")
        self._published: dict[str, int] = {}

    def message(self, obstacles: Iterable[Obstacle], stamp: tuple[int, int]) -> Any:
        """Return a `visualization_msgs/MarkerArray` of the obstacles, with this stamp."""
        array, published = self._array(), {}
        for obstacle in obstacles:
            parts = list(simple_parts(obstacle.shape, obstacle.pose))
            published[obstacle.name] = len(parts)
            for i, (shape, pose) in enumerate(parts):
                array.markers.append(self._part(obstacle, i, shape, pose, stamp))
        for name, count in self._published.items():
            array.markers += [self._header(name, i, stamp, DELETE) for i in range(published.get(name, 0), count)]
        self._published = published
        return array

    def _header(self, name: str, number: int, stamp: tuple[int, int], action: int) -> Any:
        marker = self._marker()
        marker.header.frame_id = self.frame
        marker.header.stamp.secs, marker.header.stamp.nsecs = stamp
        marker.ns, marker.id, marker.action = name, number, action
        return marker

    def _part(self, obstacle: Obstacle, number: int, shape: Simple, pose: Pose, stamp: tuple[int, int]) -> Any:
        marker = self._header(obstacle.name, number, stamp, ADD)
        bottom, top = obstacle.bottom, obstacle.height
        marker.color.r, marker.color.g, marker.color.b = rgb(obstacle.colour)
        marker.color.a = 1.0
        place, turn = marker.pose.position, marker.pose.orientation
        place.x, place.y, place.z = pose[0], pose[1], (bottom + top) / 2
        turn.z, turn.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
        size = marker.scale
        if isinstance(shape, Polygon):
            marker.type = LINE_STRIP
            size.x = LINE_WIDTH
            place.z = top
            point = message_class("geometry_msgs/Point")
            marker.points = [point(x=x, y=y) for x, y in (*shape.corners, shape.corners[0])]
        elif isinstance(shape, Box):
            marker.type = CUBE
            size.x, size.y, size.z = shape.length, shape.width, top - bottom
        elif isinstance(shape, Cylinder):
            marker.type = CYLINDER
            size.x = size.y = 2 * shape.radius
            size.z = top - bottom
        else:
            marker.type = SPHERE
            size.x = size.y = size.z = 2 * shape.radius
            place.z = bottom + shape.radius
        return marker


def obstacles_of(message: Any) -> dict[str, Obstacle]:
    """Return the obstacles in a `visualization_msgs/MarkerArray`, by name.

    An obstacle of several parts gets the pose of its first part.

    Raises:
        MarkersError: a marker is of none of the above kinds, or has an impossible size.

    """
    parts: dict[str, list[tuple[Simple, Pose, float, float, str]]] = {}
    for marker in message.markers:
        if marker.action == ADD:
            parts.setdefault(marker.ns, []).append(_read(marker))
    found = {}
    for name, several in parts.items():
        shape, pose, bottom, top, colour = several[0]
        if len(several) == 1:
            found[name] = Obstacle(name, shape, pose, top, colour, bottom=bottom)
            continue
        back = inverse(pose)
        whole = Compound(tuple((each, compose(back, at)) for each, at, *_ in several))
        low, high = min(each[2] for each in several), max(each[3] for each in several)
        found[name] = Obstacle(name, whole, pose, high, colour, bottom=low)
    return found


def first_poses(message: Any) -> dict[str, Pose]:
    """Return the pose of each obstacle's first part, by name."""
    found: dict[str, Pose] = {}
    for marker in message.markers:
        if marker.action == ADD and marker.ns not in found:
            found[marker.ns] = _pose(marker)
    return found


def _read(marker: Any) -> tuple[Simple, Pose, float, float, str]:
    z, size = marker.pose.position.z, marker.scale
    low, high = z - size.z / 2, z + size.z / 2
    shape: Simple
    if marker.type == CUBE:
        shape = Box(size.x, size.y)
    elif marker.type == CYLINDER:
        shape = Cylinder(size.x / 2)
    elif marker.type == SPHERE:
        shape = Sphere(size.x / 2)
    elif marker.type == LINE_STRIP and len(marker.points) > 3:
        shape = Polygon(tuple((p.x, p.y) for p in marker.points[:-1]))
        low, high = 0.0, z
    else:
        raise MarkersError(
            f"the marker {marker.ns!r} {marker.id} has the type {marker.type}, which no thing of a world has; cubes "
            "(1), spheres (2), cylinders (3) and closed line strips (4) are understood"
        )
    colour = "#" + "".join(
        f"{round(255 * min(max(c, 0.0), 1.0)):02x}" for c in (marker.color.r, marker.color.g, marker.color.b)
    )
    return shape, _pose(marker), low, high, colour


def _pose(marker: Any) -> Pose:
    q = marker.pose.orientation
    return (marker.pose.position.x, marker.pose.position.y, yaw_from_quaternion(q.x, q.y, q.z, q.w))
