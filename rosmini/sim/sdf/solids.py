"""Shapes of SDF in a flat world: upright solids, each an outline on the ground with a bottom and a top.

Upright shapes are kept as they are. A lying or tilted shape is replaced with its shadow: its outline seen from above,
from its lowest to its highest point. A mesh is cut horizontally at several heights, and each cut represents a layer
of the mesh.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry import polygons
from rosmini.core.geometry.poses import Pose, compose
from rosmini.core.geometry.products import matrix_product, norm
from rosmini.sim.geometry.slices import convex_hull, cut, loops, pieces, thinned
from rosmini.sim.shapes import Box, Cylinder, Polygon, Simple, Sphere
from rosmini.sim.urdf.meshes import MeshError, read

from .document import Pose6, SdfGeometry
from .poses import matrix, upright

Floats = NDArray[np.float64]
Triangles = NDArray[np.float64]
"""(n, 3, 3): the three vertices x, y, z [m] of each triangle."""

FLAT = 0.01
"""Parts that are no higher than this above the ground [m] belong to the ground: wheels roll over them."""
LEVELS = (0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0, 2.0)
"""Heights above the ground between which a mesh is cut [m], unless its own vertices have few heights."""
STEPS = 8
"""Maximum number of heights of vertices that counts as few."""
GRAIN = 0.002
"""Maximum deviation of a mesh's outline from the cut [m]; larger if it would have more than `CORNERS` corners."""
CORNERS = 60
ROUND = 64
"""Number of vertices that replace a slanted circle."""
MAX_CUT_TRIANGLES = 10_000_000
"""Maximum number of triangles that are cut for one world, counted once for each height and with `OF_A_CUT` added."""
OF_A_CUT = 5_000
"""The cost of one cut through a mesh, in triangles, in addition to its own."""


@dataclass(frozen=True)
class Solid:
    """An upright solid part."""

    shape: Simple
    pose: Pose
    bottom: float
    top: float


Found = tuple[list[Solid], str]
"""Solids, and what a reader should know about them ("" if nothing)."""


@dataclass
class Meshes:
    """The meshes of one world, each cut once for all its places on the ground."""

    work: int = 0
    """Number of triangles cut so far, as `MAX_CUT_TRIANGLES` counts them."""
    _found: dict[tuple[object, ...], Found] = field(default_factory=dict)

    def solids(self, geometry: SdfGeometry, pose: Pose6, *, sliced: bool) -> Found:
        """Return the solids of a mesh at a pose. Raises `MeshError`."""
        x, y, z, roll, pitch, yaw = pose
        key = (geometry.mesh, geometry.submesh, geometry.scale, z, roll, pitch, sliced)
        if key not in self._found:
            self._found[key] = self._cut(geometry, (0.0, 0.0, z, roll, pitch, 0.0), sliced=sliced)
        found, note = self._found[key]
        placed = [replace(each, pose=compose((x, y, yaw), each.pose)) for each in found]
        return placed, note

    def _cut(self, geometry: SdfGeometry, pose: Pose6, *, sliced: bool) -> Found:
        if geometry.mesh is None:
            raise MeshError("a mesh has no file")
        surfaces = read(geometry.mesh, geometry.submesh)
        if self.work > MAX_CUT_TRIANGLES:
            ends = np.array([end for each in surfaces for end in each.bounds])
            box = np.array(list(product(*zip(ends.min(axis=0), ends.max(axis=0), strict=True))))
            note = "is one of too many different meshes: it is taken as the box around it"
            return _shadow(_moved(box * geometry.scale, pose)), note
        triangles = np.concatenate([each.triangles for each in surfaces])
        triangles = _moved((triangles * geometry.scale).reshape(-1, 3), pose).reshape(-1, 3, 3)
        heights = _heights(triangles[..., 2]) if sliced else []
        self.work += max(1, len(heights)) * (len(triangles) + OF_A_CUT)
        return _sliced(triangles, heights) if sliced else (_shadow(triangles.reshape(-1, 3)), "")


def solids(geometry: SdfGeometry, pose: Pose6, meshes: Meshes, *, sliced: bool = True) -> Found:
    """Return the solids of a shape at a pose in a flat world.

    With `sliced=False` a mesh is one solid: the convex hull of its shadow. Raises `MeshError`.
    """
    if geometry.kind == "mesh":
        return meshes.solids(geometry, pose, sliced=sliced)
    maker = _MAKERS.get(geometry.kind)
    return maker(geometry, pose) if maker else ([], "")


def _standing(shape: Simple, pose: Pose6, bottom: float, top: float) -> list[Solid]:
    return [Solid(shape, (pose[0], pose[1], pose[5]), bottom, top)]


def _shadow(points: Floats) -> list[Solid]:
    """Return the convex hull of points (n, 3), seen from above."""
    x, y = points[:, :2].mean(axis=0)
    hull = convex_hull(points[:, :2] - (x, y))
    if len(hull) < 3 or polygons.area(hull) < 1e-9:
        return []
    low, high = points[:, 2].min(), points[:, 2].max()
    return [Solid(_polygon(hull), (float(x), float(y), 0.0), float(low), float(high))]


