"""Many robots at once: the outlines of all that can bump into one another as tables, for `rosmini.sim.engine.crowd_numba`.

It does what `rosmini.sim.engine.pushing` and `rosmini.sim.engine.physics.Contacts.around` ask pymunk for, robot by robot: the same answers but for the last digits, many
times faster for many robots. Fixed things are in tables that are made once; each robot knows which of them are near.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pymunk
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose

from .bodies import VIEW, Crate, Leaf
from .crowd_numba import compiled
from .nearby import Nearby

if TYPE_CHECKING:
    from .physics import Contacts
    from .robot import Robot

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

MARGIN = 0.5
"""So far [m] a robot goes until it is looked again which fixed things are near to it."""

Piece = tuple[Floats, float]
"""A convex outline (k, 2), counterclockwise, and the radius that is around it: of a wall two corners, of a disc its middle."""


@cache
def fast() -> bool:
    """True if there is numba, which makes machine code of what is done with a crowd."""
    try:
        import numba  # noqa: F401
    except ImportError as error:
        logging.getLogger(__name__).info("numba cannot be used, so crowds of robots are slower: %s", error)
        return False
    return True


def piece_of(shape: pymunk.Shape) -> Piece:
    """The outline of a shape in its body's frame."""
    if isinstance(shape, pymunk.Circle):
        return np.array([shape.offset]), shape.radius
    if isinstance(shape, pymunk.Segment):
        return np.array([shape.a, shape.b]), shape.radius
    polygon = cast("pymunk.Poly", shape)
    return np.array(polygon.get_vertices()), polygon.radius


class Outlines:
    """Convex outlines one below the other: corners (n, 2), where each outline begins (k + 1,), and the box around each with its radius."""

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self.corners = np.vstack([np.empty((0, 2)), *(corners for corners, _ in pieces)])
        self.first = np.cumsum([0, *(len(corners) for corners, _ in pieces)], dtype=np.int64)
        self.radii = np.array([radius for _, radius in pieces], dtype=float)

    def boxes(self, corners: Floats) -> Floats:
        """The boxes (k, 4) around the outlines, with these corners."""
        if not len(self.radii):
            return np.empty((0, 4))
        begins, r = self.first[:-1], self.radii[:, None]
        low, high = np.minimum.reduceat(corners, begins), np.maximum.reduceat(corners, begins)
        return np.hstack([low - r, high + r])


