"""Writing map files as `map_saver` does: a PGM image, and a YAML file with the metadata."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .grid_map import GridMap, MapError

BLACK, GREY, WHITE = 0, 205, 254
"""Pixels for occupied, unknown and free. 205 is barely unknown: its p is 0.196078, and free_thresh is 0.196."""

OCCUPIED_FROM, FREE_TO = 65, 25
"""Thresholds [%]: cells are occupied from the first value up, free from 0 to the second, and otherwise unknown."""


def pixels_of(occupancy: NDArray[np.int8], occupied: int = OCCUPIED_FROM, free: int = FREE_TO) -> NDArray[np.uint8]:
    """Return the pixels (h, w), row 0 at the top, for cells (h, w), row 0 at the bottom; thresholds in per cent."""
    values = np.arange(-128, 128)
    table = np.select([(values >= 0) & (values <= free), values >= occupied], [WHITE, BLACK], GREY).astype(np.uint8)
    pixels: NDArray[np.uint8] = np.roll(table, 128)[occupancy[::-1].view(np.uint8)]
    return pixels


def save_map(
    grid: GridMap, name: str | os.PathLike[str], *, occupied: int = OCCUPIED_FROM, free: int = FREE_TO
) -> tuple[Path, Path]:
    """Write a map to NAME.pgm and NAME.yaml; return their paths, the YAML file's first.

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
