"""Bodies: the geometry and mass of robots and obstacles, for contacts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import area, convex_parts
from rosmini.core.geometry.poses import Pose
from rosmini.core.geometry.products import scalar_product
from rosmini.sim.models import GRAVITY, RobotModel
from rosmini.sim.shapes import ROUND, Compound, Shape, outline_at, reach_of, simple_parts
from rosmini.sim.world import Obstacle

from .instant import SECOND, STEP_NS, Instant, Placed, between_poses
from .kernels import CRATE, KINEMATIC, ROBOT

Floats = NDArray[np.float64]
Velocity = tuple[float, float, float]
"""Along x and y of the map frame [m/s], and rate of turn to the left [rad/s]."""

AT_REST: Velocity = (0.0, 0.0, 0.0)

GRIP = 0.7
"""Friction of rubber wheels on the ground. This and the next two are typical values; the robot's are not published."""

DRAG = 0.5
"""Friction of a movable obstacle on the ground."""

FRICTION = 0.3
"""Friction between bodies."""


@dataclass(frozen=True)
class Surface:
    """Coefficients of friction, and gravitational acceleration [m/s2]."""

    grip: float = GRIP
    drag: float = DRAG
    friction: float = FRICTION
    gravity: float = GRAVITY


class Piece(NamedTuple):
    """A convex outline (k, 2), counter-clockwise, with a radius: a wall has two corners, a disc one."""

    corners: Floats
    radius: float


def pieces_of(shape: Shape, pose: Pose = (0.0, 0.0, 0.0)) -> list[Piece]:
    """Return the convex pieces of a shape at a pose."""
    found: list[Piece] = []
    for part, place in simple_parts(shape, pose):
        if isinstance(part, ROUND):
            found.append(Piece(np.array([place[:2]]), part.radius))
        else:
            found += [Piece(corners, 0.0) for corners in convex_parts(outline_at(part, place))]
    return found


class Mass(NamedTuple):
    """A body's mass [kg], its moment of inertia about its centre of mass [kg m2], and the centre's position [m]."""

    mass: float
    inertia: float
    x: float = 0.0
    y: float = 0.0


def mass_of_pieces(pieces: Sequence[Piece], mass: float) -> Mass:
    """Return the moment of inertia and centre of mass of convex pieces of uniform density; `mass` [kg] is the total."""
    parts = []  # for each piece: its area, its centre, and the second moment of the area about the centre
    for corners, radius in pieces:
        if len(corners) == 1:
            size = math.pi * radius**2
            parts.append((size, corners[0], size * radius**2 / 2))
        else:
            middle = corners.mean(axis=0)
            x, y = (corners - middle).T
            u, v = np.roll(x, -1), np.roll(y, -1)
            cross = x * v - u * y
            size = float(cross.sum()) / 2
            centre = np.array([((x + u) * cross).sum(), ((y + v) * cross).sum()]) / (6 * size)
            second = float((cross * (x * x + x * u + u * u + y * y + y * v + v * v)).sum()) / 12
            parts.append((size, middle + centre, second - size * scalar_product(centre, centre)))
    total = math.fsum(size for size, _, _ in parts)
    centre = sum(size * place for size, place, _ in parts) / total
    second = math.fsum(own + size * scalar_product(place - centre, place - centre) for size, place, own in parts)
    return Mass(mass, mass * second / total, float(centre[0]), float(centre[1]))


