"""The loops of contact: robots pushed out of obstacles, pushed obstacles, and clearances.

All bodies are convex outlines with a radius: see `rosmini.sim.geometry.outlines`.

Collisions and pushes are sequential impulses (Catto, Iterative dynamics with temporal coherence, GDC 2005) that start
from zero in each step, with a fixed number of iterations over the contacts in the order of the bodies' names. No data
is kept between steps, and a distant body does not change a result, not even in the last bit.

The functions are plain Python, which runs without numba; `compiled` makes machine code of them with
the same results to the last bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.machine_code import machine_code
from rosmini.sim.geometry.outlines import (
    NONE,
    Contact,
    contact,
    contact_disc,
    facing,
    gap,
    height,
    nearest_side,
    parting,
)

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

Scene = tuple[Floats, Floats, Floats, Floats, Ints, Ints, Floats, Ints, Ints, Floats, Ints, Floats, Ints, Ints]
"""Tables of bodies and of the outlines near them, as made by `rosmini.sim.engine.scene`:

for n bodies the poses (n, 3) and properties (n, 13); the corners of their outlines in the body's frame and in the
world, the start of each outline, the first outline of each body, and the radius of each outline; the fixed
outlines near each body (the start of its part of a list, and the list), their corners, the start of each, and
the box around each with its radius; and in the same form the bodies near each body.
"""

(
    MASS,
    INERTIA,
    MIDDLE_X,
    MIDDLE_Y,
    RADIUS,
    KIND,
    X,
    Y,
    CENTRE_X,
    CENTRE_Y,
    RESTITUTION,
    GROUND_FORCE,
    GROUND_TORQUE,
) = range(13)
"""The properties of a body: the circle around it in its frame, the current centre of the circle, its centre of mass,
and the largest force [N] and torque [N m] with which the ground holds it, or its wheels drive it."""

ROBOT, CRATE, KINEMATIC = 0.0, 1.0, 2.0
"""Kinds of bodies: driven by wheels, pushed, moving by itself."""

TOUCH = 1e-9
"""Overlap [m] below which a robot only touches an obstacle."""

PUSH_DEPTH = 2e-5
"""Overlap [m] of a robot with an obstacle that it pushes: bodies that do not overlap do not push each other."""

MAX_ROUNDS = 20
"""Maximum number of rounds of pushing a robot out of obstacles; a wedge between two walls takes the most."""

EXACT_ROUNDS, TOLERANCE = 4, 1e-6
"""Rounds after which robots that push each other may still overlap, and by how much [m]."""

ITERATIONS = 30
"""Number of iterations over the impulses of all contacts."""

MAX_GAP = 1e-6
"""Maximum gap at which two bodies can push each other [m]."""

OVERLAP_FRACTION = 0.2
"""Fraction of an overlap, not explained by an impact, that is removed in a step."""

REST_SPEED = 1e-4
"""Speed below which a movable obstacle stops [m/s, rad/s]."""


# -- bodies ----------------------------------------------------------------------------------------------------------


def point_correction(
    count: int, d0: float, d1: float, r0: float, r1: float, mass: float, inertia: float
) -> tuple[float, float]:
    """Return how far to move a body along a contact's normal [m] and how far to turn it [rad] so that it just touches.

    Each of the one or two points has a depth and a lever, its offset across the normal. The result corresponds to
    forces k >= 0 at these points, with along = sum k / m and turn = sum k r / I, that remove the overlap.
    """
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


def update_corners(i: int, scene: Scene) -> None:
    """Update a body's corners and the centre of its circle from its pose."""
    poses, bodies, outline, corners, first, begin = scene[0], scene[1], scene[2], scene[3], scene[4], scene[5]
    x, y, c, s = poses[i, 0], poses[i, 1], math.cos(poses[i, 2]), math.sin(poses[i, 2])
    for k in range(first[begin[i]], first[begin[i + 1]]):
        corners[k, 0] = x + c * outline[k, 0] - s * outline[k, 1]
        corners[k, 1] = y + s * outline[k, 0] + c * outline[k, 1]
    bodies[i, X] = x + c * bodies[i, MIDDLE_X] - s * bodies[i, MIDDLE_Y]
    bodies[i, Y] = y + s * bodies[i, MIDDLE_X] + c * bodies[i, MIDDLE_Y]