class Crowd:
    """The robots of `contacts`, and all that they can bump into. It is made anew when robots or fixed things come or go."""

    def __init__(self, contacts: Contacts) -> None:
        self.names = sorted(contacts.rovers)
        self.index = {name: i for i, name in enumerate(self.names)}
        rovers = [contacts.rovers[name] for name in self.names]
        outlines = Outlines([piece_of(rover.shape) for rover in rovers])
        self._outline, self._first = outlines.corners, outlines.first
        self._corners = self._outline.copy()
        self._poses = np.zeros((len(rovers), 3))
        # mass, inertia and height, the circle in the robot's frame, and where its middle is now
        rows = [
            (each.mass, each.inertia, each.height, *each.girth, 0.0, 0.0)
            for each in (rover.model for rover in rovers)
        ]
        self._bodies = np.array(rows, dtype=float).reshape(-1, 8)
        self._reaches = np.array([rover.model.reach for rover in rovers])
        self._all = np.arange(len(rovers))
        self._fix(contacts)
        self._shapes: list[list[pymunk.Shape]] = []
        self._soft_outlines = Outlines([])
        self._frames = np.empty((0, 7))

    def _fix(self, contacts: Contacts) -> None:
        """Note the fixed things."""
        fixed = [
            (shape, owner) for shape, owner in contacts.owners.items() if owner.kind in ("wall", "fixed")
        ]
        self._sides = Outlines([piece_of(shape) for shape, _ in fixed])
        bottoms = [owner.bottom for _, owner in fixed]
        self._boxes = np.column_stack([self._sides.boxes(self._sides.corners), bottoms, self._sides.radii])
        self._nearby = Nearby(self._boxes[:, :4])
        self._near = np.full((len(self.names), 1), -1, dtype=np.int64)
        self._anchors = np.full((len(self.names), 2), np.inf)

    def _find_near(self, which: Iterable[int]) -> None:
        """Learn which fixed things are near to robots that have gone far."""
        for i in which:
            x, y = self._anchors[i] = self._poses[i, :2]
            r = self._reaches[i] + VIEW + MARGIN
            found = self._nearby.within(x, y, r)
            if len(found) >= self._near.shape[1]:
                more = np.full((len(self.names), 2 * len(found)), -1, dtype=np.int64)
                more[:, : self._near.shape[1]] = self._near
                self._near = more
            self._near[i, : len(found)] = found
            self._near[i, len(found) :] = -1

    def _stand(self, which: Ints, poses: Iterable[Pose]) -> None:
        """Put robots to where they are."""
        self._poses[which] = list(poses)
        away = np.abs(self._poses[which, :2] - self._anchors[which]).max(axis=1, initial=0.0)
        if (away > MARGIN).any():
            self._find_near(which[away > MARGIN].tolist())

    def _around(self, contacts: Contacts) -> tuple[Any, ...]:
        """Everything that machine code needs to know of what is around; things that are not fixed where they are now."""
        loose: list[Crate | Leaf] = [*contacts.crates, *contacts.leaves.values()]
        soft = sorted(loose, key=lambda each: each.obstacle.name)
        outlines = self._soft_outlines
        if len(soft) != len(self._shapes) or any(
            each.shapes is not shapes for each, shapes in zip(soft, self._shapes, strict=True)
        ):
            self._note_soft(soft)
            outlines = self._soft_outlines
        corners = outlines.corners
        if soft:
            places = np.array([each.pose for each in soft])[self._whose]
            c, s = np.cos(places[:, 2]), np.sin(places[:, 2])
            px, py = outlines.corners.T
            corners = np.column_stack([places[:, 0] + c * px - s * py, places[:, 1] + s * px + c * py])
            self._frames[:, :4] = outlines.boxes(corners)
        return (
            self._poses,
            self._outline,
            self._first,
            self._bodies,
            self._corners,
            self._near,
            self._sides.corners,
            self._sides.first,
            self._boxes,
            corners,
            outlines.first,
            self._frames,
        )

    def _note_soft(self, soft: list[Crate | Leaf]) -> None:
        """Note the things that are not fixed."""
        pieces = [(each, piece_of(shape)) for each in soft for shape in each.shapes]
        self._shapes = [each.shapes for each in soft]
        self._soft_outlines = Outlines([piece for _, piece in pieces])
        number = {id(each): i for i, each in enumerate(soft)}
        self._whose = np.repeat(
            [number[id(each)] for each, _ in pieces], [len(corners) for _, (corners, _) in pieces]
        )
        self._frames = np.zeros((len(pieces), 7))
        self._frames[:, 4:] = [
            (each.obstacle.bottom, radius, isinstance(each, Crate)) for each, (_, radius) in pieces
        ]

    def make_way(
        self,
        contacts: Contacts,
        poses: dict[str, Pose],
        names: Sequence[str],
        limits: tuple[int, int, float, float, float],
    ) -> set[str]:
        """As `rosmini.sim.engine.pushing.make_way`: change the poses of robots that are in something, first of these names; return who was moved."""
        part_all, _ = compiled()
        members = np.array(sorted(self.index[name] for name in poses), dtype=np.int64)
        there = [self.names[i] for i in members.tolist()]
        self._stand(members, [poses[name] for name in there])
        queue = np.array([self.index[name] for name in names], dtype=np.int64)
        moved = np.zeros(len(self.names), dtype=np.int64)
        part_all(queue, *limits, members, *self._around(contacts), moved)
        pushed = np.flatnonzero(moved).tolist()
        for i, (x, y, theta) in zip(pushed, self._poses[pushed].tolist(), strict=True):
            poses[self.names[i]] = (x, y, theta)
        return {self.names[i] for i in pushed}

    def look(
        self, contacts: Contacts, robots: Mapping[str, Robot], lookers: Iterable[str], safe: float
    ) -> None:
        """As `rosmini.sim.engine.clockwork.Clockwork.look` of several robots: learn how much room they have, and the others because of them."""
        _, look = compiled()
        every = [robots[name] for name in self.names]
        self._stand(self._all, [robot.pose for robot in every])
        before, clear = [robot.room for robot in every], np.empty(len(every))
        rooms = np.array(before)
        which = [self.index[name] for name in lookers]
        look(np.array(which, dtype=np.int64), VIEW, safe, *self._around(contacts), rooms, clear)
        for robot, old, new in zip(every, before, rooms.tolist(), strict=True):
            if old != new:
                robot.room = new
        for i, value in zip(which, clear[which].tolist(), strict=True):
            every[i].clear = value
