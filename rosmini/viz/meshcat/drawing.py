"""The still picture of a scene: an SVG in the perspective in which the viewer begins.

Faces that look away are left out; the others are painted from far to near, each thing as a whole, since things stand
beside one another. Fine detail is left out too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rosmini.viz import style
from rosmini.viz.rounding import snap
from rosmini.viz.svg import document, element

from .scene3d import Camera, Scene3D, grid
from .solid_order import painting_order
from .solids import Part, Prism, Solid, triangulate
from .surfaces import LinkPart, triangles_in_world
from .triangle_order import painting_order as painting_order_of_triangles

Floats = NDArray[np.float64]

WIDTH, HEIGHT = 760, 420
NEAR = 0.02
SUN = np.array([0.25, -0.42, 0.87])
THINGS = ("group-fill", "group-line", "vermilion")


def draw(scene: Scene3D, *, title: str, alt: str) -> str:
    """The scene as an SVG."""
    look = _Look(scene.camera)
    body = [*_ground(scene, look), *_trails(scene, look)]
    groups = _groups(scene)
    described = _described(scene)
    first = len(groups)
    outlines = [outline for outline, _ in groups] + [outline for outline, _ in described]
    solid = [
        *(np.vstack([face for _, each, at in group for face in _faces(each, at)]) for _, group in groups),
        *(_corners(scene, parts) for _, parts in described),
    ]
    spans = [(float(snap(each[:, 2].min())), float(snap(each[:, 2].max()))) for each in solid]
    order = painting_order(outlines, look.position, spans, [look.box(each) for each in solid])
    # Laser points are on what is seen from the robot: in the picture, all that is farther than the robot.
    robot = next((n for n, i in enumerate(order) if i >= first or _robot(groups[i][1][0][0])), len(order))
    for n, i in enumerate(order):
        if n == robot:
            body += _scans(scene, look)
        body += (
            _painted_surfaces(look, scene, described[i - first][1])
            if i >= first
            else _painted(look, groups[i][1])
        )
    colours = [*THINGS, *(trail.colour for trail in scene.trails if trail.colour not in THINGS)]
    return document(
        element("g", "".join(body), stroke_linejoin="round", stroke_linecap="round", stroke_width=0.8),
        width=WIDTH, height=HEIGHT, title=title, alt=alt, css="", colours=colours,
    )  # fmt: skip


class _Look:
    """The camera as a projection."""

    def __init__(self, camera: Camera) -> None:
        self.position = camera.position
        ahead = camera.target - self.position
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        self._axes = np.array([right, np.cross(right, ahead), ahead])
        self._scale = HEIGHT / 2 / math.tan(math.radians(camera.field_of_view / 2))

    def points(self, face: Floats) -> Floats:
        """The picture (m, 2) of a polygon (n, 3), without what is behind the camera."""
        seen = _before((face - self.position) @ self._axes.T)
        if len(seen) == 0:
            return np.empty((0, 2))
        flat = seen[:, :2] / seen[:, 2:] * self._scale
        return snap(np.column_stack([WIDTH / 2 + flat[:, 0], HEIGHT / 2 - flat[:, 1]]), 0.1)

    def box(self, corners: Floats) -> tuple[float, float, float, float]:
        """What is around the picture of a thing with these corners (n, 3): x0, y0, x1, y1."""
        seen = (corners - self.position) @ self._axes.T
        if (seen[:, 2] < NEAR).any():  # it reaches behind the camera
            return (-math.inf, -math.inf, math.inf, math.inf)
        flat = snap(seen[:, :2] / seen[:, 2:] * self._scale, 0.1)
        (x0, y0), (x1, y1) = flat.min(axis=0).tolist(), flat.max(axis=0).tolist()
        return (x0, y0, x1, y1)

    def path(self, face: Floats, *, closed: bool = True) -> str:
        """The picture of a polygon or of a line as path data; empty where it is out of the picture."""
        points = self.points(face)
        inside = (
            len(points) > 1
            and (points.max(axis=0) > 0).all()
            and (points.min(axis=0) < (WIDTH, HEIGHT)).all()
        )
        if not inside:
            return ""
        return "M" + "L".join(f"{x:.5g},{y:.5g}" for x, y in points) + ("Z" if closed else "")

    def facing(self, triangles: Floats) -> NDArray[np.int64]:
        """Which triangles (n, 3, 3) are wholly before the camera and look at it."""
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 1])
        size = np.linalg.norm(normals, axis=1)
        towards = ((self.position - triangles.mean(axis=1)) * normals).sum(axis=1)
        ahead = (((triangles - self.position) @ self._axes.T)[:, :, 2] >= NEAR).all(axis=1)
        return np.flatnonzero(ahead & (size > 1e-12) & (towards > 1e-9 * size))

    def projected(self, triangles: Floats) -> Floats:
        """Of each corner (n, 3, 3) its place in the picture [px] and how far ahead it is [m]."""
        seen = (triangles - self.position) @ self._axes.T
        flat = seen[:, :, :2] / seen[:, :, 2:] * self._scale
        return np.dstack([WIDTH / 2 + flat[:, :, 0], HEIGHT / 2 - flat[:, :, 1], seen[:, :, 2]])


def _before(points: Floats) -> Floats:
    """A polygon (n, 3) in the camera's frame, cut at the plane `NEAR` before it."""
    if (points[:, 2] >= NEAR).all():
        return points
    kept = []
    for a, b in zip(points, np.roll(points, -1, axis=0), strict=True):
        if a[2] >= NEAR:
            kept.append(a)
        if (a[2] >= NEAR) != (b[2] >= NEAR):
            kept.append(a + (NEAR - a[2]) / (b[2] - a[2]) * (b - a))
    return np.array(kept)


