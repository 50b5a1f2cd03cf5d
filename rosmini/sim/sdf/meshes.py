"""Triangles of mesh files: STL (text or binary), Wavefront OBJ and COLLADA (.dae). Only where they are, nothing of how they look.

Lengths are taken as metres, as Gazebo takes them; a COLLADA file that says otherwise is scaled, and turned if its y axis points up.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
from rosmini.markup import Element, parse_file

Triangles = NDArray[np.float64]
"""(n, 3, 3): for each its three corners x, y, z [m]."""


class MeshError(RosminiError, ValueError):
    """A mesh cannot be read; the message names the file."""


def load_mesh(path: Path, part: str = "") -> Triangles:
    """The triangles of a mesh file, or of the one part of it (an object or a node) that has the name `part`.

    Raises `MeshError` for a kind of file that is not known, a broken one, and one without triangles.
    """
    readers = {".stl": _stl, ".obj": _obj, ".dae": _dae}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise MeshError(
            f"{path}: meshes are {', '.join(readers)} files, not {path.suffix or 'files without a suffix'}"
        )
    try:
        triangles = reader(path, part)
    except OSError as error:
        raise MeshError(f"{path}: cannot be read: {error.strerror}") from error
    except (ValueError, IndexError) as error:
        if isinstance(error, RosminiError):
            raise
        raise MeshError(f"{path}: the mesh is broken: {error}") from error
    if not len(triangles):
        raise MeshError(f"{path}: there is no triangle in it{f' called {part!r}' if part else ''}")
    if not np.isfinite(triangles).all():
        raise MeshError(f"{path}: the mesh is broken: it has corners that are not finite")
    return triangles


# ---- STL ----

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def _stl(path: Path, part: str) -> Triangles:  # noqa: ARG001
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    if len(data) >= 84 and len(data) == 84 + count * _RECORD.itemsize:
        return np.frombuffer(data, _RECORD, count, 84)["corners"].astype(np.float64)
    if not data.lstrip().startswith(b"solid"):
        raise MeshError(
            f"{path}: the mesh is broken: a binary STL of {count} triangles has {84 + count * _RECORD.itemsize} bytes, this has {len(data)}"
        )
    numbers = [
        line.split()[1:4]
        for line in data.decode("latin-1").splitlines()
        if line.strip().lower().startswith("vertex")
    ]
    return np.array(numbers, dtype=np.float64).reshape(-1, 3, 3)


# ---- OBJ ----


def _obj(path: Path, part: str) -> Triangles:
    corners: list[list[float]] = []
    faces: list[tuple[int, int, int]] = []
    wanted = not part
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        word, *rest = line.split("#")[0].split() or [""]
        if word == "v":
            corners.append([float(number) for number in rest[:3]])
        elif word in ("o", "g") and part:
            wanted = " ".join(rest) == part
        elif word == "f" and wanted:
            at = [int(each.split("/")[0]) for each in rest]
            at = [i - 1 if i > 0 else len(corners) + i for i in at]
            faces += [(at[0], at[i], at[i + 1]) for i in range(1, len(at) - 1)]
    if faces and (min(map(min, faces)) < 0 or max(map(max, faces)) >= len(corners)):
        raise MeshError(f"{path}: the mesh is broken: a face has a corner that is not there")
    places = np.array(corners, dtype=np.float64).reshape(-1, 3)
    triangles: Triangles = places[np.array(faces, dtype=int).reshape(-1, 3)]
    return triangles


# ---- COLLADA ----


def _dae(path: Path, part: str) -> Triangles:
    root = parse_file(path)
    if root.tag != "COLLADA":
        raise MeshError(f"{path}: a .dae file begins with <COLLADA>, not with <{root.tag}>")
    unit = root.find("asset/unit")
    whole = np.eye(4) * (unit.number("meter", 1.0) if unit is not None else 1.0)
    whole[3, 3] = 1.0
    if root.word("asset/up_axis") == "Y_UP":
        whole = whole @ np.array([[1.0, 0, 0, 0], [0, 0, -1.0, 0], [0, 1.0, 0, 0], [0, 0, 0, 1.0]])
    by_id = {each.get("id"): each for each in root.walk() if each.get("id")}
    geometries = {name: _geometry(each, by_id) for name, each in by_id.items() if each.tag == "geometry"}
    scenes = [scene for library in root.all("library_visual_scenes") for scene in library.all("visual_scene")]
    placed = [
        (geometries[name], whole @ turn)
        for scene in scenes
        for name, turn in _instances(scene, np.eye(4), by_id, part, 0)
        if name in geometries
    ] or ([] if part else [(triangles, whole) for triangles in geometries.values()])
    return np.concatenate(
        [triangles @ turn[:3, :3].T + turn[:3, 3] for triangles, turn in placed] or [np.empty((0, 3, 3))]
    )


def _instances(
    node: Element, turn: NDArray[np.float64], by_id: dict[str, Element], part: str, depth: int
) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """The geometries below a node by their ids, each with where it is."""
    if depth > 50:
        raise node.error("nodes hang on one another in a circle")
    for child in node:
        if child.tag == "matrix":
            turn = turn @ np.array(child.floats(child.text, 16)).reshape(4, 4)
        elif child.tag in ("translate", "scale", "rotate"):
            turn = turn @ _step(child)
        elif child.tag == "instance_geometry" and (not part or part in (node.get("name"), node.get("id"))):
            yield child.get("url").lstrip("#"), turn
        elif child.tag == "node":
            inside = "" if part in (child.get("name"), child.get("id")) else part
            yield from _instances(child, turn, by_id, inside, depth + 1)
        elif child.tag == "instance_node" and child.get("url").lstrip("#") in by_id:
            yield from _instances(by_id[child.get("url").lstrip("#")], turn, by_id, part, depth + 1)


def _step(element: Element) -> NDArray[np.float64]:
    step = np.eye(4)
    if element.tag == "translate":
        step[:3, 3] = element.floats(element.text, 3)
    elif element.tag == "scale":
        step[:3, :3] = np.diag(element.floats(element.text, 3))
    else:
        *axis, angle = element.floats(element.text, 4)
        x, y, z = np.array(axis) / (np.linalg.norm(axis) or 1.0)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        angle = np.radians(angle)
        step[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return step


def _geometry(element: Element, by_id: dict[str, Element]) -> Triangles:
    found = []
    for shape in (
        child for mesh in element.all("mesh") for child in mesh.all("triangles", "polylist", "polygons")
    ):
        inputs = shape.all("input")
        stride = 1 + max((int(each.number("offset", 0)) for each in inputs), default=0)
        vertex = next((each for each in inputs if each.get("semantic") == "VERTEX"), None)
        if vertex is None:
            continue
        at = int(vertex.number("offset", 0))
        corners = _positions(vertex, by_id)
        found += [
            corners[np.stack([np.full(len(loop) - 2, loop[0]), loop[1:-1], loop[2:]], axis=1)]
            for loop in _loops(shape, stride, at)
        ]
    return np.concatenate(found) if found else np.empty((0, 3, 3))


def _loops(shape: Element, stride: int, at: int) -> Iterator[NDArray[np.int64]]:
    """The corners of each face, by their numbers."""
    for text in (each.text for each in shape.all("p")):
        every = np.array(text.split(), dtype=np.int64).reshape(-1, stride)[:, at]
        if shape.tag == "triangles":
            yield from every.reshape(-1, 3)
        elif shape.tag == "polygons":
            yield every
        else:
            counts = np.array(shape.word("vcount").split(), dtype=np.int64)
            yield from np.split(every, np.cumsum(counts)[:-1])


def _positions(vertex: Element, by_id: dict[str, Element]) -> NDArray[np.float64]:
    vertices = by_id[_linked(vertex, by_id)]
    positions = next(each for each in vertices.all("input") if each.get("semantic") == "POSITION")
    numbers = by_id[_linked(positions, by_id)].need("float_array").text
    return np.array(re.split(r"\s+", numbers.strip()), dtype=np.float64).reshape(-1, 3)


def _linked(element: Element, by_id: dict[str, Element]) -> str:
    name = element.attribute("source").lstrip("#")
    if name not in by_id:
        raise element.error(f"there is no element {name!r}")
    return name
