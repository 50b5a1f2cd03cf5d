"""Many robots that touch, in machine code: who is pushed out of what, and how far it is to what is near. `rosmini.sim.engine.crowd` calls it.

Robots are convex outlines without a radius; whatever else there is are convex outlines too, where two corners are a wall and one corner with a radius is
a disc. Two outlines overlap by the least way that parts them, which is along the normal of one of their sides (the theorem of the separating axis:
Gottschalk, Lin and Manocha, SIGGRAPH 1996). What they touch with are the two sides that face each other.

The functions here are plain Python. `compiled` makes machine code of them, at the first call in a few seconds, later from numba's cache.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

Contact = tuple[int, float, float, float, float, float, float, float, float]
"""How many points there are, the normal, and of each point its depth and its place."""


def stand(i: int, poses: Floats, outline: Floats, first: Ints, bodies: Floats, corners: Floats) -> None:
    """Put the corners of robot i, and the middle of its circle (in `bodies`), to where its pose is."""
    x, y, c, s = poses[i, 0], poses[i, 1], math.cos(poses[i, 2]), math.sin(poses[i, 2])
    for k in range(first[i], first[i + 1]):
        corners[k, 0] = x + c * outline[k, 0] - s * outline[k, 1]
        corners[k, 1] = y + s * outline[k, 0] + c * outline[k, 1]
    bodies[i, 6] = x + c * bodies[i, 3] - s * bodies[i, 4]
    bodies[i, 7] = y + s * bodies[i, 3] + c * bodies[i, 4]


def parting(
    a: Floats, a0: int, a1: int, b: Floats, b0: int, b1: int, most: float
) -> tuple[float, float, float]:
    """How far one outline is from the other along that normal of its sides where it is farthest, and that normal, outwards; enough if over `most`."""
    best, nx, ny = -math.inf, 0.0, 0.0
    for k in range(a0, a1):
        j = k + 1 if k + 1 < a1 else a0
        ex, ey = a[j, 0] - a[k, 0], a[j, 1] - a[k, 1]
        length = math.sqrt(ex * ex + ey * ey)
        if length == 0.0:
            continue
        ux, uy = ey / length, -ex / length
        least = math.inf
        for m in range(b0, b1):
            least = min(least, (b[m, 0] - a[k, 0]) * ux + (b[m, 1] - a[k, 1]) * uy)
        if least > best:
            best, nx, ny = least, ux, uy
            if best > most:
                break
    return best, nx, ny


def facing(a: Floats, a0: int, a1: int, nx: float, ny: float) -> tuple[int, int]:
    """The two corners of the side of an outline that looks along a normal most: one of the two sides at the corner that is farthest along it."""
    far, i = -math.inf, a0
    for k in range(a0, a1):
        along = a[k, 0] * nx + a[k, 1] * ny
        if along > far:
            far, i = along, k
    before, after = (i - 1 if i > a0 else a1 - 1), (i + 1 if i + 1 < a1 else a0)
    ex, ey = a[i, 0] - a[before, 0], a[i, 1] - a[before, 1]
    fx, fy = a[after, 0] - a[i, 0], a[after, 1] - a[i, 1]
    e, f = math.sqrt(ex * ex + ey * ey), math.sqrt(fx * fx + fy * fy)
    if (ey * nx - ex * ny) * f > (fy * nx - fx * ny) * e:
        return before, i
    return i, after


def height(a: Floats, i: int, j: int, nx: float, ny: float, t: float) -> float:
    """How far a side is along a normal where it is t to the left of it; a side that is upright counts where it is farthest."""
    ti, tj = a[i, 1] * nx - a[i, 0] * ny, a[j, 1] * nx - a[j, 0] * ny
    hi, hj = a[i, 0] * nx + a[i, 1] * ny, a[j, 0] * nx + a[j, 1] * ny
    if abs(tj - ti) < 1e-12:
        return float(max(hi, hj))
    part = (t - ti) / (tj - ti)
    return float(hi + part * (hj - hi))


def contact(a: Floats, a0: int, a1: int, b: Floats, b0: int, b1: int, radius: float, least: float) -> Contact:
    """Where, and how deep, an outline overlaps another, if by more than `least`: the normal is from the first to the second, the places on the first."""
    if b1 - b0 == 1:
        return contact_disc(a, a0, a1, b[b0, 0], b[b0, 1], radius, least)
    apart, nx, ny = parting(a, a0, a1, b, b0, b1, -least)
    if apart >= -least:
        return 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    other, mx, my = parting(b, b0, b1, a, a0, a1, -least)
    if other > apart:
        apart, nx, ny = other, -mx, -my
        if apart >= -least:
            return 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    i, j = facing(a, a0, a1, nx, ny)
    p, q = facing(b, b0, b1, -nx, -ny)
    ti, tj = a[i, 1] * nx - a[i, 0] * ny, a[j, 1] * nx - a[j, 0] * ny
    tp, tq = b[p, 1] * nx - b[p, 0] * ny, b[q, 1] * nx - b[q, 0] * ny
    begin, end = max(min(ti, tj), min(tp, tq)), min(max(ti, tj), max(tp, tq))
    if begin > end:  # for want of digits
        begin = end = (begin + end) / 2
    h, k = height(a, i, j, nx, ny, begin), height(a, i, j, nx, ny, end)
    depth, deep = h - height(b, p, q, nx, ny, begin), k - height(b, p, q, nx, ny, end)
    x, y, u, v = h * nx - begin * ny, h * ny + begin * nx, k * nx - end * ny, k * ny + end * nx
    if depth < 0.0 and deep < 0.0:
        return 1, nx, ny, -apart, x, y, 0.0, 0.0, 0.0
    if deep < 0.0:
        return 1, nx, ny, depth, x, y, 0.0, 0.0, 0.0
    if depth < 0.0:
        return 1, nx, ny, deep, u, v, 0.0, 0.0, 0.0
    return 2, nx, ny, depth, x, y, deep, u, v


def nearest_side(a: Floats, a0: int, a1: int, x: float, y: float) -> tuple[float, float, float]:
    """The square of the distance of a place from an outline's sides, and where on them it is nearest."""
    best, px, py = math.inf, 0.0, 0.0
    for k in range(a0, a1):
        j = k + 1 if k + 1 < a1 else a0
        ex, ey = a[j, 0] - a[k, 0], a[j, 1] - a[k, 1]
        square = ex * ex + ey * ey
        t = 0.0
        if square > 0.0:
            t = min(1.0, max(0.0, ((x - a[k, 0]) * ex + (y - a[k, 1]) * ey) / square))
        qx, qy = a[k, 0] + t * ex, a[k, 1] + t * ey
        away = (x - qx) * (x - qx) + (y - qy) * (y - qy)
        if away < best:
            best, px, py = away, qx, qy
    return best, px, py


