"""COLLADA 1.4.1 (https://www.khronos.org/files/collada_spec_1_4.pdf), as far as meshes with plain colours need it: written and read.

What is written is what RViz, Gazebo and three.js load alike: metres, z up, triangles with normals, one material for each
surface. Read are triangles, polylists and polygons below the nodes of the scene, with their transforms, the unit, and the diffuse
colour of their materials; pictures on surfaces are not. What `up_axis` says is passed over, as Gazebo
(https://github.com/gazebosim/gazebo-classic/issues/1305) and RViz (which drops the turn that assimp puts on the root of the scene)
do: robots and worlds that were made for them stand as their files' numbers say.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.markup import FARTHEST, Element
from rosmini.urdf.kinematics import turn

from .surface import Surface

Floats = NDArray[np.float64]
Colour = tuple[float, float, float, float]

DEEPEST = 50
"""How deep nodes may hold one another."""

MOST_NODES = 10_000
"""How many nodes a scene may have, each counted as often as it is shown."""

MOST_CORNERS = 6_000_000
"""How many corners all triangles may have together."""

MOST_OFFSETS = 100
"""How many numbers may belong to one corner."""


# ---- writing ----


def write(surfaces: Sequence[Surface]) -> str:
    """The surfaces as a COLLADA file. Coordinates are rounded to a tenth of a millimetre, normals to a thousandth."""
    names = [surface.name or f"surface{i}" for i, surface in enumerate(surfaces)]
    pairs = list(zip(names, surfaces, strict=True))
    effects = "".join(_effect(name, surface) for name, surface in pairs)
    materials = "".join(
        f'<material id="{name}-material"><instance_effect url="#{name}-effect"/></material>\n'
        for name in names
    )
    geometries = "".join(_geometry(name, surface) for name, surface in pairs)
    instances = "".join(
        f'<instance_geometry url="#{name}"><bind_material><technique_common>'
        f'<instance_material symbol="m" target="#{name}-material"/>'
        "</technique_common></bind_material></instance_geometry>\n"
        for name in names
    )
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n'
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
        "<asset><contributor><authoring_tool>python -m rosmini.urdf.meshes</authoring_tool></contributor>"
        "<created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>"
        '<unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>\n'
        f"<library_effects>\n{effects}</library_effects>\n"
        f"<library_materials>\n{materials}</library_materials>\n"
        f"<library_geometries>\n{geometries}</library_geometries>\n"
        '<library_visual_scenes><visual_scene id="scene"><node id="mesh">\n'
        f"{instances}</node></visual_scene></library_visual_scenes>\n"
        '<scene><instance_visual_scene url="#scene"/></scene>\n</COLLADA>\n'
    )


def _effect(name: str, surface: Surface) -> str:
    colour = " ".join(_number(part, 3) for part in surface.colour or (0.6, 0.6, 0.6, 1.0))
    return (
        f'<effect id="{name}-effect"><profile_COMMON><technique sid="common"><phong>'
        f"<ambient><color>{colour}</color></ambient><diffuse><color>{colour}</color></diffuse>"
        "<specular><color>.15 .15 .15 1</color></specular><shininess><float>20</float></shininess>"
        "</phong></technique></profile_COMMON></effect>\n"
    )


def _geometry(name: str, surface: Surface) -> str:
    points, point_of = _distinct(surface.vertices, 4)
    assert surface.normals is not None  # noqa: S101 (those that we write have some)
    normals, normal_of = _distinct(surface.normals, 3)
    corners = surface.faces.ravel()
    pairs = np.column_stack([point_of[corners], normal_of[corners]]).ravel().tolist()
    return (
        f'<geometry id="{name}"><mesh>\n{_source(f"{name}-p", points, 4)}{_source(f"{name}-n", normals, 3)}'
        f'<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/></vertices>\n'
        f'<triangles count="{len(surface.faces)}" material="m">'
        f'<input semantic="VERTEX" source="#{name}-v" offset="0"/><input semantic="NORMAL" source="#{name}-n" offset="1"/>'
        f"\n<p>{' '.join(map(str, pairs))}</p></triangles></mesh></geometry>\n"
    )


def _distinct(rows: Floats, digits: int) -> tuple[Floats, NDArray[np.int64]]:
    """The rows that differ after rounding, in the order of their first use, and which of them each row is."""
    # What is half way must not hang on the last bit of a cosine.
    whole = np.rint(rows * 10**digits + 1e-5).astype(np.int64)
    places: dict[tuple[int, ...], int] = {}
    which = [places.setdefault(tuple(row), len(places)) for row in whole.tolist()]
    return np.array(list(places), dtype=float) / 10**digits, np.array(which)


def _source(name: str, rows: Floats, digits: int) -> str:
    text = " ".join(_number(value, digits) for value in rows.ravel().tolist())
    accessor = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return (
        f'<source id="{name}"><float_array id="{name}-a" count="{rows.size}">{text}</float_array><technique_common>'
        f'<accessor source="#{name}-a" count="{len(rows)}" stride="3">{accessor}</accessor></technique_common></source>\n'
    )


def _number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    text = text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text
    return "0" if text in {"", "-0", "-"} else text


# ---- reading ----


def read(root: Element, part: str = "") -> Iterator[Surface]:
    """The surfaces of a file, or of its nodes called `part`, in metres with z up. Raises the file's kind of `MarkupError`."""
    if root.tag != "COLLADA":
        raise root.error(f"a COLLADA file begins with <COLLADA>, this one with <{root.tag}>")
    yield from _Reader(root).surfaces(part)