def _polygon(outline: Floats) -> Polygon:
    return Polygon(tuple((float(x), float(y)) for x, y in outline))


def _moved(points: Floats, pose: Pose6) -> Floats:
    turn = matrix(pose)
    return matrix_product(points, turn[:3, :3].T) + turn[:3, 3]


def _aslant(pose: Pose6) -> str:
    """Return a remark if none of the axes of a pose is upright."""
    if (np.abs(np.abs(matrix(pose)[2, :3]) - 1) < 1e-6).any():
        return ""
    return "is tilted; it is replaced with its shadow, from its lowest to its highest point"


def _box(geometry: SdfGeometry, pose: Pose6) -> Found:
    x, y, z = geometry.size
    if upright(pose):
        return _standing(Box(x, y), pose, pose[2] - z / 2, pose[2] + z / 2), ""
    corners = np.array([(a, b, c) for a in (-x, x) for b in (-y, y) for c in (-z, z)]) / 2
    return _shadow(_moved(corners, pose)), _aslant(pose)


def _cylinder(geometry: SdfGeometry, pose: Pose6) -> Found:
    r, half = geometry.radius, geometry.length / 2
    if upright(pose):
        return _standing(Cylinder(r), pose, pose[2] - half, pose[2] + half), ""
    angles = np.arange(ROUND) * (2 * math.pi / ROUND)
    ring = np.stack([r * np.cos(angles), r * np.sin(angles)], axis=1)
    ends = np.vstack([np.column_stack([ring, np.full(ROUND, z)]) for z in (-half, half)])
    lying = abs(matrix(pose)[2, 2]) < 1e-6
    note = "lies on its side; it is replaced with its shadow, as wide at every height" if lying else _aslant(pose)
    return _shadow(_moved(ends, pose)), note


def _sphere(geometry: SdfGeometry, pose: Pose6) -> Found:
    r = geometry.radius
    return _standing(Sphere(r), pose, pose[2] - r, pose[2] + r), ""


def _plane(geometry: SdfGeometry, pose: Pose6) -> Found:
    up = matrix_product(matrix(pose)[:3, :3], geometry.normal)
    if up[2] < (1 - 1e-6) * norm(up):
        return [], "a plane that is not level is left out"
    return [], "a plane that is not at height 0 is left out; the ground is there" if abs(pose[2]) > 1e-3 else ""


def _polyline(geometry: SdfGeometry, pose: Pose6) -> Found:
    outlines = [np.array(outline) for outline in geometry.outlines]
    if not upright(pose):
        flat = np.vstack(outlines)
        ends = np.vstack([np.column_stack([flat, np.full(len(flat), z)]) for z in (0.0, geometry.length)])
        return _shadow(_moved(ends, pose)), _aslant(pose)
    found = [
        each
        for piece in pieces(outlines)
        for each in _standing(_polygon(piece), pose, pose[2], pose[2] + geometry.length)
    ]
    return found, ""


# ---- meshes ----


def _sliced(triangles: Triangles, heights: list[float]) -> Found:
    """Return the solids of a mesh that is cut between each two heights."""
    bands: list[tuple[list[Floats], float, float]] = []
    open_somewhere = False
    for low, high in pairwise(heights):
        segments = cut(triangles, (low + high) / 2)
        outlines = loops(segments)
        if outlines is None:
            open_somewhere = True
            outlines = [convex_hull(segments.reshape(-1, 2))]
        outlines = [thin for outline in outlines if (thin := _thin(outline)) is not None]
        if bands and bands[-1][2] == low and _same(outlines, bands[-1][0]):
            bands[-1] = (outlines, bands[-1][1], high)
        elif outlines:
            bands.append((outlines, low, high))
    found = [
        Solid(_polygon(piece), (0.0, 0.0, 0.0), low, high)
        for outlines, low, high in bands
        for piece in pieces(outlines)
    ]
    note = "is a mesh with holes in its surface: where a cut does not close, it is taken as the hull around it"
    return found, note if open_somewhere else ""


def _heights(z: Floats) -> list[float]:
    """Return the heights between which a mesh is cut."""
    low, high = max(0.0, float(z.min())), float(z.max())
    if high <= low:
        return []
    own = np.unique(np.round(z, 4))
    inner = own[(own > low + 1e-3) & (own < high - 1e-3)]
    levels = inner.tolist() if len(inner) <= STEPS else [level for level in LEVELS if low + 1e-3 < level < high - 1e-3]
    return [low, *levels, high]


def _thin(outline: Floats) -> Floats | None:
    grain = GRAIN
    thin = thinned(outline, grain)
    while len(thin) > CORNERS or (len(thin) > 3 and polygons.crossing_sides(thin) is not None and grain < 1.0):
        grain *= 2
        thin = thinned(outline, grain)
    return thin if len(thin) >= 3 and polygons.area(thin) > 1e-8 else None


def _same(a: list[Floats], b: list[Floats]) -> bool:
    return len(a) == len(b) and all(
        p.shape == q.shape and np.allclose(p, q, atol=1e-5) for p, q in zip(a, b, strict=True)
    )


_MAKERS = {"box": _box, "cylinder": _cylinder, "sphere": _sphere, "plane": _plane, "polyline": _polyline}