def _ground(scene: Scene3D, look: _Look) -> Iterator[str]:
    x0, y0, x1, y1 = scene.bounds
    floor = np.array([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)], dtype=float)
    yield element("path", d=look.path(floor), fill=style.variable("group-fill"))
    lines = (look.path(np.array([(*a, 0.0), (*b, 0.0)]), closed=False) for a, b in grid(scene.bounds))
    path = "".join(lines)
    if path:
        yield element(
            "path", d=path, fill="none", stroke=style.variable("group-line"), stroke_width=0.6, opacity=0.6
        )


def _trails(scene: Scene3D, look: _Look) -> Iterator[str]:
    for trail in scene.trails:
        steps = zip(trail.points, trail.points[1:], strict=False)
        path = "".join(look.path(np.array([(*a, 0.0), (*b, 0.0)]), closed=False) for a, b in steps)
        if path:
            yield element("path", d=path, fill="none", stroke=style.variable(trail.colour), stroke_width=2.5)


def _scans(scene: Scene3D, look: _Look) -> Iterator[str]:
    for scan in scene.scans:
        dots = (look.points(point[None, :]) for point in scan)
        inside = (dot[0] for dot in dots if len(dot) and (dot > 0).all() and (dot < (WIDTH, HEIGHT)).all())
        path = "".join(f"M{x:.5g},{y:.5g}h0" for x, y in inside)
        if path:
            yield element("path", d=path, fill="none", stroke=style.variable("vermilion"), stroke_width=3)


Group = list[tuple[Part, Solid, Floats]]
"""Solids that are painted as one thing, each with its part and where its node is: an obstacle, a wall, a robot."""


def _groups(scene: Scene3D) -> list[tuple[Floats, Group]]:
    """The things with their convex outlines (n, 2) on the ground."""
    found: list[tuple[Floats, Group]] = []
    robots: dict[str, Group] = {}
    for part in scene.parts:
        place = scene.transform(part.node)
        if part.fine:
            continue
        solids = [(part, solid, place) for solid in part.solids]
        if _robot(part):
            robots.setdefault("/".join(part.node.split("/")[:2]), []).extend(solids)
            continue
        for item in solids:
            found += [
                (_outline([(part, piece, place)], np.eye(4)), [(part, piece, place)])
                for piece in _convex(item[1])
            ]
    return found + [(_outline(group, scene.transform(name)), group) for name, group in robots.items()]


def _described(scene: Scene3D) -> list[tuple[Floats, list[LinkPart]]]:
    """The robots that are drawn from their description, with the rectangles around them along their own axes."""
    robots: dict[str, list[LinkPart]] = {}
    for part in scene.surfaces:
        robots.setdefault("/".join(part.node.split("/")[:2]), []).append(part)
    return [(_around(_corners(scene, parts), scene.transform(name)), parts) for name, parts in robots.items()]


def _corners(scene: Scene3D, parts: list[LinkPart]) -> Floats:
    """The corners (n, 3) of surfaces in the world."""
    return np.vstack([triangles_in_world(part, scene.transform(part.node)).reshape(-1, 3) for part in parts])


