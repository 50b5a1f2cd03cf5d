"""All bodies of a world and its ground: overlaps, contacts and neighbours."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.sim.geometry.outlines import Contact, contact
from rosmini.sim.models import RobotModel
from rosmini.sim.shapes import reach_of
from rosmini.sim.world import Obstacle, World

from .bodies import Body, Crate, Piece, Surface, crate_body, kinematic_body, pieces_of, robot_body
from .ground import Cells, Ground
from .instant import Instant
from .kernels import PUSH_DEPTH, REST_SPEED, ROBOT
from .movers import Mover
from .robot import Robot
from .scene import Loops, Near, contact_points

PLACEMENT_OVERLAP = 1e-4
"""Overlap [m] that is ignored when a robot is placed, because of rounding."""

TOUCH_DISTANCE = 1e-4
"""Maximum distance at which two bodies touch [m]."""

ROUNDING = 1e-6
"""Decrease of a distance [m] that counts as rounding, for example while a body passes at a constant distance."""


class Touch(NamedTuple):
    """One contact point between two objects."""

    other: str
    """The name of the other object: a robot or an obstacle; "wall" for a wall."""
    x: float
    """The contact point, in the map frame [m]."""
    y: float
    nx: float
    """Direction of the push, of length 1: from the other object towards the queried one."""
    ny: float
    force: float
    """Force of the other object along that direction [N], averaged over the last step, without friction."""


class Contacts:
    """The bodies of one world; robots and obstacles are added and removed by name."""

    def __init__(self, instant: Instant) -> None:
        self.surface = Surface()
        self.instant = instant
        self.ground = Ground(World("void"))
        self.bodies: dict[str, Body] = {}
        self.loose: dict[str, Crate] = {}
        """Obstacles that can be pushed or put elsewhere; they have no drive and do not move by themselves."""
        self._loops = Loops()
        self._cells = Cells()
        self._self_propelled: dict[str, Body] = {}
        """Bodies that are not in `_cells`, because they move by themselves."""
        self.forces: tuple[float, list[tuple[str, str, float]]] = (-1.0, [])
        """Time until which they apply [ns], and for each pair of bodies the force between them [N]."""

    # -- adding and removing -------------------------------------------------------------------------------------

    def add_robot(self, robot: Robot) -> None:
        """Add the body of a robot with a drive."""
        self._self_propelled[robot.name] = self.bodies[robot.name] = robot_body(robot.name, robot.model, robot)

    def add_mover(self, mover: Mover) -> None:
        """Add the body of an obstacle that moves by itself."""
        name = mover.obstacle.name
        self._self_propelled[name] = self.bodies[name] = kinematic_body(mover.obstacle, mover)

    def add_crate(self, crate: Crate) -> None:
        """Add the body of an obstacle that can be pushed or put elsewhere."""
        name = crate.obstacle.name
        self.loose[name], self.bodies[name] = crate, crate_body(crate)
        self.update_cells(crate)

    def update_cells(self, crate: Crate) -> None:
        """Update an obstacle's box in the spatial grid; a margin of 0.1 m covers its motion in this step."""
        (x, y, _), r = crate.pose, crate.reach + 0.1
        self._cells.put(crate.obstacle.name, (x - r, y - r, x + r, y + r))

    def remove(self, name: str) -> None:
        """Remove a body or a fixed obstacle; an unknown name has no effect."""
        self.bodies.pop(name, None)
        self._self_propelled.pop(name, None)
        self.loose.pop(name, None)
        self._cells.remove(name)
        self.ground.remove(name)

    def clear(self) -> None:
        """Remove all bodies and keep the ground."""
        self.bodies.clear()
        self._self_propelled.clear()
        self.loose.clear()
        self._cells = Cells()

    @property
    def crates(self) -> list[Crate]:
        """All obstacles that can be pushed."""
        return [crate for crate in self.loose.values() if crate.obstacle.movable]

    # -- neighbours ----------------------------------------------------------------------------------------------

    def near(self, x: float, y: float, reach: float) -> Iterator[Body]:
        """Yield the bodies whose bounding circles are within `reach` [m] of a position."""
        for name in self._cells.near(x, y, reach):
            yield from self._if_near(self.bodies[name], x, y, reach)
        for body in self._self_propelled.values():
            yield from self._if_near(body, x, y, reach)

    @staticmethod
    def _if_near(body: Body, x: float, y: float, reach: float) -> Iterable[Body]:
        px, py, _ = body.owner.pose
        return (body,) if math.hypot(px - x, py - y) <= reach + body.reach else ()

    def neighbours(self, bodies: Iterable[Body], reach: float) -> list[Body]:
        """Return the bodies within `reach` [m] of any of the given ones, by bounding circles, and these themselves."""
        places = [(*body.owner.pose[:2], body.reach) for body in bodies]
        found: dict[Body, None] = {}
        if self._cells:
            for x, y, own in places:
                for name in self._cells.near(x, y, own + reach):
                    found.update(dict.fromkeys(self._if_near(self.bodies[name], x, y, own + reach)))
        if self._self_propelled:
            self_propelled = list(self._self_propelled.values())
            table = np.array([(*body.owner.pose[:2], body.reach) for body in self_propelled])
            centres = np.array(places).reshape(-1, 3)
            apart = np.hypot(table[:, :1] - centres[:, 0], table[:, 1:2] - centres[:, 1]) - centres[:, 2]
            near = (apart.min(axis=1, initial=np.inf) <= reach + table[:, 2]).tolist()
            found.update(dict.fromkeys(body for body, close in zip(self_propelled, near, strict=True) if close))
        return list(found)

    def scene(self, bodies: Iterable[Body], margin: float) -> Near:
        """Return tables of bodies that move at most `margin` [m] before the next call."""
        ordered = sorted(bodies, key=lambda body: body.name)
        return Near(ordered, [body.owner.pose for body in ordered], self.ground, self.surface, margin, self._loops)

    # -- overlaps ------------------------------------------------------------------------------------------------

    def obstruction(self, model: RobotModel, pose: Pose, ignoring: str = "") -> str | None:
        """Describe a body, other than `ignoring`, that a robot would overlap at `pose`; None if there is room."""
        pieces = [Piece(np.array(model.footprint, dtype=float), 0.0)]
        return next(self._in_the_way(pieces, pose, ignoring, 0.0, model.height, model.reach), None)

    def obstruction_of(self, obstacle: Obstacle, pose: Pose) -> str | None:
        """Describe a body that is not fixed and that an obstacle would overlap at `pose`; None if there is room."""
        pieces, reach = pieces_of(obstacle.shape), reach_of(obstacle.shape)
        bottom, top = obstacle.bottom, obstacle.height
        return next(self._in_the_way(pieces, pose, obstacle.name, bottom, top, reach), None)

    def _in_the_way(
        self, pieces: list[Piece], pose: Pose, ignoring: str, bottom: float, top: float, reach: float
    ) -> Iterator[str]:
        placed = [_at(piece, pose) for piece in pieces]
        x, y, _ = pose
        for body in self.near(x, y, reach):
            if body.name != ignoring and body.meets(bottom, top):
                there = body.owner.pose
                if _overlap([_at(piece, there) for piece in body.pieces], placed) > PLACEMENT_OVERLAP:
                    yield body.description()

    def is_blocked(self, name: str, pose: Pose, keep: float) -> bool:
        """Return True if a move to `pose` brings a mover closer than `keep` [m] to a body, and closer than it is now.

        Fixed bodies are ignored.
        """
        body = self.bodies[name]
        now, then = body.owner.pose, pose
        for other in self.near(pose[0], pose[1], body.reach + keep + math.dist(now[:2], then[:2])):
            if other is not body and other.meets(body.bottom, body.top):
                there = other.owner.pose
                placed = [_at(piece, there) for piece in other.pieces]
                for piece in body.pieces:
                    deep = _overlap([_at(piece, then)], placed, keep)
                    if deep > 10 * PUSH_DEPTH and deep > _overlap([_at(piece, now)], placed, keep) + ROUNDING:
                        return True
        return False

    # -- contacts ------------------------------------------------------------------------------------------------

    def touches(self, name: str) -> list[Touch]:
        """Return the current contacts of a robot or an obstacle, with the forces of the last step."""
        body = self.bodies[name]
        pose = body.owner.pose
        placed = [_at(piece, pose) for piece in body.pieces]
        x, y, _ = pose
        others: list[tuple[str, list[Piece], Body | None]] = [
            (each.name, [each.piece], None)
            for each in self.ground.near(x, y, body.reach + TOUCH_DISTANCE)
            if body.meets(each.bottom, each.top)
        ]
        others += [
            (each.name, [_at(piece, each.owner.pose) for piece in each.pieces], each)
            for each in self.near(x, y, body.reach + TOUCH_DISTANCE)
            if each is not body and each.meets(body.bottom, body.top)
        ]
        found = []
        for other, pieces, mate in others:
            hits = [hit for a in placed for b in pieces if (hit := _contact(a, b, -TOUCH_DISTANCE))[0]]
            points = sum(hit[0] for hit in hits)
            for hit in hits:
                nx, ny = -hit[1], -hit[2]
                force = self._force(body, other, mate, (nx, ny)) / points
                found += [Touch(other, px, py, nx, ny, force) for px, py, _ in contact_points(hit)]
        return found

    def _force(self, body: Body, other: str, mate: Body | None, normal: tuple[float, float]) -> float:
        """Return the force [N] of the other object on a body along a normal."""
        until, forces = self.forces
        if body.kind == ROBOT and (mate is None or mate.name not in self.loose):
            nx, ny = normal
            force = _pressed(body, nx, ny, self.surface)
            return force if mate is None else max(force, _pressed(mate, -nx, -ny, self.surface))
        if self.instant.ns > until:
            return 0.0
        return sum(force for one, two, force in forces if {one, two} == {body.name, other})

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return the movable obstacles at their current poses."""
        return tuple(replace(crate.obstacle, pose=crate.pose) for crate in self.crates if crate.shown)


def _pressed(body: Body, nx: float, ny: float, surface: Surface) -> float:
    """Return the force [N] of slipping wheels against an obstacle: Coulomb friction, mu m g, along the normal."""
    if not isinstance(body.owner, Robot):
        return 0.0
    sx, sy = body.owner.slip
    speed = math.hypot(sx, sy)
    if speed < REST_SPEED:
        return 0.0
    grip = surface.grip * body.owner.model.mass * surface.gravity
    return max(0.0, -(sx * nx + sy * ny) / speed * grip)


def _at(piece: Piece, pose: Pose) -> Piece:
    return Piece(transform_points(pose, piece.corners), piece.radius)


def _contact(a: Piece, b: Piece, least: float) -> Contact:
    return contact(a.corners, 0, len(a.corners), a.radius, b.corners, 0, len(b.corners), b.radius, least)


def _overlap(one: list[Piece], other: list[Piece], around: float = 0.0) -> float:
    """Return the deepest overlap [m] of two sets of pieces, `one` enlarged by `around` [m]; 0 without an overlap."""
    hits = (_contact(a, b, -around) for a in one for b in other)
    deep = (max(hit[3], hit[6]) if hit[0] == 2 else hit[3] for hit in hits if hit[0])
    return max((each + around for each in deep), default=0.0)