def may_touch_fixed(i: int, m: int, more: float, bodies: Floats, boxes: Floats) -> bool:
    """Return True if a fixed outline may be within `more` [m] of a body's bounding circle."""
    x, y, r = bodies[i, X], bodies[i, Y], bodies[i, RADIUS] + more
    return bool(boxes[m, 0] - r <= x <= boxes[m, 2] + r and boxes[m, 1] - r <= y <= boxes[m, 3] + r)


def may_touch(i: int, j: int, more: float, bodies: Floats) -> bool:
    """Return True if the bounding circles of two bodies are within `more` [m] of each other."""
    dx, dy = bodies[j, X] - bodies[i, X], bodies[j, Y] - bodies[i, Y]
    r = bodies[i, RADIUS] + bodies[j, RADIUS] + more
    return bool(dx * dx + dy * dy <= r * r)


# -- position correction of robots -----------------------------------------------------------------------------------


def push_along(i: int, part: float, nx: float, ny: float, hit: Contact, slack: float, scene: Scene) -> None:
    """Move and turn a robot by the fraction `part` of the motion that removes a contact's overlap."""
    poses, bodies = scene[0], scene[1]
    count, _, _, d0, x0, y0, d1, x1, y1 = hit
    x, y = poses[i, 0], poses[i, 1]
    r0, r1 = (x0 - x) * ny - (y0 - y) * nx, (x1 - x) * ny - (y1 - y) * nx
    along, turn = point_correction(count, d0 - slack, d1 - slack, r0, r1, bodies[i, MASS], bodies[i, INERTIA])
    poses[i, 0] = x + part * along * nx
    poses[i, 1] = y + part * along * ny
    poses[i, 2] += part * turn
    update_corners(i, scene)


def push_out(i: int, nearly: float, fair: bool, scene: Scene) -> int:
    """Resolve a robot's deepest overlap; return the other robot moved, or itself, or -1 if there was none.

    Of two robots only the lighter one moves, because its wheels grip less; if they have the same mass or `fair` is set,
    each moves by half. Overlaps of less than `nearly` [m] with other robots are ignored.
    """
    _, bodies, _, corners, first, begin, radius, near_at, near, sides, starts, boxes, mate_at, mates = scene
    worst, who, slack, hit = TOUCH, i, 0.0, NONE
    p = begin[i]
    a0, a1, ra = first[p], first[p + 1], radius[p]
    for k in range(near_at[i], near_at[i + 1]):
        m = near[k]
        if may_touch_fixed(i, m, 0.0, bodies, boxes):
            found = contact(corners, a0, a1, ra, sides, starts[m], starts[m + 1], boxes[m, 4], worst)
            if found[0] and max(found[3], found[6]) > worst:
                worst, hit = max(found[3], found[6]), found
    for k in range(mate_at[i], mate_at[i + 1]):
        j = mates[k]
        if may_touch(i, j, 0.0, bodies):
            play = 0.0 if bodies[j, KIND] == KINEMATIC else PUSH_DEPTH
            least = max(worst, nearly) if bodies[j, KIND] == ROBOT else worst
            for q in range(begin[j], begin[j + 1]):
                found = contact(corners, a0, a1, ra, corners, first[q], first[q + 1], radius[q], least + play)
                if found[0] and max(found[3], found[6]) - play > least:
                    worst = least = max(found[3], found[6]) - play
                    who, slack, hit = j if bodies[j, KIND] == ROBOT else i, play, found
    if not hit[0]:
        return -1
    mine = 1.0
    if who != i:
        own, other = bodies[i, MASS], bodies[who, MASS]
        mine = 0.5 if fair or own == other else (1.0 if own < other else 0.0)
    if mine > 0.0:
        push_along(i, mine, -hit[1], -hit[2], hit, slack, scene)
    if mine < 1.0:
        push_along(who, 1.0 - mine, hit[1], hit[2], hit, slack, scene)
    return who


