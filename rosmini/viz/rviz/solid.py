"""Scenes in three dimensions: primitives as commands for meshcat's viewer, without a server (`rosmini.viz.meshcat`)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rosmini.core.geometry.products import matrix_product, norms
from rosmini.viz.meshcat.command_recorder import meshcat
from rosmini.viz.meshcat.scene3d import Camera, Scene3D
from rosmini.viz.meshcat.solids import rounded
from rosmini.viz.rounding import snap

from .gifs import gif, gif_url
from .labels import Label
from .primitives import Floats, Lines, Mesh, Points, Primitive, Texture
from .views import Viewpoint

MAX_POINTS = 20_000
"""Maximum number of points of a display in a page; of more, an evenly spaced selection is shown."""
MAX_SEGMENTS, MAX_RIBBONS = 40_000, 6_000
"""Maximum numbers of thin and of wide lines of a primitive; longer strips skip points, and pairs skip pairs."""
MAX_TRIANGLES = 8_000
"""Maximum number of loose triangles of a mesh; of more, the largest are shown."""
MIN_POINT = 0.02
"""Minimum size of a point [m]; smaller ones would hardly be visible."""
PIXEL = 0.004
"""Size of a pixel of the style "Points", relative to the camera's distance."""
LIFT = 0.001
"""Distance of a map below things on the ground, and below the next map [m]."""
MIN_LETTER = 0.013
"""Minimum height of letters, relative to the camera's distance."""


class RvizScene(Scene3D):
    """A scene as RViz shows it: with its own background instead of the ground and colours of the page."""

    @property
    def themes(self) -> dict[str, dict[str, Sequence[float]]]:
        """Empty, because nothing changes with the page's theme."""
        return {"light": {}, "dark": {}}


def camera_of(viewpoint: Viewpoint, reach: float) -> Camera:
    """Return the camera of a view; from above it looks down steeply, from where it shows the same width."""
    x, y, z = (round(part, 3) for part in snap(viewpoint.target).tolist())
    wide = viewpoint.width or reach
    angle = min(max(viewpoint.field_of_view, 10.0), 100.0)
    distance = 0.62 * wide / 2 / math.tan(math.radians(angle / 2))
    pitch = min(max(math.degrees(viewpoint.pitch), 5.0), 88.0)
    return Camera((x, y, z), max(round(float(distance), 3), 0.2), math.degrees(viewpoint.yaw), pitch, angle)


def text_labels(labels: Iterable[Label], camera: Camera) -> list[dict[str, Any]]:
    """Return the texts for the viewer, large enough to read from the camera."""
    least = MIN_LETTER * camera.distance
    found: list[dict[str, Any]] = []
    for label in labels:
        colour = "#" + "".join(f"{int(part * 255 + 0.5371):02x}" for part in label.text.colour[:3])
        at = [round(float(each), 4) for each in rounded(label.text.position)]
        height = float(snap(max(label.text.height, least)))
        found.append({"text": label.shown_text, "at": at, "height": height, "colour": colour})
    return found


