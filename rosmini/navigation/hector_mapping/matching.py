"""Matching of a scan with a map: Gauss-Newton on interpolated probabilities (Kohlbrecher et al., 2011, section IV).

It moves the beam ends onto occupied cells. One defect of the original is not copied: it interpolates the derivatives
along x by the fraction of x where that of y is needed, and vice versa.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.core.geometry.products import inverse_matrix
from rosmini.navigation.kernels import kernel

from .grid import OccupancyGrid

Floats = NDArray[np.float64]

MAX_TURN = 0.2
"""Maximum rotation of a step [rad]."""
DIGITS = 9
"""Decimals of a pose [m, rad]. Sines and cosines differ in their last bit between machines, and where the map does not
determine the pose, as in a corridor, a difference would grow with each match."""
UNKNOWN_VARIANCE = 1e6
"""Variance of a quantity that a match does not determine [m2, rad2]."""


class Matched(NamedTuple):
    """The result of matching."""

    pose: Pose
    hessian: Floats
    """Hessian (3, 3) of x, y [m] and heading [rad] at the last step; zeros if there was nothing to match."""
    spread: float
    """Mean square of the residuals (1 - occupancy at the ends), before the last step."""
    steps: int

    @property
    def covariance(self) -> Floats:
        """Covariance (3, 3) of x, y [m2] and heading [rad2]: the inverse Hessian scaled by the spread (eq. 14).

        The original publishes the Hessian itself, in cells.
        """
        known = self.hessian / max(self.spread, 1e-6)
        return inverse_matrix(known + np.eye(3) / UNKNOWN_VARIANCE)


def match(grid: OccupancyGrid, points: Floats, pose: Pose, iterations: int) -> Matched:
    """Return the pose near `pose` [m, m, rad] at which `points` (n, 2) [m] in the robot's frame are on occupied cells.

    As in the original there is one step more than `iterations`. Matching ends early where the gradient is zero.
    """
    resolution = grid.resolution
    start = np.array([*grid.cells(np.asarray(pose[:2], dtype=np.float64)), pose[2]])
    ends = np.ascontiguousarray(points, dtype=np.float64) / resolution
    result = np.zeros(8)
    compiled_climb()(grid.probabilities, ends, start, iterations + 1, result)
    xx, xy, xt, yy, yt, tt, spread, steps = result.tolist()
    if steps:
        x, y, heading = start.tolist()
        left, low = grid.origin
        pose = (
            round(left + x * resolution, DIGITS),
            round(low + y * resolution, DIGITS),
            round(math.remainder(heading, math.tau), DIGITS),
        )
    scale = np.array([1 / resolution, 1 / resolution, 1.0])
    hessian = np.array(((xx, xy, xt), (xy, yy, yt), (xt, yt, tt))) * scale[:, None] * scale
    return Matched(pose, hessian, spread, int(steps))


def surface(probabilities: Any, x: float, y: float) -> tuple[float, float, float]:
    """Return the map's (h, w) interpolated probability at x, y [cells], and its derivatives along x and y [1/cell].

    The interpolation is bilinear between the centres of four cells; outside the map all three are 0.
    """
    height, width = probabilities.shape
    if not (0.0 <= x < width - 1.0 and 0.0 <= y < height - 1.0):
        return 0.0, 0.0, 0.0
    column, row = int(x), int(y)
    fx, fy = x - column, y - row
    a, b = float(probabilities[row, column]), float(probabilities[row, column + 1])
    c, d = float(probabilities[row + 1, column]), float(probabilities[row + 1, column + 1])
    bottom, top = a + (b - a) * fx, c + (d - c) * fx
    return bottom + (top - bottom) * fy, (b - a) * (1.0 - fy) + (d - c) * fy, top - bottom


def climb(probabilities: Any, ends: Any, pose: Any, max_steps: int, result: Any) -> None:
    """Make up to `max_steps` steps of Gauss-Newton.

    Args:
        probabilities: the map (h, w).
        ends: the beam ends (n, 2), in the robot's frame [cells].
        pose: x, y [cells] and heading [rad]; modified in place.
        max_steps: maximum number of steps.
        result: (8), modified in place: the Hessian's xx, xy, xt, yy, yt, tt at the last step [cells, rad], the mean
            square of the residuals there, and the number of steps.

    """
    height, width = probabilities.shape
    for _ in range(max_steps):
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        xx = xy = xt = yy = yt = tt = bx = by = bt = spread = 0.0
        for n in range(ends.shape[0]):
            u, v = cos * ends[n, 0] - sin * ends[n, 1], sin * ends[n, 0] + cos * ends[n, 1]
            value, gx, gy = surface(probabilities, pose[0] + u, pose[1] + v)
            gt, residual = u * gy - v * gx, 1.0 - value
            xx, xy, xt = xx + gx * gx, xy + gx * gy, xt + gx * gt
            yy, yt, tt = yy + gy * gy, yt + gy * gt, tt + gt * gt
            bx, by, bt = bx + gx * residual, by + gy * residual, bt + gt * residual
            spread += residual * residual
        result[0], result[1], result[2], result[3], result[4], result[5] = xx, xy, xt, yy, yt, tt
        result[6] = spread / max(1, ends.shape[0])
        # Solve with cofactors: the Hessian is symmetric.
        ixx, ixy, ixt = yy * tt - yt * yt, xt * yt - xy * tt, xy * yt - yy * xt
        determinant = xx * ixx + xy * ixy + xt * ixt
        if xx == 0.0 or yy == 0.0 or determinant == 0.0:
            return
        iyy, iyt, itt = xx * tt - xt * xt, xy * xt - xx * yt, xx * yy - xy * xy
        x = pose[0] + (ixx * bx + ixy * by + ixt * bt) / determinant
        y = pose[1] + (ixy * bx + iyy * by + iyt * bt) / determinant
        turn = (ixt * bx + iyt * by + itt * bt) / determinant
        # If the robot could slide along a wall, the Hessian is nearly singular, and the result is not a valid step.
        if not (0.0 <= x < width and 0.0 <= y < height and abs(turn) < math.inf):
            return
        pose[0], pose[1] = x, y
        pose[2] += max(-MAX_TURN, min(MAX_TURN, turn))
        result[7] += 1.0


@kernel(climb, surface)
def compiled_climb(numba: Any) -> Any:
    """Return `climb`, compiled if numba is available; the body returns its signature for the decorator."""
    return numba.void(numba.float32[:, ::1], numba.float64[:, ::1], numba.float64[::1], numba.int64, numba.float64[::1])
