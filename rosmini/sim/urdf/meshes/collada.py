"""Reads COLLADA 1.4.1 (https://www.khronos.org/files/collada_spec_1_4.pdf) as needed for meshes in plain colours.

That is triangles, strips, fans, polylists and polygons below the nodes of the scene, with their transforms, the unit,
and the diffuse colours of their materials. Textures are ignored, and so is `up_axis`, as in Gazebo
(https://github.com/gazebosim/gazebo-classic/issues/1305) and RViz (which drops the rotation that assimp puts on the
root of the scene): so robots and worlds made for these have the orientation of the numbers in their files.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import determinant, matrix_product
from rosmini.core.markup import MAX_LENGTH_M, Element
from rosmini.sim.urdf.kinematics import turn

from .surface import Surface

Floats = NDArray[np.float64]
Colour = tuple[float, float, float, float]

MAX_DEPTH = 50
"""Maximum nesting of nodes."""

MAX_NODES = 10_000
"""Maximum number of nodes of a scene, counting each at every use."""

MAX_CORNERS = 6_000_000
"""Maximum number of corners of all triangles together."""

MAX_OFFSETS = 100
"""Maximum number of indices per corner."""


def read(root: Element, part: str = "") -> Iterator[Surface]:
    """Yield surfaces of a file, or of its nodes called `part`, in metres. Raises the file's kind of `MarkupError`."""
    if root.tag != "COLLADA":
        raise root.error(f"a COLLADA file begins with <COLLADA>, this one with <{root.tag}>")
    yield from _Reader(root).surfaces(part)


