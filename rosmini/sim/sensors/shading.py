"""Appearance of a scene: light from above and from one side, a chequered ground, a pale sky, and a little haze.

A surface with the normal n has its colour times 0.76 + 0.26 n . l, where l points to the light: walls that meet in a
corner differ, and surfaces seen from above are brightest. The squares of the ground are about a step in size, which
makes motion visible; where they are smaller than a pixel they blur into their average.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import matrix_product, norm

from .raster import GROUND, Eye
from .scene import Floats, Rgb, Scene

Pixels = NDArray[np.float32]
Ints = NDArray[np.int64]
Ways = tuple[Pixels, ...]
"""The ray directions of the pixels, along x, y and z, for one metre of depth."""

LIGHT = np.array([0.36, 0.52, 0.775]) / norm([0.36, 0.52, 0.775])
AMBIENT, DIFFUSE = 0.76, 0.26

SQUARE = 0.5
"""Edge length of a square of the ground [m]."""
GROUND_LIGHT: Rgb = (0.800, 0.775, 0.735)
GROUND_DARK: Rgb = (0.705, 0.675, 0.630)
HORIZON: Rgb = (0.905, 0.930, 0.955)
ZENITH: Rgb = (0.520, 0.680, 0.860)
HAZE = 45.0
"""Distance [m] at which objects have 63 % of the horizon's colour."""


def coloured(eye: Eye, scene: Scene, inverse: Floats, shown: Ints) -> Pixels:
    """Return the image drawn by `rosmini.sim.sensors.raster`, as planes of red, green and blue (3, h, w), 0 to 1.

    With planes numpy's loops run along many pixels instead of three numbers.
    """
    height, width = shown.shape
    u, v = np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32)
    ways = tuple(((a + c * v)[:, None] + b * u).ravel() for a, b, c in eye.rays().astype(np.float32))
    near, number = inverse.astype(np.float32).ravel(), shown.ravel()
    planes = np.empty((3, height * width), dtype=np.float32)
    free = np.flatnonzero(number == GROUND)
    onto = near[free] > 0
    _sky(planes, free[~onto], ways)
    _ground(planes, free[onto], eye, near, ways)
    things = np.flatnonzero(number != GROUND)
    if len(things):
        colours = _colours(eye, scene, near, number, things, ways)
        mist = np.exp(np.float32(-1 / HAZE) / near[things])
        for plane, colour, horizon in zip(planes, colours, *_paints(HORIZON), strict=True):
            plane[things] = colour * mist + horizon * (1 - mist)
    return planes.reshape(3, height, width)


def lit(normals: Floats) -> Floats:
    """Return the brightness of surfaces with normals (n, 3)."""
    bright: Floats = AMBIENT + DIFFUSE * matrix_product(normals, LIGHT)
    return bright


def _paints(*colours: Rgb) -> Pixels:
    """Return colours (n, 3) as 32-bit numbers."""
    return np.array(colours, dtype=np.float32)


def _sky(planes: Pixels, where: Ints, ways: Ways) -> None:
    if not len(where):
        return
    x, y, z = (way[where] for way in ways)
    up = np.sqrt(np.clip(z / np.sqrt(x * x + y * y + z * z), 0.0, 1.0))
    for plane, low, high in zip(planes, *_paints(HORIZON, ZENITH), strict=True):
        plane[where] = low + (high - low) * up