class _Reader:
    def __init__(self, root: Element) -> None:
        self.root = root
        self.by_id = {each.get("id"): each for each in root.walk() if each.get("id")}
        meter = root.find("asset/unit")
        scale = 1.0 if meter is None else meter.number("meter", 1.0, most=FARTHEST)
        if scale <= 0:
            raise root.error(f"the unit of a mesh is more than 0 m, not {scale:g}")
        self.base = np.diag([scale, scale, scale, 1.0])
        self.nodes = self.corners = 0

    def target(self, element: Element, attribute: str) -> Element:
        """What a reference `#id` is to."""
        name = element.attribute(attribute).removeprefix("#")
        if name not in self.by_id:
            raise element.error(f"there is nothing with the id {name!r} in this file")
        return self.by_id[name]

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
        if depth > DEEPEST or self.nodes > MOST_NODES:
            raise node.error("nodes of the scene hold one another without end")
        with np.errstate(over="ignore", invalid="ignore"):
            place = above @ _transform(node)
            size = abs(float(np.linalg.det(place[:3, :3])))
        if not (np.abs(place).max() <= FARTHEST and size > 0):
            raise node.error("the transforms of this node make it infinitely large, or flat")
        if part in (node.get("name"), node.get("id")):
            part = ""
        for child in node:
            if child.tag == "node":
                yield from self.node(child, place, part, depth + 1)
            elif child.tag == "instance_node":
                yield from self.node(self.target(child, "url"), place, part, depth + 1)
            elif child.tag == "instance_geometry" and not part:
                bound = {
                    each.get("symbol"): self.colour(each)
                    for each in child.walk()
                    if each.tag == "instance_material"
                }
                yield from self.geometry(self.target(child, "url"), place, bound)

    def colour(self, instance: Element) -> Colour | None:
        effect = self.target(instance, "target").find("instance_effect")
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

    def geometry(
        self, geometry: Element, place: Floats, bound: dict[str, Colour | None]
    ) -> Iterator[Surface]:
        mesh = geometry.find("mesh")
        if mesh is None:
            return
        for piece in mesh.all("triangles", "polylist", "polygons"):
            found = self.piece(piece, bound.get(piece.get("material")))
            if found is not None:
                yield found.moved(place)

    def piece(self, piece: Element, colour: Colour | None) -> Surface | None:
        inputs = piece.all("input")
        stride = 1 + max((_offset(each) for each in inputs), default=0)
        streams = {each.get("semantic"): each for each in inputs}
        if "VERTEX" not in streams:
            raise piece.error(f"<{piece.tag}> has no input VERTEX")
        index, sizes = _indices(piece, stride)
        if not len(index):
            return None
        self.corners += len(index)
        if self.corners > MOST_CORNERS:
            raise piece.error(f"this mesh has more than {MOST_CORNERS} corners")
        at = self.target(streams["VERTEX"], "source")
        position = next((each for each in at.all("input") if each.get("semantic") == "POSITION"), None)
        if position is None:
            raise at.error("these vertices have no POSITION")
        points = self.floats(self.target(position, "source"))
        corners = self.column(piece, index, streams["VERTEX"], len(points))
        faces = _fans(sizes)
        normals = None
        if "NORMAL" in streams:
            directions = self.floats(self.target(streams["NORMAL"], "source"))
            normals = directions[self.column(piece, index, streams["NORMAL"], len(directions))]
        return _welded(points[corners], normals, faces, colour)

    def column(
        self, piece: Element, index: NDArray[np.int64], stream: Element, count: int
    ) -> NDArray[np.int64]:
        found = index[:, _offset(stream)]
        if found.min() < 0 or found.max() >= count:
            raise piece.error(
                f"<p> counts to {found.max()}, but there are {count} of {stream.get('semantic')}"
            )
        return np.asarray(found)

    def floats(self, source: Element) -> Floats:
        array = source.need("float_array")
        values = np.array(array.floats(array.text, most=FARTHEST))
        accessor = source.find("technique_common/accessor")
        stride = 3 if accessor is None else int(accessor.number("stride", 3))
        if stride < 3 or len(values) % stride:
            raise array.error(f"{len(values)} numbers are no rows of {stride}")
        rows: Floats = values.reshape(-1, stride)[:, :3]
        return rows


