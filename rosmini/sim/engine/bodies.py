"""Bodies in pymunk: what robots, things and walls are made of there, before anything moves."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import partial

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk import autogeometry

from rosmini.geometry.poses import Pose
from rosmini.sim.models import GRAVITY, RobotModel
from rosmini.sim.shapes import ROUND, Compound, Simple, simple_parts
from rosmini.sim.world import Obstacle

GRIP = 0.7
"""Friction of rubber wheels on the ground. This number and the next two are ordinary ones for such materials; none is published for the robot."""

DRAG = 0.5
"""Friction of a movable obstacle on the ground."""

FRICTION = 0.3
"""Friction of bodies on each other."""

VIEW = 0.5
"""So far [m] a robot looks around itself; what is farther away does not matter yet."""

FEEL = 1e-4
"""What is so near [m] touches."""

SOLID, GHOST, LOOK = 1, 2, 4
"""Categories of shapes: what bumps, robots that touch nothing for now, and those that only look around."""

FLOATING = 1
"""The collision type of what has room under it."""

IS_SOLID = pymunk.ShapeFilter(categories=SOLID)
IS_GHOST = pymunk.ShapeFilter(categories=GHOST, mask=LOOK)
IS_LOOK = pymunk.ShapeFilter(categories=LOOK)


@dataclass(frozen=True)
class Surface:
    """How things rub: coefficients of friction, and the gravity [m/s2] that presses them to the ground."""

    grip: float = GRIP
    drag: float = DRAG
    friction: float = FRICTION
    gravity: float = GRAVITY


@dataclass(frozen=True, slots=True)
class Owner:
    """Whose a shape is, and how high it is: from `bottom` to `top` [m]."""

    kind: str
    name: str
    bottom: float = 0.0
    top: float = math.inf
    place: tuple[float, ...] = ()

    def words(self) -> str:
        """Tell what it is, in words that fit into a sentence."""
        if self.kind == "wall":
            x1, y1, x2, y2 = self.place
            return f"the wall from ({x1:.2f}, {y1:.2f}) to ({x2:.2f}, {y2:.2f})"
        return f"the {'robot' if self.kind == 'robot' else 'obstacle'} {self.name!r}"

    def meets(self, bottom: float, top: float) -> bool:
        """Tell whether something from `bottom` to `top` can bump into it, or passes over or under it."""
        return self.bottom <= top and bottom <= self.top


@dataclass
class Crate:
    """A thing that can be pushed."""

    obstacle: Obstacle
    body: pymunk.Body
    shapes: list[pymunk.Shape]
    reach: float
    drag: tuple[pymunk.PivotJoint, pymunk.GearJoint] | tuple[()] = ()
    """The friction of the ground."""
    shown: bool = True
    """Told among the obstacles; False: it is the body of a robot model without a drive."""

    @property
    def pose(self) -> Pose:
        """Where it is."""
        body = self.body
        return (body.position.x, body.position.y, body.angle)

    @property
    def velocity(self) -> tuple[float, float, float]:
        """How fast its origin moves [m/s], and how it turns [rad/s], in the world's directions."""
        vx, vy = self.body.velocity_at_local_point((0.0, 0.0))
        return (vx, vy, self.body.angular_velocity)


@dataclass
class Rover:
    """A robot."""

    model: RobotModel
    body: pymunk.Body
    shape: pymunk.Poly
    view: pymunk.Poly
    """The footprint grown by VIEW, which nothing bumps into."""
    feel: pymunk.Poly
    """The footprint grown by FEEL, likewise."""
    axle: pymunk.Body
    """Goes as the wheels turn, and takes the body along as well as the grip allows."""
    grip: tuple[pymunk.PivotJoint, pymunk.GearJoint]
    awake: bool = False
    """It may touch something; else nothing bumps into its body, which may be elsewhere."""
    slip: tuple[float, float] = (0.0, 0.0)
    """How fast its wheels slid over the ground in the last step [m/s], in the world's directions."""
    told: tuple[Pose, tuple[float, float, float]] | None = None
    """Where its body was put last, and with which velocity, if it has not moved since."""


@dataclass
class Leaf:
    """A thing that moves by itself: a walker, a door."""

    obstacle: Obstacle
    body: pymunk.Body
    shapes: list[pymunk.Shape]
    probe: pymunk.Body
    probes: list[pymunk.Shape] = field(default_factory=list)
    """Shapes like its own, to ask what is at another place."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Of its body: none, for it goes from place to place."""

    @property
    def pose(self) -> Pose:
        """Where its body is."""
        return (self.body.position.x, self.body.position.y, self.body.angle)


# straight to these: at each `body.angle = ...` pymunk asks first whether there is such a name, which takes as long as the rest
_turn_to, _move_to = vars(pymunk.Body)["angle"].fset, vars(pymunk.Body)["position"].fset


def put(body: pymunk.Body, pose: Pose) -> None:
    """Place a body's origin."""
    # in this order: pymunk turns a body about its centre of mass, which takes its origin elsewhere
    _turn_to(body, pose[2])
    _move_to(body, (pose[0], pose[1]))


def make_crate(obstacle: Obstacle) -> Crate:
    """The body and shapes of a thing that can be pushed."""
    mass = obstacle.mass or 0.0
    body = pymunk.Body()
    shapes = shapes_of(obstacle, body, (0.0, 0.0, 0.0))
    area = sum(shape.area for shape in shapes)
    for shape in shapes:
        shape.density = mass / area
        shape.elasticity = obstacle.restitution
    return Crate(obstacle, body, shapes, _reach(shapes))


