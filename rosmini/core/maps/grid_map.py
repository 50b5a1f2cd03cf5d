"""Grid maps: their cells and their pose, and conversion to and from `nav_msgs/OccupancyGrid`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import quaternion_from_yaw, yaw_from_quaternion
from rosmini.core.geometry.poses import compose, inverse
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from rosmini.core.time import Time

FREE, OCCUPIED, UNKNOWN = 0, 100, -1


class MapError(RosminiError, ValueError):
    """A map cannot be read or written; the message names the file, its line, and the field at fault."""

    result = 255
    """The result code in `nav_msgs/LoadMap`: RESULT_UNDEFINED_FAILURE."""


class MapMissing(MapError):
    """The YAML file does not exist: RESULT_MAP_DOES_NOT_EXIST."""

    result = 1


class MapDataError(MapError):
    """The cells, that is the image, are wrong: RESULT_INVALID_MAP_DATA."""

    result = 2


class MapMetadataError(MapError):
    """The YAML file, or its `field`, is wrong: RESULT_INVALID_MAP_METADATA."""

    result = 3

    def __init__(self, message: str, field: str = "") -> None:
        super().__init__(message)
        self.field = field


@dataclass(frozen=True, eq=False)
class GridMap:
    """A map of square cells, as in nav_msgs/OccupancyGrid."""

    occupancy: NDArray[np.int8]
    """(h, w), row 0 at the bottom: 0 free, 100 occupied, between them the probability [%], -1 unknown.

    In the mode raw, cells contain any byte.
    """
    resolution: float
    """The side of a cell [m]."""
    origin: tuple[float, float, float]
    """x [m], y [m] and heading [rad] of the lower left corner of cell (0, 0), in the frame of the map."""
    path: Path | None = None
    """The file that the map was read from: the YAML file, or else the image. None for a map from a topic."""

    def __repr__(self) -> str:
        height, width = self.occupancy.shape
        name = f" {self.path.name}" if self.path else ""
        return f"<GridMap{name}: {width} x {height} cells of {self.resolution:g} m>"

    @property
    def occupied(self) -> NDArray[np.bool_]:
        """A mask (h, w) of the occupied cells, by costmap_2d's rule for static maps: 100 or more."""
        mask: NDArray[np.bool_] = self.occupancy >= OCCUPIED
        return mask

    @property
    def free(self) -> NDArray[np.bool_]:
        """A mask (h, w) of the free cells."""
        mask: NDArray[np.bool_] = self.occupancy == FREE
        return mask

    @property
    def unknown(self) -> NDArray[np.bool_]:
        """A mask (h, w) of the unknown cells."""
        mask: NDArray[np.bool_] = self.occupancy == UNKNOWN
        return mask

    def world_to_map(self, x: float, y: float) -> tuple[int, int] | None:
        """Return the cell (mx, my) of a point [m] in the frame of the map, or None if it is outside."""
        along, across, _ = compose(inverse(self.origin), (x, y, 0.0))
        mx, my = math.floor(along / self.resolution), math.floor(across / self.resolution)
        height, width = self.occupancy.shape
        return (mx, my) if 0 <= mx < width and 0 <= my < height else None

    def map_to_world(self, mx: float, my: float) -> tuple[float, float]:
        """Return the centre of a cell [m], in the frame of the map."""
        x, y, _ = compose(self.origin, ((mx + 0.5) * self.resolution, (my + 0.5) * self.resolution, 0.0))
        return x, y

    @classmethod
    def from_message(cls, message: Any) -> GridMap:
        """Return the map in a `nav_msgs/OccupancyGrid`. An all-zero orientation, as in a new message, means yaw 0.

        Raises `MapError` if the number of cells does not match the size, or the resolution or origin is invalid.
        """
        info = message.info
        cells = np.array(message.data, dtype=np.int8)
        if len(cells) != info.width * info.height or not len(cells):
            raise MapDataError(
                f"a map of {info.width} x {info.height} cells needs {info.width * info.height} of them, at least "
                f"1, but its message has {len(cells)}"
            )
        position, q = info.origin.position, info.origin.orientation
        yaw = yaw_from_quaternion(q.x, q.y, q.z, q.w) if any((q.x, q.y, q.z, q.w)) else 0.0
        resolution = float(info.resolution)
        if not (resolution > 0 and all(map(math.isfinite, (resolution, position.x, position.y, yaw)))):
            raise MapMetadataError(
                f"the map's cells are {resolution} m wide and its origin is ({position.x}, {position.y}, {yaw}): "
                "these must be finite, and the width positive"
            )
        cells.flags.writeable = False
        return cls(cells.reshape(info.height, info.width), resolution, (position.x, position.y, yaw))

    def to_message(self, frame_id: str = "map", stamp: Time | None = None) -> Any:
        """Return a `nav_msgs/OccupancyGrid`, loaded at the time `stamp` (zero if None)."""
        message = message_class("nav_msgs/OccupancyGrid")()
        message.header.frame_id = frame_id
        info = message.info
        if stamp is not None:
            message.header.stamp = info.map_load_time = stamp
        info.height, info.width = self.occupancy.shape
        info.resolution = self.resolution
        info.origin.position.x, info.origin.position.y, yaw = self.origin
        q = info.origin.orientation
        q.x, q.y, q.z, q.w = quaternion_from_yaw(yaw)
        message.data = self.occupancy.ravel()
        return message