def _painted_surfaces(look: _Look, scene: Scene3D, parts: list[LinkPart]) -> Iterator[str]:
    """The triangles of a robot that one sees, those of one colour that follow one another as one path."""
    corners = np.vstack([triangles_in_world(part, scene.transform(part.node)) for part in parts])
    colours = [part.colour for part in parts for _ in range(len(part.surface.faces))]
    faces = look.facing(corners)
    order = painting_order_of_triangles(look.projected(corners[faces]), WIDTH, HEIGHT)
    last, way = "", ""
    for i in (int(faces[j]) for j in order):
        shaded = _shaded(look, corners[i], colours[i])
        if shaded is None:
            continue
        if shaded[2] != last and way:
            yield element("path", d=way, fill=last, stroke=last)
            way = ""
        last, way = shaded[2], way + shaded[1]
    if way:
        yield element("path", d=way, fill=last, stroke=last)


def _robot(part: Part) -> bool:
    return part.node.startswith("robots/")


def _convex(solid: Solid) -> list[Solid]:
    """A prism with an inner corner as prisms without one."""
    if not isinstance(solid, Prism):
        return [solid]
    along = np.roll(solid.outline, -1, axis=0) - solid.outline
    turns = along[:, 0] * np.roll(along[:, 1], -1) - along[:, 1] * np.roll(along[:, 0], -1)
    if (turns >= -1e-9).all():
        return [solid]
    return [Prism(solid.outline[corners], solid.bottom, solid.top) for corners in triangulate(solid.outline)]


def _outline(group: Group, place: Floats) -> Floats:
    """The outline of a single solid; of several, the rectangle around them along the axes of `place`."""
    if len(group) == 1:
        _, solid, at = group[0]
        flat = solid.outline if isinstance(solid, Prism) else next(iter(solid.faces()))[:, :2]
        return np.asarray(flat @ at[:2, :2].T + at[:2, 3])
    corners = np.vstack([face for _, solid, at in group for face in _faces(solid, at)])
    return _around(corners, place)


def _around(corners: Floats, place: Floats) -> Floats:
    """The rectangle (4, 2) around points (n, 3) along the axes of `place`."""
    own = (corners - place[:3, 3]) @ place[:3, :3]
    (x0, y0), (x1, y1) = own[:, :2].min(axis=0), own[:, :2].max(axis=0)
    box = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    return np.asarray(box @ place[:2, :2].T + place[:2, 3])


def _faces(solid: Solid, place: Floats) -> Iterator[Floats]:
    for face in solid.faces():
        yield face @ place[:3, :3].T + place[:3, 3]


def _painted(look: _Look, group: Group) -> Iterator[str]:
    """The faces of a group that look at the camera: what stands lower first, and the farther first."""

    def away(item: tuple[Part, Solid, Floats]) -> float:
        corners = np.vstack(list(_faces(item[1], item[2])))
        return -float(snap(np.linalg.norm(corners.mean(axis=0) - look.position), 1e-6))

    def order(item: tuple[Part, Solid, Floats]) -> tuple[float, float]:
        return (float(snap(min(face[:, 2].min() for face in _faces(item[1], item[2])), 1e-5)), away(item))

    # A robot's body stands between its wheels.
    body: Group = []
    wheels: dict[str, Group] = {}
    for item in group:
        (wheels.setdefault(item[0].node, []) if item[0].node.count("/") > 1 else body).append(item)
    middle = _away(look, group[0][2])
    far: Group = []
    near: Group = []
    for wheel in wheels.values():
        (far if _away(look, wheel[0][2]) > middle else near).extend(wheel)
    sequence = [*far, *sorted(body, key=order), *near]
    for part, solid, place in sequence:
        shaded = [_shaded(look, face, part.colour) for face in _faces(solid, place)]
        seen = [item for item in shaded if item is not None]
        for _, path, colour in sorted(seen, key=lambda item: -item[0]):
            yield element("path", d=path, fill=colour, stroke=colour)


def _away(look: _Look, place: Floats) -> float:
    """How far a node is on the ground."""
    return float(np.linalg.norm(place[:2, 3] - look.position[:2]))


def _shaded(look: _Look, face: Floats, colour: str) -> tuple[float, str, str] | None:
    """How far a face is, its path and its colour in the light; None if it looks away or is out of the picture."""
    normal = np.cross(face[1] - face[0], face[2] - face[1])
    size = float(np.linalg.norm(normal))
    middle = face.mean(axis=0)
    if size < 1e-12 or float(normal @ (look.position - middle)) <= 1e-9 * size:
        return None
    path = look.path(face)
    if not path:
        return None
    light = 0.66 + 0.36 * max(0.0, float(normal @ SUN) / size)
    channels = (min(255.0, int(colour[i : i + 2], 16) * light) for i in (1, 3, 5))
    shade = "#" + "".join(f"{int(snap(channel, 1.0)):02x}" for channel in channels)
    return float(snap(np.linalg.norm(middle - look.position), 1e-6)), path, shade
