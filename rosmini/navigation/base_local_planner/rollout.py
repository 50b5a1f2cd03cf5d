"""The kernels of the local planners: the cost of a footprint, and the simulation and lookup of sampled trajectories.

The functions are plain Python. `compiled_footprint_cost` and `compiled_rollout` compile them; without numba they run
as they are. They are in one file because numba's cache only checks the modification time of this file.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

Costs = NDArray[np.uint8]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Distances = NDArray[np.int32]

# Constants in the compiled code.
INSCRIBED = 253
LETHAL = 254
UNKNOWN = 255

HIT = -1
"""The outline of the footprint touches an obstacle."""
UNSEEN = -2
"""The outline touches an unknown cell."""
OUTSIDE = -3
"""The outline leaves the costmap."""

IN_OBSTACLE = -3.0
"""The map grid score of a trajectory that enters an obstacle."""
UNREACHABLE = -2.0
"""The map grid score of a trajectory that enters an unreachable cell."""
OFF_GRID = -4.0
"""The map grid score of a trajectory that leaves the costmap."""


def footprint_cost(
    costs: Costs,
    width: int,
    height: int,
    origin_x: float,
    origin_y: float,
    resolution: float,
    x: float,
    y: float,
    theta: float,
    footprint: Floats,
    scale: float,
) -> int:
    """Return the largest cost under a footprint's outline (n, 2) [m], scaled by `scale`, at a pose.

    `costs` (height * width) are the costmap's costs, row by row. Returns `HIT`, `UNSEEN` or `OUTSIDE` at the first such
    cell, edge by edge. With fewer than three vertices the robot is round: only the cell of its centre counts, and
    `INSCRIBED` is a hit.
    """
    return outline_cost(
        costs,
        width,
        height,
        origin_x,
        origin_y,
        resolution,
        x,
        y,
        math.cos(theta) * scale,
        math.sin(theta) * scale,
        footprint,
    )


def outline_cost(
    costs: Costs,
    width: int,
    height: int,
    origin_x: float,
    origin_y: float,
    resolution: float,
    x: float,
    y: float,
    cos: float,
    sin: float,
    footprint: Floats,
) -> int:
    """Return the same as `footprint_cost`, for an outline rotated and scaled by `cos` and `sin` and moved to (x, y)."""
    if x < origin_x or y < origin_y:
        return OUTSIDE
    mx = int((x - origin_x) / resolution)
    my = int((y - origin_y) / resolution)
    if mx >= width or my >= height:
        return OUTSIDE
    count = footprint.shape[0]
    if count < 3:
        cost = int(costs[my * width + mx])
        if cost == UNKNOWN:
            return UNSEEN
        return HIT if cost >= INSCRIBED else cost
    largest, last_x, last_y, first_x, first_y = 0, 0, 0, 0, 0
    for i in range(count + 1):
        if i == count:
            mx, my = first_x, first_y
        else:
            px = x + footprint[i, 0] * cos - footprint[i, 1] * sin
            py = y + footprint[i, 0] * sin + footprint[i, 1] * cos
            if px < origin_x or py < origin_y:
                return OUTSIDE
            mx = int((px - origin_x) / resolution)
            my = int((py - origin_y) / resolution)
            if mx >= width or my >= height:
                return OUTSIDE
        if i == 0:
            first_x, first_y = mx, my
        else:
            cost = line_cost(costs, width, last_x, last_y, mx, my)
            if cost < 0:
                return cost
            largest = max(largest, cost)
        last_x, last_y = mx, my
    return largest


def line_cost(costs: Costs, width: int, x: int, y: int, end_x: int, end_y: int) -> int:
    """Return the largest cost of the cells on a line (Bresenham, 1965), or `HIT` or `UNSEEN`.

    The last cell is omitted, because the next edge starts with it.
    """
    step_x = 1 if end_x >= x else -1
    step_y = width if end_y >= y else -width
    dx, dy = abs(end_x - x), abs(end_y - y)
    steps, gain, along, across = dx, dy, step_x, step_y
    if dy > dx:
        steps, gain, along, across = dy, dx, step_y, step_x
    cell, rest, largest = y * width + x, steps // 2, 0
    for _ in range(max(steps, 1)):
        cost = int(costs[cell])
        if cost >= LETHAL:
            return UNSEEN if cost == UNKNOWN else HIT
        largest = max(largest, cost)
        rest += gain
        if rest >= steps:
            rest -= steps
            cell += across
        cell += along
    return largest


def rollout(
    costs: Costs,
    width: int,
    height: int,
    origin_x: float,
    origin_y: float,
    resolution: float,
    pose: Floats,
    starts: Floats,
    targets: Floats,
    limits: Floats,
    sim_time: float,
    steps: Ints,
    footprint: Floats,
    scales: Floats,
    path: Distances,
    goal: Distances,
    front: Distances,
    shift: float,
    points: Floats,
    raw: Floats,
    where: Ints,
) -> None:
    """Simulate every sample and evaluate the critics of its points.

    All grids have height * width elements, row by row. From `pose` (3) each of n samples drives `steps[n]` equal steps
    in `sim_time` [s]: its velocity (x, y, theta) starts at `starts[n]` and approaches `targets[n]` with at most the
    accelerations `limits` (3) [m/s2, m/s2, rad/s2]. The points are written into `points` (n, at least as many as steps,
    3).

    `raw` (n, 5) receives first the largest cost under the footprint, scaled by `scales[n]`, or a negative number from
    `footprint_cost`; then the distances [cells] at the last point: in `front` and in `path`, both measured `shift` [m]
    ahead of the robot, in `path` and in `goal`, or one of the negative scores above. `where` (n, 5) receives the first
    point at which the number became negative, or -1.
    """
    for n in range(targets.shape[0]):
        dt = sim_time / max(steps[n], 1)
        x, y, theta = pose[0], pose[1], pose[2]
        vx, vy, w = starts[n, 0], starts[n, 1], starts[n, 2]
        under, before, beside, off, ahead = 0.0, 0.0, 0.0, 0.0, 0.0
        for critic in range(5):
            where[n, critic] = -1
        for i in range(steps[n]):
            points[n, i, 0], points[n, i, 1], points[n, i, 2] = x, y, theta
            cos, sin = math.cos(theta), math.sin(theta)
            cell = cell_of(x, y, origin_x, origin_y, resolution, width, height)
            if under >= 0:
                cost = outline_cost(
                    costs,
                    width,
                    height,
                    origin_x,
                    origin_y,
                    resolution,
                    x,
                    y,
                    cos * scales[n],
                    sin * scales[n],
                    footprint,
                )
                if cost < 0:
                    under, where[n, 0] = float(cost), i
                else:
                    under = max(under, float(max(cost, int(costs[cell]))))
            nose = cell_of(x + shift * cos, y + shift * sin, origin_x, origin_y, resolution, width, height)
            before = looked_up_distance(front, nose, False, before, n, 1, i, where)
            beside = looked_up_distance(path, nose, False, beside, n, 2, i, where)
            off = looked_up_distance(path, cell, True, off, n, 3, i, where)
            ahead = looked_up_distance(goal, cell, True, ahead, n, 4, i, where)
            vx = approached(vx, targets[n, 0], limits[0] * dt)
            vy = approached(vy, targets[n, 1], limits[1] * dt)
            w = approached(w, targets[n, 2], limits[2] * dt)
            x, y, theta = x + (vx * cos - vy * sin) * dt, y + (vx * sin + vy * cos) * dt, theta + w * dt
        raw[n, 0], raw[n, 1], raw[n, 2], raw[n, 3], raw[n, 4] = under, before, beside, off, ahead


def cell_of(x: float, y: float, origin_x: float, origin_y: float, resolution: float, width: int, height: int) -> int:
    """Return the index of the cell that contains a point, row by row, or -1 outside the costmap."""
    if x < origin_x or y < origin_y:
        return -1
    mx = int((x - origin_x) / resolution)
    my = int((y - origin_y) / resolution)
    return my * width + mx if mx < width and my < height else -1


def approached(value: float, target: float, most: float) -> float:
    """Return `value` moved towards `target` by at most `most`."""
    if value < target:
        return min(target, value + most)
    return max(target, value - most)


def looked_up_distance(
    distances: Distances, cell: int, strict: bool, last: float, n: int, critic: int, i: int, where: Ints
) -> float:
    """Return the distance of a cell, or `OFF_GRID`; if `strict`, also `IN_OBSTACLE` or `UNREACHABLE`.

    If the score `last` of the previous point is negative, return that. Record the first negative point in `where`.
    """
    if last < 0:
        return last
    value = OFF_GRID
    if cell >= 0:
        value = float(distances[cell])
        size = distances.shape[0]
        if strict and value >= size:
            value = IN_OBSTACLE if value == size else UNREACHABLE
    if value < 0:
        where[n, critic] = i
    return value


@kernel(footprint_cost, outline_cost, line_cost)
def compiled_footprint_cost(numba: Any) -> Any:
    """Return `footprint_cost`, compiled if numba is available; the body returns its signature for the decorator."""
    number = numba.float64
    cells = numba.types.Array(numba.uint8, 1, "C", readonly=True)
    outline = numba.types.Array(number, 2, "C", readonly=True)
    return numba.int64(cells, numba.int64, numba.int64, *(number,) * 6, outline, number)


@kernel(rollout, outline_cost, line_cost, cell_of, approached, looked_up_distance)
def compiled_rollout(numba: Any) -> Any:
    """Return `rollout`, compiled if numba is available; the body returns its signature for the decorator."""
    number, whole, array = numba.float64, numba.int64, numba.types.Array

    def read(kind: Any, dimensions: int) -> Any:
        return array(kind, dimensions, "C", readonly=True)

    return numba.void(
        read(numba.uint8, 1),
        whole,
        whole,
        *(number,) * 3,
        read(number, 1),
        read(number, 2),
        read(number, 2),
        read(number, 1),
        number,
        read(whole, 1),
        read(number, 2),
        read(number, 1),
        *(read(numba.int32, 1),) * 3,
        number,
        number[:, :, ::1],
        number[:, ::1],
        whole[:, ::1],
    )
