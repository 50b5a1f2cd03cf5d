"""How things look: light from above and from one side, a chequered ground, a pale sky, and a little haze.

A surface with the normal n has its colour times 0.70 + 0.30 n . l, where l points to the light: walls that meet in a corner differ, and what one sees from
above is brightest. The ground's squares are as large as a step, so that motion is seen; where they are smaller than a pixel they blur into their mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .raster import GROUND, Eye
from .scenery import Floats, Rgb, Scenery

Pixels = NDArray[np.float32]
Ints = NDArray[np.int64]

LIGHT = np.array([0.36, 0.52, 0.775]) / np.linalg.norm([0.36, 0.52, 0.775])
AMBIENT, DIFFUSE = 0.72, 0.30

SQUARE = 0.5
"""The side of one square of the ground [m]."""
GROUND_LIGHT: Rgb = (0.800, 0.775, 0.735)
GROUND_DARK: Rgb = (0.705, 0.675, 0.630)
HORIZON: Rgb = (0.905, 0.930, 0.955)
ZENITH: Rgb = (0.520, 0.680, 0.860)
HAZE = 45.0
"""At this distance [m] things have 63 % of the horizon's colour."""


def coloured(eye: Eye, scenery: Scenery, inverse: Floats, shown: Ints) -> Pixels:
    """The image (h, w, 3), 0 to 1, of what `rosmini.sim.raster` drew."""
    height, width = shown.shape
    rays = eye.rays().astype(np.float32)
    u, v = np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32)
    dx, dy, dz = ((a + c * v)[:, None] + b * u for a, b, c in rays)
    near = inverse.astype(np.float32)
    image = np.empty((height, width, 3), dtype=np.float32)
    free = shown == GROUND
    ground = free & (near > 0)
    _sky(image, free & ~ground, dx, dy, dz)
    _ground(image, ground, eye, near, dx, dy)
    _faces(image, eye, scenery, shown)
    _round(image, eye, scenery, near, shown, (dx, dy, dz))
    _haze(image, near, shown != GROUND)
    return image


def lit(normals: Floats) -> Floats:
    """How bright surfaces with normals (n, 3) are."""
    bright: Floats = AMBIENT + DIFFUSE * (normals @ LIGHT)
    return bright


def _sky(image: Pixels, where: NDArray[np.bool_], dx: Pixels, dy: Pixels, dz: Pixels) -> None:
    if not where.any():
        return
    x, y, z = dx[where], dy[where], dz[where]
    up = np.clip(z / np.sqrt(x * x + y * y + z * z), 0.0, 1.0)[:, None]
    low, high = np.array(HORIZON, np.float32), np.array(ZENITH, np.float32)
    image[where] = low + (high - low) * np.sqrt(up)


def _ground(image: Pixels, where: NDArray[np.bool_], eye: Eye, near: Pixels, dx: Pixels, dy: Pixels) -> None:
    if not where.any():
        return
    depth = 1 / near[where]
    x, y = depth * dx[where] + np.float32(eye.position[0]), depth * dy[where] + np.float32(eye.position[1])
    # a pixel covers so much of the ground: more along the way than across it
    step = depth * np.float32(1 / eye.lens.fx)
    step *= np.maximum(1.0, 0.35 * depth / np.float32(abs(eye.position[2])))
    wave = _wave(x, step) * _wave(y, step)
    wave *= np.clip(1.6 - step / np.float32(SQUARE), 0.0, 1.0)
    light, dark = np.array(GROUND_LIGHT, np.float32), np.array(GROUND_DARK, np.float32)
    colour = (light + dark) / 2 + (light - dark) / 2 * wave[:, None]
    mist = np.exp(depth * np.float32(-1 / HAZE))[:, None]
    image[where] = colour * mist + np.array(HORIZON, np.float32) * (1 - mist)


def _wave(x: Pixels, step: Pixels) -> Pixels:
    """1 and -1 by turns, with edges as soft as a pixel is wide."""
    period = np.float32(2 * SQUARE)
    x = x / period + np.float32(0.25)
    x -= np.floor(x)
    edge = np.float32(SQUARE / 2) - np.abs(x * period - np.float32(SQUARE))
    soft: Pixels = np.clip(edge / (0.5 * step), -1.0, 1.0)
    return soft


def _faces(image: Pixels, eye: Eye, scenery: Scenery, shown: Ints) -> None:
    count = len(scenery.faces)
    if not count:
        return
    normals = scenery.normals
    towards = np.einsum("ij,ij->i", normals, eye.position - scenery.faces[:, 0])
    normals = np.where((scenery.thin & (towards < 0))[:, None], -normals, normals)
    colours = (scenery.paints * lit(normals)[:, None]).astype(np.float32)
    where = (shown >= 0) & (shown < count)
    image[where] = colours[shown[where]]


def _round(
    image: Pixels, eye: Eye, scenery: Scenery, near: Pixels, shown: Ints, ways: tuple[Pixels, Pixels, Pixels]
) -> None:
    """Cylinders and balls: their normals follow from where they were met."""
    faces, rods = len(scenery.faces), len(scenery.rods)
    where = shown >= faces
    number = shown[where] - faces
    if not len(number):
        return
    depth = 1 / near[where]
    x, y, z = (e + depth * way[where] for e, way in zip(eye.position, ways, strict=True))
    normals = np.zeros((len(number), 3))
    rod = number < rods
    if rod.any():
        cx, cy, radius, bottom, top = scenery.rods[number[rod]].T
        away = np.column_stack([x[rod] - cx, y[rod] - cy, np.zeros(len(cx))]) / radius[:, None]
        above, below = (z[rod] > top - 1e-4) & (eye.position[2] > top), eye.position[2] < bottom
        below &= z[rod] < bottom + 1e-4
        away[above], away[below] = (0, 0, 1), (0, 0, -1)
        normals[rod] = away
    if not rod.all():
        cx, cy, cz, radius = scenery.balls[number[~rod] - rods].T
        normals[~rod] = np.column_stack([x[~rod] - cx, y[~rod] - cy, z[~rod] - cz]) / radius[:, None]
    paints = np.concatenate([scenery.rod_paints, scenery.ball_paints])
    image[where] = paints[number] * lit(normals)[:, None]


def _haze(image: Pixels, near: Pixels, where: NDArray[np.bool_]) -> None:
    mist = np.exp(np.float32(-1 / HAZE) / np.where(where, near, np.float32(np.inf)))[..., None]
    image *= mist
    image += np.array(HORIZON, np.float32) * (1 - mist)
