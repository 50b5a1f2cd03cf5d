"""A maze whose cells can all be reached, many of them by more than one way."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.world import Obstacle, World

from .walls import wall

COLUMNS, ROWS = 10, 8
CELL = 1.0
"""From the middle of one corridor to that of the next [m]."""
THICKNESS = 0.1
HEIGHT = 0.5
SEED, LOOPS = 11, 4


def maze() -> World:
    """The maze, as its file is written from; a robot starts in its lower left cell, where the origin is."""
    right, up = passages(COLUMNS, ROWS, np.random.default_rng(SEED), LOOPS)
    starts: tuple[Pose, ...] = (
        (0.0, 0.0, math.pi / 2 if up[0, 0] else 0.0),
        ((COLUMNS - 1) * CELL, (ROWS - 1) * CELL, math.pi),
        (0.0, (ROWS - 1) * CELL, 0.0),
        ((COLUMNS - 1) * CELL, 0.0, math.pi),
    )
    return World("maze", tuple(walls(right, up)), starts=starts)


def passages(
    columns: int, rows: int, rng: np.random.Generator, loops: int
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which cells are joined to the next to the right (rows, columns - 1) and to the next above (rows - 1, columns).

    A depth-first search joins all cells; then `loops` more openings are made.
    """
    right = np.zeros((rows, columns - 1), dtype=bool)
    up = np.zeros((rows - 1, columns), dtype=bool)
    seen = np.zeros((rows, columns), dtype=bool)
    way = [(0, 0)]
    seen[0, 0] = True
    while way:
        row, column = way[-1]
        around = [(row, column + 1), (row + 1, column), (row, column - 1), (row - 1, column)]
        new = [(r, c) for r, c in around if 0 <= r < rows and 0 <= c < columns and not seen[r, c]]
        if not new:
            way.pop()
            continue
        r, c = new[rng.integers(len(new))]
        seen[r, c] = True
        _join(right, up, (row, column), (r, c))
        way.append((r, c))
    closed = [(table, i, j) for table in (right, up) for i, j in np.argwhere(~table).tolist()]
    for k in rng.permutation(len(closed))[:loops]:
        table, i, j = closed[k]
        table[i, j] = True
    return right, up


def _join(right: NDArray[np.bool_], up: NDArray[np.bool_], a: tuple[int, int], b: tuple[int, int]) -> None:
    row, column = min(a[0], b[0]), min(a[1], b[1])
    (right if a[0] == b[0] else up)[row, column] = True


def walls(right: NDArray[np.bool_], up: NDArray[np.bool_]) -> list[Obstacle]:
    """The walls between cells that are not joined, in the longest pieces; those along x end in those along y."""
    rows, columns = right.shape[0], up.shape[1]
    found: list[Obstacle] = []
    half = THICKNESS / 2

    def line(i: int) -> float:
        return (i - 0.5) * CELL

    for row in range(rows + 1):
        closed = np.ones(columns, bool) if row in (0, rows) else ~up[row - 1]
        for a, b in _runs(closed):
            found += wall(
                f"row {row} {a}", (line(a) - half, line(row)), (line(b) + half, line(row)), THICKNESS, height=HEIGHT
            )
    for column in range(columns + 1):
        closed = np.ones(rows, bool) if column in (0, columns) else ~right[:, column - 1]
        for a, b in _runs(closed):
            found += wall(
                f"column {column} {a}",
                (line(column), line(a) - half),
                (line(column), line(b) + half),
                THICKNESS,
                height=HEIGHT,
            )
    return found


def _runs(closed: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """From where to where each unbroken stretch goes."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], closed, [False]]).astype(int)))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]
