"""From visible objects to pixels: the object that each pixel shows, and its depth.

A pixel (u, v) looks along r = ((u - cx) / fx, (v - cy) / fy, 1) in the frame of the camera. A flat face with the
corners P_i covers it if r is on the inner side of each plane through the camera and two neighbouring corners, that is
if (P_i x P_i+1) . r has the same sign for all i; and the inverse of the depth at which r meets the face's plane n . P =
d is n . r / d. Both are linear in u and v, so no corner has to be in front of the camera and nothing is clipped (Olano
and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997). The nearest face wins; of two at the
same depth, the one drawn first.

Cylinders and balls meet r at the solution of a quadratic equation.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import matrix_product, norms

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SLACK = 1e-9
"""Tolerance, relative to its length, of a corner's plane: adjacent faces have no gap between them."""

GROUND = -1
"""Number of a pixel without an object: the ground or the sky."""


class Lens(NamedTuple):
    """How a camera projects a point (X right, Y down, Z ahead): u = fx X / Z + cx, v = fy Y / Z + cy."""

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    near: float
    far: float


class Eye(NamedTuple):
    """A camera in the world: its position (3,), and the directions right, down and ahead as rows (3, 3)."""

    position: Floats
    axes: Floats
    lens: Lens

    def seen(self, points: Floats) -> Floats:
        """Transform points (n, 3) of the world to the frame of the camera: X to the right, Y down, Z ahead [m]."""
        return matrix_product(points - self.position, self.axes.T)

    def project(self, points: Floats) -> Floats:
        """Return the positions of points (n, 3) of the world on the image, and their depths: u, v and depth (n, 3).

        Behind the camera the depth is negative.
        """
        x, y, z = self.seen(np.asarray(points, dtype=float).reshape(-1, 3)).T
        lens = self.lens
        return np.column_stack([lens.fx * x / z + lens.cx, lens.fy * y / z + lens.cy, z])

    def rays(self) -> Floats:
        """Return the coefficients (3, 3) of a pixel's ray d, per metre of depth: d_i = row i . (1, u, v)."""
        lens = self.lens
        right, down, ahead = self.axes[0] / lens.fx, self.axes[1] / lens.fy, self.axes[2]
        return np.column_stack([ahead - right * lens.cx - down * lens.cy, right, down])


class Plan(NamedTuple):
    """The visible faces, prepared: coefficients that are linear in u and v, and bounding boxes on the image."""

    number: Ints
    """(n,): index of the face."""
    edges: Floats
    """(n, 4, 3): inside if a + b u + c v >= 0 for each edge."""
    inverse: Floats
    """(n, 3): the inverse depth is a + b u + c v."""
    box: Ints
    """(n, 4): first and last column, first and last row."""


def plan(corners: Floats, seen: NDArray[np.bool_], lens: Lens) -> Plan:
    """Prepare faces (n, 4, 3), in the frame of the camera.

    Faces that are not `seen`, or outside the image, are left out.
    """
    number = np.flatnonzero(
        seen & (corners[:, :, 2].max(axis=1) > lens.near) & (corners[:, :, 2].min(axis=1) < lens.far)
    )
    corners = corners[number]
    box = _boxes(corners, lens)
    inside = (box[:, 0] <= box[:, 1]) & (box[:, 2] <= box[:, 3])
    number, corners, box = number[inside], corners[inside], box[inside]
    planes = np.cross(corners, np.roll(corners, -1, axis=1))
    middle = corners.mean(axis=1)
    side = (planes * middle[:, None]).sum(axis=2)
    planes *= np.where(side < 0, -1.0, 1.0)[..., None]
    slack = SLACK * norms(planes)
    edges = _linear(planes, lens)
    edges[..., 0] += slack
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    distance = (across * middle).sum(axis=1)
    flat = distance == 0  # seen edge-on
    inverse = _linear(across / np.where(flat, 1.0, distance)[:, None], lens)
    return Plan(number[~flat], edges[~flat], inverse[~flat], box[~flat])


