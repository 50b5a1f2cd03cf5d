"""A world and a robot as JSON for the scripts in a page: the replay player and the pad draw them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rosmini.core.geometry.polygons import area
from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.shapes import ROUND, outline_at, simple_parts
from rosmini.sim.world import Obstacle, World
from rosmini.viz.rounding import MILLIMETRE, snap
from rosmini.viz.style import dark_of

UNBOUNDED = 1e6
"""Replaces an infinite acceleration, speed or range [m/s2, m/s, rad/s, m]: JSON has no infinity."""


def scene_data(world: World, model: RobotModel | None = None) -> dict[str, Any]:
    """Return a world, and the robot in it if there is one, as `rosmini/viz/static/rosmini-canvas.js` expects them.

    Lengths are metres rounded to the millimetre, in the frame `map`; the robot's are in `base_footprint`. Polygons
    are counter-clockwise. `segments` are the walls without an outline; the reader derives the sides of shapes from
    the shapes. The same world gives the same data on every machine.
    """
    shapes = [shape for obstacle in world.obstacles for shape in shapes_of(obstacle)]
    data: dict[str, Any] = {
        "name": world.name,
        "bounds": _metres(world.bounds),
        "segments": _metres(world.walls.reshape(-1, 4)),
        "shapes": shapes,
    }
    if model is not None:
        data["robot"] = robot_data(model)
    return data


def robot_data(model: RobotModel) -> dict[str, Any]:
    """Return the data with which a script draws and drives a robot: speeds in m/s and rad/s, accelerations in m/s2."""
    lidar = model.lidar
    return {
        "name": model.name,
        "footprint": _metres(_counter_clockwise(model.footprint)),
        "lidar": None
        if lidar is None
        else {
            "x": _metres(lidar.mount[0]),
            "beams": lidar.beams,
            "min": _metres(lidar.range_min),
            "max": _metres(min(lidar.range_max, UNBOUNDED)),
            **_fan(lidar),
        },
        "max_linear": _metres(min(model.max_linear, UNBOUNDED)),
        "max_angular": _metres(min(model.max_angular, UNBOUNDED)),
        "acceleration": _metres(min(model.wheel_acceleration, UNBOUNDED)),
        "wheel_separation": _metres(model.wheel_separation),
        "wheel_radius": _metres(model.wheel_radius),
    }


def _fan(lidar: LidarModel) -> dict[str, float]:
    """Return `y`, `start` and `step` of a laser that is off centre or is not a full circle starting straight ahead."""
    if lidar.angle_max is None and lidar.angle_min == lidar.yaw == lidar.mount[1] == 0:
        return {}
    start, step = round(lidar.angle_min + lidar.yaw, 8), round(lidar.increment, 8)
    return {"y": _metres(lidar.mount[1]), "start": start, "step": step}


def shapes_of(obstacle: Obstacle, pose: Pose | None = None) -> list[dict[str, Any]]:
    """Return the simple shapes of an obstacle at its own pose, or at `pose`.

    Shapes above the ground have a `bottom` [m]; a colour outside the palette has a variant for dark pages, `dark`.
    """
    more: dict[str, Any] = {"colour": obstacle.colour}
    if obstacle.bottom > 0:
        more["bottom"] = _metres(obstacle.bottom)
    if obstacle.colour.startswith("#"):
        more["dark"] = dark_of(obstacle.colour)
    found = []
    for shape, place in simple_parts(obstacle.shape, obstacle.pose if pose is None else pose):
        if isinstance(shape, ROUND):
            x, y, r = _metres((*place[:2], shape.radius))
            found.append({"kind": "disc", "x": x, "y": y, "r": r, **more})
        else:
            points = _metres(_counter_clockwise(outline_at(shape, place)))
            found.append({"kind": "polygon", "points": points, **more})
    return found


def _counter_clockwise(corners: ArrayLike) -> ArrayLike:
    """Return the vertices (n, 2) of a simple polygon in counter-clockwise order."""
    points = np.asarray(corners, dtype=float)
    return points[::-1] if area(points) < 0 else points


def _metres(values: ArrayLike) -> Any:
    """Return plain numbers in the shape of `values`, rounded; never a negative zero."""
    return np.round(snap(np.asarray(values, dtype=float), MILLIMETRE), 3).tolist()
