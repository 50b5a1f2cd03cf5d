"""The still picture of a scene: an SVG in the viewer's initial perspective.

Faces turned away and fine detail are left out; of the others, the visible ones are painted, farther ones first.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import inside, sides_of
from rosmini.core.geometry.products import matrix_product, norm, scalar_product
from rosmini.viz import style
from rosmini.viz.rounding import snap
from rosmini.viz.svg import document, element

from .scene3d import Camera, Scene3D, grid

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

WIDTH, HEIGHT = 760, 420
NEAR = 0.02
DEEP = 0.05
"""A laser's point up to this distance behind a face is still on it [m], because lasers have noise."""
SUN = np.array([0.25, -0.42, 0.87])
THINGS = ("group-fill", "group-line", "vermilion")


def draw(scene: Scene3D, *, title: str, alt: str) -> str:
    """Return the scene as an SVG."""
    view = _View(scene.camera)
    faces = [face for polygon, colour in _all_polygons(scene) if (face := view.face(polygon, colour)) is not None]
    planes = np.array([face.plane for face in faces]).reshape(-1, 3)
    depth_buffer = DepthBuffer([face.outline for face in faces], planes, WIDTH, HEIGHT)
    body = [*_ground(scene, view), *_trails(scene, view), *_paths([faces[i] for i in depth_buffer.order])]
    body += _scans(scene, view, depth_buffer)
    colours = [*THINGS, *(trail.colour for trail in scene.trails if trail.colour not in THINGS)]
    return document(
        element("g", "".join(body), stroke_linejoin="round", stroke_linecap="round", stroke_width=0.8),
        width=WIDTH, height=HEIGHT, title=title, alt=alt, css="", colours=colours,
    )  # fmt: skip


class _Face(NamedTuple):
    """A face turned towards the camera: its outline in the picture, its plane (see `DepthBuffer`), its lit colour."""

    outline: Floats
    plane: Floats
    colour: str


class _View:
    """The camera as a projection."""

    def __init__(self, camera: Camera) -> None:
        self.position = camera.position
        ahead = camera.target - self.position
        ahead /= norm(ahead)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right /= norm(right)
        self._axes = np.array([right, np.cross(right, ahead), ahead])
        self._scale = HEIGHT / 2 / math.tan(math.radians(camera.field_of_view / 2))

    def project(self, points: Floats) -> Floats:
        """Project a polygon or line (n, 3) to (m, 3): x, y [px], depth [m]; parts behind the camera are cut off."""
        seen = _clipped(matrix_product(points - self.position, self._axes.T))
        if not len(seen):
            return np.empty((0, 3))
        flat = seen[:, :2] / seen[:, 2:] * self._scale
        return np.column_stack([snap([WIDTH / 2, HEIGHT / 2] + flat * (1, -1), 0.1), seen[:, 2]])

    def path(self, points: Floats, *, closed: bool = True) -> str:
        """Return the projection of a polygon or line as path data; empty if it is outside the picture."""
        outline = self.project(points)[:, :2]
        return _path(outline, closed=closed) if _is_visible(outline) else ""

    def face(self, polygon: Floats, colour: str) -> _Face | None:
        """Project a flat polygon (n, 3) of a colour; None if it is turned away or outside the picture."""
        normal = np.cross(polygon[1] - polygon[0], polygon[2] - polygon[1])
        size = norm(normal)
        towards = scalar_product(normal, self.position - polygon[0])
        if size < 1e-12 or towards <= 1e-9 * size:
            return None
        outline = self.project(polygon)[:, :2]
        if not _is_visible(outline):
            return None
        across, up, ahead = -matrix_product(self._axes, normal) / towards
        plane = np.array([across, -up, ahead * self._scale - across * WIDTH / 2 + up * HEIGHT / 2]) / self._scale
        light = 0.66 + 0.36 * max(0.0, scalar_product(normal, SUN) / size)
        channels = (min(255.0, int(colour[i : i + 2], 16) * light) for i in (1, 3, 5))
        return _Face(outline, plane, "#" + "".join(f"{int(snap(channel, 1.0)):02x}" for channel in channels))


