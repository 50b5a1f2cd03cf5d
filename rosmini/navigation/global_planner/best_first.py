"""A* on a cost grid as in global_planner: a heap of cells, ranked by potential plus distance to the goal.

A cell gets its potential when the first of its neighbours is taken from the heap, and keeps it: this is fast, but the
path is not always the cheapest (http://wiki.ros.org/global_planner). One defect of the original is not copied: it adds
a cell's cost and `neutral_cost` in 8 bits, so that costs of 206 and above wrap around to low ones.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel
from rosmini.navigation.navfn.wave import HIGH, interpolated


def push(heap: NDArray[np.int32], ranks: NDArray[np.float32], size: int, cell: int, rank: float) -> None:
    """Insert a cell into a heap of `size` cells and their ranks, in place; the cell with the lowest rank is first."""
    at = size
    while at > 0:
        above = (at - 1) // 2
        if ranks[above] <= rank:
            break
        heap[at], ranks[at] = heap[above], ranks[above]
        at = above
    heap[at], ranks[at] = cell, rank


def sift(heap: NDArray[np.int32], ranks: NDArray[np.float32], size: int) -> None:
    """Restore a heap of `size` cells after its first cell has been taken; the last cell replaces it."""
    cell, rank = heap[size], ranks[size]
    at = 0
    while 2 * at + 1 < size:
        below = 2 * at + 1
        if below + 1 < size and ranks[below + 1] < ranks[below]:
            below += 1
        if ranks[below] >= rank:
            break
        heap[at], ranks[at] = heap[below], ranks[below]
        at = below
    heap[at], ranks[at] = cell, rank


def best_first(
    costs: NDArray[np.uint8],
    table: NDArray[np.float32],
    potential: NDArray[np.float32],
    heap: NDArray[np.int32],
    ranks: NDArray[np.float32],
    state: NDArray[np.int64],
    width: int,
    quadratic: int,
    stop: int,
    heuristic: float,
    count: int,
) -> int:
    """Expand up to `count` cells from the heap. The arrays contain the whole state, so the next call continues.

    Args:
        costs: the costs of all cells, row by row; the outermost must be lethal.
        table: the cost of entering a cell by cost value [256]; infinite if impassable.
        potential: the potential of the cells, modified in place.
        heap: the waiting cells, lowest rank first.
        ranks: the ranks of the waiting cells.
        state: number of waiting cells, number of cells taken [2].
        width: number of cells in a row.
        quadratic: 1 to interpolate potentials between two neighbours, 0 to use the preceding cell alone.
        stop: the goal.
        heuristic: the addition to a rank per cell of Manhattan distance to the goal.
        count: maximum number of cells to take.

    Returns:
        0 if cells are left, 1 if `stop` was taken, 2 if no cell is waiting.

    """
    size, taken, result = state[0], 0, 0
    stop_x, stop_y = stop % width, stop // width
    while taken < count:
        if size == 0:
            result = 2
            break
        n = heap[0]
        size -= 1
        sift(heap, ranks, size)
        taken += 1
        if n == stop:
            result = 1
            break
        for m in (n + 1, n - 1, n + width, n - width):
            cost = table[costs[m]]
            if potential[m] < HIGH or not cost < HIGH:
                continue
            if quadratic:
                a = min(potential[m - 1], potential[m + 1])
                b = min(potential[m - width], potential[m + width])
                pot = np.float32(interpolated(a, b, cost))
            else:
                pot = np.float32(potential[n] + cost)
            potential[m] = pot
            ahead = abs(stop_x - m % width) + abs(stop_y - m // width)
            push(heap, ranks, size, m, float(pot) + heuristic * ahead)
            size += 1
    state[0] = size
    state[1] += taken
    return result


@kernel(best_first, interpolated, push, sift)
def compiled_best_first(numba: Any) -> Any:
    """Return `best_first`, compiled if numba is available; the body returns its signature for the decorator."""
    types = numba.types
    number, floats = types.int64, types.float32[::1]
    arrays = (types.uint8[::1], floats, floats, types.int32[::1], floats, types.int64[::1])
    return number(*arrays, number, number, number, types.float64, number)