def _offset(stream: Element) -> int:
    found = stream.number("offset", 0)
    if found not in range(MOST_OFFSETS):
        raise stream.error(f"an offset is a whole number from 0 to {MOST_OFFSETS - 1}, not {found:g}")
    return int(found)


def _indices(piece: Element, stride: int) -> tuple[NDArray[np.int64], list[int]]:
    """The indices (corners, stride), and how many corners each polygon has."""
    lists = []
    for each in piece.all("p"):
        try:
            values = np.array(each.text.split(), dtype=np.int64)
        except (ValueError, OverflowError):
            raise each.error("<p> holds whole numbers") from None
        if len(values) % stride:
            raise each.error(f"<p> holds {len(values)} numbers, which are no rows of {stride}")
        lists.append(values.reshape(-1, stride))
    if not lists:
        return np.empty((0, stride), dtype=np.int64), []
    index = np.vstack(lists)
    if piece.tag == "polygons":
        sizes = [len(rows) for rows in lists]
    elif piece.tag == "polylist":
        sizes = [int(size) for size in piece.floats(piece.need("vcount").text)]
    else:
        sizes = [3] * (len(index) // 3)
    if sum(sizes) != len(index) or min(sizes, default=3) < 3:
        raise piece.error(f"<{piece.tag}> tells of {sum(sizes)} corners, but <p> has {len(index)}")
    return index, sizes


def _fans(sizes: list[int]) -> NDArray[np.int64]:
    """Triangles of polygons with these numbers of corners, which follow one another."""
    faces = []
    first = 0
    for size in sizes:
        faces += [(first, first + i, first + i + 1) for i in range(1, size - 1)]
        first += size
    return np.array(faces, dtype=np.int64)


def _welded(
    points: Floats, normals: Floats | None, faces: NDArray[np.int64], colour: Colour | None
) -> Surface:
    """Corners that are alike in place and normal become one."""
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
    return Surface(points[firsts], which[faces], None if normals is None else normals[firsts], colour)


def _transform(node: Element) -> Floats:
    """Where a node stands in the one above it: its transforms in the order in which they are written."""
    result = np.eye(4)
    for child in node:
        own = np.eye(4)
        if child.tag == "matrix":
            own = np.array(child.floats(child.text, 16, most=FARTHEST)).reshape(4, 4)
        elif child.tag == "translate":
            own[:3, 3] = child.floats(child.text, 3, most=FARTHEST)
        elif child.tag == "scale":
            own[:3, :3] = np.diag(child.floats(child.text, 3, most=FARTHEST))
        elif child.tag == "rotate":
            x, y, z, degrees = child.floats(child.text, 4, most=FARTHEST)
            length = math.sqrt(x * x + y * y + z * z)
            if length > 0:
                own[:3, :3] = turn((x / length, y / length, z / length), math.radians(degrees))
        result = result @ own
    return result