def _is_visible(outline: Floats) -> bool:
    """Return True if part of an outline (n, 2) may be in the picture."""
    return (
        len(outline) > 1
        and bool((outline.max(axis=0) > 0).all())
        and bool((outline.min(axis=0) < (WIDTH, HEIGHT)).all())
    )


def _path(outline: Floats, *, closed: bool = True) -> str:
    return "M" + "L".join(f"{x:.5g},{y:.5g}" for x, y in outline) + ("Z" if closed else "")


def _clipped(points: Floats) -> Floats:
    """Cut a polygon (n, 3) in the camera's frame at the plane `NEAR` in front of the camera."""
    if (points[:, 2] >= NEAR).all():
        return points
    kept = []
    for a, b in zip(points, np.roll(points, -1, axis=0), strict=True):
        if a[2] >= NEAR:
            kept.append(a)
        if (a[2] >= NEAR) != (b[2] >= NEAR):
            kept.append(a + (NEAR - a[2]) / (b[2] - a[2]) * (b - a))
    return np.array(kept)


def _ground(scene: Scene3D, view: _View) -> Iterator[str]:
    x0, y0, x1, y1 = scene.bounds
    floor = np.array([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)], dtype=float)
    yield element("path", d=view.path(floor), fill=style.variable("group-fill"))
    lines = (view.path(np.array([(*a, 0.0), (*b, 0.0)]), closed=False) for a, b in grid(scene.bounds))
    path = "".join(lines)
    if path:
        yield element("path", d=path, fill="none", stroke=style.variable("group-line"), stroke_width=0.6, opacity=0.6)


def _trails(scene: Scene3D, view: _View) -> Iterator[str]:
    for trail in scene.trails:
        steps = zip(trail.points, trail.points[1:], strict=False)
        path = "".join(view.path(np.array([(*a, 0.0), (*b, 0.0)]), closed=False) for a, b in steps)
        if path:
            yield element("path", d=path, fill="none", stroke=style.variable(trail.colour), stroke_width=2.5)


def _scans(scene: Scene3D, view: _View, depth_buffer: DepthBuffer) -> Iterator[str]:
    """Yield the points seen by lasers, except those that something hides."""
    for scan in scene.scans:
        dots = np.vstack([np.empty((0, 3)), *(view.project(point[None]) for point in scan)])
        inside = dots[((dots[:, :2] > 0) & (dots[:, :2] < (WIDTH, HEIGHT))).all(axis=1)]
        shown = [(x, y) for x, y, depth in inside.tolist() if not depth_buffer.hides(x, y, depth - DEEP)]
        path = "".join(f"M{x:.5g},{y:.5g}h0" for x, y in shown)
        if path:
            yield element("path", d=path, fill="none", stroke=style.variable("vermilion"), stroke_width=3)


def _all_polygons(scene: Scene3D) -> Iterator[tuple[Floats, str]]:
    """Yield all faces (n, 3) in the world and their colours; fine detail is left out."""
    for part in scene.parts:
        place = scene.transform(part.node)
        for solid in () if part.fine else part.solids:
            for face in solid.faces():
                yield matrix_product(face, place[:3, :3].T) + place[:3, 3], part.colour
    for link in scene.surfaces:
        place = scene.transform(link.node)
        for triangle in matrix_product(link.surface.triangles, place[:3, :3].T) + place[:3, 3]:
            yield triangle, link.colour


def _paths(faces: list[_Face]) -> Iterator[str]:
    """Yield faces in this order; consecutive ones of the same colour form one path."""
    for colour, alike in groupby(faces, key=lambda face: face.colour):
        yield element("path", d="".join(_path(face.outline) for face in alike), fill=colour, stroke=colour)


# -- visible faces -----------------------------------------------------------------------------------------------------


