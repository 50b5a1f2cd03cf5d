"""A map as ROS keeps it in files: a YAML file with its numbers, and an image with a pixel for each cell.

What the fields and the colours mean stands on http://wiki.ros.org/map_server, sections 1.1 to 1.3. Where that page is
silent, this does what map_server's image loader does: alpha is averaged with the colours in the mode `trinary` and
means "unknown" where it is 0 in the mode `scale`; values are cut, not rounded. It is stricter in one thing: a
cell without size and numbers that are not finite are errors here. Where map_server silently makes a map that is of no
use, such as one that is unknown everywhere, there is a warning.
"""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from rosmini.core import files, images
from rosmini.core.errors import nearest, shown
from rosmini.core.graph.show import show

from .grid_map import FREE, OCCUPIED, UNKNOWN, GridMap, MapDataError, MapMetadataError, MapMissing

if TYPE_CHECKING:
    from PIL.Image import Image

Mode = Literal["trinary", "scale", "raw"]

MODES: tuple[Mode, ...] = ("trinary", "scale", "raw")
REQUIRED = ("image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate")
OPTIONAL = ("mode",)

AT_ONCE = 1_000_000
"""So many pixels are computed with at a time: for each it takes many bytes."""

LARGEST_TEXT = 1_000_000
"""Bytes of a YAML file."""

SMALLEST, LARGEST = 1e-6, 1e9
"""Of a cell and of a whole map [m]: what is beyond is a mistake, and cannot be calculated with."""


@dataclass(frozen=True)
class Fields:
    """What a YAML file says."""

    image: str
    resolution: float
    origin: tuple[float, float, float]
    occupied_thresh: float
    free_thresh: float
    negate: bool
    mode: Mode


@dataclass(frozen=True)
class _Document:
    """A YAML file with a mapping in it."""

    path: Path
    fields: Mapping[Any, Any]
    lines: Mapping[Any, int]
    """Where each field stands."""

    def place(self, name: str) -> str:
        """The file, and the line of a field."""
        return f"{self.path}:{self.lines[name]}" if name in self.lines else str(self.path)


@dataclass(frozen=True)
class MapFile:
    """The description of a map, checked; its image is not yet read."""

    document: _Document
    fields: Fields

    @property
    def image(self) -> Path:
        """The image: beside the YAML file, unless its path is absolute."""
        return self.document.path.parent / self.fields.image

    def pixels(self) -> NDArray[np.uint8]:
        """The image's pixels (h, w, channels), row 0 at the bottom. Raises `MapDataError` if it cannot be read."""
        return _channels(self.image, self.document.place("image"))

    def show(self, **options: Any) -> Any:
        """The image and the map made from it, for several thresholds: see `rosmini.viz.stepped_pictures.map_steps`."""
        return show("map_file", self, **options)

    def load(self, warn: Callable[[str], object] = warnings.warn) -> GridMap:
        """The map. Raises `MapError` as `load_map` does; `warn` is called if it is probably not the one wanted."""
        document, fields = self.document, self.fields
        occupancy = occupancy_of(self.pixels(), fields)
        most = max(occupancy.shape)
        if not SMALLEST <= fields.resolution <= most * fields.resolution <= LARGEST:
            bounds = f"{SMALLEST:g} or more, and with {most} of them no more than {LARGEST:g}"
            wanted = f"the side of a cell in metres, {bounds}"
            raise _wrong(document, "resolution", fields.resolution, wanted)
        odd = _odd_thresholds(fields) if fields.mode != "raw" else ""
        if fields.mode != "raw" and (occupancy == UNKNOWN).all():
            odd = (
                f"every cell of the map is unknown: no pixel of {self.image} is darker than occupied_thresh "
                f"({fields.occupied_thresh:g}) or lighter than free_thresh ({fields.free_thresh:g}) asks for"
            )
        if odd:
            warn(f"{document.path}: {odd}; change the image or these fields")
        occupancy.flags.writeable = False
        return GridMap(occupancy, fields.resolution, fields.origin, document.path)


def map_file(yaml_path: str | os.PathLike[str]) -> MapFile:
    """What a YAML file says of a map. Raises `MapError` as `load_map` does."""
    document = _document(Path(yaml_path))
    return MapFile(document, _fields(document))


def image_file(
    path: str | os.PathLike[str],
    resolution: float,
    *,
    negate: int = 0,
    occupied_thresh: float = 0.65,
    free_thresh: float = 0.196,
) -> MapFile:
    """An image alone as a map, in the mode trinary and with its origin at (0, 0): what map_server once took.

    Raises `MapMetadataError` for numbers that make no map.
    """
    image = Path(path)
    given = {
        "image": image.name,
        "resolution": resolution,
        "origin": [0.0, 0.0, 0.0],
        "occupied_thresh": occupied_thresh,
        "free_thresh": free_thresh,
        "negate": negate,
    }
    document = _Document(image, given, {})
    return MapFile(document, _fields(document))


