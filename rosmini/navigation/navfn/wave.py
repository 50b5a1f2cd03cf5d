"""A wave that spreads over a cost grid and computes the path cost of each cell: the loop of navfn.

Cells wait in three blocks: those of the current round, those of the next, and those whose potential is beyond the
threshold. When a block and its successors are done, the threshold rises. A cell is expanded again when a neighbour
has become cheaper, so the order is nearly that of Dijkstra's algorithm, without a heap
(http://wiki.ros.org/navfn; Brock and Khatib, High-speed navigation using the global dynamic window approach, 1999).

Three defects of the original are not copied. Its blocks hold 10,000 cells and drop the excess; here a block can hold
all cells. It gives up after a number of rounds, which may be too few in a maze. And it expands a cell again only if a
neighbour has become cheaper by 0.7 of the cell's cost, so that its potentials depend on the order and are a few
percent above the fixed point of their formula; here (except for A*) they are the fixed point.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

HIGH = 1e10
"""The potential of a cell that the wave has not reached."""

EXPANDED = 6
"""Index of the number of expansions in a wave's state."""

GOING, ARRIVED, EXHAUSTED = range(3)
"""The results of `wave`."""


def interpolated(a: float, b: float, cost: float) -> float:
    """Return a cell's potential from its lower neighbours in the row, `a`, and in the column, `b` (planar wave)."""
    low = min(a, b)
    apart = max(a, b) - low
    if apart >= cost:
        return low + cost
    share = apart / cost
    return low + cost * (-0.2301 * share * share + 0.5307 * share + 0.7040)


def enqueue(cell: np.uint64, at: int, blocks: NDArray[np.int32], pending: NDArray[np.uint8]) -> int:
    """Write a cell into `blocks` at the index `at`, and mark it as pending; return the next index."""
    pending[cell] = 1
    blocks[at] = cell
    return at + 1


def wave(
    costs: NDArray[np.uint8],
    table: NDArray[np.float32],
    potential: NDArray[np.float32],
    pending: NDArray[np.uint8],
    blocks: NDArray[np.int32],
    state: NDArray[np.int64],
    levels: NDArray[np.float64],
    width: int,
    quadratic: int,
    stop: int,
    heuristic: float,
    count: int,
) -> int:
    """Expand up to `count` cells; the state is in the arrays, so that the next call continues.

    Args:
        costs: the costs of all cells, row by row; the outermost must be lethal.
        table: the cost of entering a cell by cost value [256]; infinite if impassable.
        potential: the potential of the cells, modified in place.
        pending: 1 for cells that are waiting in a block.
        blocks: three blocks of cells, one after another, each with room for all cells.
        state: indices of the current and the next block; the next cell in the current block; numbers of cells in the
            current block, in the next block and beyond the threshold; number of expansions [7].
        levels: the threshold and its increment.
        width: number of cells in a row.
        quadratic: 1 to interpolate potentials between two neighbours, 0 to use the lowest one alone.
        stop: the cell at which the wave ends, once reached, at the end of a round; -1 for none.
        heuristic: for A*, the addition to a cell's rank per cell of distance to `stop`; 0 for Dijkstra. As in the
            original it also applies to repeated expansions, so A* finds a path, but not always the cheapest.
        count: maximum number of cells to expand.

    Returns:
        `GOING`, `ARRIVED` at `stop`, or `EXHAUSTED` if no cell is waiting.

    """
    room = costs.shape[0]
    current, following, at, here, after, over = state[0], state[1], state[2], state[3], state[4], state[5]
    threshold = levels[0]
    # Unsigned, so that numba need not handle negative indices.
    one, row = np.uint64(1), np.uint64(width)
    stop_x, stop_y = stop % width, stop // width
    # A neighbour cannot improve unless its potential exceeds this cell's by more than this fraction of its cost: with
    # interpolation v(1) - 1 is 0.0046.
    margin = 0.707106781 if heuristic > 0 else (0.004 if quadratic else 1.0)
    result, budget = 0, count
    while budget > 0:
        if here == 0:
            result = 2
            break
        base = current * room
        end = min(here, at + budget)
        next_base, over_base = following * room, (3 - current - following) * room
        for i in range(base + at, base + end):
            n = np.uint64(blocks[i])
            pending[n] = 0
            nl, nr, nd, nu = n - one, n + one, n - row, n + row
            left, right, below, above = potential[nl], potential[nr], potential[nd], potential[nu]
            cost = table[costs[n]]
            pot = np.float32(
                interpolated(min(left, right), min(below, above), cost)
                if quadratic
                else min(left, right, below, above) + cost
            )
            if not pot < potential[n]:
                continue
            potential[n] = pot
            rank = float(pot)
            if heuristic > 0:
                dx, dy = np.int64(n) % width - stop_x, np.int64(n) // width - stop_y
                rank += heuristic * math.sqrt(dx * dx + dy * dy)
            first = next_base + after if rank < threshold else over_base + over
            put = first
            if left > rank and pending[nl] == 0 and left > rank + margin * table[costs[nl]]:
                put = enqueue(nl, put, blocks, pending)
            if right > rank and pending[nr] == 0 and right > rank + margin * table[costs[nr]]:
                put = enqueue(nr, put, blocks, pending)
            if below > rank and pending[nd] == 0 and below > rank + margin * table[costs[nd]]:
                put = enqueue(nd, put, blocks, pending)
            if above > rank and pending[nu] == 0 and above > rank + margin * table[costs[nu]]:
                put = enqueue(nu, put, blocks, pending)
            if rank < threshold:
                after += put - first
            else:
                over += put - first
        budget -= end - at
        state[6] += end - at
        at = end
        if at < here:
            break
        at, here, after = 0, after, 0
        current, following = following, current
        if here == 0:
            current, here, over = 3 - current - following, over, 0
            threshold += levels[1]
        if stop >= 0 and potential[stop] < HIGH:
            result = 1
            break
    state[0], state[1], state[2], state[3], state[4], state[5] = current, following, at, here, after, over
    levels[0] = threshold
    return result


@kernel(wave, interpolated, enqueue)
def compiled_wave(numba: Any) -> Any:
    """Return `wave`, compiled if numba is available; the body returns its signature for the decorator."""
    types = numba.types
    number, real = types.int64, types.float64
    bytes_, floats = types.uint8[::1], types.float32[::1]
    arrays = (bytes_, floats, floats, bytes_, types.int32[::1], types.int64[::1], types.float64[::1])
    return number(*arrays, number, number, number, real, number)
