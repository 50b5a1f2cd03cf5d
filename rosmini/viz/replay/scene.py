"""What the scripts in a page need to know of a world and a robot, as JSON: the replay player and the pad draw it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rosmini.geometry.poses import Pose
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.shapes import ROUND, outline_at, simple_parts
from rosmini.sim.world import Obstacle, World
from rosmini.viz.rounding import MILLIMETRE, snap
from rosmini.viz.style import dark_of
from rosmini.viz.view import ViewError

AT_ONCE = 1e6
"""What is said of an acceleration, or of a speed, that has no bound [m/s2, m/s, rad/s]: JSON has no infinity."""


def scene_data(world: World, model: RobotModel | None = None) -> dict[str, Any]:
    """A world, and the robot in it if there is one, in the terms of `rosmini/viz/static/rosmini-canvas.js`.

    Lengths are metres rounded to the millimetre, in the frame `map`; the robot's are in `base_footprint`. Polygons
    are counter-clockwise. `segments` are the walls that have no outline of their own: what a shape's sides are is left
    to who reads them. The same world gives the same data on every machine.

    Raises:
        ViewError: a wall, an obstacle or the robot has a number that is not finite; the message names it.

    """
    shapes = [shape for obstacle in world.obstacles for shape in shapes_of(obstacle)]
    walls = _metres(world.walls.reshape(-1, 4), f"a wall of the world {world.name!r}")
    data: dict[str, Any] = {
        "name": world.name,
        "bounds": _metres(world.bounds, f"the bounds of the world {world.name!r}"),
        "segments": walls,
        "shapes": shapes,
    }
    if model is not None:
        data["robot"] = robot_data(model)
    return data


def robot_data(model: RobotModel) -> dict[str, Any]:
    """A robot as a script draws and drives it: speeds in m/s and rad/s, accelerations in m/s2.

    Raises:
        ViewError: a number of the robot is not finite.

    """
    what = f"the robot {model.name!r}"
    lidar = model.lidar
    return {
        "name": model.name,
        "footprint": _metres(_counter_clockwise(model.footprint), what),
        "lidar": None
        if lidar is None
        else {
            "x": _metres(lidar.mount[0], what),
            "beams": lidar.beams,
            "min": _metres(lidar.range_min, what),
            "max": _metres(lidar.range_max, what),
            **_fan(lidar, what),
        },
        "max_linear": _metres(min(model.max_linear, AT_ONCE), what),
        "max_angular": _metres(min(model.max_angular, AT_ONCE), what),
        "acceleration": _metres(min(model.wheel_acceleration, AT_ONCE), what),
        "wheel_separation": _metres(model.wheel_separation, what),
        "wheel_radius": _metres(model.wheel_radius, what),
    }


def _fan(lidar: LidarModel, what: str) -> dict[str, float]:
    """What is to be known of a laser that does not look all around from ahead on, or does not sit in the middle: `y`, `start` and `step`."""
    if lidar.angle_max is None and lidar.angle_min == lidar.yaw == lidar.mount[1] == 0:
        return {}
    start, step = round(lidar.angle_min + lidar.yaw, 8), round(lidar.increment, 8)
    return {"y": _metres(lidar.mount[1], what), "start": start, "step": step}


def shapes_of(obstacle: Obstacle, pose: Pose | None = None) -> list[dict[str, Any]]:
    """The simple shapes that a thing is made of, where it stands, or where it would at `pose`.

    What a robot may pass under has its `bottom` [m]; a colour beside the palette has its twin for dark pages, `dark`.
    """
    what = f"the obstacle {obstacle.name!r}"
    more: dict[str, Any] = {"colour": obstacle.colour}
    if obstacle.bottom > 0:
        more["bottom"] = _metres(obstacle.bottom, what)
    if obstacle.colour.startswith("#"):
        more["dark"] = dark_of(obstacle.colour)
    found = []
    for shape, place in simple_parts(obstacle.shape, obstacle.pose if pose is None else pose):
        if isinstance(shape, ROUND):
            x, y, r = _metres((*place[:2], shape.radius), what)
            found.append({"kind": "disc", "x": x, "y": y, "r": r, **more})
        else:
            points = _metres(_counter_clockwise(outline_at(shape, place)), what)
            found.append({"kind": "polygon", "points": points, **more})
    return found


def _counter_clockwise(corners: ArrayLike) -> ArrayLike:
    """The corners (n, 2) of a simple polygon, turned round if they go clockwise (the shoelace formula tells)."""
    points = np.asarray(corners, dtype=float)
    x, y = points[:, 0], points[:, 1]
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return points[::-1] if area < 0 else points


def _metres(values: ArrayLike, what: str) -> Any:
    """Plain numbers in the shape of `values`, rounded; never a negative zero."""
    array = np.asarray(values, dtype=float)
    if not np.isfinite(array).all():
        bad = next(v for v in array.ravel() if not math.isfinite(v))
        raise ViewError(f"{what} has the number {bad} and cannot be drawn: give it finite ones")
    return np.round(snap(array, MILLIMETRE), 3).tolist()