def _ground(planes: Pixels, where: Ints, eye: Eye, near: Pixels, ways: Ways) -> None:
    if not len(where):
        return
    depth: Pixels = np.reciprocal(near[where])
    x: Pixels = depth * ways[0][where] + np.float32(eye.position[0])
    y: Pixels = depth * ways[1][where] + np.float32(eye.position[1])
    # a pixel's extent on the ground is larger along the ray than across it
    stretch = np.maximum(np.float32(1.0), np.float32(0.35 / abs(eye.position[2])) * depth)
    step: Pixels = (depth * np.float32(1 / eye.lens.fx) * stretch).astype(np.float32)
    wave = (_wave(x, step) * _wave(y, step)).astype(np.float32, copy=False)
    wave *= np.clip(np.float32(1.6) - step / np.float32(SQUARE), 0.0, 1.0)
    mist = np.exp(depth * np.float32(-1 / HAZE))
    clear = 1 - mist
    for plane, light, dark, horizon in zip(planes, *_paints(GROUND_LIGHT, GROUND_DARK, HORIZON), strict=True):
        plane[where] = ((light + dark) / 2 + (light - dark) / 2 * wave) * mist + horizon * clear


def _wave(x: Pixels, step: Pixels) -> Pixels:
    """Return a square wave between 1 and -1, with edges one pixel wide."""
    period = np.float32(2 * SQUARE)
    x = x / period + np.float32(0.25)
    x -= np.floor(x)
    edge = np.float32(SQUARE / 2) - np.abs(x * period - np.float32(SQUARE))
    soft: Pixels = np.clip(edge / (0.5 * step), -1.0, 1.0)
    return soft


def face_colours(eye: Eye, scene: Scene) -> Floats:
    """Return the colours (n, 3) of the lit faces; a thin wall shows the side that faces the camera."""
    normals = scene.normals
    towards = (normals * (eye.position - scene.faces[:, 0])).sum(axis=1)
    normals = np.where((scene.thin & (towards < 0))[:, None], -normals, normals)
    colours: Floats = scene.paints * lit(normals)[:, None]
    return colours


def _colours(eye: Eye, scene: Scene, near: Pixels, number: Ints, things: Ints, ways: Ways) -> Pixels:
    """Return the colours (3, n) of the pixels that show an object, in the light."""
    shown, faces = number[things], len(scene.faces)
    table = np.zeros((faces + len(scene.rods) + len(scene.balls), 3), dtype=np.float32)
    table[:faces] = face_colours(eye, scene)
    colours: Pixels = np.stack([column[shown] for column in np.ascontiguousarray(table.T)])
    bent = np.flatnonzero(shown >= faces)
    if len(bent):
        where = things[bent]
        colours[:, bent] = _round(eye, scene, near[where], shown[bent] - faces, [way[where] for way in ways])
    return colours


def _round(eye: Eye, scene: Scene, near: Pixels, number: Ints, ways: Sequence[Pixels]) -> Pixels:
    """Return the colours (3, n) of cylinders and balls, whose normals follow from the visible points."""
    rods = len(scene.rods)
    depth = np.reciprocal(near)
    x, y, z = (depth * way + np.float32(e) for e, way in zip(eye.position, ways, strict=True))
    shine = np.empty(len(number), dtype=np.float32)
    lx, ly, lz = LIGHT.astype(np.float32)
    rod, ball = np.flatnonzero(number < rods), np.flatnonzero(number >= rods)
    if len(rod):
        cx, cy, radius, bottom, top = (column[number[rod]] for column in scene.rods.T.astype(np.float32))
        bright = ((x[rod] - cx) * lx + (y[rod] - cy) * ly) / radius
        height = np.float32(eye.position[2])
        bright[(height > top) & (z[rod] > top - np.float32(1e-4))] = lz
        bright[(height < bottom) & (z[rod] < bottom + np.float32(1e-4))] = -lz
        shine[rod] = bright
    if len(ball):
        cx, cy, cz, radius = (column[number[ball] - rods] for column in scene.balls.T.astype(np.float32))
        shine[ball] = ((x[ball] - cx) * lx + (y[ball] - cy) * ly + (z[ball] - cz) * lz) / radius
    shine = np.float32(AMBIENT) + np.float32(DIFFUSE) * shine
    paints = np.concatenate([scene.rod_paints, scene.ball_paints]).astype(np.float32)
    return np.stack([column[number] * shine for column in paints.T])
