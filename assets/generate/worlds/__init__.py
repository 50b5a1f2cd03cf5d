"""Our own worlds, and the files made from them: SDF worlds, and ROS maps of some."""

from __future__ import annotations

from pathlib import Path

from rosmini.sim.world import World
from rosmini.sim.worlds import world
from rosmini.sim.worlds.world_map import to_map

from .floor import draw
from .house import house
from .map_file import write_map
from .maze import maze
from .office import office
from .pillars import pillars
from .sdf_writer import to_sdf

MAPPED = {
    "rosmini_sim/maps/house": "house",
    "rosmini_sim/maps/maze": "maze",
    "rosmini_sim/maps/office": "office",
    "rosmini_sim/maps/room": "room",
    "turtlebot3_navigation/maps/map": "pillars",
}
"""The worlds that also have a map, by its path below `assets/ros`."""


def sdf_texts() -> dict[str, str]:
    """The text of each world file, by its path below `assets/ros`."""
    return {
        "turtlebot3_gazebo/worlds/turtlebot3_house.world": to_sdf(house()),
        "rosmini_sim/worlds/maze.world": to_sdf(maze()),
        "rosmini_sim/worlds/office.world": to_sdf(office()),
        "turtlebot3_gazebo/worlds/turtlebot3_world.world": to_sdf(pillars()),
        "turtlebot3_gazebo/worlds/empty.world": to_sdf(World("empty")),
    }


def write_maps(folder: Path) -> list[Path]:
    """Write the maps into a folder of packages; returns the files written. The worlds are read from their files."""
    written = write_map(draw(), _in(folder, "rosmini_sim/maps/floor"))
    for path, name in MAPPED.items():
        written += write_map(to_map(world(name)), _in(folder, path))
    return written


def _in(folder: Path, path: str) -> Path:
    file = folder / f"{path}.yaml"
    file.parent.mkdir(parents=True, exist_ok=True)
    return file
