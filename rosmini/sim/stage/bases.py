"""Conversion of the robots in a Stage file to models for the engine."""

from __future__ import annotations

from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import LidarModel, RobotModel, WheelErrors, hull
from rosmini.sim.shapes import Part, outline_at

from .errors import StageError
from .robots import StageLaser, StageRobot
from .solids import Solid, filled, solid
from .things import Thing

UNSEEN = (-2.0, -1.0)
"""Bottom and top of the parts that rangers do not see [m]: below the ground."""


def robot_model(robot: StageRobot, interval: float) -> RobotModel:
    """Return the model of a robot that is updated every `interval` [s].

    It reaches a commanded velocity at once, within its bounds, as in Stage, and its wheels are perfect: the errors of
    its odometry follow Stage's own model (`StageOdometry`). Its contact outline is the convex hull of
    its body. Raises `StageError`.
    """
    bodies = [(thing, each) for thing in robot.body for each in _solids(thing)]
    touching = [each for thing, each in bodies if thing.solid] or [each for _, each in bodies]
    if not touching:
        raise StageError(robot.place, f"the robot {robot.name} has no body")
    corners = [corner for each in touching for corner in _corners(each, robot.pose)]
    (back, ahead), (right, left), (clockwise, counter) = robot.velocity_bounds
    length, width = robot.size[:2]
    return RobotModel(
        name=robot.name,
        title=robot.name,
        mass=robot.mass,
        inertia=robot.mass * (length**2 + width**2) / 12,
        footprint=hull(corners),
        height=max(each.top for each in touching),
        drive="holonomic" if robot.drive == "omni" else "differential",
        wheel_separation=width,
        max_linear=max(abs(back), abs(ahead)),
        max_lateral=max(abs(right), abs(left)),
        max_angular=max(abs(clockwise), abs(counter)),
        errors=WheelErrors(0.0, 0.0, 0.0),
        rate=1 / interval,
        lidar=laser_model(robot.lasers[0], "base_scan", interval) if robot.lasers else None,
        parts=tuple(_part(thing, each, robot) for thing, each in bodies),
    )


def laser_model(laser: StageLaser, name: str, interval: float) -> LidarModel:
    """Return the model of a laser whose topic has this name. Objects that are too near are measured, as in Stage."""
    half = laser.fov / 2 if laser.samples > 1 else 0.0
    return LidarModel(
        name=name,
        mount=(laser.pose[0], laser.pose[1], laser.height),
        beams=laser.samples,
        rate=1 / interval,
        range_min=0.0,
        range_max=laser.range_max,
        noise=laser.noise[0],
        frame="base_laser_link",
        angle_min=-half,
        angle_max=half,
        yaw=laser.pose[3],
    )


def _solids(thing: Thing) -> list[Solid]:
    if thing.body is None:
        return []
    return [solid(thing, each) for each in (*filled(thing)[0], *thing.body.boundary)]


def _corners(what: Solid, base: Pose) -> list[tuple[float, float]]:
    shape, pose = what.seen_from(base)
    outline = outline_at(shape, pose)  # type: ignore[arg-type]  # blocks are boxes and polygons
    return [(round(x, 9) + 0.0, round(y, 9) + 0.0) for x, y in outline.tolist()]


def _part(thing: Thing, what: Solid, robot: StageRobot) -> Part:
    shape, pose = what.seen_from(robot.pose)
    bottom, top = UNSEEN if thing.seen < 0 else (what.bottom, what.top)
    return Part(shape, pose, bottom, top, thing.colour, robot.name)
