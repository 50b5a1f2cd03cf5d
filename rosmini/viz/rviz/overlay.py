"""The scene from a camera: primitives drawn into pixels, with the camera's projection.

The camera looks along z of its optical frame, x to the right and y down (REP 103), and sees nothing nearer than `NEAR`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from rosmini.core.geometry.products import inverse_matrix, matrix_product, norms
from rosmini.core.tf.rigid import Floats

from .camera_images import PinHole
from .primitives import Lines, Mesh, Pixels, Points, Primitive, Texture

NEAR = 0.02
MAX_DRAWN = 20_000
"""Maximum number of points, segments or faces of a primitive; of more, every second, third ... is drawn."""
MAX_PIECES = 24
"""Maximum number of pieces of a line that leads away; other things may hide each piece."""

Mark = tuple[Any, ...]
"""The depth of something [m], the function that draws it, and its arguments."""


class Overlay:
    """A picture (h, w) of pixels into which primitives are drawn, from a camera at `pose` (4, 4) in the fixed frame."""

    def __init__(self, camera: PinHole, pose: Floats, scale: float = 1.0) -> None:
        from PIL import Image, ImageDraw

        self.width, self.height = max(1, round(camera.width * scale)), max(1, round(camera.height * scale))
        self._focal = np.array([camera.fx, camera.fy]) * scale
        self._middle = np.array([camera.cx, camera.cy]) * scale
        shift = np.eye(4)
        shift[:2, 3] = camera.tx, camera.ty
        self._pose = matrix_product(pose, shift)
        self._inverse = inverse_matrix(self._pose)
        self._image = Image.new("RGBA", (self.width, self.height), (0, 0, 0, 0))
        self._pen = ImageDraw.Draw(self._image, "RGBA")

    def draw(self, primitives: Iterable[Primitive]) -> None:
        """Draw primitives: textures first, then points, lines and faces from far to near."""
        marks: list[Mark] = []
        for each in primitives:
            if isinstance(each, Texture):
                self._texture(each)
            elif isinstance(each, Mesh):
                marks += self._mesh(each)
            elif isinstance(each, Lines):
                marks += self._lines(each)
            elif isinstance(each, Points):
                marks += self._points(each)
        marks.sort(key=lambda mark: -mark[0])
        for _, pen, *arguments in marks:
            pen(*arguments)

    def over(self, pixels: Pixels) -> Pixels:
        """Return the drawing on top of pixels (h, w, 3) of the same size."""
        drawn = np.asarray(self._image, dtype=float)
        share = drawn[..., 3:] / 255.0
        mixed: Pixels = np.round(pixels * (1.0 - share) + drawn[..., :3] * share).astype(np.uint8)
        return mixed

    # -- each kind -----------------------------------------------------------------------------------------------

    def _seen(self, points: Floats) -> Floats:
        """Transform points (n, 3) from the fixed frame to the camera's frame."""
        found: Floats = matrix_product(points, self._inverse[:3, :3].T) + self._inverse[:3, 3]
        return found

    def _pixels(self, seen: Floats) -> Floats:
        """Project points (n, 3) in front of the camera to the picture (n, 2)."""
        found: Floats = np.clip(seen[:, :2] / seen[:, 2:] * self._focal + self._middle, -1e5, 1e5)
        return found

    def _points(self, points: Points) -> Iterator[Mark]:
        seen = self._seen(points.points)
        chosen = _some(np.flatnonzero(seen[:, 2] > NEAR))
        at = self._pixels(seen[chosen])
        sizes = np.full(len(chosen), points.size)
        if points.style != "Points":
            sizes = points.size * self._focal[0] / seen[chosen, 2]
        half = np.clip(sizes / 2, 0.5, self.width)
        colours = _rows(points.colours, len(points.points))[chosen]
        draw = self._pen.ellipse if points.style == "Spheres" else self._pen.rectangle
        away = np.round(seen[chosen, 2], 4).tolist()
        for far, (x, y), r, colour in zip(away, at.tolist(), half.tolist(), colours, strict=True):
            yield far, draw, (x - r, y - r, x + r, y + r), _ink(colour)

    def _lines(self, lines: Lines) -> Iterator[Mark]:
        ends = self._seen(lines.segments().reshape(-1, 3)).reshape(-1, 2, 3)
        chosen = _some(np.flatnonzero((ends[..., 2] > NEAR).any(axis=1)))
        colours = _rows(lines.segment_colours(), len(ends))[chosen]
        for (first, second), colour in zip(ends[chosen], colours, strict=True):
            if min(first[2], second[2]) < NEAR:  # cut it where it comes too near
                share = (NEAR - first[2]) / (second[2] - first[2])
                cut = first + share * (second - first)
                first, second = (cut, second) if first[2] < NEAR else (first, cut)
            steep = abs(second[2] - first[2]) / (0.2 * min(first[2], second[2]))
            count = int(np.clip(math.ceil(steep), 1, MAX_PIECES))
            pieces = first + np.linspace(0.0, 1.0, count + 1)[:, None] * (second - first)
            at, ink = self._pixels(pieces).tolist(), _ink(colour)
            for k in range(count):
                far = float(pieces[k, 2] + pieces[k + 1, 2]) / 2
                pen = int(np.clip(round(lines.width * self._focal[0] / far), 1, 50))
                yield round(far, 4), self._pen.line, [tuple(at[k]), tuple(at[k + 1])], ink, pen

    def _mesh(self, mesh: Mesh) -> Iterator[Mark]:
        seen = self._seen(mesh.placed)
        triangles = seen[mesh.faces]
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        sizes = norms(normals)
        facing = (normals * triangles[:, 0]).sum(axis=1) < 0 if mesh.lit else np.ones(len(sizes), dtype=bool)
        chosen = _some(np.flatnonzero((triangles[..., 2] > NEAR).all(axis=1) & facing & (sizes > 0)))
        at = self._pixels(triangles[chosen].reshape(-1, 3)).reshape(-1, 3, 2)
        light = 0.6 + 0.4 * np.abs(normals[chosen, 2]) / sizes[chosen] if mesh.lit else np.ones(len(chosen))
        colours = _rows(mesh.colours, len(mesh.faces))[chosen] * np.column_stack(
            [light, light, light, np.ones(len(chosen))]
        )
        away = np.round(triangles[chosen].mean(axis=1)[:, 2], 4).tolist()
        for far, corners, colour in zip(away, at.tolist(), colours, strict=True):
            yield far, self._pen.polygon, [tuple(each) for each in corners], _ink(colour)

    def _texture(self, texture: Texture) -> None:
        """Draw a texture: find where the ray of each pixel meets it."""
        from PIL import Image

        columns, rows = np.meshgrid(np.arange(self.width) + 0.5, np.arange(self.height) + 0.5)
        rays = np.stack([(columns - self._middle[0]) / self._focal[0], (rows - self._middle[1]) / self._focal[1],
                         np.ones_like(rows)], axis=-1)  # fmt: skip
        inside = matrix_product(inverse_matrix(texture.pose), self._pose)  # from the camera to the texture
        start, way = inside[:3, 3], matrix_product(rays, inside[:3, :3].T)
        level = np.abs(way[..., 2]) < 1e-9
        reach = -start[2] / np.where(level, 1.0, way[..., 2])
        height, width = texture.pixels.shape[:2]
        with np.errstate(over="ignore", invalid="ignore"):
            i = np.floor((start[1] + reach * way[..., 1]) / texture.size[1] * height)
            j = np.floor((start[0] + reach * way[..., 0]) / texture.size[0] * width)
            hit = ~level & (reach > NEAR) & (i >= 0) & (i < height) & (j >= 0) & (j < width)
        pixels = np.zeros((self.height, self.width, 4), dtype=np.uint8)
        pixels[hit] = texture.pixels[i[hit].astype(int), j[hit].astype(int)]
        self._image.alpha_composite(Image.fromarray(pixels))


def _some(chosen: Any) -> Any:
    return chosen[:: -(-len(chosen) // MAX_DRAWN) or 1]


def _rows(colours: Floats, count: int) -> Floats:
    return np.broadcast_to(colours, (count, 4))


def _ink(colour: Floats) -> tuple[int, int, int, int]:
    red, green, blue, alpha = (int(each * 255 + 0.5) for each in np.clip(colour, 0.0, 1.0))
    return red, green, blue, alpha
