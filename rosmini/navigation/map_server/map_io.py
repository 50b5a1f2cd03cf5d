"""A map as ROS keeps it in files: a YAML file with its numbers, and an image with a pixel for each cell.

What the fields and the colours mean stands on http://wiki.ros.org/map_server, sections 1.1 to 1.3. Where that page is silent, this does what
map_server's image loader does: alpha is averaged with the colours in the mode `trinary` and means "unknown" where it is 0 in the mode `scale`;
values are cut, not rounded. It is stricter in one thing: numbers that make no map are errors here.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError, nearest

if TYPE_CHECKING:
    from PIL.Image import Image

Mode = Literal["trinary", "scale", "raw"]

MODES: tuple[Mode, ...] = ("trinary", "scale", "raw")
REQUIRED = ("image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate")
OPTIONAL = ("mode",)

FREE, OCCUPIED, UNKNOWN = 0, 100, -1


class MapError(RosminiError, ValueError):
    """A map cannot be read; the message names the file and the field at fault."""


@dataclass(frozen=True, eq=False)
class GridMap:
    """A map of square cells, as nav_msgs/OccupancyGrid has it."""

    occupancy: NDArray[np.int8]
    """(h, w), row 0 at the bottom: 0 free, 100 occupied, between them the probability [%], -1 unknown. In the mode raw it is any byte."""
    resolution: float
    """The side of a cell [m]."""
    origin: tuple[float, float, float]
    """x [m], y [m] and heading [rad] of the lower left corner of cell (0, 0), in the frame of the map."""
    path: Path
    """The YAML file it was read from."""

    def __repr__(self) -> str:
        height, width = self.occupancy.shape
        return f"<GridMap {self.path.name}: {width} x {height} cells of {self.resolution:g} m>"

    @property
    def occupied(self) -> NDArray[np.bool_]:
        """A mask (h, w) of the cells that are surely occupied, as costmap_2d's static layer takes them: 100 or more."""
        mask: NDArray[np.bool_] = self.occupancy >= OCCUPIED
        return mask

    @property
    def free(self) -> NDArray[np.bool_]:
        """A mask (h, w) of the cells that are surely free."""
        mask: NDArray[np.bool_] = self.occupancy == FREE
        return mask


@dataclass(frozen=True)
class _Fields:
    """What a YAML file says."""

    image: str
    resolution: float
    origin: tuple[float, float, float]
    occupied_thresh: float
    free_thresh: float
    negate: bool
    mode: Mode


def load_map(yaml_path: str | os.PathLike[str]) -> GridMap:
    """The map that a YAML file describes. Its image is looked for beside the YAML file, unless its path is absolute.

    Raises `MapError` if a file is not there, or is no YAML or no image; if a field is missing or has a value of another type; if the
    resolution is not positive, a number not finite, a threshold not between 0 and 1, or `free_thresh` above `occupied_thresh`; and if
    the image has no pixels or leaves every cell unknown.
    """
    path = Path(yaml_path)
    fields = _fields(path)
    image = path.parent / fields.image
    occupancy = _occupancy(_channels(image, path), fields)
    if fields.mode != "raw" and (occupancy == UNKNOWN).all():
        raise MapError(
            f"{path}: every cell of the map is unknown, for no pixel of {image} is darker than occupied_thresh "
            f"({fields.occupied_thresh:g}) or lighter than free_thresh ({fields.free_thresh:g}) asks for; change the image or these fields"
        )
    occupancy.flags.writeable = False
    return GridMap(occupancy, fields.resolution, fields.origin, path)


# ---- the YAML file ----