def resolve_overlaps(queue: Ints, scene: Scene, moved: Ints) -> None:
    """Resolve the overlaps of robots with obstacles and each other; set `moved` to 1 for each robot that was moved."""
    poses = scene[0]
    total = poses.shape[0]
    for i in range(total):
        update_corners(i, scene)
    waiting, again = np.empty(total, np.int64), np.zeros(total, np.int64)
    count = queue.shape[0]
    for k in range(count):
        waiting[k] = queue[k]
    for number in range(MAX_ROUNDS):
        for k in range(count):
            i = waiting[k]
            who = push_out(i, TOUCH if number < EXACT_ROUNDS else TOLERANCE, 2 * number >= MAX_ROUNDS, scene)
            if who >= 0:
                again[i] = again[who] = moved[i] = moved[who] = 1
        left = 0
        for k in range(count):  # first the robots of this round, then those that they pushed
            if again[waiting[k]]:
                again[waiting[k]] = 0
                waiting[left] = waiting[k]
                left += 1
        for i in range(total):
            if again[i]:
                again[i] = 0
                waiting[left] = i
                left += 1
        count = left
        if not count:
            break


# -- contact impulses ------------------------------------------------------------------------------------------------

FIRST, SECOND, NX, NY, PX, PY, DEPTH, SPEED, BOUNCE, ALONG, ACROSS, PUSH_IMPULSE, FRICTION_IMPULSE = range(13)
"""Columns of a contact: the bodies, the normal, the point, the depth, the opening speed, its target, the effective
masses along and across the normal, and the impulses.
"""


def lever_arm(i: int, x: float, y: float, scene: Scene) -> tuple[float, float]:
    """Return the vector from a body's centre of mass to a point."""
    poses, bodies = scene[0], scene[1]
    c, s = math.cos(poses[i, 2]), math.sin(poses[i, 2])
    cx, cy = bodies[i, CENTRE_X], bodies[i, CENTRE_Y]
    return x - poses[i, 0] - c * cx + s * cy, y - poses[i, 1] - s * cx - c * cy


def find_contacts(scene: Scene, hits: Floats) -> int:
    """Write the points of all contacts into `hits` and return their number.

    The second body of a contact is -1 - m for the fixed outline m.
    """
    _, bodies, _, corners, first, begin, radius, near_at, near, sides, starts, boxes, mate_at, mates = scene
    count = 0
    for i in range(bodies.shape[0]):
        if bodies[i, KIND] == KINEMATIC:
            continue
        for p in range(begin[i], begin[i + 1]):
            a0, a1, ra = first[p], first[p + 1], radius[p]
            for k in range(near_at[i], near_at[i + 1]):
                m = near[k]
                if may_touch_fixed(i, m, MAX_GAP, bodies, boxes):
                    found = contact(corners, a0, a1, ra, sides, starts[m], starts[m + 1], boxes[m, 4], -MAX_GAP)
                    count = append_contact(found, i, -1 - m, hits, count)
            for k in range(mate_at[i], mate_at[i + 1]):
                j = mates[k]
                if (j > i or bodies[j, KIND] == KINEMATIC) and may_touch(i, j, MAX_GAP, bodies):
                    for q in range(begin[j], begin[j + 1]):
                        found = contact(corners, a0, a1, ra, corners, first[q], first[q + 1], radius[q], -MAX_GAP)
                        count = append_contact(found, i, j, hits, count)
    return count


def append_contact(found: Contact, i: int, j: int, hits: Floats, count: int) -> int:
    """Write the points of a contact into `hits` from row `count` on; return the new number of points."""
    points, nx, ny, d0, x0, y0, d1, x1, y1 = found
    for k in range(points):
        hit = hits[count]
        hit[FIRST], hit[SECOND], hit[NX], hit[NY] = i, j, nx, ny
        if k == 0:
            hit[PX], hit[PY], hit[DEPTH] = x0, y0, d0
        else:
            hit[PX], hit[PY], hit[DEPTH] = x1, y1, d1
        count += 1
    return count