class Crate:
    """An obstacle that can be pushed, or, if it has no mass, one that stays where it is put."""

    def __init__(self, obstacle: Obstacle, instant: Instant, *, shown: bool = True) -> None:
        self.obstacle = obstacle
        self.shown = shown
        """True if it is listed among the obstacles; False: it is the body of a robot model without a drive."""
        self.reach = reach_of(obstacle.shape)
        self._instant = instant
        self.put(obstacle.pose)

    def put(self, pose: Pose, velocity: Velocity = AT_REST) -> None:
        """Set the pose and the velocity of the origin, and extrapolate to the end of the step."""
        now = self._instant.ns
        self._begin_ns, self._end_ns = now, -(-now // STEP_NS) * STEP_NS
        (x, y, theta), (vx, vy, w), dt = pose, velocity, (self._end_ns - now) / SECOND
        self._begin, self._end = pose, (x + vx * dt, y + vy * dt, theta + w * dt)
        self.velocity = velocity
        """Velocity of its origin and its rate of turn at the end of the last step."""

    def carry(self, begin_ns: int, end_ns: int, end: Pose, velocity: Velocity) -> None:
        """Move along a straight line to `end`, where it arrives at `end_ns` with this velocity."""
        self._begin_ns, self._begin, self._end_ns, self._end = begin_ns, self.pose, end_ns, end
        self.velocity = velocity

    @property
    def pose(self) -> Pose:
        """Its current pose."""
        ns = self._instant.ns
        if ns >= self._end_ns:
            return self._end
        return between_poses(self._begin, self._end, (ns - self._begin_ns) / (self._end_ns - self._begin_ns))

    @property
    def sliding(self) -> bool:
        """True if its velocity is not zero."""
        return self.velocity != AT_REST

    def state(self) -> tuple[Any, ...]:
        """Return the data that `restore` takes.

        They are the times [ns] and poses at the start and the end of the current motion, and the velocity.
        """
        return (self._begin_ns, self._begin, self._end_ns, self._end, self.velocity)

    def restore(self, state: tuple[Any, ...]) -> None:
        """Restore what `state` returned."""
        self._begin_ns, self._begin, self._end_ns, self._end, self.velocity = state


@dataclass(eq=False)
class Body:
    """A body that is not fixed, for the contact computations."""

    name: str
    kind: float
    """`ROBOT`, `CRATE` or `KINEMATIC`."""
    owner: Placed
    """The object that knows its pose."""
    pieces: list[Piece]
    bottom: float
    top: float
    mass: Mass
    reach: float
    """Distance of the farthest point from its origin [m]."""
    restitution: float = 0.0
    ground_friction: tuple[float | None, float, float] = (None, 0.0, 0.0)
    """Ground friction coefficient (None: the surface's), the load on it [kg], and the lever arm [m]."""
    around: Any = field(default=None, repr=False)
    """The fixed outlines near it; used by `rosmini.sim.engine.scene`."""

    def description(self) -> str:
        """Return a description that fits into a sentence."""
        return f"the {'robot' if self.kind == ROBOT else 'obstacle'} {self.name!r}"

    def meets(self, bottom: float, top: float) -> bool:
        """Return True if an object between the heights `bottom` and `top` [m] can hit it, not pass over or under it."""
        return self.bottom <= top and bottom <= self.top

    @cached_property
    def _circle(self) -> tuple[float, float, float]:
        """Centre and radius of a circle around its pieces, in its own frame."""
        corners = np.vstack([piece.corners for piece in self.pieces])
        x, y = ((corners.min(axis=0) + corners.max(axis=0)) / 2).tolist()
        farthest = float(np.hypot(corners[:, 0] - x, corners[:, 1] - y).max())
        return x, y, farthest + max(piece.radius for piece in self.pieces)

    def row(self, surface: Surface) -> tuple[float, ...]:
        """Return its properties in the order of `rosmini.sim.engine.kernels`."""
        x, y, girth = self._circle
        drag, load, lever = self.ground_friction
        default = surface.grip if self.kind == ROBOT else surface.drag
        hold = (default if drag is None else drag) * load * surface.gravity
        mass = self.mass
        return (
            *(mass.mass, mass.inertia, x, y, girth, self.kind, 0.0, 0.0),
            *(mass.x, mass.y, self.restitution, hold, hold * lever),
        )  # fmt: skip


def robot_body(name: str, model: RobotModel, owner: Placed) -> Body:
    """Return the body of a robot with a drive."""
    lever = model.wheel_separation / 2 if model.drive == "differential" else model.reach / 2
    pieces = [Piece(np.array(model.footprint, dtype=float), 0.0)]
    mass = Mass(model.mass, model.inertia)
    ground_friction = (None, model.mass, lever)
    return Body(name, ROBOT, owner, pieces, 0.0, model.height, mass, model.reach, 0.0, ground_friction)


def crate_body(crate: Crate) -> Body:
    """Return the body of an obstacle that can be pushed or put elsewhere."""
    obstacle = crate.obstacle
    if obstacle.mass is None:
        return kinematic_body(obstacle, crate)
    pieces = pieces_of(obstacle.shape)
    mass = mass_of_pieces(pieces, obstacle.mass)
    # friction distributed evenly over a disc of this area has a lever arm of two thirds of its radius
    size = math.fsum(math.pi * p.radius**2 if len(p.corners) == 1 else area(p.corners) for p in pieces)
    radius = math.sqrt(size / math.pi)
    if isinstance(obstacle.shape, Compound):  # use the disc with the same moment of inertia, m r^2 / 2
        radius = math.sqrt(2 * mass.inertia / mass.mass)
    ground_friction = (obstacle.drag, obstacle.mass, 2 / 3 * radius)
    return Body(
        *(obstacle.name, CRATE, crate, pieces, obstacle.bottom, obstacle.height),
        *(mass, crate.reach, obstacle.restitution, ground_friction),
    )  # fmt: skip


def kinematic_body(obstacle: Obstacle, owner: Placed) -> Body:
    """Return the body of an obstacle that cannot be pushed but is not fixed."""
    reach, mass = reach_of(obstacle.shape), Mass(1.0, 1.0)
    return Body(
        obstacle.name, KINEMATIC, owner, pieces_of(obstacle.shape), obstacle.bottom, obstacle.height, mass, reach
    )
