"""What touches what, and what gives way: the bodies of a world, in pymunk.

A robot that touches nothing moves by its own equations (`rosmini.sim.drive`), exactly. Where it comes to touch something it is asked here, a few
milliseconds at a time, how far it gets. Walls and fixed obstacles do not move; movable ones are pushed, held by the friction of the ground; and the
wheels cannot push harder than their grip allows (Coulomb: the force is at most mu m g).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk import autogeometry

from rosmini.geometry.poses import Pose

from .imu import GRAVITY
from .models import RobotModel
from .world import Cylinder, Obstacle, World

GRIP = 0.7
"""Friction of rubber wheels on the ground."""

DRAG = 0.5
"""Friction of a movable obstacle on the ground."""

FRICTION = 0.3
"""Friction of bodies on each other."""

TOUCH = 1e-9
"""Bodies that overlap by less [m] only touch."""

SLACK = 2e-5
"""So deep [m] a robot reaches into what it pushes: bodies that do not overlap do not push each other."""

OVERLAP = 1e-4
"""By so much [m] a robot may be put into something, for want of digits."""

ROUNDS = 20
"""So often at most a robot is pushed out of what it has driven into; a wedge between two walls takes the most."""

REST = 1e-4
"""A movable obstacle that is slower [m/s, rad/s] stands."""


@dataclass
class _Crate:
    obstacle: Obstacle
    body: pymunk.Body
    shapes: list[pymunk.Shape]


@dataclass
class _Rover:
    model: RobotModel
    body: pymunk.Body
    shape: pymunk.Poly
    axle: pymunk.Body
    """Goes as the wheels turn, and takes the body along as well as the grip allows."""
    grip: tuple[pymunk.PivotJoint, pymunk.GearJoint]


class Contacts:
    """The bodies of one world; robots come and go by name."""

    def __init__(self, world: World) -> None:
        self._space = pymunk.Space()
        self._space.collision_slop = SLACK
        self._space.iterations = 30
        self._names: dict[pymunk.Shape, str] = {}
        self._rovers: dict[str, _Rover] = {}
        self._crates: list[_Crate] = []
        ground = self._space.static_body
        for x1, y1, x2, y2 in world.walls.tolist():
            wall = pymunk.Segment(ground, (x1, y1), (x2, y2), 0.0)
            self._add(wall, f"the wall from ({x1:.2f}, {y1:.2f}) to ({x2:.2f}, {y2:.2f})")
        for obstacle in world.obstacles:
            if obstacle.movable:
                self._crates.append(self._crate(obstacle))
            else:
                for shape in _shapes(obstacle, ground, obstacle.pose):
                    self._add(shape, f"the obstacle {obstacle.name!r}")

    def _add(self, shape: pymunk.Shape, name: str) -> None:
        shape.friction = FRICTION
        self._names[shape] = name
        self._space.add(shape)

    def _crate(self, obstacle: Obstacle) -> _Crate:
        mass = obstacle.mass or 0.0
        body = pymunk.Body()
        shapes = _shapes(obstacle, body, (0.0, 0.0, 0.0))
        area = sum(shape.area for shape in shapes)
        for shape in shapes:
            shape.density = mass / area
        self._space.add(body)
        for shape in shapes:
            self._add(shape, f"the obstacle {obstacle.name!r}")
        x, y, theta = obstacle.pose
        body.position, body.angle = (x, y), theta
        ground = self._space.static_body
        slide = pymunk.PivotJoint(ground, body, (0, 0), body.center_of_gravity)
        turn = pymunk.GearJoint(ground, body, 0.0, 1.0)
        slide.max_bias = turn.max_bias = 0.0  # they hold what moves and pull nothing back
        slide.max_force = DRAG * mass * GRAVITY
        # the lever of friction that is spread over a disc of this size is two thirds of its radius
        turn.max_force = slide.max_force * 2 / 3 * math.sqrt(area / math.pi)
        self._space.add(slide, turn)
        self._space.reindex_shapes_for_body(body)
        return _Crate(obstacle, body, shapes)

    # -- robots --------------------------------------------------------------------------------------------------

    def add(self, name: str, model: RobotModel, pose: Pose) -> None:
        """Put a robot there."""
        body = pymunk.Body(model.mass, model.inertia)
        shape = pymunk.Poly(body, model.footprint)
        axle = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        along, around = pymunk.PivotJoint(axle, body, (0, 0), (0, 0)), pymunk.GearJoint(axle, body, 0.0, 1.0)
        along.max_bias = around.max_bias = 0.0  # they bring speeds together, not places
        along.max_force = GRIP * model.mass * GRAVITY
        around.max_force = along.max_force * model.wheel_separation / 2
        self._space.add(body, axle, along, around)
        self._add(shape, f"the robot {name!r}")
        self._rovers[name] = _Rover(model, body, shape, axle, (along, around))
        self.move(name, pose)

    def remove(self, name: str) -> None:
        """Take a robot away."""
        rover = self._rovers.pop(name)
        del self._names[rover.shape]
        self._space.remove(*rover.grip, rover.shape, rover.body, rover.axle)

    def move(self, name: str, pose: Pose, velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        """Tell where a robot is that has moved by itself, and how fast it goes in the world's directions."""
        body = self._rovers[name].body
        _put(body, pose)
        body.velocity, body.angular_velocity = velocity[:2], velocity[2]
        self._space.reindex_shapes_for_body(body)

    def hindrance(self, model: RobotModel, pose: Pose, ignoring: str = "") -> str | None:
        """Return what a robot of this model would overlap with at `pose`, in words; None if it has room there."""
        probe = pymunk.Body(model.mass, model.inertia)
        shape = pymunk.Poly(probe, model.footprint)
        _put(probe, pose)
        rover = self._rovers.get(ignoring)
        for hit in self._space.shape_query(shape):
            own = rover is not None and hit.shape is rover.shape
            if hit.shape is not None and not own and max(_depths(hit.contact_point_set)) > OVERLAP:
                return self._names[hit.shape]
        return None

    # -- movable obstacles ---------------------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """True while an obstacle moves."""
        return any(
            crate.body.velocity.length > REST or abs(crate.body.angular_velocity) > REST
            for crate in self._crates
        )

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The movable obstacles where they are now."""
        return tuple(_moved(crate.obstacle, crate.body) for crate in self._crates)

    def reset(self) -> None:
        """Put the movable obstacles back to where they were."""
        for crate in self._crates:
            _put(crate.body, crate.obstacle.pose)
            crate.body.velocity, crate.body.angular_velocity = (0.0, 0.0), 0.0
            self._space.reindex_shapes_for_body(crate.body)

    # -- contact -------------------------------------------------------------------------------------------------

    def step(self, ways: dict[str, tuple[Pose, Pose]], dt: float) -> dict[str, tuple[Pose, bool]]:
        """Let `dt` seconds pass in which each robot's wheels take it from the first pose to the second, if nothing is in the way.

        Return where each robot is then, and whether it touches anything.
        """
        for name, (before, after) in ways.items():
            rover = self._rovers[name]
            body, axle = rover.body, rover.axle
            axle.velocity = ((after[0] - before[0]) / dt, (after[1] - before[1]) / dt)
            axle.angular_velocity = (after[2] - before[2]) / dt
            # pymunk moves each body by the velocity it has, looks what touches, and then changes the velocities
            (vx, vy), w = body.velocity, body.angular_velocity
            _put(body, (after[0] - vx * dt, after[1] - vy * dt, after[2] - w * dt))
        self._space.step(dt)
        poses = {name: after for name, (_, after) in ways.items()}
        for name, pose in poses.items():
            _put(self._rovers[name].body, pose)
        touching = dict.fromkeys(poses, False)
        for _ in range(ROUNDS):
            pushed = [name for name in poses if self._push_out(name, poses)]
            if not pushed:
                break
            for name in pushed:
                touching[name] = True
        return {name: (pose, touching[name]) for name, pose in poses.items()}

    def _push_out(self, name: str, poses: dict[str, Pose]) -> bool:
        """Move a robot out of the thing into which it reaches deepest, turning it by its lever; tell whether there was one.

        The correction along the normal n of the contact at r from the axle is the one that needs the least work:
        dx = k n / m and dtheta = k (r x n) / I, with k such that the overlap vanishes.
        """
        rover = self._rovers[name]
        worst: tuple[float, Any] = (TOUCH, None)
        for hit in self._space.shape_query(rover.shape):
            depth = max(_depths(hit.contact_point_set))
            body = None if hit.shape is None else hit.shape.body
            if body is not None and body.body_type == pymunk.Body.DYNAMIC:
                depth -= SLACK
            if depth > worst[0]:
                worst = (depth, hit)
        depth, hit = worst
        if hit is None:
            return False
        contacts = hit.contact_point_set
        depths = _depths(contacts)
        deepest = [
            point for point, its in zip(contacts.points, depths, strict=True) if its > max(depths) - 1e-7
        ]
        px = sum(point.point_a.x for point in deepest) / len(deepest)
        py = sum(point.point_a.y for point in deepest) / len(deepest)
        x, y, theta = poses[name]
        nx, ny = -contacts.normal.x, -contacts.normal.y
        lever = (px - x) * ny - (py - y) * nx
        model = rover.model
        k = depth / (1 / model.mass + lever * lever / model.inertia)
        if any(hit.shape is other.shape for other in self._rovers.values()):
            k /= 2  # the other one gives way as well
        poses[name] = (x + k * nx / model.mass, y + k * ny / model.mass, theta + k * lever / model.inertia)
        _put(rover.body, poses[name])
        return True


def _depths(contacts: pymunk.ContactPointSet) -> list[float]:
    """How deep two shapes overlap at each point of their contact; pymunk's own `distance` has either sign."""
    n = contacts.normal
    return [(point.point_a - point.point_b).dot(n) for point in contacts.points]


