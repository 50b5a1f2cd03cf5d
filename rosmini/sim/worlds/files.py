"""Worlds in files of all supported kinds."""

from __future__ import annotations

import codecs
import os
import re
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.core.files import read
from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.poses import inverse, transform_points
from rosmini.core.maps import GridMap, load_map
from rosmini.core.packages import SCHEME, PackageIndex
from rosmini.sim.geometry.contours import trace
from rosmini.sim.sdf import SdfError, converted, load
from rosmini.sim.sdf.document import Note
from rosmini.sim.world import Pose, World, WorldError

Kind = Literal["sdf", "stage", "map", "urdf", "xml"]

START_CLEARANCE = 0.25
"""Required free space around a start, to each side [m]."""
ENOUGH_CLEARANCE = 1.0
"""Free space beyond which a place is not considered better [m]."""


def kind_of(path: str | os.PathLike[str]) -> Kind:
    """Return a file's kind by its content: XML by its first element, a map by its suffix or fields, else a Stage world.

    The suffix decides if the content is not conclusive. The file is given by its path or `package://` address. Raises
    `UnknownPackage` or `RosminiError` for an address that does not exist.
    """
    text = os.fspath(path)
    path = Path(PackageIndex().resolve(text)) if text.startswith(SCHEME) else Path(text)
    try:
        start = read(path)[:50_000]
    except OSError:
        start = b""
    wide = start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    head = start.decode("utf-16" if wide else "utf-8", "replace").lstrip("\ufeff").lstrip()
    if head.startswith("<"):
        first = re.search(
            r"<([A-Za-z_][\w:.-]*)", re.sub(r"<!--.*?(-->|$)|<[?].*?[?]>|<!DOCTYPE[^>]*>", "", head, flags=re.DOTALL)
        )
        tag = first[1] if first else ""
        return "sdf" if tag in ("sdf", "gazebo") else "urdf" if tag == "robot" else "xml"
    suffix = path.suffix.lower()
    if suffix in (".yaml", ".yml", ".pgm", ".png"):
        return "map"
    if suffix in (".sdf", ".urdf", ".xacro"):
        return "sdf" if suffix == ".sdf" else "urdf"
    if head and re.search(r"^(image|resolution|origin)\s*:", head, flags=re.MULTILINE):
        return "map"
    return "stage" if head or suffix == ".world" else "map"


def world_from_file(path: str | os.PathLike[str]) -> World:
    """Return the world in a file. Raises the errors of its kind's reader, and `SdfError` for XML that is not SDF."""
    kind = kind_of(path)
    if kind == "stage":
        from rosmini.sim.stage.world_file import load

        return load(path).world
    if kind == "map":
        return world_from_map(path)
    return world_from_sdf(path)


def world_from_sdf(path: str | os.PathLike[str], *, name: str = "", title: str = "") -> World:
    """Return the first world in an SDF file; see `sdf_world` for what was left out.

    One warning lists missing models and meshes, and other faults of the file that were corrected. Raises
    `SdfError`.
    """
    made, notes = sdf_world(path, name=name, title=title)
    wrong = [str(note) for note in notes if note.warning]
    if wrong:
        warnings.warn("\n".join([f"the world {made.name!r} is incomplete:", *wrong]), stacklevel=2)
    return made


def sdf_world(path: str | os.PathLike[str], *, name: str = "", title: str = "") -> tuple[World, tuple[Note, ...]]:
    """Return the first world in an SDF file, and notes about what was left out. Raises `SdfError`.

    A world with the common name `default` gets the name of its file.
    """
    document = load(path)
    if not document.worlds:
        found = [f"the model {each.name!r}" for each in document.models]
        has = f"; it has {', '.join(found)}, which <include> or spawn_model adds to a world" if found else ""
        raise SdfError(f"there is no <world> in this file{has}", str(path), 1)
    first = document.worlds[0]
    made, notes = converted(first, title=title or f"The world {Path(path).name}")
    called = name or (Path(path).stem if first.name == "default" else first.name)
    return replace(made, name=called), (*document.notes, *notes)


def world_from_map(
    yaml_path: str | os.PathLike[str], *, title: str = "", starts: tuple[Pose, ...] | None = None
) -> World:
    """Return the world of a map: its walls are the outlines of the occupied cells, in the frame of the map.

    Unknown cells count as free. Without `starts` a robot starts at the origin of the map's frame, usually the start of
    the robot that made the map, or in the largest free space if the origin is not free. Raises `load_map`'s errors, and
    `WorldError` for too many outlines.
    """
    grid = load_map(yaml_path)
    try:
        walls = trace(grid.occupied, grid.resolution, grid.origin)
    except GeometryError as error:
        raise WorldError(f"{yaml_path}: {error}") from error
    return World(
        Path(yaml_path).stem,
        walls=walls,
        starts=starts or (_start(grid),),
        title=title or f"The map {Path(yaml_path).name}",
        solid=True,
    )


def _start(grid: GridMap) -> Pose:
    column, row = transform_points(inverse(grid.origin), [(0.0, 0.0)])[0] / grid.resolution
    reach = START_CLEARANCE / grid.resolution
    height, width = grid.free.shape
    if reach <= column <= width - reach and reach <= row <= height - reach:
        around = grid.free[
            int(row - reach) : int(np.ceil(row + reach)), int(column - reach) : int(np.ceil(column + reach))
        ]
        if around.all():
            return (0.0, 0.0, 0.0)
    rows, columns = np.nonzero(_roomiest(grid.free, int(np.ceil(ENOUGH_CLEARANCE / grid.resolution))))
    if not len(rows):
        return (0.0, 0.0, 0.0)
    nearest = np.argmin(np.hypot(columns + 0.5 - column, rows + 0.5 - row))
    cell = np.array([(columns[nearest] + 0.5, rows[nearest] + 0.5)]) * grid.resolution
    x, y = transform_points(grid.origin, cell)[0]
    return (float(x), float(y), 0.0)


def _roomiest(free: NDArray[np.bool_], most: int) -> NDArray[np.bool_]:
    """Return the free cells farthest from all others, in steps to the sides; at most `most` steps are considered."""
    left = free
    for _ in range(most):
        padded = np.pad(left, 1)
        inner = left & padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
        if not inner.any():
            break
        left = inner
    return left