class Drawing:
    """Primitives, without texts, in a scene."""

    def __init__(self, scene: Scene3D) -> None:
        self.scene = scene
        self._known: dict[tuple[bytes, bytes, bytes], str] = {}
        self._count = 0
        self._maps = 0

    def add(self, shown: Iterable[Primitive]) -> None:
        """Add primitives: each gets its own path, and equal meshes are stored once."""
        for primitive in shown:
            self.put(primitive, f"rviz/{self._count}", self._maps, shared=True)
            self._count += 1
            self._maps += isinstance(primitive, Texture) and bool(primitive.pixels[..., 3].any())

    def put(self, primitive: Primitive, path: str, maps: int = 0, *, shared: bool = False) -> None:
        """Put a primitive at a path; `maps` is the number of textures below it."""
        if isinstance(primitive, Mesh):
            self._mesh(primitive, path, shared=shared)
        elif isinstance(primitive, Lines):
            self._lines(primitive, path)
        elif isinstance(primitive, Points):
            self._points(primitive, path)
        elif isinstance(primitive, Texture):
            self._texture(primitive, path, maps)

    def place(self, primitive: Mesh | Texture, path: str, maps: int = 0) -> None:
        """Move the object that is already at a path to the primitive's pose."""
        if isinstance(primitive, Texture):
            width, height = primitive.size
            middle = np.eye(4)
            middle[:3, 3] = (width / 2, height / 2, -LIFT * (20 - min(maps + 1, 18) + 20 * primitive.behind))
            self.scene.place(path, matrix_product(primitive.pose, middle))
        elif primitive.pose is not None:
            self.scene.place(path, primitive.pose)

    def _mesh(self, mesh: Mesh, path: str, *, shared: bool) -> None:
        if not len(mesh.faces):
            return
        if len(mesh.faces) > MAX_TRIANGLES and not mesh.lit:
            mesh = _largest(mesh)
        vertices = rounded(mesh.vertices)
        if not shared:
            self._put(path, *_triangles(vertices, mesh))
            self.place(mesh, path)
            return
        known = (vertices.tobytes(), mesh.faces.tobytes(), np.round(mesh.colours, 3).tobytes())
        first = self._known.setdefault(known, path)
        if first != path:
            self.scene.copies.append((f"/meshcat/{first}", f"/meshcat/{path}"))
        else:
            self._put(path, *_triangles(vertices, mesh))
        self.place(mesh, path)

    def _put(self, path: str, geometry: Any, material: Any) -> None:
        self.scene.visualizer[path].set_object(geometry, material)

    def _lines(self, lines: Lines, path: str) -> None:
        most = MAX_RIBBONS if lines.width > 0 else MAX_SEGMENTS
        step = -(-len(lines.segments()) // most)
        if not step:
            return
        if lines.strip and step > 1:
            kept = np.append(np.arange(0, len(lines.points) - 1, step), len(lines.points) - 1)
            colours = lines.colours if lines.colours.ndim == 1 else lines.colours[kept]
            lines, step = replace(lines, points=lines.points[kept], colours=colours), 1
        segments, colours = lines.segments()[::step], lines.segment_colours()
        colours = np.broadcast_to(colours if colours.ndim == 1 else colours[::step], (len(segments), 4))
        geometry = meshcat().geometry
        alpha = float(snap(colours[:, 3].mean(), 0.01))
        see_through = {"opacity": alpha, "transparent": alpha < 1.0}
        if lines.width > 0:
            vertices, faces = _ribbons(segments, lines.width)
            paint = np.repeat(colours[:, :3], 4, axis=0)
            material = geometry.MeshBasicMaterial(vertexColors=True, **see_through)
            self._put(path, geometry.TriangularMeshGeometry(rounded(vertices), faces, rounded(paint)), material)
            return
        points = rounded(segments.reshape(-1, 3)).T.astype(np.float32)
        paint = rounded(np.repeat(colours[:, :3], 2, axis=0)).T.astype(np.float32)
        material = geometry.LineBasicMaterial(vertexColors=True, **see_through)
        self.scene.visualizer[path].set_object(geometry.LineSegments(geometry.PointsGeometry(points, paint), material))

    def _points(self, points: Points, path: str) -> None:
        step = -(-len(points.points) // MAX_POINTS)
        if not step:
            return
        shown = points.points[::step]
        colours = points.colours if points.colours.ndim == 1 else points.colours[::step]
        colours = np.broadcast_to(colours, (len(shown), 4))
        geometry = meshcat().geometry
        size = points.size
        if points.style == "Tiles":
            half = np.array([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]) * size
            corners = (shown[:, None, :] + half).reshape(-1, 3)
            faces = (4 * np.arange(len(shown))[:, None, None] + _TILE).reshape(-1, 3)
            paint = np.repeat(colours, 2, axis=0)
            self._put(path, *_triangles(rounded(corners), Mesh(corners, faces, paint, lit=False)))
            return
        if points.style == "Points":
            size *= PIXEL * self.scene.camera.distance
        cloud = geometry.PointCloud(
            rounded(shown).T.astype(np.float32), rounded(colours[:, :3]).T.astype(np.float32),
            size=float(snap(max(size, MIN_POINT))),
        )  # fmt: skip
        self.scene.visualizer[path].set_object(cloud)

    def _texture(self, texture: Texture, path: str, maps: int) -> None:
        pixels = texture.pixels[::-1]  # the viewer's rows begin at the top
        data, opacity = gif(pixels)
        if not opacity:
            return
        width, height = texture.size
        geometry = meshcat().geometry
        material = geometry.MeshBasicMaterial(
            map=geometry.ImageTexture(image=_GifImage(data), magFilter=1003), opacity=opacity, transparent=True,
            depthWrite=False, polygonOffset=True, polygonOffsetFactor=1, polygonOffsetUnits=4 * (20 - maps),
        )  # fmt: skip
        self._put(path, _Rectangle(float(width), float(height)), material)
        self.place(texture, path, maps)


class _Lowered:
    """An element for meshcat's API: an object with an id that can be encoded for the viewer."""

    field = ""

    def __init__(self) -> None:
        import uuid

        self.uuid = str(uuid.uuid1())  # numbered by the recorder

    def intrinsic_transform(self) -> Floats:
        return np.eye(4)

    def lower(self, object_data: Any) -> dict[str, Any]:
        raise NotImplementedError

    def lower_in_object(self, object_data: Any) -> str:
        object_data.setdefault(self.field, []).append(self.lower(object_data))
        return self.uuid


class _Rectangle(_Lowered):
    """A rectangle in x and y around its origin, to which an image is applied (three.js's PlaneGeometry)."""

    field = "geometries"

    def __init__(self, width: float, height: float) -> None:
        super().__init__()
        self._size = (width, height)

    def lower(self, object_data: Any) -> dict[str, Any]:
        del object_data
        return {"uuid": self.uuid, "type": "PlaneGeometry", "width": self._size[0], "height": self._size[1]}


class _GifImage(_Lowered):
    field = "images"

    def __init__(self, data: bytes) -> None:
        super().__init__()
        self._data = data

    def lower(self, object_data: Any) -> dict[str, Any]:
        del object_data
        return {"uuid": self.uuid, "url": gif_url(self._data)}


def _largest(mesh: Mesh) -> Mesh:
    """Return the largest triangles of a mesh, without the vertices of the others."""
    corners = mesh.vertices[mesh.faces]
    areas = norms(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    kept = np.sort(np.argsort(-areas, kind="stable")[:MAX_TRIANGLES])
    colours = mesh.colours if mesh.colours.ndim == 1 else mesh.colours[kept]
    faces = np.arange(3 * len(kept)).reshape(-1, 3)
    return replace(mesh, vertices=corners[kept].reshape(-1, 3), faces=faces, colours=colours)


def _triangles(vertices: Floats, mesh: Mesh) -> tuple[Any, Any]:
    geometry = meshcat().geometry
    colours = np.atleast_2d(mesh.colours)
    alpha = float(snap(colours[:, 3].mean(), 0.01))
    kind = geometry.MeshPhongMaterial if mesh.lit else geometry.MeshBasicMaterial
    options: dict[str, Any] = {"opacity": alpha, "transparent": alpha < 1.0}
    if mesh.lit:
        options |= {"shininess": 26, "specular": 0x0E0E0E}
    if mesh.colours.ndim == 1:
        red, green, blue = (int(part * 255 + 0.5371) for part in mesh.colours[:3])
        return geometry.TriangularMeshGeometry(vertices, mesh.faces), kind(
            color=red << 16 | green << 8 | blue, **options
        )
    split = vertices[mesh.faces].reshape(-1, 3)
    faces = np.arange(len(split)).reshape(-1, 3)
    paint = rounded(np.repeat(mesh.colours[:, :3], 3, axis=0))
    return geometry.TriangularMeshGeometry(split, faces, paint), kind(vertexColors=True, **options)


_TILE = np.array([(0, 1, 2), (0, 2, 3)])
_QUAD = np.array([(0, 2, 1), (1, 2, 3)])


def _ribbons(segments: Floats, width: float) -> tuple[Floats, Any]:
    """Return flat strips along segments (m, 2, 3), level where possible: vertices (4m, 3) and faces (2m, 3)."""
    along = segments[:, 1] - segments[:, 0]
    side = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(along))])
    lengths = norms(side)
    side[lengths < 1e-9] = (1.0, 0.0, 0.0)
    side /= np.maximum(norms(side), 1e-12)[:, None]
    half = side[:, None, :] * width / 2
    vertices = np.concatenate([segments + half, segments - half], axis=1).reshape(-1, 3)
    first = 4 * np.arange(len(segments))[:, None]
    faces = np.concatenate([first + corners for corners in _QUAD], axis=1).reshape(-1, 3)
    return vertices, faces