def _put(body: pymunk.Body, pose: Pose) -> None:
    body.position, body.angle = (pose[0], pose[1]), pose[2]


def _moved(obstacle: Obstacle, body: pymunk.Body) -> Obstacle:
    from dataclasses import replace

    return replace(obstacle, pose=(body.position.x, body.position.y, body.angle))


def _shapes(obstacle: Obstacle, body: pymunk.Body, pose: Pose) -> list[pymunk.Shape]:
    """The convex parts of an obstacle that stands at `pose` of the body's frame."""
    x, y, theta = pose
    if isinstance(obstacle.shape, Cylinder):
        return [pymunk.Circle(body, obstacle.shape.radius, (x, y))]
    outline: NDArray[np.float64] = obstacle.shape.outline
    placed = pymunk.Transform(
        a=math.cos(theta), b=math.sin(theta), c=-math.sin(theta), d=math.cos(theta), tx=x, ty=y
    )
    make = partial(pymunk.Poly, body, transform=placed)
    corners = [(float(px), float(py)) for px, py in outline]
    if _convex(corners):
        return [make(corners)]
    return [make(part) for part in autogeometry.convex_decomposition([*corners, corners[0]], 0.0)]


def _convex(corners: list[tuple[float, float]]) -> bool:
    turns = [
        (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
        for (ax, ay), (bx, by), (cx, cy) in zip(
            corners, corners[1:] + corners[:1], corners[2:] + corners[:2], strict=True
        )
    ]
    return all(turn >= 0 for turn in turns)
