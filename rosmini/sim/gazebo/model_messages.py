"""What the server sends to clients about its models: their parts in Gazebo's messages, and the poses of their links.

A client draws this, and knows nothing else of the models.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from rosmini.errors import RosminiError
from rosmini.geometry.poses import compose
from rosmini.sim.models import RobotModel
from rosmini.sim.sdf import ORIGIN, Pose6, SdfGeometry, SdfVisual, placed_links, to_obstacles
from rosmini.sim.world import Obstacle

from .model import Model
from .msgs import (
    BoxGeom,
    Collision,
    Color,
    CylinderGeom,
    Flat,
    Geometry,
    Link,
    Material,
    MeshGeom,
    PlaneGeom,
    Polyline,
    Pose,
    Quaternion,
    SphereGeom,
    Vector2d,
    Vector3d,
    Visual,
    Word,
)
from .msgs import Model as ModelMessage

Numbers = Callable[[str], int]
"""Returns the number of a name in messages."""


def model_message(model: Model, number: Numbers) -> ModelMessage:
    """All there is to know of a model."""
    own = number(model.name)
    return ModelMessage(
        model.name,
        own,
        model.static,
        Pose.of(model.name, own, model.pose),
        tuple(_links(model, number)),
        Flat(solids(model), *_robot(model)),
    )


def solids(model: Model) -> tuple[Obstacle, ...]:
    """What a model is in a flat world, seen from its origin."""
    if model.body is not None:
        return tuple(
            Obstacle(
                f"{model.name} {i}" if i else model.name,
                part.shape,
                compose(model.body.axle, part.pose),
                part.top,
                part.colour,
                bottom=part.bottom,
            )
            for i, part in enumerate(model.body.parts())
            if part.top > 0
        )
    if model.sdf.links and not any(link.collisions for link in model.sdf.links):
        own = (each for each in model.world.flat.obstacles if each.name in model.obstacles)
        return tuple(replace(each, pose=(0.0, 0.0, 0.0)) for each in own)
    at: Pose6 = (*ORIGIN[:2], *model.start[2:5], 0.0)
    return to_obstacles(replace(model.sdf, static=True), at)  # each part as it is, with its own colour


def _robot(model: Model) -> tuple[RobotModel | None, tuple[float, float, float]]:
    """How a model with a drive is drawn from above, and where the middle of its axle is."""
    if model.body is None or model.body.drive is None:
        return None, (0.0, 0.0, 0.0)
    from .ros_plugins.lasers import lidar_of

    robot = model.body.robot_model()
    for sensor in model.sensors:
        if sensor.element.find("ray") is not None or sensor.element.find("lidar") is not None:
            try:
                return replace(robot, lidar=lidar_of(sensor)), model.body.axle
            except RosminiError:  # one that is not simulated; the server has told of it
                continue
    return robot, model.body.axle


def _links(model: Model, number: Numbers) -> list[Link]:
    found = []
    for name, link, pose in placed_links(model.sdf):
        called = f"{model.name}::{name}"
        visuals = [_visual(each, called, number) for each in link.visuals]
        collisions = []
        for each in link.collisions:
            whole = f"{called}::{each.name}"
            at = Pose.of(whole, number(whole), each.pose)
            collisions.append(Collision(at.id, whole, at, _geometry(each.geometry)))
        at = Pose.of(called, number(called), pose)
        found.append(Link(at.id, called, at, tuple(visuals), tuple(collisions)))
    return found


def _visual(visual: SdfVisual, link: str, number: Numbers) -> Visual:
    called = f"{link}::{visual.name}"
    at = Pose.of(called, number(called), visual.pose)
    material = None
    if visual.colour is not None:
        red, green, blue = (round(int(visual.colour[i : i + 2], 16) / 255, 4) for i in (1, 3, 5))
        material = Material(Color(red, green, blue))
    return Visual(called, at.id, link, at, _geometry(visual.geometry), material)


def _geometry(shape: SdfGeometry) -> Geometry:
    kind = Word(shape.kind.upper())
    if shape.kind == "box":
        return Geometry(kind, box=BoxGeom(Vector3d(*shape.size)))
    if shape.kind == "cylinder":
        return Geometry(kind, cylinder=CylinderGeom(shape.radius, shape.length))
    if shape.kind == "sphere":
        return Geometry(kind, sphere=SphereGeom(shape.radius))
    if shape.kind == "plane":
        return Geometry(kind, plane=PlaneGeom(Vector3d(*shape.normal), Vector2d(*shape.size)))
    if shape.kind == "polyline":
        lines = (tuple(Vector2d(*corner) for corner in outline) for outline in shape.outlines)
        return Geometry(kind, polyline=tuple(Polyline(shape.length, line) for line in lines))
    if shape.kind == "mesh" and shape.mesh is not None:
        mesh = MeshGeom(str(shape.mesh), Vector3d(*shape.scale), shape.submesh or None)
        return Geometry(kind, mesh=mesh)
    return Geometry(Word("EMPTY"))


# ---- links that move in their model ----


@dataclass(frozen=True)
class Wheel:
    """A link that rotates, as ~/pose/info shows it."""

    model: Model
    start: Pose
    """Where it is, seen from the model, before it turns."""
    joint: str
    axis: tuple[float, float, float]
    """About which it turns, in its own frame; of length 1."""

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        half = self.model.joint(self.joint)[0] / 2
        s, w = math.sin(half), math.cos(half)
        x, y, z = (s * part for part in self.axis)
        q = self.start.orientation
        turned = Quaternion(
            q.w * x + q.x * w + q.y * z - q.z * y,
            q.w * y - q.x * z + q.y * w + q.z * x,
            q.w * z + q.x * y - q.y * x + q.z * w,
            q.w * w - q.x * x - q.y * y - q.z * z,
        )
        return Pose(self.start.name, self.start.id, self.start.position, turned)


def wheels(model: Model, number: Numbers) -> tuple[Wheel, ...]:
    """The wheels of a model."""
    if model.body is None:
        return ()
    found = []
    for joint in model.sdf.joints:
        length = math.hypot(*joint.axis)
        if joint.name in model.body.sides and length:
            called = f"{model.name}::{joint.child}"
            start = Pose.of(called, number(called), model.link_frame(joint.child))
            x, y, z = (part / length for part in joint.axis)
            found.append(Wheel(model, start, joint.name, (x, y, z)))
    return tuple(found)