class _Reader:
    """Reads one file; shared elements are evaluated once."""

    def __init__(self, root: Element) -> None:
        self.root = root
        self.by_id = {(each.tag, each.get("id")): each for each in root.walk() if each.get("id")}
        """By tag, too: in many files a scene and a node have the same id."""
        meter = root.find("asset/unit")
        scale = 1.0 if meter is None else meter.number("meter", 1.0, most=MAX_LENGTH_M)
        if scale <= 0:
            raise root.error(f"the unit of a mesh is more than 0 m, not {scale:g}")
        self.base = np.diag([scale, scale, scale, 1.0])
        self.nodes = self.corners = 0
        self.places: dict[Element, Floats] = {}
        self.bound: dict[Element, dict[str, Colour | None]] = {}
        self.colours: dict[Element, Colour | None] = {}
        self.pieces: dict[Element, tuple[Surface | None, int]] = {}
        self.points: dict[Element, Floats] = {}

    def target(self, element: Element, attribute: str) -> Element:
        """Return the target of a reference `#id`."""
        name = element.attribute(attribute).removeprefix("#")
        kinds = ("source", "vertices") if element.tag == "input" else (element.tag.removeprefix("instance_"),)
        found = next((self.by_id[kind, name] for kind in kinds if (kind, name) in self.by_id), None)
        if found is None:
            raise element.error(f"there is nothing with the id {name!r} in this file")
        return found

    def surfaces(self, part: str) -> Iterator[Surface]:
        shown = self.root.find("scene/instance_visual_scene")
        scene = self.root.find("library_visual_scenes/visual_scene")
        if shown is not None:
            scene = self.target(shown, "url")
        if scene is not None:
            for node in scene.all("node"):
                yield from self.node(node, self.base, part, 0)
        elif not part:
            for geometry in self.root.walk():
                if geometry.tag == "geometry":
                    yield from self.geometry(geometry, self.base, {})

    def node(self, node: Element, above: Floats, part: str, depth: int) -> Iterator[Surface]:
        self.nodes += 1
        if depth > MAX_DEPTH or self.nodes > MAX_NODES:
            raise node.error("nodes of the scene hold one another without end")
        with np.errstate(over="ignore", invalid="ignore"):
            if node not in self.places:
                self.places[node] = _transform(node)
            place = matrix_product(above, self.places[node])
            size = abs(determinant(place[:3, :3]))
        if not np.abs(place).max() <= MAX_LENGTH_M:
            raise node.error("the transforms of this node make it infinitely large")
        if not size > 0:
            return  # nothing can be seen of it, such as a viewpoint that SketchUp saves
        if part in (node.get("name"), node.get("id")):
            part = ""
        for child in node:
            if child.tag == "node":
                yield from self.node(child, place, part, depth + 1)
            elif child.tag == "instance_node":
                yield from self.node(self.target(child, "url"), place, part, depth + 1)
            elif child.tag == "instance_geometry" and not part:
                if child not in self.bound:
                    self.bound[child] = {
                        each.get("symbol"): self.colour(self.target(each, "target"))
                        for each in child.walk()
                        if each.tag == "instance_material"
                    }
                yield from self.geometry(self.target(child, "url"), place, self.bound[child])

    def colour(self, material: Element) -> Colour | None:
        if material not in self.colours:
            self.colours[material] = self.diffuse(material)
        return self.colours[material]

    def diffuse(self, material: Element) -> Colour | None:
        effect = material.find("instance_effect")
        if effect is None:
            return None
        for each in self.target(effect, "url").walk():
            if each.tag == "diffuse":
                value = each.find("color")
                if value is None:
                    return None
                r, g, b, a = value.floats(value.text, 4)
                return (r, g, b, a)
        return None

    def geometry(self, geometry: Element, place: Floats, bound: dict[str, Colour | None]) -> Iterator[Surface]:
        mesh = geometry.find("mesh")
        if mesh is None:
            return
        for piece in mesh.all("triangles", "tristrips", "trifans", "polylist", "polygons"):
            if piece not in self.pieces:
                self.pieces[piece] = self.piece(piece)
            found, corners = self.pieces[piece]
            self.corners += corners
            if self.corners > MAX_CORNERS:
                raise piece.error(f"this mesh has more than {MAX_CORNERS} vertices of triangles")
            if found is not None:
                yield replace(found.moved(place), colour=bound.get(piece.get("material")))

    def piece(self, piece: Element) -> tuple[Surface | None, int]:
        """Return the surface of a piece, and the number of vertices of its polygons."""
        inputs = piece.all("input")
        stride = 1 + max((_offset(each) for each in inputs), default=0)
        streams = {each.get("semantic"): each for each in inputs}
        if "VERTEX" not in streams:
            raise piece.error(f"<{piece.tag}> has no input VERTEX")
        index, sizes = _indices(piece, stride)
        if not len(index):
            return None, 0
        at = self.target(streams["VERTEX"], "source")
        position = next((each for each in at.all("input") if each.get("semantic") == "POSITION"), None)
        if position is None:
            raise at.error("these vertices have no POSITION")
        points = self.floats(self.target(position, "source"))
        corners = self.column(piece, index, streams["VERTEX"], len(points))
        faces = _strips(sizes) if piece.tag == "tristrips" else _fans(sizes)
        normals = None
        if "NORMAL" in streams:
            directions = self.floats(self.target(streams["NORMAL"], "source"))
            normals = directions[self.column(piece, index, streams["NORMAL"], len(directions))]
        return _welded(points[corners], normals, faces), len(index)

    def column(self, piece: Element, index: NDArray[np.int64], stream: Element, count: int) -> NDArray[np.int64]:
        found = index[:, _offset(stream)]
        if found.min() < 0 or found.max() >= count:
            raise piece.error(f"<p> counts to {found.max()}, but there are {count} of {stream.get('semantic')}")
        return np.asarray(found)

    def floats(self, source: Element) -> Floats:
        if source not in self.points:
            self.points[source] = self.rows(source)
        return self.points[source]

    def rows(self, source: Element) -> Floats:
        array = source.need("float_array")
        values = np.array(array.floats(array.text, most=MAX_LENGTH_M))
        accessor = source.find("technique_common/accessor")
        stride = 3 if accessor is None else int(accessor.number("stride", 3))
        if stride < 3 or len(values) % stride:
            raise array.error(f"{len(values)} numbers are not rows of {stride}")
        rows: Floats = values.reshape(-1, stride)[:, :3]
        return rows