def contact_disc(a: Floats, a0: int, a1: int, cx: float, cy: float, radius: float, least: float) -> Contact:
    """`contact` of an outline with a disc."""
    away, nx, ny = math.inf, 0.0, 0.0
    # how far the middle is out of the side that it is farthest out of
    out = -math.inf
    for k in range(a0, a1):
        j = k + 1 if k + 1 < a1 else a0
        ex, ey = a[j, 0] - a[k, 0], a[j, 1] - a[k, 1]
        length = math.sqrt(ex * ex + ey * ey)
        if length > 0.0:
            far = ((cx - a[k, 0]) * ey - (cy - a[k, 1]) * ex) / length
            if far > out:
                out, nx, ny = far, ey / length, -ex / length
    if radius - out <= least:
        return 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if out <= 0.0:
        return 1, nx, ny, radius - out, cx - out * nx, cy - out * ny, 0.0, 0.0, 0.0
    square, px, py = nearest_side(a, a0, a1, cx, cy)
    away = math.sqrt(square)
    if radius - away <= least:
        return 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return 1, (cx - px) / away, (cy - py) / away, radius - away, px, py, 0.0, 0.0, 0.0


def gap(a: Floats, a0: int, a1: int, b: Floats, b0: int, b1: int, radius: float) -> float:
    """How far two outlines are apart; less than 0 if they overlap."""
    apart, _, _ = parting(a, a0, a1, b, b0, b1, math.inf)
    if b1 - b0 > 1:
        other, _, _ = parting(b, b0, b1, a, a0, a1, math.inf)
        apart = max(apart, other)
    if apart <= 0.0:
        return apart - radius
    best = math.inf
    for m in range(b0, b1):
        away, _, _ = nearest_side(a, a0, a1, b[m, 0], b[m, 1])
        best = min(best, away)
    if b1 - b0 > 1:
        for k in range(a0, a1):
            away, _, _ = nearest_side(b, b0, b1, a[k, 0], a[k, 1])
            best = min(best, away)
    return math.sqrt(best) - radius


def beside(bodies: Floats, i: int, boxes: Floats, n: int, more: float) -> bool:
    """Tell whether the box around an outline is within `more` of a robot's circle, and not above the robot."""
    x, y, r = bodies[i, 6], bodies[i, 7], bodies[i, 5] + more
    return bool(
        boxes[n, 0] - r <= x <= boxes[n, 2] + r
        and boxes[n, 1] - r <= y <= boxes[n, 3] + r
        and boxes[n, 4] <= bodies[i, 2]
    )


