"""``python -m rosmini.urdf.meshes [FOLDER]``: make the meshes of the TurtleBot3, in its package if no folder is named."""

from __future__ import annotations

import sys
from pathlib import Path

from rosmini.packages import assets_dir

from .turtlebot3 import files


def main(arguments: list[str]) -> None:
    """Write the files and say how large they are."""
    folder = Path(arguments[0]) if arguments else assets_dir() / "ros" / "turtlebot3_description" / "meshes"
    made = files()
    for name, data in made.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        print(f"{len(data) / 1000:6.1f} kB  {name}")
    print(f"{sum(map(len, made.values())) / 1000:6.1f} kB  together")


if __name__ == "__main__":
    main(sys.argv[1:])