def load_map(yaml_path: str | os.PathLike[str]) -> GridMap:
    """The map that a YAML file describes. Its image is looked for beside the YAML file, unless its path is absolute.

    Raises `MapError`, as `MapMissing` if there is no such file; as `MapMetadataError` if it is no YAML, a field is
    missing or has a value of another type, the resolution is not positive or a number not finite; as `MapDataError`
    if the image is not there, is none or has no pixels. Warns of a map that is probably not the one wanted.
    """
    return map_file(yaml_path).load()


def _fields(document: _Document) -> Fields:
    found = document.fields
    missing = [name for name in REQUIRED if name not in found]
    if missing:
        unknown = [str(name) for name in found if name not in (*REQUIRED, *OPTIONAL)]
        hints = [hint for name in unknown if (hint := nearest(name, missing))]
        said = f" (it has {', '.join(unknown)}: {' '.join(hints)})" if hints else ""
        raise MapMetadataError(
            f"{document.path}: the map has no field {missing[0]!r}{said}; it needs {', '.join(REQUIRED)}",
            missing[0],
        )
    image = found["image"]
    if not isinstance(image, str) or not image:
        raise _wrong(document, "image", image, "the path of an image")
    resolution = _number(document, "resolution", found["resolution"])
    if resolution <= 0:
        raise _wrong(document, "resolution", resolution, "the side of a cell in metres, more than 0")
    occupied, free = (_number(document, name, found[name]) for name in ("occupied_thresh", "free_thresh"))
    negate = _whole(document, "negate", found["negate"], "0 or 1 (map_server does not read true and false)")
    mode = found.get("mode")
    if mode is None or isinstance(mode, list | dict | set):  # map_server overlooks what is not one word
        mode = "trinary"
    if mode not in MODES:
        hint = nearest(str(mode), MODES)
        raise _wrong(document, "mode", mode, f"one of {', '.join(MODES)}{'; ' + hint if hint else ''}")
    origin = _origin(document, found["origin"])
    return Fields(image, resolution, origin, occupied, free, bool(negate), cast("Mode", mode))


def _odd_thresholds(fields: Fields) -> str:
    """What is wrong with the thresholds, which map_server does not check; or nothing."""
    occupied, free = fields.occupied_thresh, fields.free_thresh
    if occupied < free:
        return f"occupied_thresh ({occupied:g}) is below free_thresh ({free:g}), so the greys between are occupied"
    for name, value, cells in (("occupied_thresh", occupied, "occupied"), ("free_thresh", free, "free")):
        if not 0 <= value <= 1:
            which = "all" if (value > 1) == (cells == "free") else "no"
            return f"{name} ({value:g}) is not a probability from 0 to 1: {which} cells can be {cells}"
    return ""


def _document(path: Path) -> _Document:
    import yaml

    from rosmini.core.yaml_text import documents

    try:
        text = files.read(path, LARGEST_TEXT).decode("utf-8-sig", errors="replace")
    except FileNotFoundError as error:
        raise MapMissing(f"there is no map {path}: {_nearest_file(path)}".rstrip(": ")) from error
    except OSError as error:
        raise MapMissing(f"the map {path} cannot be read: {error.strerror}") from error
    found, root = next(documents(text, str(path), _no_yaml), (None, None))
    if not isinstance(found, dict) or not isinstance(root, yaml.MappingNode):
        raise MapMetadataError(f"{path} is not a map: it has no fields; it needs {', '.join(REQUIRED)}")
    lines = {key.value: key.start_mark.line + 1 for key, _ in root.value if isinstance(key, yaml.ScalarNode)}
    return _Document(path, found, lines)


def _no_yaml(message: str, path: str, line: int | None) -> MapMetadataError:
    place = path if line is None else f"{path}:{line}"
    return MapMetadataError(f"{place}: {message}. A map is the YAML file, which names the image")


def _origin(document: _Document, value: object) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) < 3:
        raise _wrong(document, "origin", value, "a list of x, y and yaw")
    x, y, yaw = (_number(document, "origin", each) for each in value[:3])
    return x, y, yaw


def _whole(document: _Document, name: str, value: object, wanted: str) -> int:
    """A whole number, in quotation marks or not."""
    try:
        if isinstance(value, str) or type(value) is int:
            return int(value)
    except ValueError:
        pass
    raise _wrong(document, name, value, wanted)


