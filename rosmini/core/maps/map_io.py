"""ROS's map files, read and written: a YAML file with the metadata, and an image with one pixel per cell.

The fields and colours are described on http://wiki.ros.org/map_server, sections 1.1 to 1.3. Where that page is silent,
this follows map_server's image loader: alpha is averaged with the colours in the mode `trinary`, and means "unknown" if
it is 0 in the mode `scale`; values are truncated, not rounded. Unlike in map_server, a resolution of 0 and numbers that
are not finite are errors, and a useless map, such as one that is unknown everywhere, causes a warning.
"""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from rosmini.core import files, images
from rosmini.core.errors import nearest, shown

from .grid_map import FREE, OCCUPIED, UNKNOWN, GridMap, MapDataError, MapError, MapMetadataError, MapMissing

if TYPE_CHECKING:
    from PIL.Image import Image

Mode = Literal["trinary", "scale", "raw"]
_Cell = TypeVar("_Cell", np.uint8, np.int8)

MODES: tuple[Mode, ...] = ("trinary", "scale", "raw")
REQUIRED = ("image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate")
OPTIONAL = ("mode",)

MAX_YAML_BYTES = 1_000_000
"""Maximum size of a YAML file [bytes]."""

MIN_CELL_M, MAX_MAP_M = 1e-6, 1e9
"""Minimum size of a cell and maximum size of a map [m]; other values are mistakes and cause overflows."""

BLACK, GREY, WHITE = 0, 205, 254
"""Pixels written for occupied, unknown and free. 205 is barely unknown: its p is 0.196078, and free_thresh is 0.196."""

OCCUPIED_FROM, FREE_TO = 65, 25
"""Thresholds for writing [%]: cells are occupied from the first up, free from 0 to the second, otherwise unknown."""


@dataclass(frozen=True)
class Fields:
    """The fields of a map's YAML file: resolution [m], origin [m, m, rad], thresholds from 0 to 1."""

    image: str
    resolution: float
    origin: tuple[float, float, float]
    occupied_thresh: float
    free_thresh: float
    negate: bool
    mode: Mode


@dataclass(frozen=True)
class _Document:
    """A YAML file that contains a mapping."""

    path: Path
    fields: Mapping[Any, Any]
    lines: Mapping[Any, int]
    """The line of each field."""

    def place(self, name: str) -> str:
        """Return the file and the line of a field, for an error message."""
        return f"{self.path}:{self.lines[name]}" if name in self.lines else str(self.path)


