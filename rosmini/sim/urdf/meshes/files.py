"""Reads meshes: STL (text and binary), COLLADA and Wavefront OBJ, as surfaces in the file's own coordinates."""

from __future__ import annotations

import re
from functools import lru_cache
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rosmini.core import files
from rosmini.core.errors import shown
from rosmini.core.markup import MAX_LENGTH_M, MarkupError, parse_file

from . import collada
from .surface import Surface

Floats = NDArray[np.float64]

MAX_INDEX_DIGITS = 9
"""Maximum number of digits of a vertex index."""


class MeshError(MarkupError):
    """A mesh file is invalid, or of an unsupported kind."""


def read(path: str | PathLike[str], part: str = "") -> tuple[Surface, ...]:
    """Return the surfaces of a ``.stl``, ``.dae`` or ``.obj`` file. STL and OBJ have no colours here.

    With `part`, return only those of the COLLADA nodes, or of the OBJ objects and groups, of this name.

    Raises `MeshError`, with the line in a text file, also for a file without triangles.
    """
    file = Path(path)
    try:
        changed = files.check(file)
    except OSError as error:
        raise MeshError(f"cannot be read: {error.strerror}", file) from error
    return _read(file, part, changed.st_mtime_ns)


@lru_cache(maxsize=64)
def _read(file: Path, part: str, _changed: int) -> tuple[Surface, ...]:
    kind = file.suffix.lower()
    if kind == ".dae":
        found = tuple(collada.read(parse_file(file, MeshError), part))
    elif kind == ".stl":
        found = (_flat(_stl(file)),)
    elif kind == ".obj":
        found = (_flat(_obj(file, part)),)
    else:
        raise MeshError(f"a mesh is a .dae, .stl or .obj file, not {kind or 'one without an ending'}", file)
    if not any(len(surface.faces) for surface in found):
        raise MeshError(f"there is no triangle in it{f' called {part!r}' if part else ''}", file)
    return found


def _bytes(file: Path) -> bytes:
    try:
        return files.read(file)
    except OSError as error:
        raise MeshError(f"cannot be read: {error.strerror}", file) from error


def _flat(triangles: Floats) -> Surface:
    """Return a surface of triangles (m, 3, 3) that share no corners."""
    return Surface(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def _stl(file: Path) -> Floats:
    """Return the triangles (m, 3, 3) of a binary or text file; a binary header may begin with "solid", too."""
    data = _bytes(file)
    count = int.from_bytes(data[80:84], "little") if len(data) >= 84 else -1
    length = 84 + 50 * count
    is_text = data.lstrip()[:5].lower() == b"solid"
    if is_text and len(data) != length:
        triangles = _text_stl(data, file)
        if len(triangles) or not 0 < length <= len(data):
            return triangles
    if count < 0 or len(data) < length:
        raise MeshError(
            f"this is not an STL file: {max(count, 0)} triangles would be {84 + 50 * max(count, 0)} bytes, "
            f"not {len(data)}",
            file,
        )
    kind = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]
    rows = np.frombuffer(data, dtype=kind, offset=84, count=count)
    return _finite(rows["corners"].astype(np.float64), file)


def _text_stl(data: bytes, file: Path) -> Floats:
    corners = []
    for number, line in enumerate(data.decode("utf-8", "replace").lower().splitlines(), start=1):
        words = line.split()
        corners += [_three(words[i + 1 : i + 4], file, number) for i, word in enumerate(words) if word == "vertex"]
    if len(corners) % 3:
        raise MeshError(f"{len(corners)} corners are not triangles", file)
    return _finite(np.array(corners).reshape(-1, 3, 3), file)


def _obj(file: Path, part: str) -> Floats:
    points: list[tuple[float, float, float]] = []
    triangles = []
    wanted = not part
    for number, line in enumerate(_bytes(file).decode("utf-8", "replace").splitlines(), start=1):
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            points.append(_three(words[1:4], file, number))
        elif words[:1] in (["o"], ["g"]) and part:
            wanted = " ".join(words[1:]) == part
        elif words[:1] == ["f"] and wanted:
            found = [re.match(rf"-?\d{{1,{MAX_INDEX_DIGITS}}}(?!\d)", word) for word in words[1:]]
            places = [int(each[0]) if each else 0 for each in found]
            places = [place - 1 if place > 0 else len(points) + place for place in places]
            if len(places) < 3 or not all(0 <= place < len(points) for place in places):
                raise MeshError(
                    f"the face {shown(' '.join(words[1:]))} is invalid: there are {len(points)} vertices", file, number
                )
            triangles += [(places[0], places[i], places[i + 1]) for i in range(1, len(places) - 1)]
    if not triangles:
        return np.empty((0, 3, 3))
    return _finite(np.array(points)[np.array(triangles)], file)


def _three(words: list[str], file: Path, line: int) -> tuple[float, float, float]:
    try:
        x, y, z = (float(word) for word in words)
    except ValueError:
        raise MeshError(f"a corner has three numbers, not {shown(' '.join(words))}", file, line) from None
    return (x, y, z)


def _finite(triangles: Floats, file: Path) -> Floats:
    if not np.isfinite(triangles).all():
        raise MeshError("a corner is not finite", file)
    if (np.abs(triangles) > MAX_LENGTH_M).any():
        raise MeshError(f"a corner is further away than {MAX_LENGTH_M:g} m", file)
    return triangles