def _fields(path: Path) -> _Fields:
    found = _document(path)
    missing = [name for name in REQUIRED if name not in found]
    if missing:
        unknown = [str(name) for name in found if name not in (*REQUIRED, *OPTIONAL)]
        hints = [hint for name in unknown if (hint := nearest(name, missing))]
        said = f" (it has {', '.join(unknown)}: {' '.join(hints)})" if hints else ""
        raise MapError(f"{path}: the map has no field {missing[0]!r}{said}; it needs {', '.join(REQUIRED)}")
    image = found["image"]
    if not isinstance(image, str) or not image:
        raise _wrong(path, "image", image, "the path of an image")
    resolution = _number(path, "resolution", found["resolution"])
    if resolution <= 0:
        raise _wrong(path, "resolution", resolution, "the side of a cell in metres, more than 0")
    occupied, free = (_number(path, name, found[name]) for name in ("occupied_thresh", "free_thresh"))
    for name, value in (("occupied_thresh", occupied), ("free_thresh", free)):
        if not 0 <= value <= 1:
            raise _wrong(path, name, value, "a probability, from 0 to 1")
    if free > occupied:
        raise MapError(
            f"{path}: free_thresh ({free:g}) is above occupied_thresh ({occupied:g}), so cells would be both; usual are 0.196 and 0.65"
        )
    negate = found["negate"]
    if isinstance(negate, bool) or negate not in (0, 1):
        raise _wrong(path, "negate", negate, "0 or 1 (map_server does not read true and false)")
    mode = found.get("mode", "trinary")
    if mode not in MODES:
        hint = nearest(str(mode), MODES)
        raise _wrong(path, "mode", mode, f"one of {', '.join(MODES)}{'; ' + hint if hint else ''}")
    return _Fields(
        image, resolution, _origin(path, found["origin"]), occupied, free, bool(negate), cast("Mode", mode)
    )


def _document(path: Path) -> Mapping[Any, Any]:
    import yaml

    try:
        found = yaml.safe_load(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise MapError(f"there is no map {path}: {_nearest_file(path)}".rstrip(": ")) from error
    except OSError as error:
        raise MapError(f"the map {path} cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        reason = " ".join(str(error).split())
        raise MapError(
            f"{path} is not YAML: {reason}. A map is the YAML file, which names the image"
        ) from error
    if not isinstance(found, dict):
        raise MapError(f"{path} is not a map: it has no fields; it needs {', '.join(REQUIRED)}")
    return found


def _origin(path: Path, value: object) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise _wrong(path, "origin", value, "a list of x, y and yaw")
    x, y, yaw = (_number(path, "origin", each) for each in value)
    return x, y, yaw


def _number(path: Path, name: str, value: object) -> float:
    try:
        # PyYAML takes 5e-2 for a string, map_server does not.
        number = math.nan if isinstance(value, bool) else float(cast("float", value))
    except (TypeError, ValueError, OverflowError) as error:
        raise _wrong(path, name, value, "a number") from error
    if not math.isfinite(number):
        raise _wrong(path, name, value, "a finite number")
    return number


def _wrong(path: Path, name: str, value: object, wanted: str) -> MapError:
    return MapError(f"{path}: the field {name!r} is {value!r}; it has to be {wanted}")


def _nearest_file(path: Path) -> str:
    if not path.parent.is_dir():
        return f"there is no folder {path.parent}"
    return nearest(
        path.name, [each.name for each in path.parent.iterdir() if each.suffix in (".yaml", ".yml")]
    )


# ---- the image ----


def _channels(image: Path, path: Path) -> NDArray[np.uint8]:
    """The pixels (h, w, channels), row 0 at the bottom."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(image) as opened:
            pixels = _eight_bits(opened)
    except FileNotFoundError as error:
        raise MapError(f"{path}: the field 'image' names {image}, which is not there") from error
    except (UnidentifiedImageError, Image.DecompressionBombError) as error:
        raise MapError(f"{path}: the field 'image' names {image}, which is no image: {error}") from error
    except (OSError, SyntaxError, ValueError) as error:  # what Pillow raises for a broken one
        raise MapError(f"{path}: the image {image} cannot be read: {error}") from error
    if not pixels.size:
        raise MapError(f"{path}: the image {image} has no pixels")
    return pixels[::-1]


def _eight_bits(image: Image) -> NDArray[np.uint8]:
    """The pixels (h, w, channels) with 8 bits a channel: grey alone, or colours, with alpha if there is any."""
    if image.mode.startswith("I"):  # 16 bits: the lower ones are dropped
        wide = np.asarray(image).astype(np.int64)
        grey: NDArray[np.uint8] = np.clip(wide >> 8, 0, 255).astype(np.uint8)[..., None]
        return grey
    if image.mode == "1":
        image = image.convert("L")
    elif image.mode in ("LA", "PA") or (image.mode == "P" and "transparency" in image.info):
        image = image.convert("RGBA")
    elif image.mode not in ("L", "RGB", "RGBA"):
        image = image.convert("RGB")
    pixels = np.asarray(image, dtype=np.uint8)
    return pixels[..., None] if pixels.ndim == 2 else pixels


def _occupancy(pixels: NDArray[np.uint8], fields: _Fields) -> NDArray[np.int8]:
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
