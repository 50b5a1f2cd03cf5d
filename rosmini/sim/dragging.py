"""Dragging things with a mouse, a finger or a key in a view of a running world."""

from __future__ import annotations

import math

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose

from .engine.engine import Engine, RobotGone
from .shapes import ROUND, outline_at, simple_parts
from .world import Obstacle, WorldError


def drag(engine: Engine, name: str, pose: Pose) -> None:
    """Lift a robot or a movable obstacle and put it down elsewhere, at rest.

    Raises `WorldError` if a wall or another object is in the way, or if the obstacle moves by itself, and `RobotGone`
    for an unknown name; nothing has changed then.
    """
    if name in engine.robots:
        engine.place(name, pose)
        return
    found = {obstacle.name: obstacle for obstacle in engine.obstacles()}
    if name not in found:
        takeable = [*engine.robots, *(each.name for each in found.values() if each.movable)]
        hint = nearest(name, takeable) or f"there are: {', '.join(takeable) or 'none'}"
        fixed = any(each.name == name for each in engine.world.obstacles)
        what = f"{name!r} is fixed" if fixed else f"there is no {name!r}"
        msg = f"{what} in the world {engine.world.name!r}; robots and what can be pushed can be taken by hand. {hint}"
        raise RobotGone(msg)
    if found[name].movable and all(math.isfinite(part) for part in pose):
        check_room(engine, found[name], pose)
    engine.put(name, pose)


def check_room(engine: Engine, thing: Obstacle, pose: Pose) -> None:
    """Raise `WorldError` if a wall or another fixed object occupies the pose."""
    fixtures = engine.contacts.ground.fixtures
    for shape, place in simple_parts(thing.shape, pose):
        if isinstance(shape, ROUND):
            obstruction = fixtures.blocked(place, shape.radius, thing.height)
        else:
            obstruction = fixtures.blocked((0.0, 0.0, 0.0), outline_at(shape, place), thing.height)
        if obstruction is not None:
            x, y, theta = pose
            where = f"({x:.2f}, {y:.2f}) with heading {theta:.2f}"
            raise WorldError(f"{thing.name!r} cannot be moved to {where}: {obstruction} is in its way")