def _linear(planes: Floats, lens: Lens) -> Floats:
    """Return `planes . r` (..., 3) as the coefficients of 1, u and v."""
    b, c = planes[..., 0] / lens.fx, planes[..., 1] / lens.fy
    return np.stack([planes[..., 2] - b * lens.cx - c * lens.cy, b, c], axis=-1)


def _boxes(corners: Floats, lens: Lens) -> Ints:
    """Return bounding boxes (n, 4) on the image of faces (n, 4, 3)."""
    here, there = corners, np.roll(corners, -1, axis=1)
    z, onward = here[..., 2], there[..., 2]
    crossing = (z < lens.near) != (onward < lens.near)
    share = np.where(crossing, lens.near - z, 0.0) / np.where(crossing, onward - z, 1.0)
    cut = here + share[..., None] * (there - here)
    points = np.concatenate([here, cut], axis=1)
    valid = np.concatenate([z >= lens.near, crossing], axis=1)
    depth = np.where(valid, np.maximum(points[..., 2], lens.near), 1.0)
    u = lens.fx * points[..., 0] / depth + lens.cx
    v = lens.fy * points[..., 1] / depth + lens.cy
    return _pixels(
        np.where(valid, u, np.inf).min(axis=1),
        np.where(valid, u, -np.inf).max(axis=1),
        np.where(valid, v, np.inf).min(axis=1),
        np.where(valid, v, -np.inf).max(axis=1),
        lens,
    )


def _pixels(left: Floats, right: Floats, top: Floats, bottom: Floats, lens: Lens) -> Ints:
    """Return the pixels between borders, as (n, 4)."""
    return np.stack(
        [
            np.ceil(np.clip(left - 1e-6, 0, lens.width)),
            np.floor(np.clip(right + 1e-6, -1, lens.width - 1)),
            np.ceil(np.clip(top - 1e-6, 0, lens.height)),
            np.floor(np.clip(bottom + 1e-6, -1, lens.height - 1)),
        ],
        axis=1,
    ).astype(np.int64)


def boxes_around(low: Floats, high: Floats, eye: Eye) -> Ints:
    """Return image bounding boxes (n, 4) of objects in upright boxes from `low` to `high` (n, 3) in the world."""
    x0, y0, z0 = low.T
    x1, y1, z1 = high.T
    sides = np.stack(
        [
            np.stack([np.column_stack([x, y, z]) for x, y,
                z in ((xa, ya, z0), (xb, yb, z0), (xb, yb, z1), (xa, ya, z1))], axis=1)
            for xa, ya, xb, yb in ((x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0))
        ],
        axis=1,
    )  # fmt: skip
    each = _boxes(eye.seen(sides.reshape(-1, 3)).reshape(-1, 4, 3), eye.lens).reshape(-1, 4, 4)
    box: Ints = np.where([True, False, True, False], each.min(axis=1), each.max(axis=1))
    nothing = (each[..., 0] > each[..., 1]) | (each[..., 2] > each[..., 3])
    box[nothing.all(axis=1)] = (0, -1, 0, -1)
    return box


def draw(plan: Plan, lens: Lens, inverse: Floats, shown: Ints) -> None:
    """Draw faces into the inverse depth `inverse` (h, w) and the number `shown` (h, w) of the nearest object so far."""
    columns, rows = np.arange(lens.width, dtype=np.float64), np.arange(lens.height, dtype=np.float64)
    most, least = 1.0 / lens.near, 1.0 / lens.far
    for number, edges, (a, b, c), (left, right, top, bottom) in zip(
        plan.number.tolist(), plan.edges.tolist(), plan.inverse.tolist(), plan.box.tolist(), strict=True
    ):
        v = rows[top : bottom + 1]
        first, last = np.full(len(v), float(left)), np.full(len(v), float(right))
        for ea, eb, ec in edges:
            rest = ea + ec * v
            if eb > 0:
                np.maximum(first, -rest / eb, out=first)
            elif eb < 0:
                np.minimum(last, -rest / eb, out=last)
            else:
                last[rest < 0] = -1.0
        some = np.flatnonzero(first <= last)
        if not len(some):
            continue
        top, bottom = top + int(some[0]), top + int(some[-1])
        first, last = first[some[0] : some[-1] + 1], last[some[0] : some[-1] + 1]
        left, right = math.ceil(first[some - some[0]].min()), math.floor(last.max())
        if left > right:
            continue
        window = (slice(top, bottom + 1), slice(left, right + 1))
        u, v = columns[left : right + 1], rows[top : bottom + 1]
        near = (a + c * v)[:, None] + b * u
        before = inverse[window]
        hit = near > before
        hit &= u >= first[:, None]
        hit &= u <= last[:, None]
        hit &= near <= most
        hit &= near >= least
        np.copyto(before, near, where=hit)
        np.copyto(shown[window], number, where=hit)


