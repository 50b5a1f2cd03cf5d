"""Arithmetic of transforms, and the walk along a chain of frames: scalar loops, compiled by numba if worthwhile.

Keep the kernel's helpers in this file: numba's cache is renewed only when this file changes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from rosmini.core.geometry.machine_code import machine_code

Rigid = tuple[float, float, float, float, float, float, float]
"""x, y, z [m], and the rotation as a quaternion x, y, z, w."""

IDENTITY: Rigid = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)

PARENT_SHIFT = 32
"""The bits of an origin from this one up number the parent, those below it the pair of parent and authority."""

FOUND = -1
"""Returned by `walk` if all edges have data; otherwise it returns the index of one that does not."""


def compose(a: Rigid, b: Rigid) -> Rigid:
    """Return the pose of c in the frame of a, where `a` is the pose of b in a, and `b` that of c in b."""
    ax, ay, az, ai, aj, ak, aw = a
    bx, by, bz, bi, bj, bk, bw = b
    # v + 2 w (q x v) + 2 q x (q x v)
    tx = 2 * (aj * bz - ak * by)
    ty = 2 * (ak * bx - ai * bz)
    tz = 2 * (ai * by - aj * bx)
    return (
        ax + bx + aw * tx + aj * tz - ak * ty,
        ay + by + aw * ty + ak * tx - ai * tz,
        az + bz + aw * tz + ai * ty - aj * tx,
        aw * bi + ai * bw + aj * bk - ak * bj,
        aw * bj - ai * bk + aj * bw + ak * bi,
        aw * bk + ai * bj - aj * bi + ak * bw,
        aw * bw - ai * bi - aj * bj - ak * bk,
    )


def inverse(a: Rigid) -> Rigid:
    """Return the inverse: composed with `a`, on either side, it is the identity."""
    x, y, z, i, j, k, w = a
    tx = 2 * (k * y - j * z)
    ty = 2 * (i * z - k * x)
    tz = 2 * (j * x - i * y)
    # The rotation by (-i, -j, -k, w) of (x, y, z), negated.
    return (
        -(x + w * tx - j * tz + k * ty),
        -(y + w * ty - k * tx + i * tz),
        -(z + w * tz - i * ty + j * tx),
        -i,
        -j,
        -k,
        w,
    )


def interpolate(a: Rigid, b: Rigid, fraction: float) -> Rigid:
    """Interpolate from `a` (fraction 0) to `b` (1): the position linearly, the rotation by slerp (Shoemake, 1985)."""
    ax, ay, az, ai, aj, ak, aw = a
    bx, by, bz, bi, bj, bk, bw = b
    rest = 1.0 - fraction
    cosine = ai * bi + aj * bj + ak * bk + aw * bw
    if cosine < 0:
        bi, bj, bk, bw, cosine = -bi, -bj, -bk, -bw, -cosine
    p, q = rest, fraction
    if cosine <= 0.9999:  # for smaller angles, linear is accurate; normalised below
        angle = math.acos(cosine)
        sine = math.sin(angle)
        p, q = math.sin(rest * angle) / sine, math.sin(fraction * angle) / sine
    i, j, k, w = p * ai + q * bi, p * aj + q * bj, p * ak + q * bk, p * aw + q * bw
    scale = 1 / math.sqrt(i * i + j * j + k * k + w * w)
    return (
        rest * ax + fraction * bx,
        rest * ay + fraction * by,
        rest * az + fraction * bz,
        i * scale,
        j * scale,
        k * scale,
        w * scale,
    )


def find(stamps: Sequence[int], begin: int, end: int, stamp_ns: int) -> int:
    """Return the first index of the sorted `stamps[begin:end]` that is not before `stamp_ns`, or `end`.

    Samples are usually evenly spaced, so an interpolated guess is tried first, then bisection.
    """
    low, high = begin, end - 1
    if stamp_ns > stamps[high]:
        return end
    first = stamps[low]
    if stamp_ns <= first:
        return low
    guess = low + int((stamp_ns - first) / (stamps[high] - first) * (high - low))
    if stamps[guess] < stamp_ns:
        low = guess
        if stamps[guess + 1] >= stamp_ns:
            return guess + 1
    else:
        high = guess
        if stamps[guess - 1] < stamp_ns:
            return guess
    while high - low > 1:
        middle = (low + high) // 2
        if stamps[middle] < stamp_ns:
            low = middle
        else:
            high = middle
    return high


def sample(values: Sequence[float], place: int) -> Rigid:
    """Return the transform at an index of the flat `values`."""
    k = 7 * place
    return (values[k], values[k + 1], values[k + 2], values[k + 3], values[k + 4], values[k + 5], values[k + 6])


def walk(
    stamps: Sequence[int],
    origins: Sequence[int],
    values: Sequence[float],
    spans: Sequence[int],
    edge_numbers: Sequence[int],
    ups: int,
    stamp_ns: int,
) -> tuple[int, int, Rigid]:
    """Return the pose of a source frame in a target frame, found along a path of edges.

    Args:
        stamps: the time of each sample [ns]; those of one edge are contiguous and sorted.
        origins: the parent and the authority of each sample, as numbers.
        values: the transform of each sample, seven numbers.
        spans: for each edge the start and end of its samples, and 1 if it is static.
        edge_numbers: the edges from the source up to the common ancestor, then those from the target up to it.
        ups: the number of edges on the source's side.
        stamp_ns: the time [ns]; 0 means the latest time known for all edges.

    Returns:
        `FOUND`, or the index in `edge_numbers` of an edge that is not known at that time; the time; the pose.

    """
    if stamp_ns == 0:
        for n in range(len(edge_numbers)):
            edge = 3 * edge_numbers[n]
            newest = stamps[spans[edge + 1] - 1]
            if not spans[edge + 2] and newest and (stamp_ns == 0 or newest < stamp_ns):
                stamp_ns = newest
    up, down = IDENTITY, IDENTITY
    for n in range(len(edge_numbers)):
        edge = 3 * edge_numbers[n]
        begin, end = spans[edge], spans[edge + 1]
        if spans[edge + 2]:
            step = sample(values, begin)
        else:
            place = find(stamps, begin, end, stamp_ns)
            if place == end or (place == begin and stamps[begin] != stamp_ns):
                return n, stamp_ns, IDENTITY
            later = stamps[place]
            if later == stamp_ns:
                step = sample(values, place)
            elif origins[place - 1] >> PARENT_SHIFT != origins[place] >> PARENT_SHIFT:
                step = sample(values, place - 1)
            else:
                earlier = stamps[place - 1]
                step = interpolate(
                    sample(values, place - 1), sample(values, place), (stamp_ns - earlier) / (later - earlier)
                )
        if n < ups:
            up = step if n == 0 else compose(step, up)
        else:
            down = step if n == ups else compose(step, down)
    if ups == len(edge_numbers):
        return FOUND, stamp_ns, up
    back = inverse(down)
    return FOUND, stamp_ns, back if ups == 0 else compose(back, up)


@cache
def compiled_walk() -> Callable[..., tuple[int, int, Rigid]]:
    """Return `walk` compiled by numba, for arrays. Raises `ImportError` without numba."""

    def signature(numba: Any) -> Any:
        types = numba.types
        number, ints, floats = types.int64, types.int64[::1], types.float64[::1]
        result = types.Tuple((number, number, types.UniTuple(types.float64, 7)))
        return result(ints, ints, floats, ints, ints, number, number)

    return machine_code(walk, signature, (compose, inverse, interpolate, find, sample))
