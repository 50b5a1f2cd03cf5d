"""Fixed walls and obstacles, and a grid that indexes them by position."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.fixtures import Fixtures
from rosmini.sim.world import Obstacle, World

from .bodies import Piece, pieces_of
from .nearby import Nearby, boxes_around

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]
"""x and y of the lower and the upper corner [m]."""

CELL_SIZE = 1.0
"""Edge length of the grid's cells [m]."""

MAX_CELLS = 64
"""Number of cells above which a box is kept in a separate list and always tested."""


class Cells:
    """A spatial hash of named boxes; inserting and removing take constant time."""

    def __init__(self) -> None:
        self._squares: dict[tuple[int, int], dict[str, None]] = {}
        self._large: dict[str, None] = {}
        self._where: dict[str, list[tuple[int, int]]] = {}

    def __len__(self) -> int:
        return len(self._where)

    def put(self, name: str, box: Box) -> None:
        """Insert a box, or move it."""
        squares = self._covered(box)
        if self._where.get(name) == squares:
            return
        self.remove(name)
        self._where[name] = squares
        if not squares:
            self._large[name] = None
        for square in squares:
            self._squares.setdefault(square, {})[name] = None

    def remove(self, name: str) -> None:
        """Remove a box if it exists."""
        for square in self._where.pop(name, ()):
            names = self._squares[square]
            del names[name]
            if not names:
                del self._squares[square]
        self._large.pop(name, None)

    def near(self, x: float, y: float, reach: float) -> list[str]:
        """Return names of boxes that may meet the square of half-width `reach` [m]; some may be farther away."""
        squares = self._covered((x - reach, y - reach, x + reach, y + reach))
        if not squares:
            return list(self._where)
        found = dict(self._large)
        for square in squares:
            found |= self._squares.get(square, {})
        return list(found)

    @staticmethod
    def _covered(box: Box) -> list[tuple[int, int]]:
        """Return the cells that a box covers; an empty list if there are too many."""
        left, bottom, right, top = (math.floor(each / CELL_SIZE) for each in box)
        if (right - left + 1) * (top - bottom + 1) > MAX_CELLS:
            return []
        return [(i, j) for i in range(left, right + 1) for j in range(bottom, top + 1)]


class FixedPiece(NamedTuple):
    """A convex piece of a fixed object, in the map frame."""

    order: tuple[int, int]
    """Sort key of the pieces."""
    name: str
    """Name of the obstacle; "wall" for a wall."""
    bottom: float
    top: float
    piece: Piece
    box: Box


def box_of(piece: Piece) -> Box:
    """Return the bounding box of a piece."""
    (x0, y0), (x1, y1) = piece.corners.min(axis=0).tolist(), piece.corners.max(axis=0).tolist()
    r = piece.radius
    return (x0 - r, y0 - r, x1 + r, y1 + r)


class Ground:
    """The walls of a world and its fixed obstacles, which can be added and removed."""

    def __init__(self, world: World) -> None:
        self._walls, self._height = world.hard_walls, world.wall_height
        self._index = Nearby(boxes_around(self._walls)) if len(self._walls) else None
        self._wall_pieces: dict[int, FixedPiece] = {}
        self.cells = Cells()
        self._pieces: dict[str, list[FixedPiece]] = {}
        self._number = 0
        self.fixtures = Fixtures(self._walls, solid=world.solid)
        """The same obstacles, for collision queries."""
        self.version = 0
        """Number of changes so far."""

    def insert(self, obstacle: Obstacle) -> None:
        """Insert a fixed obstacle at its pose; passable ones are ignored."""
        if obstacle.passable:
            return
        self.version += 1
        self._number += 1
        name = obstacle.name
        self.fixtures.insert(obstacle.name, obstacle.bottom, obstacle.parts())
        pieces = self._pieces[name] = [
            FixedPiece((self._number, i), name, obstacle.bottom, obstacle.height, piece, box_of(piece))
            for i, piece in enumerate(pieces_of(obstacle.shape, obstacle.pose))
        ]
        x0s, y0s, x1s, y1s = zip(*(piece.box for piece in pieces), strict=True)
        self.cells.put(name, (min(x0s), min(y0s), max(x1s), max(y1s)))

    def remove(self, name: str) -> None:
        """Remove an obstacle if it exists."""
        if self._pieces.pop(name, None) is not None:
            self.version += 1
            self.cells.remove(name)
            self.fixtures.remove(name)

    def near(self, x: float, y: float, reach: float) -> list[FixedPiece]:
        """Return the pieces that meet the square of half-width `reach` [m] around a position, in insertion order."""
        low_x, low_y, high_x, high_y = x - reach, y - reach, x + reach, y + reach
        found = [
            piece
            for name in self.cells.near(x, y, reach)
            for piece in self._pieces[name]
            if piece.box[0] <= high_x and piece.box[2] >= low_x and piece.box[1] <= high_y and piece.box[3] >= low_y
        ]
        if self._index is not None:
            found += [self._wall(row) for row in self._index.within(x, y, reach).tolist()]
        return sorted(found, key=lambda piece: piece.order)

    def _wall(self, row: int) -> FixedPiece:
        made = self._wall_pieces.get(row)
        if made is None:
            piece = Piece(self._walls[row].reshape(2, 2).copy(), 0.0)
            made = self._wall_pieces[row] = FixedPiece((0, row), "wall", 0.0, self._height, piece, box_of(piece))
        return made
