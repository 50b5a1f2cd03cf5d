"""`map_server/map_saver`: saves a map from a topic to files (http://wiki.ros.org/map_server#map_saver).

    rosrun map_server map_saver -f house map:=/some/map

It waits for one map, writes `house.pgm` and `house.yaml`, and ends. The behaviour follows map_saver.cpp of
https://github.com/ros-planning/navigation, except that the node logs an error and ends if a file cannot be written.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import UsageError
from rosmini.core.maps.grid_map import GridMap, MapError
from rosmini.core.maps.map_io import FREE_TO, OCCUPIED_FROM, save_map
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from pathlib import Path

    from rosmini.core.graph import Node

USAGE = """Usage:
  map_saver -h
  map_saver [--occ <threshold_occupied>] [--free <threshold_free>] [-f <mapname>] [ROS remapping args]"""


@dataclass(frozen=True)
class SaverOptions:
    """The options of `map_saver`: the name of the files, and thresholds in per cent."""

    name: str = "map"
    occupied: int = OCCUPIED_FROM
    free: int = FREE_TO

    @classmethod
    def of(cls, arguments: tuple[str, ...]) -> SaverOptions:
        """Return the options on a command line. Raises `UsageError` for an unknown option or an invalid value."""
        found: dict[str, Any] = {}
        words = iter(arguments)
        for word in words:
            option = {"-f": "name", "--occ": "occupied", "--free": "free"}.get(word)
            value = next(words, None)
            if option is None or value is None:
                raise UsageError(USAGE)
            found[option] = value if option == "name" else _percent(f"threshold_{option}", value)
        made = cls(**found)
        if not 1 <= made.occupied <= 100:
            raise UsageError(f"threshold_occupied must be between 1 and 100, not {made.occupied}")
        if not 0 <= made.free <= 100:
            raise UsageError(f"threshold_free must be between 0 and 100, not {made.free}")
        if made.occupied <= made.free:
            raise UsageError(
                f"threshold_free must be smaller than threshold_occupied, and {made.free} is not below {made.occupied}"
            )
        return made


def _percent(name: str, value: str) -> int:
    try:
        return int(value)
    except ValueError as error:
        raise UsageError(f"{name} is {value!r}, which is not an integer.\n{USAGE}") from error


class MapSaver:
    """Saves one map, and then shuts its node down.

    Args:
        node: the started node.
        arguments: as on the command line.

    Raises:
        UsageError: the arguments or thresholds are invalid.

    """

    def __init__(self, node: Node, *arguments: str) -> None:
        self.node = node
        self.exit_status = 0
        self.paths: tuple[Path, ...] = ()
        """The files that were written."""
        self._ended = False
        if "-h" in arguments:
            print(USAGE)
            self._end()
            return
        self.options = SaverOptions.of(arguments)
        node.loginfo("Waiting for the map")
        node.subscriber("map", message_class("nav_msgs/OccupancyGrid"), self._on_map, queue_size=1)

    def _on_map(self, message: Any) -> None:
        if self._ended:
            return
        log, info, name = self.node.loginfo, message.info, self.options.name
        log(f"Received a {info.width} X {info.height} map @ {info.resolution:.3f} m/pix")
        try:
            grid = GridMap.from_message(message)
            log(f"Writing map occupancy data to {name}.pgm")
            self.paths = save_map(grid, name, occupied=self.options.occupied, free=self.options.free)
        except MapError as error:
            self.node.logerr(error)
            self.exit_status = 1
        else:
            log(f"Writing map occupancy data to {name}.yaml")
            log("Done\n")
        self._end()

    def _end(self) -> None:
        self._ended = True
        self.node.scheduler.call_soon(lambda: self.node.shutdown("the map has been saved"))
