"""Clip primitives to the region in front of the eye, for perspective drawing, and turn maps into rectangles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import matrix_product

from .primitives import Floats, Lines, Mesh, Pixels, Points, Primitive, Texture
from .projection import Perspective

NEAR = 0.05
"""Minimum distance from the eye at which things are drawn [m]."""
STEPS = (16, 32, 64)
"""Steps to which colour channels are rounded if a map has too many colours."""


def clipped(primitive: Primitive, projection: Perspective) -> Primitive:
    """Return a primitive without the parts behind the eye."""
    if isinstance(primitive, Points):
        ahead = _distances(primitive.points, projection) > NEAR
        colours = primitive.colours if primitive.colours.ndim == 1 else primitive.colours[ahead]
        return replace(primitive, points=primitive.points[ahead], colours=colours)
    if isinstance(primitive, Mesh):
        faced = (_distances(primitive.placed, projection) > NEAR)[primitive.faces].all(axis=1)
        colours = primitive.colours if primitive.colours.ndim == 1 else primitive.colours[faced]
        return replace(primitive, faces=primitive.faces[faced], colours=colours)
    if isinstance(primitive, Lines):
        return _clipped_lines(primitive, projection)
    return primitive


def _distances(points: Floats, projection: Perspective) -> Floats:
    """Return the distance (n,) of points (n, 3) ahead of the eye [m]."""
    return -projection.nearness(points)


def _clipped_lines(lines: Lines, projection: Perspective) -> Lines:
    """Clip segments in front of the eye."""
    distances = _distances(lines.points, projection)
    if not len(distances) or distances.min() > NEAR:
        return lines
    segments, colours = lines.segments(), lines.segment_colours()
    first, last = (_distances(segments[:, i], projection) for i in (0, 1))
    kept = np.maximum(first, last) > NEAR
    segments, first, last = segments[kept].copy(), first[kept], last[kept]
    part = (NEAR - first) / np.where(first == last, 1.0, last - first)
    at = segments[:, 0] + part[:, None] * (segments[:, 1] - segments[:, 0])
    for i, ends in enumerate((first, last)):
        behind = ends < NEAR
        segments[behind, i] = at[behind]
    if colours.ndim == 2:
        colours = np.repeat(colours[kept], 2, axis=0)
    return Lines(segments.reshape(-1, 3), colours, lines.width, strip=False)


def rectangles(texture: Texture, projection: Perspective, most: int) -> Iterator[tuple[Floats, list[Floats]]]:
    """Yield each colour (4,) of a map, 0 to 1 and opaque, with its outlines (n, 2) [px]: at most `most` of them."""
    attempts = (_outlines(pixels, texture, projection, most) for pixels in _coarser(texture.pixels))
    outlines = next((found for found in attempts if found is not None), {})
    for colour, several in sorted(outlines.items()):
        yield np.append(np.frombuffer(colour, dtype=np.uint8) / 255, 1.0), several


def _coarser(pixels: Pixels) -> Iterator[Pixels]:
    """Yield a map as it is, in fewer colours, and then with larger and larger cells."""
    yield pixels
    for step in STEPS:
        reduced = pixels.copy()
        reduced[..., :3] = np.minimum((pixels[..., :3].astype(int) + step // 2) // step * step, 255)
        yield reduced
    while max(reduced.shape[:2]) > 1:
        reduced = reduced[::2, ::2]
        yield reduced


def _outlines(pixels: Pixels, texture: Texture, projection: Perspective, most: int) -> dict[bytes, list[Floats]] | None:
    """Return the outlines of each colour within the picture, or None if there are more than `most`."""
    cell = np.array(texture.size) / (pixels.shape[1], pixels.shape[0])
    outlines: dict[bytes, list[Floats]] = {}
    count = 0
    for x0, y0, x1, y1 in _rectangles(pixels):
        flat = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]) * cell
        corners = matrix_product(np.column_stack([flat, np.zeros(4)]), texture.pose[:3, :3].T) + texture.pose[:3, 3]
        corners = _clipped_polygon(corners, _distances(corners, projection))
        if len(corners) < 3:
            continue
        outline = projection.pixels(corners)
        if (outline.max(axis=0) > 0).all() and (outline.min(axis=0) < (projection.width, projection.height)).all():
            if (count := count + 1) > most:
                return None
            outlines.setdefault(pixels[y0, x0, :3].tobytes(), []).append(outline)
    return outlines


def _rectangles(pixels: Pixels) -> list[tuple[int, int, int, int]]:
    """Return rectangles of one colour (x0, y0, x1, y1) that cover the visible cells, by joining equal runs of rows."""
    packed = np.ascontiguousarray(pixels).view(np.uint32)[..., 0]
    found: list[tuple[int, int, int, int]] = []
    growing: dict[tuple[int, int, int], int] = {}
    for y in range(len(packed) + 1):
        runs = _runs(packed[y], pixels[y, :, 3]) if y < len(packed) else []
        over = set(growing).difference(runs)
        found += [(x0, growing.pop((x0, x1, colour)), x1, y) for x0, x1, colour in sorted(over)]
        for run in runs:
            growing.setdefault(run, y)
    return found


def _runs(row: NDArray[np.uint32], alphas: NDArray[np.uint8]) -> list[tuple[int, int, int]]:
    """Return start, end and colour of the runs of equal cells, without transparent ones."""
    edges = [0, *(np.flatnonzero(np.diff(row)) + 1).tolist(), len(row)]
    return [(x0, x1, int(row[x0])) for x0, x1 in pairwise(edges) if alphas[x0]]


def _clipped_polygon(corners: Floats, distances: Floats) -> Floats:
    """Clip a polygon (n, 3) in front of the eye."""
    if (distances > NEAR).all():
        return corners
    kept: list[Floats] = []
    for i, (a, b) in enumerate(zip(corners, np.roll(corners, -1, axis=0), strict=True)):
        here, there = distances[i] - NEAR, distances[(i + 1) % len(distances)] - NEAR
        if here > 0:
            kept.append(a)
        if (here > 0) != (there > 0):
            kept.append(a + here / (here - there) * (b - a))
    return np.array(kept).reshape(-1, 3)