def draw_rods(
    first: int, rods: Floats, boxes: Ints, position: Floats, rays: Floats, lens: Lens, inverse: Floats, shown: Ints
) -> None:
    """Draw upright cylinders (m, 5), the first with the number `first`, in the same way as `draw`.

    A cylinder that contains the camera is invisible.
    """
    ex, ey, ez = position.tolist()
    for i, ((x, y, radius, bottom, top), box) in enumerate(zip(rods.tolist(), boxes.tolist(), strict=True)):
        ox, oy = ex - x, ey - y
        outside = ox * ox + oy * oy - radius * radius
        window, dx, dy, dz = _window(box, rays)
        if window is None:
            continue
        a, b = dx * dx + dy * dy, ox * dx + oy * dy
        left = b * b - a * outside
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = (-b - np.sqrt(left)) / a
            height = ez + depth * dz
            found = np.where((left >= 0) & (height >= bottom) & (height <= top) & (outside > 0), depth, np.inf)
            for level, beyond in ((top, ez > top), (bottom, ez < bottom)):
                if beyond:
                    flat = (level - ez) / dz
                    px, py = ox + flat * dx, oy + flat * dy
                    on = (px * px + py * py <= radius * radius) & (flat > 0)
                    found = np.where(on & (flat < found), flat, found)
        _put(found, first + i, window, lens, inverse, shown)


def draw_balls(
    first: int, balls: Floats, boxes: Ints, position: Floats, rays: Floats, lens: Lens, inverse: Floats, shown: Ints
) -> None:
    """Draw balls (k, 4) in the same way as `draw_rods`."""
    ex, ey, ez = position.tolist()
    for i, ((x, y, z, radius), box) in enumerate(zip(balls.tolist(), boxes.tolist(), strict=True)):
        ox, oy, oz = ex - x, ey - y, ez - z
        outside = ox * ox + oy * oy + oz * oz - radius * radius
        window, dx, dy, dz = _window(box, rays)
        if window is None or outside <= 0:
            continue
        a, b = dx * dx + dy * dy + dz * dz, ox * dx + oy * dy + oz * dz
        left = b * b - a * outside
        with np.errstate(invalid="ignore"):
            found = np.where(left >= 0, (-b - np.sqrt(left)) / a, np.inf)
        _put(found, first + i, window, lens, inverse, shown)


def _window(box: list[int], rays: Floats) -> tuple[tuple[slice, slice] | None, Floats, Floats, Floats]:
    """Return a window of the image, and the ray directions of its pixels."""
    left, right, top, bottom = box
    u, v = np.arange(left, right + 1, dtype=np.float64), np.arange(top, bottom + 1, dtype=np.float64)
    if not (len(u) and len(v)):
        return None, u, u, u
    x, y, z = ((a + c * v)[:, None] + b * u for a, b, c in rays.tolist())
    return (slice(top, bottom + 1), slice(left, right + 1)), x, y, z


def _put(depth: Floats, number: int, window: tuple[slice, slice], lens: Lens, inverse: Floats, shown: Ints) -> None:
    """Draw an object at `depth` where no nearer one is drawn."""
    hit = (depth >= lens.near) & (depth <= lens.far)
    near = np.where(hit, 1.0 / np.where(hit, depth, 1.0), -1.0)
    hit &= near > inverse[window]
    np.copyto(inverse[window], near, where=hit)
    np.copyto(shown[window], number, where=hit)