def give(
    count: int, d0: float, d1: float, r0: float, r1: float, mass: float, inertia: float
) -> tuple[float, float]:
    """As `rosmini.sim.engine.bodies.correction`."""
    if count == 2 and abs(r0 - r1) > 1e-9:
        turn = (d0 - d1) / (r0 - r1)
        along = d0 - turn * r0
        k = (inertia * turn - mass * along * r1) / (r0 - r1)
        spare = 1e-12 * mass * along
        if -spare <= k <= mass * along + spare:
            return along, turn
    depth, lever = d0, r0
    if count == 2 and (d1 > d0 or (d1 == d0 and r1 > r0)):
        depth, lever = d1, r1
    k = depth / (1 / mass + lever * lever / inertia)
    return k / mass, k * lever / inertia


def shove(
    i: int,
    part: float,
    nx: float,
    ny: float,
    hit: Contact,
    slack: float,
    poses: Floats,
    bodies: Floats,
) -> None:
    """Move robot i along a normal, and turn it, by so much of what brings it out of a contact."""
    count, _, _, d0, x0, y0, d1, x1, y1 = hit
    x, y = poses[i, 0], poses[i, 1]
    r0, r1 = (x0 - x) * ny - (y0 - y) * nx, (x1 - x) * ny - (y1 - y) * nx
    along, turn = give(count, d0 - slack, d1 - slack, r0, r1, bodies[i, 0], bodies[i, 1])
    poses[i, 0] = x + part * along * nx
    poses[i, 1] = y + part * along * ny
    poses[i, 2] += part * turn


