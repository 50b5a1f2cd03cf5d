"""Worlds in files of all supported kinds."""

from __future__ import annotations

import codecs
import os
import re
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Literal

from rosmini.core.files import read
from rosmini.core.packages import PackageIndex
from rosmini.sim.sdf import SdfError, converted, load
from rosmini.sim.sdf.document import Note
from rosmini.sim.world import World

from .traced import world_from_map

Kind = Literal["sdf", "stage", "map", "urdf", "xml"]

SCHEME = "package://"


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
            r"<([A-Za-z_][\w:.-]*)",
            re.sub(r"<!--.*?(-->|$)|<[?].*?[?]>|<!DOCTYPE[^>]*>", "", head, flags=re.DOTALL),
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
        from rosmini.sim import stage

        return stage.load(path).world
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


def sdf_world(
    path: str | os.PathLike[str], *, name: str = "", title: str = ""
) -> tuple[World, tuple[Note, ...]]:
    """Return the first world in an SDF file, and notes about what was left out. Raises `SdfError`.

    A world with the common name `default` gets the name of its file.
    """
    document = load(path)
    if not document.worlds:
        found = [f"the model {each.name!r}" for each in document.models]
        has = (
            f"; it has {', '.join(found)}, which stands in a world by <include> or spawn_model"
            if found
            else ""
        )
        raise SdfError(f"there is no <world> in this file{has}", str(path), 1)
    first = document.worlds[0]
    made, notes = converted(first, title=title or f"The world {Path(path).name}")
    called = name or (Path(path).stem if first.name == "default" else first.name)
    return replace(made, name=called), (*document.notes, *notes)
