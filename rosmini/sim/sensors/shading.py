"""How things look: light from above and from one side, a chequered ground, a pale sky, and a little haze.

A surface with the normal n has its colour times 0.76 + 0.26 n . l, where l points to the light: walls that meet in a corner differ, and what one sees from
above is brightest. The ground's squares are as large as a step, so that motion is seen; where they are smaller than a pixel they blur into their mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .raster import GROUND, Eye
from .scene import Floats, Rgb, Scene

Pixels = NDArray[np.float32]
Ints = NDArray[np.int64]

LIGHT = np.array([0.36, 0.52, 0.775]) / np.linalg.norm([0.36, 0.52, 0.775])
AMBIENT, DIFFUSE = 0.76, 0.26

SQUARE = 0.5
"""The side of one square of the ground [m]."""
GROUND_LIGHT: Rgb = (0.800, 0.775, 0.735)
GROUND_DARK: Rgb = (0.705, 0.675, 0.630)
HORIZON: Rgb = (0.905, 0.930, 0.955)
ZENITH: Rgb = (0.520, 0.680, 0.860)
HAZE = 45.0
"""At this distance [m] things have 63 % of the horizon's colour."""

LOOKS = np.array([LIGHT, GROUND_LIGHT, GROUND_DARK, HORIZON, ZENITH])


def coloured(eye: Eye, scene: Scene, inverse: Floats, shown: Ints) -> Pixels:
    """The image (h, w, 3), 0 to 1, of what `rosmini.sim.sensors.raster` drew."""
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
    _faces(image, eye, scene, shown)
    _round(image, eye, scene, near, shown, (dx, dy, dz))
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
    depth: Pixels = np.reciprocal(near[where])
    x: Pixels = depth * dx[where] + np.float32(eye.position[0])
    y: Pixels = depth * dy[where] + np.float32(eye.position[1])
    # a pixel covers so much of the ground: more along the way than across it
    stretch = np.maximum(np.float32(1.0), np.float32(0.35 / abs(eye.position[2])) * depth)
    step: Pixels = (depth * np.float32(1 / eye.lens.fx) * stretch).astype(np.float32)
    wave = (_wave(x, step) * _wave(y, step)).astype(np.float32, copy=False)
    wave *= np.clip(np.float32(1.6) - step / np.float32(SQUARE), 0.0, 1.0)
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


def face_colours(eye: Eye, scene: Scene) -> Floats:
    """The colours (n, 3) of the faces in the light; a thin wall shows the side where the camera is."""
    normals = scene.normals
    towards = np.einsum("ij,ij->i", normals, eye.position - scene.faces[:, 0])
    normals = np.where((scene.thin & (towards < 0))[:, None], -normals, normals)
    colours: Floats = scene.paints * lit(normals)[:, None]
    return colours


def looks_of(eye: Eye, scene: Scene) -> tuple[Floats, Floats, Floats, Floats]:
    """What a loop over pixels needs: the faces' colours, the cylinders, the balls, and the colours of both."""
    paints = np.concatenate([scene.rod_paints, scene.ball_paints])
    return face_colours(eye, scene), scene.rods, scene.balls, paints


def _faces(image: Pixels, eye: Eye, scene: Scene, shown: Ints) -> None:
    count = len(scene.faces)
    if count:
        where = (shown >= 0) & (shown < count)
        image[where] = face_colours(eye, scene).astype(np.float32)[shown[where]]


def _round(
    image: Pixels, eye: Eye, scene: Scene, near: Pixels, shown: Ints, ways: tuple[Pixels, Pixels, Pixels]
) -> None:
    """Cylinders and balls: their normals follow from where they were met."""
    faces, rods = len(scene.faces), len(scene.rods)
    where = shown >= faces
    number = shown[where] - faces
    if not len(number):
        return
    depth = 1 / near[where]
    x, y, z = (e + depth * way[where] for e, way in zip(eye.position, ways, strict=True))
    normals = np.zeros((len(number), 3))
    rod = number < rods
    if rod.any():
        cx, cy, radius, bottom, top = scene.rods[number[rod]].T
        away = np.column_stack([x[rod] - cx, y[rod] - cy, np.zeros(len(cx))]) / radius[:, None]
        above, below = (z[rod] > top - 1e-4) & (eye.position[2] > top), eye.position[2] < bottom
        below &= z[rod] < bottom + 1e-4
        away[above], away[below] = (0, 0, 1), (0, 0, -1)
        normals[rod] = away
    if not rod.all():
        cx, cy, cz, radius = scene.balls[number[~rod] - rods].T
        normals[~rod] = np.column_stack([x[~rod] - cx, y[~rod] - cy, z[~rod] - cz]) / radius[:, None]
    paints = np.concatenate([scene.rod_paints, scene.ball_paints])
    image[where] = paints[number] * lit(normals)[:, None]


def _haze(image: Pixels, near: Pixels, where: NDArray[np.bool_]) -> None:
    mist = np.exp(np.float32(-1 / HAZE) / np.where(where, near, np.float32(np.inf)))[..., None]
    image *= mist
    image += np.array(HORIZON, np.float32) * (1 - mist)