def deepest_thing(
    i: int,
    least: float,
    slack: float,
    first: Ints,
    bodies: Floats,
    corners: Floats,
    near: Ints,
    sides: Floats,
    begins: Ints,
    boxes: Floats,
    others: Floats,
    starts: Ints,
    frames: Floats,
) -> tuple[float, float, Contact]:
    """Of all but robots that into which robot i reaches deepest: by how much more than it may, how deep it may, and the contact."""
    a0, a1 = first[i], first[i + 1]
    worst, given, hit = least, 0.0, (0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for k in range(near.shape[1]):
        n = near[i, k]
        if n < 0:
            break
        if beside(bodies, i, boxes, n, 0.0):
            found = contact(corners, a0, a1, sides, begins[n], begins[n + 1], boxes[n, 5], worst)
            if found[0] and max(found[3], found[6]) > worst:
                worst, hit = max(found[3], found[6]), found
    for n in range(frames.shape[0]):
        if beside(bodies, i, frames, n, 0.0):
            play = slack if frames[n, 6] else 0.0
            found = contact(corners, a0, a1, others, starts[n], starts[n + 1], frames[n, 5], worst + play)
            if found[0] and max(found[3], found[6]) - play > worst:
                worst, given, hit = max(found[3], found[6]) - play, play, found
    return worst, given, hit


def deepest_robot(
    i: int, least: float, members: Ints, first: Ints, bodies: Floats, corners: Floats
) -> tuple[int, Contact]:
    """The robot into which robot i reaches deepest, if by more than `least`, and the contact; else i itself."""
    worst, who, hit = least, i, (0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for m in range(members.shape[0]):
        j = members[m]
        dx, dy, r = bodies[j, 6] - bodies[i, 6], bodies[j, 7] - bodies[i, 7], bodies[i, 5] + bodies[j, 5]
        if j != i and dx * dx + dy * dy <= r * r:
            found = contact(corners, first[i], first[i + 1], corners, first[j], first[j + 1], 0.0, worst)
            if found[0] and max(found[3], found[6]) > worst:
                worst, who, hit = max(found[3], found[6]), j, found
    return who, hit


def push_out(
    i: int,
    least: float,
    fair: bool,
    slack: float,
    members: Ints,
    poses: Floats,
    outline: Floats,
    first: Ints,
    bodies: Floats,
    corners: Floats,
    near: Ints,
    sides: Floats,
    begins: Ints,
    boxes: Floats,
    others: Floats,
    starts: Ints,
    frames: Floats,
) -> int:
    """As `rosmini.sim.engine.pushing.push_out`; return which robot was moved besides, i itself if none was, and -1 if nothing was."""
    worst, given, hit = deepest_thing(
        i, least, slack, first, bodies, corners, near, sides, begins, boxes, others, starts, frames
    )
    who, deeper = deepest_robot(i, worst + slack, members, first, bodies, corners)
    mine = 1.0
    if who != i:
        given, hit = slack, deeper
        own, other = bodies[i, 0], bodies[who, 0]
        mine = 0.5 if fair or own == other else (1.0 if own < other else 0.0)
    if not hit[0]:
        return -1
    if mine > 0.0:
        shove(i, mine, -hit[1], -hit[2], hit, given, poses, bodies)
        stand(i, poses, outline, first, bodies, corners)
    if mine < 1.0:
        shove(who, 1.0 - mine, hit[1], hit[2], hit, given, poses, bodies)
        stand(who, poses, outline, first, bodies, corners)
    return who


def part_all(
    queue: Ints,
    rounds: int,
    quick: int,
    touch: float,
    nearly: float,
    slack: float,
    members: Ints,
    poses: Floats,
    outline: Floats,
    first: Ints,
    bodies: Floats,
    corners: Floats,
    near: Ints,
    sides: Floats,
    begins: Ints,
    boxes: Floats,
    others: Floats,
    starts: Ints,
    frames: Floats,
    moved: Ints,
) -> None:
    """As `rosmini.sim.engine.pushing.make_way`: bring the robots of the queue out of what they have driven into; `moved` tells who was moved."""
    for m in range(members.shape[0]):
        stand(members[m], poses, outline, first, bodies, corners)
    waiting = np.empty(poses.shape[0], np.int64)
    again = np.zeros(poses.shape[0], np.int64)
    count = queue.shape[0]
    for k in range(count):
        waiting[k] = queue[k]
    for number in range(rounds):
        least = touch if number < quick or members.shape[0] == 1 else nearly
        fair = 2 * number >= rounds
        for k in range(count):
            i = waiting[k]
            who = push_out(
                i,
                least,
                fair,
                slack,
                members,
                poses,
                outline,
                first,
                bodies,
                corners,
                near,
                sides,
                begins,
                boxes,
                others,
                starts,
                frames,
            )
            if who >= 0:
                again[i] = again[who] = moved[i] = moved[who] = 1
        left = 0
        for k in range(count):
            i = waiting[k]
            if again[i]:
                again[i] = 0
                waiting[left] = i
                left += 1
        for m in range(members.shape[0]):
            if again[members[m]]:
                again[members[m]] = 0
                waiting[left] = members[m]
                left += 1
        count = left
        if not count:
            break


def look(
    lookers: Ints,
    view: float,
    safe: float,
    poses: Floats,
    outline: Floats,
    first: Ints,
    bodies: Floats,
    corners: Floats,
    near: Ints,
    sides: Floats,
    begins: Ints,
    boxes: Floats,
    others: Floats,
    starts: Ints,
    frames: Floats,
    rooms: Floats,
    clear: Floats,
) -> None:
    """As `rosmini.sim.engine.clockwork.Clockwork.look`, for several robots one after the other."""
    for i in range(poses.shape[0]):
        stand(i, poses, outline, first, bodies, corners)
    for m in range(lookers.shape[0]):
        i = lookers[m]
        a0, a1 = first[i], first[i + 1]
        free = view
        for k in range(near.shape[1]):
            n = near[i, k]
            if n < 0:
                break
            if beside(bodies, i, boxes, n, free):
                free = min(free, gap(corners, a0, a1, sides, begins[n], begins[n + 1], boxes[n, 5]))
        for n in range(frames.shape[0]):
            if beside(bodies, i, frames, n, free):
                free = min(free, gap(corners, a0, a1, others, starts[n], starts[n + 1], frames[n, 5]))
        clear[i] = free - safe
        for j in range(poses.shape[0]):
            dx, dy = bodies[j, 6] - bodies[i, 6], bodies[j, 7] - bodies[i, 7]
            r = bodies[i, 5] + bodies[j, 5] + view
            if j != i and dx * dx + dy * dy <= r * r:
                half = gap(corners, a0, a1, corners, first[j], first[j + 1], 0.0) / 2
                if 2 * half <= view:
                    rooms[j] = min(rooms[j], half - safe)
                    free = min(free, half)
        rooms[i] = free - safe


@cache
def compiled() -> tuple[Callable[..., None], Callable[..., None]]:
    """`part_all` and `look` as machine code. Raises `ImportError` without numba."""
    import numba
    from numba.extending import register_jitable

    helpers = (
        stand,
        parting,
        facing,
        height,
        nearest_side,
        contact_disc,
        contact,
        gap,
        beside,
        give,
        shove,
        deepest_thing,
        deepest_robot,
        push_out,
    )
    for function in helpers:
        register_jitable(function)
    f, i = numba.float64, numba.int64
    table, ways, numbers, vector = f[:, ::1], i[:, ::1], i[::1], f[::1]
    around = (table, table, numbers, table, table, ways, table, numbers, table, table, numbers, table)
    return (
        _compiled(part_all, numba.void(numbers, i, i, f, f, f, numbers, *around, numbers)),
        _compiled(look, numba.void(numbers, f, f, *around, vector, vector)),
    )


def _compiled(function: Any, signature: Any) -> Callable[..., None]:
    import numba

    try:
        return numba.njit([signature], cache=True)(function)
    except Exception as error:
        # A cache that can be neither written nor read costs a few seconds at each start and no more; what is wrong with the code itself is raised below.
        logging.getLogger(__name__).info("numba cannot cache what parts robots: %s", error)
    return numba.njit([signature])(function)