def hold(crate: Crate, ground: pymunk.Body, surface: Surface) -> None:
    """Make the joints anew that hold a thing as friction does: they remember nothing. Its body is in a space, and so has its mass."""
    obstacle, body = crate.obstacle, crate.body
    slide = pymunk.PivotJoint(ground, body, (0, 0), body.center_of_gravity)
    turn = pymunk.GearJoint(ground, body, 0.0, 1.0)
    slide.max_bias = turn.max_bias = 0.0  # they hold what moves and pull nothing back
    drag = surface.drag if obstacle.drag is None else obstacle.drag
    slide.max_force = drag * (obstacle.mass or 0.0) * surface.gravity
    # the lever of friction that is spread over a disc of this size is two thirds of its radius
    radius = math.sqrt(sum(shape.area for shape in crate.shapes) / math.pi)
    if isinstance(obstacle.shape, Compound):  # that of the disc with the same moment of inertia, m r^2 / 2
        radius = math.sqrt(2 * body.moment / body.mass)
    turn.max_force = slide.max_force * 2 / 3 * radius
    crate.drag = (slide, turn)


def make_rover(model: RobotModel, surface: Surface) -> Rover:
    """The body and shapes of a robot, and the joints by which its wheels take it along."""
    body = pymunk.Body(model.mass, model.inertia)
    shape = pymunk.Poly(body, model.footprint)
    view = pymunk.Poly(body, model.footprint, radius=VIEW)
    feel = pymunk.Poly(body, model.footprint, radius=FEEL)
    view.filter = feel.filter = IS_LOOK
    axle = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    rover = Rover(model, body, shape, view, feel, axle, _grip(axle, body, model, surface))
    shape.filter = IS_GHOST
    return rover


def _grip(
    axle: pymunk.Body, body: pymunk.Body, model: RobotModel, surface: Surface
) -> tuple[pymunk.PivotJoint, pymunk.GearJoint]:
    along, around = pymunk.PivotJoint(axle, body, (0, 0), (0, 0)), pymunk.GearJoint(axle, body, 0.0, 1.0)
    along.max_bias = around.max_bias = 0.0  # they bring speeds together, not places
    along.max_force = surface.grip * model.mass * surface.gravity
    around.max_force = along.max_force * (
        model.wheel_separation / 2 if model.drive == "differential" else model.reach / 2
    )
    return along, around


def grip_again(rover: Rover, surface: Surface) -> None:
    """Make the joints of a robot anew: they remember nothing."""
    rover.grip = _grip(rover.axle, rover.body, rover.model, surface)


def make_leaf(obstacle: Obstacle) -> Leaf:
    """The body and shapes of a thing that moves by itself; nothing pushes it."""
    body, probe = (pymunk.Body(body_type=pymunk.Body.KINEMATIC) for _ in range(2))
    shapes, probes = (shapes_of(obstacle, each, (0.0, 0.0, 0.0)) for each in (body, probe))
    for shape in shapes:
        shape.elasticity = 1.0
    return Leaf(obstacle, body, shapes, probe, probes)


def shapes_of(obstacle: Obstacle, body: pymunk.Body, pose: Pose) -> list[pymunk.Shape]:
    """The convex parts of an obstacle that stands at `pose` of the body's frame."""
    found = [
        piece for shape, place in simple_parts(obstacle.shape, pose) for piece in _pieces(shape, body, place)
    ]
    for piece in found:
        piece.filter = IS_SOLID
        if obstacle.bottom > 0:
            piece.collision_type = FLOATING
    return found


def _pieces(shape: Simple, body: pymunk.Body, pose: Pose) -> list[pymunk.Shape]:
    x, y, theta = pose
    if isinstance(shape, ROUND):
        return [pymunk.Circle(body, shape.radius, (x, y))]
    outline: NDArray[np.float64] = shape.outline
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


def _reach(shapes: list[pymunk.Shape]) -> float:
    """How far the farthest point is from the body's origin."""
    found = 0.0
    for shape in shapes:
        if isinstance(shape, pymunk.Circle):
            found = max(found, shape.offset.length + shape.radius)
        elif isinstance(shape, pymunk.Poly):
            found = max(found, *(corner.length for corner in shape.get_vertices()))
    return found


def correction(depths: list[float], levers: list[float], mass: float, inertia: float) -> tuple[float, float]:
    """How far to move a body along the normal of a contact [m], and how far to turn it [rad], so that it just touches.

    The contact has one or two points, each with the depth of the overlap there and its lever, the part of its place across the normal. The
    answer is what forces k >= 0 at these points do, along = sum k / m and turn = sum k r / I, that make the overlap vanish.
    """
    if len(depths) == 2:
        (first, second), (r, q) = depths, levers
        if abs(r - q) > 1e-9:
            turn = (first - second) / (r - q)
            along = first - turn * r
            k = (inertia * turn - mass * along * q) / (r - q)
            spare = 1e-12 * mass * along  # for want of digits
            if -spare <= k <= mass * along + spare:  # both points push, and none pulls
                return along, turn
    depth, lever = max(zip(depths, levers, strict=True))
    k = depth / (1 / mass + lever * lever / inertia)
    return k / mass, k * lever / inertia


def depths_of(contacts: pymunk.ContactPointSet) -> list[float]:
    """How deep two shapes overlap at each point of their contact; pymunk's own `distance` has either sign."""
    nx, ny = contacts.normal
    pairs = ((point.point_a, point.point_b) for point in contacts.points)
    return [(a[0] - b[0]) * nx + (a[1] - b[1]) * ny for a, b in pairs]
