"""Bodies that may touch each other soon, and fixed outlines near them, as tables for `rosmini.sim.engine.kernels`."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.machine_code import COMPILES
from rosmini.core.geometry.poses import Pose
from rosmini.sim.geometry.outlines import Contact

from .bodies import Body, Surface
from .ground import FixedPiece, Ground
from .kernels import PLAIN, ROBOT, Scene, compiled

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

MARGIN = 0.5
"""Distance a body can move [m] before the fixed outlines near it are looked up again."""


COMPILE_AFTER_BODIES = 5000 if COMPILES else 0
"""Number of bodies processed in plain Python first; beyond it compilation of the loops pays off."""


def _fastest(name: str) -> Callable[..., Any]:
    """Return a loop as machine code, or without numba as plain Python with the same results to the last bit."""
    try:
        return compiled(name)
    except ImportError as error:
        logging.getLogger(__name__).info("numba cannot be used, so contacts are slower: %s", error)
        return PLAIN[name]


KERNELS = {name: cache(partial(_fastest, name)) for name in PLAIN}
"""The loops; each is compiled at its first call."""


class Loops:
    """Runs the loops of one engine; while the load is small it does not wait for the compiler."""

    def __init__(self) -> None:
        self._done = 0

    def run(self, name: str, size: int, *args: Any) -> Any:
        """Run a loop over this number of bodies."""
        kernel = KERNELS[name]
        is_compiled = kernel.cache_info().currsize > 0
        if self._done < COMPILE_AFTER_BODIES and not is_compiled:
            self._done += size
            return PLAIN[name](*args)
        return kernel()(*args)


class Near:
    """Tables of bodies sorted by name, valid as long as none of them moves farther than `margin` [m]."""

    def __init__(
        self,
        bodies: Sequence[Body],
        poses: Sequence[Pose],
        ground: Ground,
        surface: Surface,
        margin: float,
        loops: Loops,
    ) -> None:
        self.bodies = list(bodies)
        self._loops = loops
        self.index = {body.name: i for i, body in enumerate(self.bodies)}
        self.friction = surface.friction**2
        total = len(self.bodies)
        self.poses = np.array(poses, dtype=float).reshape(-1, 3)
        pieces = [piece for body in self.bodies for piece in body.pieces]
        outline, first, radius = _stacked([(p.corners, p.radius) for p in pieces])
        begin = _sums([len(body.pieces) for body in self.bodies])
        fixed = [_around(body, pose, ground, margin) for body, pose in zip(self.bodies, poses, strict=True)]
        rows: dict[int, int] = {}
        self.fixed: list[FixedPiece] = []
        near: list[int] = []
        for each in fixed:
            for piece in each:
                row = rows.setdefault(id(piece), len(rows))
                if row == len(self.fixed):
                    self.fixed.append(piece)
                near.append(row)
        sides, starts, _ = _stacked([(piece.piece.corners, 0.0) for piece in self.fixed])
        boxes = np.array([(*piece.box, piece.piece.radius) for piece in self.fixed]).reshape(-1, 5)
        mate_at, mates = self._candidate_pairs(margin)
        self.scene: Scene = (
            self.poses,
            np.array([body.row(surface) for body in self.bodies]).reshape(-1, 13),
            outline,
            outline.copy(),
            first,
            begin,
            radius,
            _sums([len(each) for each in fixed]),
            np.array(near, dtype=np.int64),
            sides,
            starts,
            boxes,
            mate_at,
            mates,
        )
        lengths = [len(body.pieces) for body in self.bodies]
        most = sum(count * len(each) for count, each in zip(lengths, fixed, strict=True))
        most += sum(lengths[i] * lengths[j] for i in range(total) for j in mates[mate_at[i] : mate_at[i + 1]])
        self.hits = np.zeros((2 * most, 13))

    def _candidate_pairs(self, margin: float) -> tuple[Ints, Ints]:
        """Return the pairs of bodies that may come near each other.

        The bodies near body i are `mates[starts[i]:starts[i + 1]]` (indices; `starts` and `mates` are returned). This
        holds as long as no body moves farther than `margin` [m].
        """
        x, y = self.poses[:, 0], self.poses[:, 1]
        reach = np.array([body.reach for body in self.bodies])
        low, high = np.array([(b.bottom, b.top) for b in self.bodies]).reshape(-1, 2).T
        apart = np.hypot(x[:, None] - x, y[:, None] - y) - (reach[:, None] + reach)
        near = (apart <= 2 * margin) & (low[:, None] <= high) & (low <= high[:, None])
        np.fill_diagonal(near, val=False)
        rows, columns = np.nonzero(near)
        return _sums(np.bincount(rows, minlength=len(self.bodies)).tolist()), columns.astype(np.int64)

    def slide(self, dt: float, motion: Floats) -> list[tuple[str, str, float]]:
        """Let objects slide for a step; return each pair of bodies in contact with the force between them [N]."""
        count = self._loops.run("slide", 10 * len(self.bodies), dt, self.friction, self.scene, motion, self.hits)
        found: dict[tuple[str, str], float] = {}
        for i, j, push in self.hits[:count, [0, 1, 11]].tolist():
            if push:
                one = self.bodies[int(i)].name
                other = self.bodies[int(j)].name if j >= 0 else self.fixed[-1 - int(j)].name
                found[one, other] = found.get((one, other), 0.0) + push / dt
        return [(*pair, force) for pair, force in found.items()]

    def resolve_overlaps(self, queue: list[int]) -> list[int]:
        """Resolve the overlaps of robots, those in `queue` first; return the indices of the robots that were moved."""
        moved = np.zeros(len(self.bodies), dtype=np.int64)
        self._loops.run("resolve_overlaps", len(self.bodies), np.array(queue, dtype=np.int64), self.scene, moved)
        return np.flatnonzero(moved).tolist()

    def clearances(self, robots: list[int], view: float) -> list[float]:
        """Return how far [m] each of `robots` can move before a contact; for other bodies inf, or an upper bound."""
        rooms = np.full(len(self.bodies), np.inf)
        numbers = np.array(robots, dtype=np.int64)
        self._loops.run("clearances", len(robots), numbers, view, self.scene, rooms)
        return rooms.tolist()


def _around(body: Body, pose: Pose, ground: Ground, margin: float) -> list[FixedPiece]:
    """Return the fixed pieces that a body may come near if it moves by up to `margin` [m]; cached with the body."""
    x, y, _ = pose
    need = body.reach + margin
    if body.around is not None:
        (px, py), covered, version, pieces = body.around
        if version == ground.version and max(abs(x - px), abs(y - py)) + need <= covered:
            return pieces  # type: ignore[no-any-return]
    pieces = [
        piece
        for piece in ground.near(x, y, need + MARGIN)
        if piece.bottom <= body.top and (body.kind == ROBOT or body.bottom <= piece.top)
    ]
    body.around = ((x, y), need + MARGIN, ground.version, pieces)
    return pieces


def _sums(counts: Sequence[int]) -> Ints:
    return np.cumsum([0, *counts], dtype=np.int64)


def _stacked(outlines: Sequence[tuple[Floats, float]]) -> tuple[Floats, Ints, Floats]:
    """Stack outlines: return their corners, the start of each, and their radii."""
    corners = np.vstack([np.empty((0, 2)), *(corners for corners, _ in outlines)])
    radii = np.array([radius for _, radius in outlines], dtype=float)
    return corners, _sums([len(corners) for corners, _ in outlines]), radii


def contact_points(found: Contact) -> list[tuple[float, float, float]]:
    """Return the position and depth of each point of a contact."""
    count, _, _, d0, x0, y0, d1, x1, y1 = found
    return [(x0, y0, d0), (x1, y1, d1)][:count]