@dataclass(frozen=True)
class MapFile:
    """The checked YAML file of a map. `load` reads its image."""

    document: _Document
    fields: Fields

    @property
    def image(self) -> Path:
        """The path of the image, relative to the folder of the YAML file unless absolute."""
        return self.document.path.parent / self.fields.image

    def _rows(self, convert: Callable[[NDArray[np.uint8]], NDArray[_Cell]]) -> NDArray[_Cell]:
        """Return the image with its pixels (h, w, channels) converted by `convert`, row 0 at the bottom."""
        place, image = self.document.place("image"), self.image
        found: NDArray[_Cell] | None = None
        try:
            with images.opened(image) as opened:
                for top, strip in images.strips(opened):
                    part: NDArray[_Cell] = convert(_eight_bits(strip))
                    if found is None:
                        found = np.empty((opened.height, *part.shape[1:]), dtype=part.dtype)
                    bottom = opened.height - top
                    found[bottom - len(part) : bottom] = part[::-1]
        except FileNotFoundError as error:
            raise MapDataError(f"{place}: the field 'image' names {image}, which is not there") from error
        except images.ImageError as error:
            raise MapDataError(f"{place}: the field 'image' names {image}, which cannot be read: {error}") from error
        if found is None or not found.size:
            raise MapDataError(f"{place}: the image {image} has no pixels")
        return found

    def load(self, warn: Callable[[str], object] = warnings.warn) -> GridMap:
        """Load the map. Raises `MapError` as `load_map` does; `warn` is called for a map that is probably a mistake."""
        document, fields = self.document, self.fields
        occupancy = self._rows(lambda pixels: occupancy_of(pixels, fields))
        most = max(occupancy.shape)
        if not MIN_CELL_M <= fields.resolution <= most * fields.resolution <= MAX_MAP_M:
            bounds = f"{MIN_CELL_M:g} or more, and with {most} of them no more than {MAX_MAP_M:g}"
            requirement = f"the side of a cell in metres, {bounds}"
            raise _wrong(document, "resolution", fields.resolution, requirement)
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
    """Return the description of a map in a YAML file, without reading the image. Raises `MapError` as `load_map`."""
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
    """Return the description of a map for an image without a YAML file, as old versions of map_server accept it.

    The mode is trinary, the origin (0, 0, 0), and a cell `resolution` metres wide. Raises `MapMetadataError` for
    invalid numbers.
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
    """Load the map that a YAML file describes. The image's path is relative to its folder, unless absolute.

    Raises `MapError`: `MapMissing` if the YAML file cannot be read; `MapMetadataError` if it is not YAML, a field is
    missing or of another type, the resolution is not positive or a number not finite; `MapDataError` if the image is
    missing, unreadable or empty. Warns of a map that is probably a mistake.
    """
    return map_file(yaml_path).load()


def _fields(document: _Document) -> Fields:
    found = document.fields
    missing = [name for name in REQUIRED if name not in found]
    if missing:
        unknown = [str(name) for name in found if name not in (*REQUIRED, *OPTIONAL)]
        hints = [hint for name in unknown if (hint := nearest(name, missing))]
        text = f" (it has {', '.join(unknown)}: {' '.join(hints)})" if hints else ""
        raise MapMetadataError(
            f"{document.path}: the map has no field {missing[0]!r}{text}; it needs {', '.join(REQUIRED)}", missing[0]
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
    if mode is None or isinstance(mode, list | dict | set):  # map_server ignores a value that is not a scalar
        mode = "trinary"
    if mode not in MODES:
        hint = nearest(str(mode), MODES)
        raise _wrong(document, "mode", mode, f"one of {', '.join(MODES)}{'; ' + hint if hint else ''}")
    origin = _origin(document, found["origin"])
    return Fields(image, resolution, origin, occupied, free, bool(negate), cast("Mode", mode))


def _odd_thresholds(fields: Fields) -> str:
    """Return a description of an error in the thresholds, which map_server does not check; empty if there is none."""
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
        text = files.read(path, MAX_YAML_BYTES).decode("utf-8-sig", errors="replace")
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


def _whole(document: _Document, name: str, value: object, requirement: str) -> int:
    """Return the integer `value`, which may be in quotation marks. Raises `MapMetadataError` for anything else."""
    try:
        if isinstance(value, str) or type(value) is int:
            return int(value)
    except ValueError:
        pass
    raise _wrong(document, name, value, requirement)


def _number(document: _Document, name: str, value: object) -> float:
    try:
        # PyYAML reads 5e-2 as a string, map_server does not.
        number = math.nan if isinstance(value, bool) else float(cast("float", value))
    except (TypeError, ValueError, OverflowError) as error:
        raise _wrong(document, name, value, "a number") from error
    if not math.isfinite(number):
        raise _wrong(document, name, value, "a finite number")
    return number


def _wrong(document: _Document, name: str, value: object, requirement: str) -> MapMetadataError:
    text = f"{document.place(name)}: the field {name!r} is {shown(value)}; it must be {requirement}"
    return MapMetadataError(text, name)


def _nearest_file(path: Path) -> str:
    if not path.parent.is_dir():
        return f"there is no folder {path.parent}"
    there = files.names_in(path.parent)
    return nearest(path.name, [name for name in there if name.endswith((".yaml", ".yml"))])


# ---- the image ----


def _eight_bits(image: Image) -> NDArray[np.uint8]:
    """Return the pixels (h, w, channels) with 8 bits per channel: grey, or colours, with alpha if there is any."""
    if image.mode.startswith("I"):  # 16 bits: drop the lower ones
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
    """Return the cells (h, w) for pixels (h, w, channels) and the fields of a YAML file, as `GridMap.occupancy`."""
    if pixels.shape[2] == 1:  # each grey value gives one cell value, so look it up
        table = _cells(np.arange(256, dtype=np.uint8).reshape(1, 256, 1), fields)[0]
        found: NDArray[np.int8] = table[pixels[..., 0]]
        return found
    cells: NDArray[np.int8] = np.empty(pixels.shape[:2], dtype=np.int8)
    rows = max(1, images.AT_ONCE // pixels.shape[1])
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
        # If the thresholds are equal, only probabilities equal to them are in between; these become 1.
        share = np.clip((probability - fields.free_thresh) / span, 0, 1) if span else np.zeros_like(grey)
        # Like map_server, treat the last channel as alpha even if it is blue.
        seen = pixels[..., -1] > 0 if channels > 1 else np.ones(grey.shape, dtype=bool)
        cells[seen] = (1 + 98 * share[seen]).astype(np.int8)
    cells[is_free] = FREE
    cells[is_occupied] = OCCUPIED
    return cells


def pixels_of(occupancy: NDArray[np.int8], occupied: int = OCCUPIED_FROM, free: int = FREE_TO) -> NDArray[np.uint8]:
    """Return the pixels (h, w), row 0 at the top, for cells (h, w), row 0 at the bottom; thresholds in per cent."""
    values = np.arange(-128, 128)
    table = np.select([(values >= 0) & (values <= free), values >= occupied], [WHITE, BLACK], GREY).astype(np.uint8)
    pixels: NDArray[np.uint8] = np.roll(table, 128)[occupancy[::-1].view(np.uint8)]
    return pixels


def save_map(
    grid: GridMap, name: str | os.PathLike[str], *, occupied: int = OCCUPIED_FROM, free: int = FREE_TO
) -> tuple[Path, Path]:
    """Write a map to NAME.pgm and NAME.yaml, as `map_saver` does; return their paths, the YAML file's first.

    The files are the same as map_saver's, byte for byte, with one exception. In `maps/house.yaml`, map_saver calls the
    image `maps/house.pgm`, which map_server then looks for in `maps/maps`; this function calls it `house.pgm`. An
    absolute path stays absolute.

    Numbers have six decimals, as in map_saver. Raises `MapError` if a file cannot be written.
    """
    yaml, image = Path(f"{os.fspath(name)}.yaml"), Path(f"{os.fspath(name)}.pgm")
    height, width = grid.occupancy.shape
    x, y, yaw = grid.origin
    head = f"P5\n# CREATOR: map_saver.cpp {grid.resolution:.3f} m/pix\n{width} {height}\n255\n"
    numbers = f"resolution: {grid.resolution:f}\norigin: [{x:f}, {y:f}, {yaw:f}]\n"
    named = image if image.is_absolute() else image.name
    fields = f"image: {named}\n{numbers}negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n"
    for path, data in (
        (image, head.encode() + pixels_of(grid.occupancy, occupied, free).tobytes()),
        (yaml, fields.encode()),
    ):
        try:
            path.write_bytes(data)
        except OSError as error:
            raise MapError(f"Couldn't save map file to {path}: {error.strerror}") from error
    return yaml, image
