"""`map_server/map_server`: publishes a map from a file (http://wiki.ros.org/map_server).

    rosrun map_server map_server house.yaml
    rosrun map_server map_server house.pgm 0.05

The second form is also deprecated in ROS. The map is latched on `map`, its metadata on `map_metadata`; `static_map`
returns the map, and `change_map` loads another. The behaviour follows main.cpp of
https://github.com/ros-planning/navigation, except that the result of `change_map` distinguishes errors (in the original
it is 255). As in the original, its response has no map.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import RosminiError, UsageError
from rosmini.core.files import path_of
from rosmini.core.graph import Node
from rosmini.core.graph.clock import TopicClock
from rosmini.core.maps.grid_map import GridMap, MapError, MapMetadataError, MapMissing
from rosmini.core.maps.map_io import MapFile, image_file, map_file
from rosmini.core.packages import PackageIndex, address_of
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class, service_class

USAGE = """USAGE: map_server <map.yaml>
  map.yaml: map description file
DEPRECATED USAGE: map_server <map> <resolution>
  map: image file to load
  resolution: map resolution [meters/pixel]"""


@dataclass(frozen=True)
class MapServerParameters(Parameters):
    """The private parameters of `map_server/map_server`; all but the first apply only to the deprecated form."""

    frame_id: str = parameter("map", "the frame of the published map")
    negate: int = parameter(0, "1: white is occupied and black is free")
    occupied_thresh: float = parameter(0.65, "darker pixels are occupied")
    free_thresh: float = parameter(0.196, "lighter pixels are free")


class MapServer:
    """Publishes a map and offers its services.

    Args:
        node: the started node.
        arguments: a YAML file; or an image and the size of its pixels [m].

    Raises:
        UsageError: the arguments are invalid.
        MapError: the map cannot be read.
        ParameterError: a parameter has a wrong type or is out of range.

    """

    def __init__(self, node: Node, *arguments: str) -> None:
        if len(arguments) not in (1, 2):
            raise UsageError(f"map_server got {len(arguments)} arguments.\n{USAGE}")
        self.node = node
        self.parameters = MapServerParameters.read(node)
        self._message = message_class("nav_msgs/OccupancyGrid")()
        self._metadata = node.publisher("map_metadata", message_class("nav_msgs/MapMetaData"), queue_size=1, latch=True)
        self._map = node.publisher("map", message_class("nav_msgs/OccupancyGrid"), queue_size=1, latch=True)
        try:
            self.grid = self._load(
                self._image_file(*arguments) if len(arguments) == 2 else map_file(_path_of(arguments[0]))
            )
        except MapError as error:
            node.logerr(_error_text(error, arguments[0]))
            raise
        self._start()

    def __repr__(self) -> str:
        return f"<MapServer {self.node.name}: {self.grid!r}>"

    def _load(self, file: MapFile) -> GridMap:
        self.node.loginfo(f'Loading map from image "{address_of(file.image)}"')
        return file.load(self.node.logwarn)

    def _image_file(self, image: str, resolution: str) -> MapFile:
        self.node.logwarn("Using deprecated map server interface. Please switch to new interface.")
        try:
            side = float(resolution)
        except ValueError as error:
            raise UsageError(
                f"map_server: the resolution is {resolution!r}, which is not a number.\n{USAGE}"
            ) from error
        own = self.parameters
        thresholds = {"occupied_thresh": own.occupied_thresh, "free_thresh": own.free_thresh}
        return image_file(image, side, negate=own.negate, **thresholds)

    def _start(self) -> None:
        """Publish the map and offer the services once the clock has started, so that no client gets an empty map."""
        clock = self.node.clock
        if isinstance(clock, TopicClock) and clock.now_ns() == 0:
            clock.call_at(1, self._start)
            return
        self._publish()
        self.node.service("static_map", service_class("nav_msgs/GetMap"), self._static_map)
        self.node.service("change_map", service_class("nav_msgs/LoadMap"), self._change_map)

    def _publish(self) -> None:
        self._message = self.grid.to_message(self.parameters.frame_id, self.node.now())
        info = self._message.info
        self.node.loginfo(f"Read a {info.width} X {info.height} map @ {info.resolution:.3f} m/cell")
        self._metadata.publish(info)
        self._map.publish(self._message)

    def _static_map(self, _: Any) -> dict[str, Any]:
        self.node.loginfo("Sending map")
        return {"map": self._message}

    def _change_map(self, request: Any) -> dict[str, Any]:
        try:
            self.grid = self._load(map_file(_path_of(request.map_url)))
        except MapError as error:
            self.node.logerr(_error_text(error, request.map_url))
            return {"result": error.result}
        self._publish()
        self.node.loginfo(f"Changed map to {request.map_url}")
        return {"result": 0}


def _path_of(address: str) -> str:
    """Return the path itself, or the path that an address `package://...` or `file://...` refers to.

    Raises `MapMissing` for an unknown package or a missing file in it.
    """
    if address.startswith("file://"):
        return path_of(address)
    if not address.startswith("package://"):
        return address
    try:
        return str(PackageIndex().resolve(address))
    except RosminiError as error:
        raise MapMissing(str(error)) from error


def _error_text(error: MapError, path: str) -> str:
    """Return the message of ROS's map_server, which users may search for, followed by the text of `error`."""
    text = str(error)
    if isinstance(error, MapMissing):
        return f"Map_server could not open {path}. {text[:1].upper()}{text[1:]}"
    field = error.field if isinstance(error, MapMetadataError) else ""
    if not field:
        return text
    return f"The map does not contain a{'n' * (field[:1] in 'aeiou')} {field} tag or it is invalid. {text}"