def _number(document: _Document, name: str, value: object) -> float:
    try:
        # PyYAML takes 5e-2 for a string, map_server does not.
        number = math.nan if isinstance(value, bool) else float(cast("float", value))
    except (TypeError, ValueError, OverflowError) as error:
        raise _wrong(document, name, value, "a number") from error
    if not math.isfinite(number):
        raise _wrong(document, name, value, "a finite number")
    return number


def _wrong(document: _Document, name: str, value: object, wanted: str) -> MapMetadataError:
    said = f"{document.place(name)}: the field {name!r} is {shown(value)}; it has to be {wanted}"
    return MapMetadataError(said, name)


def _nearest_file(path: Path) -> str:
    if not path.parent.is_dir():
        return f"there is no folder {path.parent}"
    there = files.names_in(path.parent)
    return nearest(path.name, [name for name in there if name.endswith((".yaml", ".yml"))])


# ---- the image ----


def _channels(image: Path, place: str) -> NDArray[np.uint8]:
    """The pixels (h, w, channels), row 0 at the bottom."""
    try:
        with images.opened(image) as opened:
            pixels = _eight_bits(opened)
    except FileNotFoundError as error:
        raise MapDataError(f"{place}: the field 'image' names {image}, which is not there") from error
    except images.ImageError as error:
        raise MapDataError(
            f"{place}: the field 'image' names {image}, which cannot be read: {error}"
        ) from error
    if not pixels.size:
        raise MapDataError(f"{place}: the image {image} has no pixels")
    return pixels[::-1]


def _eight_bits(image: Image) -> NDArray[np.uint8]:
    """The pixels (h, w, channels) with 8 bits a channel: grey alone, or colours, with alpha if there is any."""
    if image.mode.startswith("I"):  # 16 bits: the lower ones are dropped
        grey: NDArray[np.uint8] = np.clip(np.asarray(image) >> 8, 0, 255).astype(np.uint8)[..., None]
        return grey
    if image.mode == "1":
        image = image.convert("L")
    elif image.mode in ("LA", "PA") or (image.mode == "P" and "transparency" in image.info):
        image = image.convert("RGBA")
    elif image.mode not in ("L", "RGB", "RGBA"):
        image = image.convert("RGB")
    pixels = np.asarray(image, dtype=np.uint8)
    return pixels[..., None] if pixels.ndim == 2 else pixels


def occupancy_of(pixels: NDArray[np.uint8], fields: Fields) -> NDArray[np.int8]:
    """What pixels (h, w, channels) mean by the numbers of a YAML file: (h, w), as in `GridMap.occupancy`."""
    if pixels.shape[2] == 1:  # a grey has one meaning, so it is worked out once
        table = _cells(np.arange(256, dtype=np.uint8).reshape(1, 256, 1), fields)[0]
        found: NDArray[np.int8] = table[pixels[..., 0]]
        return found
    cells: NDArray[np.int8] = np.empty(pixels.shape[:2], dtype=np.int8)
    rows = max(1, AT_ONCE // pixels.shape[1])
    for first in range(0, len(pixels), rows):
        cells[first : first + rows] = _cells(pixels[first : first + rows], fields)
    return cells


def _cells(pixels: NDArray[np.uint8], fields: Fields) -> NDArray[np.int8]:
    channels = pixels.shape[2]
    colours = 3 if channels == 4 and fields.mode != "trinary" else channels
    grey = pixels[..., :colours].sum(axis=2, dtype=np.int64) / colours
    if fields.negate:
        grey = 255 - grey
    if fields.mode == "raw":
        raw: NDArray[np.int8] = grey.astype(np.uint8).view(np.int8)
        return raw
    probability = (255 - grey) / 255.0
    is_occupied = probability > fields.occupied_thresh
    is_free = ~is_occupied & (probability < fields.free_thresh)
    cells: NDArray[np.int8] = np.full(grey.shape, UNKNOWN, dtype=np.int8)
    if fields.mode == "scale":
        span = fields.occupied_thresh - fields.free_thresh
        # Where the thresholds are equal, only what equals them is between: it is 1.
        share = np.clip((probability - fields.free_thresh) / span, 0, 1) if span else np.zeros_like(grey)
        # The last channel is taken for alpha even where it is blue, as map_server does.
        seen = pixels[..., -1] > 0 if channels > 1 else np.ones(grey.shape, dtype=bool)
        cells[seen] = (1 + 98 * share[seen]).astype(np.int8)
    cells[is_free] = FREE
    cells[is_occupied] = OCCUPIED
    return cells
