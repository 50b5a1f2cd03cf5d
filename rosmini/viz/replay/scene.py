"""What the scripts in a page need to know of a world and a robot, as JSON: the replay player and the pad draw it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rosmini.sim.models import RobotModel
from rosmini.sim.world import Cylinder, Obstacle, World
from rosmini.viz.rounding import MILLIMETRE, snap
from rosmini.viz.view import ViewError


def scene_data(world: World, model: RobotModel | None = None) -> dict[str, Any]:
    """A world, and the robot in it if there is one, in the terms of `rosmini/viz/static/rosmini-canvas.js`.

    Lengths are metres rounded to the millimetre, in the frame `map`; the robot's are in `base_footprint`. Polygons
    are counter-clockwise. `segments` are the walls that have no outline of their own: what a shape's sides are is left
    to who reads them. The same world gives the same data on every machine.

    Raises:
        ViewError: a wall, an obstacle or the robot has a number that is not finite; the message names it.

    """
    shapes = [_shape(obstacle) for obstacle in world.obstacles]
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
    lidar = model.laser
    return {
        "name": model.name,
        "footprint": _metres(_counter_clockwise(model.footprint), what),
        "lidar": {
            "x": _metres(lidar.mount[0], what),
            "beams": lidar.beams,
            "min": _metres(lidar.range_min, what),
            "max": _metres(lidar.range_max, what),
        },
        "max_linear": _metres(model.max_linear, what),
        "max_angular": _metres(model.max_angular, what),
        "acceleration": _metres(model.wheel_acceleration, what),
        "wheel_separation": _metres(model.wheel_separation, what),
        "wheel_radius": _metres(model.wheel_radius, what),
    }


def _shape(obstacle: Obstacle) -> dict[str, Any]:
    what = f"the obstacle {obstacle.name!r}"
    if isinstance(obstacle.shape, Cylinder):
        x, y, _ = obstacle.pose
        x, y, r = _metres((x, y, obstacle.shape.radius), what)
        return {"kind": "disc", "x": x, "y": y, "r": r, "colour": obstacle.colour}
    points = _metres(_counter_clockwise(obstacle.outline()), what)
    return {"kind": "polygon", "points": points, "colour": obstacle.colour}


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
