"""Writes maps as files."""

from __future__ import annotations

from pathlib import Path

from rosmini.core.maps import GridMap
from rosmini.core.maps.map_io import pixels_of


def write_map(grid: GridMap, yaml_path: Path) -> list[Path]:
    """Write a map as `map_saver` does, but with its image as PNG, beside the YAML file; returns the files written."""
    from PIL import Image

    image = yaml_path.with_suffix(".png")
    Image.fromarray(pixels_of(grid.occupancy)).save(image, optimize=True)
    origin = ", ".join(f"{round(float(value), 6)}" for value in grid.origin)
    yaml_path.write_text(
        f"image: {image.name}\nresolution: {grid.resolution}\norigin: [{origin}]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n",
        encoding="utf-8",
        newline="\n",
    )
    return [yaml_path, image]