def inverse_mass(i: int, rx: float, ry: float, nx: float, ny: float, bodies: Floats) -> float:
    """Return a body's inverse effective mass along (nx, ny) at (rx, ry) [m] from its centre of mass."""
    if i < 0 or bodies[i, KIND] == KINEMATIC:
        return 0.0
    lever = rx * ny - ry * nx
    return float(1.0 / bodies[i, MASS] + lever * lever / bodies[i, INERTIA])


def speed_at(i: int, rx: float, ry: float, nx: float, ny: float, motion: Floats) -> float:
    """Return the speed [m/s] along (nx, ny) of a body's point at (rx, ry) [m] from its centre of mass."""
    if i < 0:
        return 0.0
    return float((motion[i, 0] - motion[i, 2] * ry) * nx + (motion[i, 1] + motion[i, 2] * rx) * ny)


def apply_impulse(i: int, rx: float, ry: float, px: float, py: float, bodies: Floats, motion: Floats) -> None:
    """Apply an impulse (px, py) [N s] to a body at (rx, ry) [m] from its centre of mass."""
    if i >= 0 and bodies[i, KIND] != KINEMATIC:
        motion[i, 0] += px / bodies[i, MASS]
        motion[i, 1] += py / bodies[i, MASS]
        motion[i, 2] += (rx * py - ry * px) / bodies[i, INERTIA]


def restitution(i: int, bodies: Floats) -> float:
    """Return a body's coefficient of restitution; 1 for a body that cannot be pushed, so that the other's applies."""
    return 1.0 if i < 0 or bodies[i, KIND] == KINEMATIC else float(bodies[i, RESTITUTION])


def prepare_contacts(scene: Scene, motion: Floats, hits: Floats, arms: Floats, count: int) -> None:
    """Compute each contact's effective masses, opening speed and target speed."""
    bodies = scene[1]
    for n in range(count):
        hit = hits[n]
        i, j, nx, ny = int(hit[FIRST]), int(hit[SECOND]), hit[NX], hit[NY]
        ax, ay = lever_arm(i, hit[PX], hit[PY], scene)
        bx, by = 0.0, 0.0
        if j >= 0:
            bx, by = lever_arm(j, hit[PX], hit[PY], scene)
        arms[n, 0], arms[n, 1], arms[n, 2], arms[n, 3] = ax, ay, bx, by
        hit[ALONG] = 1.0 / (inverse_mass(i, ax, ay, nx, ny, bodies) + inverse_mass(j, bx, by, nx, ny, bodies))
        hit[ACROSS] = 1.0 / (inverse_mass(i, ax, ay, -ny, nx, bodies) + inverse_mass(j, bx, by, -ny, nx, bodies))
        hit[SPEED] = speed_at(j, bx, by, nx, ny, motion) - speed_at(i, ax, ay, nx, ny, motion)
        hit[BOUNCE] = -min(hit[SPEED], 0.0) * restitution(i, bodies) * restitution(j, bodies)
        hit[PUSH_IMPULSE] = hit[FRICTION_IMPULSE] = 0.0


def solve_contact(n: int, friction: float, scene: Scene, motion: Floats, hits: Floats, arms: Floats) -> bool:
    """Correct one contact's impulses: no approach, friction within Coulomb's cone. Return True if any changed."""
    bodies, hit = scene[1], hits[n]
    i, j, nx, ny = int(hit[FIRST]), int(hit[SECOND]), hit[NX], hit[NY]
    ax, ay, bx, by = arms[n, 0], arms[n, 1], arms[n, 2], arms[n, 3]
    opening = speed_at(j, bx, by, nx, ny, motion) - speed_at(i, ax, ay, nx, ny, motion)
    push = max(0.0, hit[PUSH_IMPULSE] + (hit[BOUNCE] - opening) * hit[ALONG])
    along = push - hit[PUSH_IMPULSE]
    sliding = speed_at(j, bx, by, -ny, nx, motion) - speed_at(i, ax, ay, -ny, nx, motion)
    most = friction * push
    drag = min(most, max(-most, hit[FRICTION_IMPULSE] - sliding * hit[ACROSS]))
    across = drag - hit[FRICTION_IMPULSE]
    if along == 0.0 and across == 0.0:
        return False
    hit[PUSH_IMPULSE], hit[FRICTION_IMPULSE] = push, drag
    px, py = along * nx - across * ny, along * ny + across * nx
    apply_impulse(i, ax, ay, -px, -py, bodies, motion)
    apply_impulse(j, bx, by, px, py, bodies, motion)
    return True


