"""The camera in machine code: the loops of `rosmini.sim.sensors.raster` and of `rosmini.sim.sensors.shading`, where both are explained.

The functions here are plain Python. `compiled` makes machine code of them, at the first call in a few seconds, later from numba's cache. Scalars, explicit
types and no slices keep those seconds few.
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

# As in `rosmini.sim.sensors.shading`. They are compiled in, and numba's cache looks at the age of this file only.
SQUARE, HAZE = 0.5, 45.0
AMBIENT, DIFFUSE = 0.76, 0.26


def draw_faces(
    number: Ints,
    edges: Floats,
    linear: Floats,
    box: Ints,
    near: float,
    far: float,
    inverse: Floats,
    shown: Ints,
) -> None:
    """As `rosmini.sim.sensors.raster.draw`."""
    most, least = 1.0 / near, 1.0 / far
    for n in range(number.shape[0]):
        a, b, c = linear[n, 0], linear[n, 1], linear[n, 2]
        for v in range(box[n, 2], box[n, 3] + 1):
            first, last = float(box[n, 0]), float(box[n, 1])
            for k in range(edges.shape[1]):
                rest = edges[n, k, 0] + edges[n, k, 2] * v
                slope = edges[n, k, 1]
                if slope > 0:
                    first = max(first, -rest / slope)
                elif slope < 0:
                    last = min(last, -rest / slope)
                elif rest < 0:
                    last = -1.0
            if first > last:
                continue
            row = a + c * v
            for u in range(math.ceil(first), math.floor(last) + 1):
                value = row + b * u
                if value > inverse[v, u] and value <= most and value >= least:
                    inverse[v, u] = value
                    shown[v, u] = number[n]


def draw_rods(
    first: int,
    rods: Floats,
    boxes: Ints,
    eye: Floats,
    rays: Floats,
    near: float,
    far: float,
    inverse: Floats,
    shown: Ints,
) -> None:
    """As `rosmini.sim.sensors.raster.draw_rods`."""
    for n in range(rods.shape[0]):
        ox, oy, ez = eye[0] - rods[n, 0], eye[1] - rods[n, 1], eye[2]
        radius, bottom, top = rods[n, 2], rods[n, 3], rods[n, 4]
        outside = ox * ox + oy * oy - radius * radius
        for v in range(boxes[n, 2], boxes[n, 3] + 1):
            for u in range(boxes[n, 0], boxes[n, 1] + 1):
                dx = (rays[0, 0] + rays[0, 2] * v) + rays[0, 1] * u
                dy = (rays[1, 0] + rays[1, 2] * v) + rays[1, 1] * u
                dz = (rays[2, 0] + rays[2, 2] * v) + rays[2, 1] * u
                a, b = dx * dx + dy * dy, ox * dx + oy * dy
                left = b * b - a * outside
                if left < 0 or (a == 0 and outside > 0):
                    continue
                found = math.inf
                if outside > 0:
                    depth = (-b - math.sqrt(left)) / a
                    height = ez + depth * dz
                    if height >= bottom and height <= top:
                        found = depth
                if dz != 0:
                    for side in range(2):
                        level = top if side == 0 else bottom
                        if ez > top if side == 0 else ez < bottom:
                            flat = (level - ez) / dz
                            px, py = ox + flat * dx, oy + flat * dy
                            if px * px + py * py <= radius * radius and flat > 0 and flat < found:
                                found = flat
                if found >= near and found <= far and 1.0 / found > inverse[v, u]:
                    inverse[v, u] = 1.0 / found
                    shown[v, u] = first + n


def draw_balls(
    first: int,
    balls: Floats,
    boxes: Ints,
    eye: Floats,
    rays: Floats,
    near: float,
    far: float,
    inverse: Floats,
    shown: Ints,
) -> None:
    """As `rosmini.sim.sensors.raster.draw_balls`."""
    for n in range(balls.shape[0]):
        ox, oy, oz = eye[0] - balls[n, 0], eye[1] - balls[n, 1], eye[2] - balls[n, 2]
        outside = ox * ox + oy * oy + oz * oz - balls[n, 3] * balls[n, 3]
        if outside <= 0:
            continue
        for v in range(boxes[n, 2], boxes[n, 3] + 1):
            for u in range(boxes[n, 0], boxes[n, 1] + 1):
                dx = (rays[0, 0] + rays[0, 2] * v) + rays[0, 1] * u
                dy = (rays[1, 0] + rays[1, 2] * v) + rays[1, 1] * u
                dz = (rays[2, 0] + rays[2, 2] * v) + rays[2, 1] * u
                a, b = dx * dx + dy * dy + dz * dz, ox * dx + oy * dy + oz * dz
                left = b * b - a * outside
                if left < 0:
                    continue
                found = (-b - math.sqrt(left)) / a
                if found >= near and found <= far and 1.0 / found > inverse[v, u]:
                    inverse[v, u] = 1.0 / found
                    shown[v, u] = first + n


def shade(
    inverse: Floats,
    shown: Ints,
    eye: Floats,
    rays: Floats,
    pixel: float,
    looks: Floats,
    faces: Floats,
    rods: Floats,
    balls: Floats,
    paints: Floats,
    noise: Floats,
    image: NDArray[np.uint8],
) -> None:
    """As `rosmini.sim.sensors.shading.coloured`, with noise (h, w), or (0, 0) for none, and as bytes.

    `pixel` is what a pixel is wide at one metre; the rows of `looks` (5, 3) are the light's direction, the ground's light and dark, the horizon and the zenith.
    """
    ez = eye[2]
    for v in range(shown.shape[0]):
        for u in range(shown.shape[1]):
            dx = (rays[0, 0] + rays[0, 2] * v) + rays[0, 1] * u
            dy = (rays[1, 0] + rays[1, 2] * v) + rays[1, 1] * u
            dz = (rays[2, 0] + rays[2, 2] * v) + rays[2, 1] * u
            near, number = inverse[v, u], shown[v, u]
            extra = noise[v, u] if noise.shape[0] else 0.0
            if number < 0 and near <= 0:
                up = math.sqrt(max(dz / math.sqrt(dx * dx + dy * dy + dz * dz), 0.0))
                for k in range(3):
                    image[v, u, k] = byte(looks[3, k] + (looks[4, k] - looks[3, k]) * up + extra)
                continue
            depth = 1.0 / near
            mist = math.exp(-depth / HAZE)
            if number < 0:
                step = depth * pixel * max(1.0, 0.35 * depth / abs(ez))
                half = wave(eye[0] + depth * dx, step) * wave(eye[1] + depth * dy, step)
                half *= min(max(1.6 - step / SQUARE, 0.0), 1.0) / 2
                for k in range(3):
                    own = (looks[1, k] + looks[2, k]) / 2 + (looks[1, k] - looks[2, k]) * half
                    image[v, u, k] = byte(own * mist + looks[3, k] * (1 - mist) + extra)
                continue
            if number < faces.shape[0]:
                for k in range(3):
                    image[v, u, k] = byte(faces[number, k] * mist + looks[3, k] * (1 - mist) + extra)
                continue
            number -= faces.shape[0]
            x, y, z = eye[0] + depth * dx, eye[1] + depth * dy, ez + depth * dz
            if number < rods.shape[0]:
                radius, bottom, top = rods[number, 2], rods[number, 3], rods[number, 4]
                if ez > top and z > top - 1e-4:
                    shine = looks[0, 2]
                elif ez < bottom and z < bottom + 1e-4:
                    shine = -looks[0, 2]
                else:
                    shine = (
                        (x - rods[number, 0]) * looks[0, 0] + (y - rods[number, 1]) * looks[0, 1]
                    ) / radius
            else:
                ball = number - rods.shape[0]
                shine = (x - balls[ball, 0]) * looks[0, 0] + (y - balls[ball, 1]) * looks[0, 1]
                shine = (shine + (z - balls[ball, 2]) * looks[0, 2]) / balls[ball, 3]
            bright = AMBIENT + DIFFUSE * shine
            for k in range(3):
                image[v, u, k] = byte(paints[number, k] * bright * mist + looks[3, k] * (1 - mist) + extra)


def wave(x: float, step: float) -> float:
    """1 and -1 by turns, with edges as soft as `step`."""
    x = x / (2 * SQUARE) + 0.25
    x -= math.floor(x)
    edge = SQUARE / 2 - abs(x * 2 * SQUARE - SQUARE)
    return min(max(edge / (0.5 * step), -1.0), 1.0)


def byte(value: float) -> int:
    """0 to 1 as 0 to 255."""
    return int(min(max(value * 255.0, 0.0), 255.0) + 0.5)


@cache
def compiled() -> tuple[Callable[..., None], Callable[..., None], Callable[..., None], Callable[..., None]]:
    """`draw_faces`, `draw_rods`, `draw_balls` and `shade` as machine code. Raises `ImportError` without numba."""
    import numba
    from numba.extending import register_jitable

    for function in (wave, byte):
        register_jitable(function)
    f, i = numba.float64, numba.int64

    def read(kind: Any, dimensions: int) -> Any:
        return numba.types.Array(kind, dimensions, "C", readonly=True)

    table, vector, tables = read(f, 2), read(f, 1), read(f, 3)
    places, numbers = read(i, 2), read(i, 1)
    depths, shown, image = f[:, ::1], i[:, ::1], numba.uint8[:, :, ::1]
    solid = (i, table, places, vector, table, f, f, depths, shown)
    signatures = {
        draw_faces: (numbers, tables, table, places, f, f, depths, shown),
        draw_rods: solid,
        draw_balls: solid,
        shade: (table, places, vector, table, f, table, table, table, table, table, table, image),
    }
    first, second, third, fourth = (_compiled(each, numba.void(*given)) for each, given in signatures.items())
    return first, second, third, fourth


def _compiled(function: Any, signature: Any) -> Callable[..., None]:
    import numba

    try:
        return numba.njit([signature], cache=True)(function)
    except Exception as error:
        # A cache that can be neither written nor read costs a few seconds at each start and no more; what is wrong with the code itself is raised below.
        logging.getLogger(__name__).info("numba cannot cache the camera: %s", error)
    return numba.njit([signature])(function)
