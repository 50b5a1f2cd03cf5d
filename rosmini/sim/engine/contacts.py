"""What is where, and what is in whose way: all bodies of a world, and its ground."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.sim.models import RobotModel
from rosmini.sim.world import Obstacle, World

from .bodies import (
    Body,
    Crate,
    Piece,
    Surface,
    body_of_crate,
    body_of_leaf,
    body_of_robot,
    pieces_of,
)
from .ground import Cells, Ground
from .instant import Instant
from .kernels import REST, ROBOT, SLACK
from .movers import Mover
from .outlines import Contact, contact
from .robot import Robot
from .scene import Loops, Near, contact_points

OVERLAP = 1e-4
"""By so much [m] a robot may be put into something, for want of digits."""

FEEL = 1e-4
"""What is so near [m] touches."""

NEARER = 1e-6
"""What passes something at an even distance comes no nearer to it but by rounding [m]."""


class Touch(NamedTuple):
    """One place where something touches another."""

    other: str
    """The name of the other: a robot's or an obstacle's; "wall" for a wall."""
    x: float
    """Where, in the frame map [m]."""
    y: float
    nx: float
    """The direction of the push: from the other into what was asked for, of length 1."""
    ny: float
    force: float
    """How hard the other pushes here along that direction [N], averaged over the last step; friction is not counted."""


class Contacts:
    """The bodies of one world; robots and things come and go by name."""

    def __init__(self, instant: Instant) -> None:
        self.surface = Surface()
        self.instant = instant
        self.ground = Ground(World("void"))
        self.bodies: dict[str, Body] = {}
        self.loose: dict[str, Crate] = {}
        """What can be pushed, or put elsewhere, but has no drive and does not move by itself."""
        self._loops = Loops()
        self._cells = Cells()
        self._roaming: dict[str, Body] = {}
        """What goes where nobody tells the cells."""
        self.forces: tuple[float, list[tuple[str, str, float]]] = (-1.0, [])
        """Until when [ns] which bodies push which others how hard [N]."""

    # -- what comes and goes -------------------------------------------------------------------------------------

    def add_robot(self, robot: Robot) -> None:
        """Take in the body of a robot with a drive."""
        self._roaming[robot.name] = self.bodies[robot.name] = body_of_robot(robot.name, robot.model, robot)

    def add_mover(self, mover: Mover) -> None:
        """Take in the body of something that moves by itself."""
        name = mover.obstacle.name
        self._roaming[name] = self.bodies[name] = body_of_leaf(mover.obstacle, mover)

    def add_crate(self, crate: Crate) -> None:
        """Take in the body of a thing that can be pushed, or put elsewhere."""
        name = crate.obstacle.name
        self.loose[name], self.bodies[name] = crate, body_of_crate(crate)
        self.settle(crate)

    def settle(self, crate: Crate) -> None:
        """Note where a thing is now, or gets to in this step."""
        (x, y, _), r = crate.pose, crate.reach + 0.1
        self._cells.put(crate.obstacle.name, (x - r, y - r, x + r, y + r))

    def remove(self, name: str) -> None:
        """Take a body, or a fixed obstacle, away."""
        self.bodies.pop(name, None)
        self._roaming.pop(name, None)
        self.loose.pop(name, None)
        self._cells.remove(name)
        self.ground.remove(name)

    def clear(self) -> None:
        """Take all bodies away, and leave the ground."""
        self.bodies.clear()
        self._roaming.clear()
        self.loose.clear()
        self._cells = Cells()

    @property
    def crates(self) -> list[Crate]:
        """All things that can be pushed."""
        return [crate for crate in self.loose.values() if crate.obstacle.movable]

    # -- who is near ---------------------------------------------------------------------------------------------

    def near(self, x: float, y: float, reach: float) -> Iterator[Body]:
        """The bodies whose circles come so near [m] to a place."""
        for name in self._cells.near(x, y, reach):
            yield from self._if_near(self.bodies[name], x, y, reach)
        for body in self._roaming.values():
            yield from self._if_near(body, x, y, reach)

    @staticmethod
    def _if_near(body: Body, x: float, y: float, reach: float) -> Iterable[Body]:
        px, py, _ = body.owner.pose
        return (body,) if math.hypot(px - x, py - y) <= reach + body.reach else ()

    def around(self, bodies: Iterable[Body], reach: float) -> list[Body]:
        """The bodies whose circles come so near [m] to those of any of some."""
        places = [(*body.owner.pose[:2], body.reach) for body in bodies]
        found: dict[Body, None] = {}
        if self._cells:
            for x, y, own in places:
                for name in self._cells.near(x, y, own + reach):
                    found.update(dict.fromkeys(self._if_near(self.bodies[name], x, y, own + reach)))
        if self._roaming:
            roaming = list(self._roaming.values())
            table = np.array([(*body.owner.pose[:2], body.reach) for body in roaming])
            centres = np.array(places).reshape(-1, 3)
            apart = np.hypot(table[:, :1] - centres[:, 0], table[:, 1:2] - centres[:, 1]) - centres[:, 2]
            near = (apart.min(axis=1, initial=np.inf) <= reach + table[:, 2]).tolist()
            found.update(dict.fromkeys(body for body, close in zip(roaming, near, strict=True) if close))
        return list(found)

    def scene(self, bodies: Iterable[Body], margin: float) -> Near:
        """Tables of bodies that go no farther than `margin` [m] before it is asked again."""
        ordered = sorted(bodies, key=lambda body: body.name)
        return Near(
            ordered, [body.owner.pose for body in ordered], self.ground, self.surface, margin, self._loops
        )

    # -- what is in the way --------------------------------------------------------------------------------------

    def hindrance(self, model: RobotModel, pose: Pose, ignoring: str = "") -> str | None:
        """Return what a robot of this model overlaps at `pose` that is not fixed, in words; None if it has room."""
        pieces = [Piece(np.array(model.footprint, dtype=float), 0.0)]
        return next(self._in_the_way(pieces, pose, ignoring, 0.0, model.height, model.reach), None)

    def hindrance_of(self, obstacle: Obstacle, pose: Pose) -> str | None:
        """The same of a thing; fixed things and walls do not count."""
        pieces, reach = pieces_of(obstacle.shape), self.reach_of(obstacle)
        bottom, top = obstacle.bottom, obstacle.height
        return next(self._in_the_way(pieces, pose, obstacle.name, bottom, top, reach), None)

    @staticmethod
    def reach_of(obstacle: Obstacle) -> float:
        """How far the farthest point of an obstacle is from its origin [m]."""
        return Crate(obstacle, Instant()).reach

    def _in_the_way(
        self, pieces: list[Piece], pose: Pose, ignoring: str, bottom: float, top: float, reach: float
    ) -> Iterator[str]:
        placed = [_at(piece, pose) for piece in pieces]
        x, y, _ = pose
        for body in self.near(x, y, reach):
            if body.name != ignoring and body.meets(bottom, top):
                there = body.owner.pose
                if _overlap([_at(piece, there) for piece in body.pieces], placed) > OVERLAP:
                    yield body.words()

    def stuck(self, name: str, pose: Pose, keep: float) -> bool:
        """Whether a mover at `pose` would be nearer to something that can give way than now, and nearer than `keep`."""
        body = self.bodies[name]
        now, then = body.owner.pose, pose
        for other in self.near(pose[0], pose[1], body.reach + keep + math.dist(now[:2], then[:2])):
            if other is not body and other.meets(body.bottom, body.top):
                there = other.owner.pose
                placed = [_at(piece, there) for piece in other.pieces]
                for piece in body.pieces:
                    deep = _overlap([_at(piece, then)], placed, keep)
                    if deep > 10 * SLACK and deep > _overlap([_at(piece, now)], placed, keep) + NEARER:
                        return True
        return False

    # -- what touches --------------------------------------------------------------------------------------------

    def touches(self, name: str) -> list[Touch]:
        """What a robot or a thing touches now, and where; with the force of the last step."""
        body = self.bodies[name]
        pose = body.owner.pose
        placed = [_at(piece, pose) for piece in body.pieces]
        x, y, _ = pose
        others: list[tuple[str, list[Piece], Body | None]] = [
            (each.name, [each.piece], None)
            for each in self.ground.near(x, y, body.reach + FEEL)
            if body.meets(each.bottom, each.top)
        ]
        others += [
            (each.name, [_at(piece, each.owner.pose) for piece in each.pieces], each)
            for each in self.near(x, y, body.reach + FEEL)
            if each is not body and each.meets(body.bottom, body.top)
        ]
        found = []
        for other, pieces, mate in others:
            hits = [hit for a in placed for b in pieces if (hit := _contact(a, b, -FEEL))[0]]
            points = sum(hit[0] for hit in hits)
            for hit in hits:
                nx, ny = -hit[1], -hit[2]
                force = self._force(body, other, mate, (nx, ny)) / points
                found += [Touch(other, px, py, nx, ny, force) for px, py, _ in contact_points(hit)]
        return found

    def _force(self, body: Body, other: str, mate: Body | None, normal: tuple[float, float]) -> float:
        """How hard the other pushes a body along a normal [N]."""
        until, forces = self.forces
        if body.kind == ROBOT and (mate is None or mate.name not in self.loose):
            nx, ny = normal
            force = _pressed(body, nx, ny, self.surface)
            return force if mate is None else max(force, _pressed(mate, -nx, -ny, self.surface))
        if self.instant.ns > until:
            return 0.0
        return sum(force for one, two, force in forces if {one, two} == {body.name, other})

    def tune(self, surface: Surface) -> None:
        """Let things rub otherwise from now on."""
        self.surface = surface

    def obstacles(self) -> tuple[Obstacle, ...]:
        """The movable obstacles where they are now."""
        return tuple(replace(crate.obstacle, pose=crate.pose) for crate in self.crates if crate.shown)


def _pressed(body: Body, nx: float, ny: float, surface: Surface) -> float:
    """How hard slipping wheels press a robot against an obstacle: the part of Coulomb's mu m g along the normal."""
    if not isinstance(body.owner, Robot):
        return 0.0
    sx, sy = body.owner.slip
    speed = math.hypot(sx, sy)
    if speed < REST:
        return 0.0
    grip = surface.grip * body.owner.model.mass * surface.gravity
    return max(0.0, -(sx * nx + sy * ny) / speed * grip)


def _at(piece: Piece, pose: Pose) -> Piece:
    return Piece(transform_points(pose, piece.corners), piece.radius)


def _contact(a: Piece, b: Piece, least: float) -> Contact:
    return contact(a.corners, 0, len(a.corners), a.radius, b.corners, 0, len(b.corners), b.radius, least)


def _overlap(one: list[Piece], other: list[Piece], around: float = 0.0) -> float:
    """How deep the deepest of some pieces, and what is `around` them, reach into others [m]; 0 if they do not."""
    hits = (_contact(a, b, -around) for a in one for b in other)
    deep = (max(hit[3], hit[6]) if hit[0] == 2 else hit[3] for hit in hits if hit[0])
    return max((each + around for each in deep), default=0.0)