def apply_ground_force(i: int, dt: float, bodies: Floats, motion: Floats, held: Floats) -> bool:
    """Apply ground friction to an obstacle, or wheel drive to a robot, within its limit; return True if it changed."""
    mass, inertia = bodies[i, MASS], bodies[i, INERTIA]
    x = held[i, 0] + (motion[i, 3] - motion[i, 0]) * mass
    y = held[i, 1] + (motion[i, 4] - motion[i, 1]) * mass
    turn = held[i, 2] + (motion[i, 5] - motion[i, 2]) * inertia
    most, size = bodies[i, GROUND_FORCE] * dt, math.sqrt(x * x + y * y)
    if size > most:
        x, y = x * most / size, y * most / size
    most = bodies[i, GROUND_TORQUE] * dt
    turn = min(most, max(-most, turn))
    dx, dy, dw = x - held[i, 0], y - held[i, 1], turn - held[i, 2]
    if dx == 0.0 and dy == 0.0 and dw == 0.0:
        return False
    held[i, 0], held[i, 1], held[i, 2] = x, y, turn
    motion[i, 0] += dx / mass
    motion[i, 1] += dy / mass
    motion[i, 2] += dw / inertia
    return True


def slide(dt: float, friction: float, scene: Scene, motion: Floats, hits: Floats) -> int:
    """Advance the poses and velocities of pushed and sliding obstacles by a step; return the number of contacts.

    `motion` (n, 6) contains the velocity of each body's centre of mass [m/s, m/s, rad/s] and its target velocity, from
    the wheels or the ground. Robots exert forces here, but their new poses are not computed.
    """
    poses, bodies = scene[0], scene[1]
    total = bodies.shape[0]
    for i in range(total):
        update_corners(i, scene)
    count = find_contacts(scene, hits)
    before, held, arms = motion.copy(), np.zeros((total, 3)), np.empty((count, 4))
    prepare_contacts(scene, motion, hits, arms, count)
    for _ in range(ITERATIONS):
        changed = False
        for n in range(count):
            changed |= solve_contact(n, friction, scene, motion, hits, arms)
        for i in range(total):
            if bodies[i, KIND] != KINEMATIC:
                changed |= apply_ground_force(i, dt, bodies, motion, held)
        if not changed:
            break
    late, out = np.zeros(total), np.zeros((total, 2))
    separate(dt, bodies, hits, count, late, out)
    for i in range(total):
        if bodies[i, KIND] == CRATE:
            integrate(i, dt, late[i], out, poses, bodies, before, motion)
    return count


def separate(dt: float, bodies: Floats, hits: Floats, count: int, late: Floats, out: Floats) -> None:
    """Compute the time since each body's impact (-1: no impact) and the motion that undoes other overlaps."""
    for i in range(bodies.shape[0]):
        late[i] = -1.0
    for n in range(count):
        hit = hits[n]
        i, j, deep = int(hit[FIRST]), int(hit[SECOND]), max(hit[DEPTH] - PUSH_DEPTH, 0.0)
        since = 0.0
        if hit[SPEED] < 0.0:
            since = min(dt, -deep / hit[SPEED])
            deep += since * hit[SPEED]
        if hit[PUSH_IMPULSE] > 0.0:
            late[i] = max(late[i], since)
            if j >= 0:
                late[j] = max(late[j], since)
        own = 1.0 / bodies[i, MASS] if bodies[i, KIND] == CRATE else 0.0
        other = 1.0 / bodies[j, MASS] if j >= 0 and bodies[j, KIND] == CRATE else 0.0
        if deep > 0.0 and own + other > 0.0:
            back = OVERLAP_FRACTION * deep / (own + other)
            out[i, 0] -= back * own * hit[NX]
            out[i, 1] -= back * own * hit[NY]
            if j >= 0:
                out[j, 0] += back * other * hit[NX]
                out[j, 1] += back * other * hit[NY]


