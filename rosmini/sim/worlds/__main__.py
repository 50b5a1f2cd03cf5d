"""`python -m rosmini.sim.worlds` draws the maps and writes the world files that rosmini brings again."""

from __future__ import annotations

from pathlib import Path

from rosmini.packages import assets_dir
from rosmini.sim.sdf.writer import to_sdf
from rosmini.sim.world import World

from . import floor, house, maze, office, pillars, source, world
from .rasters import to_map, write_map


def texts() -> dict[Path, str]:
    """What is to stand in the world files, by their paths."""
    made = {
        "house": house.house(),
        "maze": maze.maze(),
        "office": office.office(),
        "pillars": pillars.pillars(),
    }
    found = {path: to_sdf(made[name]) for name in made if (path := source(name)) is not None}
    found[assets_dir() / "ros" / "turtlebot3_gazebo" / "worlds" / "empty.world"] = to_sdf(World("empty"))
    return found


def main() -> None:
    """Write all files and say which."""
    for path, text in texts().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
        print(path)
    written = floor.write(floor.maps_dir())
    for name in ("house", "office"):
        written += write_map(to_map(world(name)), floor.maps_dir() / f"{name}.yaml")
    for path in written:
        print(path)


if __name__ == "__main__":
    main()