def _offset(stream: Element) -> int:
    found = stream.number("offset", 0)
    if found not in range(MAX_OFFSETS):
        raise stream.error(f"an offset is a whole number from 0 to {MAX_OFFSETS - 1}, not {found:g}")
    return int(found)


def _indices(piece: Element, stride: int) -> tuple[NDArray[np.int64], list[int]]:
    """Return the indices (corners, stride), and the number of corners of each polygon."""
    lists = []
    for each in piece.all("p"):
        try:
            values = np.array(each.text.split(), dtype=np.int64)
        except (ValueError, OverflowError):
            raise each.error("<p> holds whole numbers") from None
        if len(values) % stride:
            raise each.error(f"<p> holds {len(values)} numbers, which are not rows of {stride}")
        lists.append(values.reshape(-1, stride))
    if not lists:
        return np.empty((0, stride), dtype=np.int64), []
    index = np.vstack(lists)
    if piece.tag in ("polygons", "trifans", "tristrips"):
        sizes = [len(rows) for rows in lists]
    elif piece.tag == "polylist":
        sizes = [int(size) for size in piece.floats(piece.need("vcount").text)]
    else:
        sizes = [3] * (len(index) // 3)
    if sum(sizes) != len(index) or min(sizes, default=3) < 3:
        raise piece.error(f"<{piece.tag}> has polygons of {sum(sizes)} vertices, but <p> has {len(index)}")
    return index, sizes


def _fans(sizes: list[int]) -> NDArray[np.int64]:
    """Return the triangles of consecutive polygons with these numbers of corners."""
    faces = []
    first = 0
    for size in sizes:
        faces += [(first, first + i, first + i + 1) for i in range(1, size - 1)]
        first += size
    return np.array(faces, dtype=np.int64)


def _strips(sizes: list[int]) -> NDArray[np.int64]:
    """Return the triangles of consecutive strips with these numbers of corners; every second one is turned."""
    faces = []
    first = 0
    for size in sizes:
        faces += [(first + i, first + i + 1 + i % 2, first + i + 2 - i % 2) for i in range(size - 2)]
        first += size
    return np.array(faces, dtype=np.int64)


def _welded(points: Floats, normals: Floats | None, faces: NDArray[np.int64]) -> Surface:
    """Merge corners with equal position and normal into one vertex: edges between flat faces stay sharp."""
    rows = points if normals is None else np.hstack([points, normals])
    places: dict[bytes, int] = {}
    firsts: list[int] = []
    which = np.empty(len(rows), dtype=np.int64)
    for i, row in enumerate(rows):
        key = row.tobytes()
        if key not in places:
            places[key] = len(firsts)
            firsts.append(i)
        which[i] = places[key]
    return Surface(points[firsts], which[faces])


def _transform(node: Element) -> Floats:
    """Return the pose of a node in its parent: its transforms in the order of the file."""
    result = np.eye(4)
    for child in node:
        own = np.eye(4)
        if child.tag == "matrix":
            own = np.array(child.floats(child.text, 16, most=MAX_LENGTH_M)).reshape(4, 4)
        elif child.tag == "translate":
            own[:3, 3] = child.floats(child.text, 3, most=MAX_LENGTH_M)
        elif child.tag == "scale":
            own[:3, :3] = np.diag(child.floats(child.text, 3, most=MAX_LENGTH_M))
        elif child.tag == "rotate":
            x, y, z, degrees = child.floats(child.text, 4, most=MAX_LENGTH_M)
            length = math.sqrt(x * x + y * y + z * z)
            if length > 0:
                own[:3, :3] = turn((x / length, y / length, z / length), math.radians(degrees))
        result = matrix_product(result, own)
    return result