class DepthBuffer:
    """The order in which to paint flat polygons, and the depth of the nearest one at each pixel.

    `outlines` are their projections (n, 2) [px], and `planes` (n, 3) their depths: a b c, where 1 / depth is
    `a x + b y + c` at the pixel (x, y) [1/m].
    """

    def __init__(self, outlines: Sequence[Floats], planes: Floats, width: int, height: int) -> None:
        self._width, self._height = width, height
        self._nearest = np.zeros(width * height)
        """1 / depth [1/m]; 0 where there is no polygon."""
        self.order: list[int] = []
        """The visible polygons, by index."""
        polygon, pixel, inverse_depth = self._rasterise(outlines, planes)
        if not len(polygon):
            return
        order = np.lexsort((polygon, inverse_depth, pixel))
        polygon, pixel = polygon[order], pixel[order]
        last = np.append(pixel[1:] != pixel[:-1], True)
        self._nearest[pixel[last]] = inverse_depth[order][last]
        seen = np.unique(polygon[last])
        kept = np.isin(polygon, seen)
        polygon, pixel = polygon[kept], pixel[kept]
        shared = pixel[1:] == pixel[:-1]
        pairs, count = np.unique(
            np.column_stack([polygon[:-1][shared], polygon[1:][shared]]), axis=0, return_counts=True
        )
        far = snap([1 / _inverse_depths(outlines[i], planes[i]).min() for i in seen], 1e-6)
        self.order = _sorted(
            seen.tolist(), pairs.tolist(), count.tolist(), dict(zip(seen.tolist(), far.tolist(), strict=True))
        )

    def hides(self, x: float, y: float, depth: float) -> bool:
        """Return True if something is in front of a point of the picture [px] that is `depth` away [m]."""
        return bool(self._nearest[int(y) * self._width + int(x)] * depth > 1)

    def _rasterise(self, outlines: Sequence[Floats], planes: Floats) -> tuple[Ints, Ints, Floats]:
        """For every pixel whose centre a polygon covers, return the polygon, the pixel, and 1 / its depth there."""
        found: list[tuple[Ints, Ints, Floats]] = [(np.empty(0, int), np.empty(0, int), np.empty(0))]
        for i, outline in enumerate(outlines):
            x0, y0 = np.maximum(np.ceil(outline.min(axis=0) - 0.5), 0).astype(int)
            x1, y1 = np.minimum(np.floor(outline.max(axis=0) - 0.5), (self._width - 1, self._height - 1)).astype(int)
            if x0 > x1 or y0 > y1:
                continue
            x, y = (part.ravel() for part in np.meshgrid(np.arange(x0, x1 + 1), np.arange(y0, y1 + 1)))
            covered = inside(np.column_stack([x, y]) + 0.5, sides_of(outline))
            x, y = x[covered], y[covered]
            inverse_depth = _inverse_depths(np.column_stack([x, y]) + 0.5, planes[i])
            found.append((np.full(len(x), i), y * self._width + x, inverse_depth))
        polygon, pixel, inverse_depth = (np.concatenate(part) for part in zip(*found, strict=True))
        return polygon, pixel, inverse_depth


def _inverse_depths(points: Floats, plane: Floats) -> Floats:
    return snap(matrix_product(points, plane[:2]) + plane[2], 1e-7)


def _sorted(seen: list[int], pairs: list[tuple[int, int]], counts: list[int], far: dict[int, float]) -> list[int]:
    """Sort so that the first of every pair comes before the second; break cycles at the farthest."""
    votes = {(a, b): count for (a, b), count in zip(pairs, counts, strict=True)}
    after: dict[int, list[int]] = {i: [] for i in seen}
    waiting = dict.fromkeys(seen, 0)
    for (a, b), count in votes.items():
        # where two faces intersect or touch, the majority of pixels decides
        if count > votes.get((b, a), 0) or (count == votes.get((b, a), 0) and a < b):
            after[a].append(b)
            waiting[b] += 1
    ready = [(-far[i], i) for i in seen if waiting[i] == 0]
    heapq.heapify(ready)
    left = {i: (-far[i], i) for i in seen}
    result: list[int] = []
    while left:
        i = heapq.heappop(ready)[1] if ready else min(left.values())[1]
        if i not in left:
            continue
        del left[i]
        result.append(i)
        for j in after[i]:
            waiting[j] -= 1
            if waiting[j] == 0 and j in left:
                heapq.heappush(ready, (-far[j], j))
    return result
