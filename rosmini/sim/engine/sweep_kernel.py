"""One sweep of a laser in machine code: the loops of `rosmini.sim.engine.sweep`, which explains the method.

Moving body k was at `poses[starts[k]:starts[k + 1]]` at the `times` of the same rows, and followed
an arc from each of them to the next. Its outline, in its own frame, has the segments from `sides[k, 0]` to before
`sides[k, 1]`, and the discs from `sides[k, 2]` to before `sides[k, 3]`. Meanwhile it stayed within `around[k]`: x, y,
radius.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.machine_code import machine_code
from rosmini.sim.geometry.raycast_numba import HELPERS, MARGIN, NEAR, TURN, before, cast_disc, cast_segment

from .trails import arc

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

BEAMS_PER_POSE = 8
"""Number of consecutive beams for which other moving bodies are treated as stationary."""


def sweep(  # noqa: C901, PLR0912 - one function, because compiling each costs the first user time
    own: int,
    now: float,
    beam_time: float,
    laser: Floats,
    starts: Ints,
    times: Floats,
    poses: Floats,
    sides: Ints,
    segments: Floats,
    discs: Floats,
    around: Floats,
    walls: Floats,
    pillars: Floats,
    noise: Floats,
    seen_from: Floats,
    ranges: Floats,
) -> None:
    """Fill in `ranges` (beams,), and, unless the viewer did not move (`own` is -1), `seen_from` (beams, 3).

    `laser` contains its position ahead and to the left, the angle of its first beam, the angle between two beams, its
    reach, and its shortest and longest range. `noise` may be empty.
    """
    count = ranges.shape[0]
    mx, my, first, increment, reach = laser[0], laser[1], laser[2], laser[3], laser[4]
    shortest, longest = laser[5], laser[6]
    if own >= 0:
        low, high = starts[own], starts[own + 1]
        for i in range(count):
            x, y, theta = pose_at(low, high, times, poses, now - beam_time * i)
            seen_from[i, 0], seen_from[i, 1], seen_from[i, 2] = x, y, theta
    angle = seen_from[0, 2] + first
    onward = seen_from[count - 1, 2] + first + increment * (count - 1) - angle
    back = onward < 0.0  # rays are cast counter-clockwise
    if back:
        angle, onward = angle + onward, -onward
    step = onward / max(count - 1, 1)
    dx, dy = np.empty(count), np.empty(count)
    cos, sin = np.empty(count), np.empty(count)
    spread = away = 0.0
    for i in range(count):
        n = count - 1 - i if back else i
        theta = seen_from[i, 2]
        c, s = math.cos(theta), math.sin(theta)
        look = theta + first + increment * i
        spread = max(spread, abs(look - (angle + step * n)))
        dx[n], dy[n] = seen_from[i, 0] + c * mx - s * my, seen_from[i, 1] + s * mx + c * my
        cos[n], sin[n] = math.cos(look), math.sin(look)
        ranges[n] = math.inf
    x, y = dx[count // 2], dy[count // 2]
    for n in range(count):
        dx[n], dy[n] = dx[n] - x, dy[n] - y
        away = max(away, math.sqrt(dx[n] * dx[n] + dy[n] * dy[n]))
    angle -= 2 * math.pi * math.floor(angle / (2 * math.pi))
    for k in range(walls.shape[0]):
        x1, y1, x2, y2 = walls[k, 0] - x, walls[k, 1] - y, walls[k, 2] - x, walls[k, 3] - y
        cast_segment(x1, y1, x2, y2, cos, sin, angle, step, reach, ranges, dx, dy, away, spread, 0, count)
    for k in range(pillars.shape[0]):
        px, py, radius = pillars[k, 0] - x, pillars[k, 1] - y, pillars[k, 2]
        cast_disc(px, py, radius, cos, sin, angle, step, reach, ranges, dx, dy, away, spread, 0, count)
    for k in range(around.shape[0]):
        ax, ay = around[k, 0] - x, around[k, 1] - y
        far, size = math.sqrt(ax * ax + ay * ay), around[k, 2] + away
        if k == own or far - size >= reach:
            continue
        # the sector in which it can be seen, counted from the first ray
        lowest, width = 0.0, math.inf
        if far > size + 2 * NEAR:
            half = math.asin(size / far) + spread + 2 * MARGIN
            lowest, width = before(math.atan2(ay, ax) - half, angle), 2 * half + 2 * MARGIN
        for begin in range(0, count, BEAMS_PER_POSE):
            end = min(begin + BEAMS_PER_POSE, count)
            low, high = (count - end, count - begin) if back else (begin, end)
            if not overlap(step * low, step * (high - 1), lowest, width):
                continue
            when = now - beam_time * (begin + end - 1) / 2
            ax, ay, theta = pose_at(starts[k], starts[k + 1], times, poses, when)
            ax, ay, c, s = ax - x, ay - y, math.cos(theta), math.sin(theta)
            for j in range(sides[k, 0], sides[k, 1]):
                x1, y1 = turned(segments[j, 0], segments[j, 1], ax, ay, c, s)
                x2, y2 = turned(segments[j, 2], segments[j, 3], ax, ay, c, s)
                cast_segment(x1, y1, x2, y2, cos, sin, angle, step, reach, ranges, dx, dy, away, spread, low, high)
            for j in range(sides[k, 2], sides[k, 3]):
                x1, y1 = turned(discs[j, 0], discs[j, 1], ax, ay, c, s)
                cast_disc(x1, y1, discs[j, 2], cos, sin, angle, step, reach, ranges, dx, dy, away, spread, low, high)
    if back:
        for n in range(count // 2):
            ranges[n], ranges[count - 1 - n] = ranges[count - 1 - n], ranges[n]
    for i in range(count):
        met = ranges[i] + noise[i] if noise.shape[0] else ranges[i]
        ranges[i] = math.inf if met > longest else -math.inf if met < shortest else met


def overlap(first: float, last: float, lowest: float, width: float) -> bool:
    """Return True if angles from `first` to `last` meet those of a sector, modulo whole turns."""
    turns = math.floor((last - lowest) / TURN)
    return turns >= 0 and lowest + turns * TURN + width >= first


def turned(u: float, v: float, x: float, y: float, c: float, s: float) -> tuple[float, float]:
    """Transform a point (u, v) from the frame at (x, y), turned by the angle with this cosine and sine."""
    return x + c * u - s * v, y + s * u + c * v


def pose_at(low: int, high: int, times: Floats, poses: Floats, when: float) -> tuple[float, float, float]:
    """Return the pose at `when` on the arcs between the rows from `low` to before `high`."""
    leg = high - 2
    while leg > low and times[leg] > when:
        leg -= 1
    part = (when - times[leg]) / (times[leg + 1] - times[leg])
    x, y, theta = poses[leg, 0], poses[leg, 1], poses[leg, 2]
    return arc(x, y, theta, poses[leg + 1, 0] - x, poses[leg + 1, 1] - y, poses[leg + 1, 2] - theta, part)


@cache
def compiled() -> Callable[..., None]:
    """Return `sweep` as machine code. Raises `ImportError` without numba."""

    def signature(numba: Any) -> Any:
        f, i = numba.float64, numba.int64

        def read(kind: Any, dimensions: int) -> Any:
            return numba.types.Array(kind, dimensions, "C", readonly=True)

        line, table, numbers = read(f, 1), read(f, 2), read(i, 2)
        return numba.void(
            i, f, f, line, read(i, 1), line, table, numbers, table, table, table, table, table, line, f[:, ::1], f[::1]
        )

    return machine_code(sweep, signature, (*HELPERS, arc, pose_at, turned, overlap))