def integrate(
    i: int, dt: float, late: float, out: Floats, poses: Floats, bodies: Floats, before: Floats, motion: Floats
) -> None:
    """Move a body by its velocities before and after a step; an impact was `late` seconds before it (-1: no impact)."""
    vx, vy, w = motion[i, 0], motion[i, 1], motion[i, 2]
    if abs(vx) <= REST_SPEED and abs(vy) <= REST_SPEED and abs(w) <= REST_SPEED:
        motion[i, 0] = motion[i, 1] = motion[i, 2] = 0.0
        return
    # a freely sliding body loses its speed evenly; a pushed one has its new speed at once
    old, new = (0.5 * dt, 0.5 * dt) if late < 0.0 else (-late, dt + late)
    x, y, theta = poses[i, 0], poses[i, 1], poses[i, 2]
    cx, cy = bodies[i, CENTRE_X], bodies[i, CENTRE_Y]
    c, s = math.cos(theta), math.sin(theta)
    mx = x + c * cx - s * cy + old * before[i, 0] + new * vx + out[i, 0]
    my = y + s * cx + c * cy + old * before[i, 1] + new * vy + out[i, 1]
    theta += old * before[i, 2] + new * w
    c, s = math.cos(theta), math.sin(theta)
    poses[i, 0], poses[i, 1], poses[i, 2] = mx - c * cx + s * cy, my - s * cx - c * cy, theta


# -- clearances ------------------------------------------------------------------------------------------------------


def clearances(robots: Ints, view: float, scene: Scene, rooms: Floats) -> None:
    """Compute how far robots can move before a contact, at most `view` [m]; two moving bodies share a gap equally."""
    _, bodies, _, corners, first, begin, radius, near_at, near, sides, starts, boxes, mate_at, mates = scene
    for i in range(bodies.shape[0]):
        update_corners(i, scene)
    for n in range(robots.shape[0]):
        i = robots[n]
        p = begin[i]
        a0, a1, ra = first[p], first[p + 1], radius[p]
        free = view
        for k in range(near_at[i], near_at[i + 1]):
            m = near[k]
            if may_touch_fixed(i, m, free, bodies, boxes):
                free = min(free, gap(corners, a0, a1, ra, sides, starts[m], starts[m + 1], boxes[m, 4]))
        for k in range(mate_at[i], mate_at[i + 1]):
            j = mates[k]
            if may_touch(i, j, view, bodies):
                away = math.inf
                for q in range(begin[j], begin[j + 1]):
                    away = min(away, gap(corners, a0, a1, ra, corners, first[q], first[q + 1], radius[q]))
                if bodies[j, KIND] != CRATE:
                    away /= 2
                    rooms[j] = min(rooms[j], away)
                free = min(free, away)
        rooms[i] = free


PLAIN: dict[str, Callable[..., Any]] = {each.__name__: each for each in (resolve_overlaps, slide, clearances)}
"""The loops in plain Python."""


def compiled(name: str) -> Callable[..., Any]:
    """Compile one of `PLAIN` to machine code. Raises `ImportError` without numba."""
    pairs = (parting, facing, height, nearest_side, contact_disc, contact, gap)
    pushes = (point_correction, update_corners, may_touch_fixed, may_touch, push_along, push_out)
    blows = (
        lever_arm,
        append_contact,
        find_contacts,
        inverse_mass,
        speed_at,
        apply_impulse,
        restitution,
        prepare_contacts,
        solve_contact,
        apply_ground_force,
        separate,
        integrate,
    )

    def signature(numba: Any) -> Any:
        number, table, ways, vector = numba.float64, numba.float64[:, ::1], numba.int64[::1], numba.float64[::1]
        arrays = (table, table, table, table, ways, ways, vector, ways, ways, table, ways, table, ways, ways)
        scene = numba.types.Tuple(arrays)
        return {
            "resolve_overlaps": numba.void(ways, scene, ways),
            "slide": numba.int64(number, number, scene, table, table),
            "clearances": numba.void(ways, number, scene, vector),
        }[name]

    return machine_code(PLAIN[name], signature, (*pairs, *pushes, *blows))
