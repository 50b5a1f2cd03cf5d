"""From messages to layers: a collector for each topic, chosen by the type of its messages."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse, transform_points
from rosmini.viz.image_pictures import pixels_of
from rosmini.viz.replay.grids import Grid, Grids, grid
from rosmini.viz.replay.images import Images, reduced_image
from rosmini.viz.replay.layers import Frames, Mode, Scans, Shape, Shapes
from rosmini.viz.replay.recorded_frames import RecordedFrames, planar_pose
from rosmini.viz.replay.run import Body
from rosmini.viz.view import ViewError

Floats = NDArray[np.float64]

MAX_BEAMS = 720
MAX_LINES = 200
COLOURS = ("green", "purple", "sky", "orange", "vermilion")


COLLECTORS: dict[str, type[Collector]] = {}
"""The collectors by the type of the messages: each class adds itself."""
UPDATE = "map_msgs/OccupancyGridUpdate"
TRANSFORMS = ("tf2_msgs/TFMessage", "tf/tfMessage")


class Collector(ABC):
    """Collects the messages of a topic. `take` gets a selection of them: at most one message per `period` [s].

    Collectors that accumulate (`accumulates`) get all messages, and `snapshot` is called once per period.
    """

    types: ClassVar[tuple[str, ...]] = ()
    """Types of the messages that it shows."""
    of_robot: ClassVar[bool] = False
    """True for what every recorder of a robot records, also without `layers`."""
    period: ClassVar[float] = 0.5
    accumulates: bool = False

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        COLLECTORS.update(dict.fromkeys(cls.types, cls))

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        self.topic = topic
        self.frames = frames
        self.colour = COLOURS[number % len(COLOURS)]
        self.found = 0
        self.left_out: dict[str, int] = {}
        """Number of messages left out, by reason."""

    @abstractmethod
    def take(self, time: float, message: Any) -> None:
        """Process a message that was recorded at `time` [s]. Raises `ViewError` if it cannot be shown."""

    def snapshot(self, time: float) -> None:  # noqa: B027 - only collectors that accumulate have one
        """Store the current state for this time."""

    @abstractmethod
    def result(self) -> Frames | Body | None:
        """Return the layer or body; None if nothing can be shown."""

    def place(self, header: Any) -> Pose:
        """Return the pose of a header's frame at its time. Raises `ViewError` if it is unknown."""
        found = self.frames.pose(header.frame_id, header.stamp.to_nsec())
        if found is None:
            raise ViewError(
                f"no transform from {header.frame_id!r} to {self.frames.fixed!r} at the time of the message"
            )
        return found


class ShapeCollector(Collector):
    """Something drawn as shapes of points."""

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        super().__init__(topic, frames, number)
        self._times: list[float] = []
        self._items: list[tuple[Shape, ...]] = []

    def take(self, time: float, message: Any) -> None:
        """Store the shapes of a message."""
        self.keep(time, tuple(self.shapes(message)))

    def keep(self, time: float, shapes: tuple[Shape, ...]) -> None:
        """Store shapes, unless both these and the last ones are empty."""
        if shapes or (self._items and self._items[-1]):
            self._times.append(time)
            self._items.append(shapes)

    def shapes(self, message: Any) -> list[Shape]:
        """Return the shapes of a message."""
        raise NotImplementedError

    def shape(self, header: Any, points: Any, mode: Mode, colour: str | None = None) -> Shape:
        """Return a shape of points (n, 2) or arrows (n, 3) in a header's frame, without those that are not finite."""
        array = np.asarray(points, dtype=float).reshape(-1, 3 if mode == "arrows" else 2)
        good = np.isfinite(array).all(axis=1)
        if len(array) and not good.any():
            raise ViewError("no point is finite: all are nan or infinite")
        place = self.place(header)
        moved = compose(place, array[good]) if mode == "arrows" else transform_points(place, array[good])
        return Shape(mode, np.asarray(moved), colour or self.colour)

    def result(self) -> Frames | None:
        """Return the layer."""
        if not any(self._items):
            return None
        return Shapes(self.topic, np.array(self._times), tuple(self._items), found=self.found)


class PathCollector(ShapeCollector):
    """`nav_msgs/Path`: a plan."""

    types = ("nav_msgs/Path",)

    def shapes(self, message: Any) -> list[Shape]:
        """Return a line."""
        points = [(each.pose.position.x, each.pose.position.y) for each in message.poses]
        return [self.shape(message.header, points, "line")] if points else []


class PosesCollector(ShapeCollector):
    """`geometry_msgs/PoseArray`: particles."""

    types = ("geometry_msgs/PoseArray",)

    def shapes(self, message: Any) -> list[Shape]:
        """Return arrows."""
        every = max(1, len(message.poses) // 300)
        arrows = [planar_pose(pose) for pose in message.poses[::every]]
        return [self.shape(message.header, arrows, "arrows")] if arrows else []


class PoseCollector(ShapeCollector):
    """`geometry_msgs/PoseStamped` or `PoseWithCovarianceStamped`: a goal, an estimate."""

    types = ("geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped")

    def shapes(self, message: Any) -> list[Shape]:
        """Return an arrow."""
        pose = getattr(message.pose, "pose", message.pose)
        return [self.shape(message.header, [planar_pose(pose)], "arrows")]


class PolygonCollector(ShapeCollector):
    """`geometry_msgs/PolygonStamped`: a footprint."""

    types = ("geometry_msgs/PolygonStamped",)

    def shapes(self, message: Any) -> list[Shape]:
        """Return a closed line."""
        points = [(point.x, point.y) for point in message.polygon.points]
        return [self.shape(message.header, points, "closed")] if points else []


class PointCollector(ShapeCollector):
    """`geometry_msgs/PointStamped`: a point that a user clicked."""

    types = ("geometry_msgs/PointStamped",)

    def shapes(self, message: Any) -> list[Shape]:
        """Return a point."""
        return [self.shape(message.header, [(message.point.x, message.point.y)], "points")]


class CellsCollector(ShapeCollector):
    """`nav_msgs/GridCells`."""

    types = ("nav_msgs/GridCells",)

    def shapes(self, message: Any) -> list[Shape]:
        """Return points."""
        points = [(point.x, point.y) for point in message.cells]
        return [self.shape(message.header, points, "points")] if points else []


class MarkerCollector(ShapeCollector):
    """`visualization_msgs/Marker` and `MarkerArray`: frontiers, goals, footprints, until they are deleted or expire."""

    types = ("visualization_msgs/Marker", "visualization_msgs/MarkerArray")
    accumulates = True
    ADD, DELETE, DELETE_ALL = 0, 2, 3
    ARROW, LINE_STRIP, LINE_LIST, LISTS = 0, 4, 5, (6, 7, 8, 11)

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        super().__init__(topic, frames, number)
        self._there: dict[tuple[str, int], tuple[float, tuple[Shape, ...]]] = {}

    def take(self, time: float, message: Any) -> None:
        """Add, change and delete markers."""
        for marker in getattr(message, "markers", [message]):
            if marker.action == self.DELETE_ALL:
                self._there.clear()
            elif marker.action == self.DELETE:
                self._there.pop((marker.ns, marker.id), None)
            else:
                lifetime = marker.lifetime.to_sec()
                until = time + lifetime if lifetime > 0 else math.inf
                self._there[marker.ns, marker.id] = (until, tuple(self.shapes(marker)))

    def snapshot(self, time: float) -> None:
        """Store the markers that exist now."""
        self._there = {key: each for key, each in self._there.items() if each[0] >= time}
        self.keep(time, tuple(shape for _, shapes in self._there.values() for shape in shapes))

    def shapes(self, message: Any) -> list[Shape]:
        """Return a simple form of a marker, seen from above."""
        colour = _hex(message.color)
        pose = planar_pose(message.pose)
        inner = [(point.x, point.y) for point in message.points]
        points = transform_points(pose, inner) if inner else np.array([pose[:2]])
        if message.type == self.ARROW:
            arrow = pose
            if len(points) == 2:
                ahead = points[1] - points[0]
                arrow = (*points[0].tolist(), math.atan2(ahead[1], ahead[0]))
            return [self.shape(message.header, [arrow], "arrows", colour)]
        if message.type == self.LINE_STRIP:
            return [self.shape(message.header, points, "line", colour)] if inner else []
        if message.type == self.LINE_LIST:
            pairs = points[: len(inner) // 2 * 2].reshape(-1, 2, 2)[:MAX_LINES]
            return [self.shape(message.header, pair, "line", colour) for pair in pairs]
        if message.type in self.LISTS and not inner:
            return []
        return [self.shape(message.header, points, "points", colour)]


def _hex(colour: Any) -> str:
    parts = [getattr(colour, name) for name in "rgb"]
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, p if math.isfinite(p) else 0.0))):02x}" for p in parts)


class GridCollector(Collector):
    """`nav_msgs/OccupancyGrid`, and the `map_msgs/OccupancyGridUpdate`s of its second topic."""

    types = ("nav_msgs/OccupancyGrid",)

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        super().__init__(topic, frames, number)
        self._times: list[float] = []
        self._grids: list[Grid] = []
        self._now: tuple[NDArray[np.uint8], float, Pose] | None = None
        self._is_new = False

    def take(self, time: float, message: Any) -> None:
        """Store a map, or update the current one."""
        if hasattr(message, "info"):
            info = message.info
            cells = _cells(message.data, int(info.width), int(info.height))
            where = compose(self.place(message.header), planar_pose(info.origin))
            if not cells.size or not (math.isfinite(info.resolution) and info.resolution > 0):
                raise ViewError(
                    f"a map of {info.width} x {info.height} cells, {info.resolution:g} m wide, has nothing to show"
                )
            self._now = cells, float(info.resolution), where
        elif self._now is None:
            raise ViewError("an update came before the first map")
        else:
            cells = self._now[0]
            x, y, width, height = int(message.x), int(message.y), int(message.width), int(message.height)
            if not (0 <= x <= x + width <= cells.shape[1] and 0 <= y <= y + height <= cells.shape[0]):
                raise ViewError(f"an update of {width} x {height} cells at {x}, {y} lies outside of its map")
            cells[y : y + height, x : x + width] = _cells(message.data, width, height)
        self._is_new = True
        if not self.accumulates:
            self.snapshot(time)

    def snapshot(self, time: float) -> None:
        """Store the map as it is, if it has changed."""
        if self._now is None or not self._is_new:
            return
        self._is_new = False
        new = grid(*self._now)
        last = self._grids[-1] if self._grids else None
        if last is None or last[1:] != new[1:] or not np.array_equal(last.cells, new.cells):
            self._times.append(time)
            self._grids.append(Grid(new.cells.copy(), new.resolution, new.origin))

    def result(self) -> Frames | None:
        """Return the layer."""
        if not self._grids:
            return None
        return Grids(self.topic, np.array(self._times), tuple(self._grids), found=self.found)


def _cells(data: Any, width: int, height: int) -> NDArray[np.uint8]:
    cells = np.frombuffer(data, dtype=np.uint8) if isinstance(data, bytes) else np.asarray(data, dtype=np.int8)
    if cells.size != width * height:
        raise ViewError(f"a map of {width} x {height} cells has data for {cells.size}")
    return cells.astype(np.uint8).reshape(height, width)


class ScanCollector(Collector):
    """`sensor_msgs/LaserScan`."""

    types = ("sensor_msgs/LaserScan",)
    of_robot = True

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        super().__init__(topic, frames, number)
        self._rows: list[tuple[float, Pose, Floats]] = []
        self._fan: tuple[int, float, float, float] | None = None

    def take(self, time: float, message: Any) -> None:
        """Store its ranges and the pose of the laser."""
        ranges = np.asarray(message.ranges, dtype=float)
        every = -(-len(ranges) // MAX_BEAMS) or 1
        fan = (len(ranges), float(message.angle_min), float(message.angle_increment), float(message.range_max))
        if not len(ranges) or not all(math.isfinite(part) for part in fan[:3]):
            raise ViewError("a scan has no beams, or angles that are not finite")
        if self._fan is None:
            self._fan = fan
        elif self._fan[:3] != fan[:3]:
            raise ViewError("the beams of a scan differ from those of the first one")
        seen = (ranges >= message.range_min) & (ranges <= message.range_max)
        self._rows.append((time, self.place(message.header), np.where(seen, ranges, np.inf)[::every]))

    def result(self) -> Frames | None:
        """Return the layer."""
        if not self._rows or self._fan is None:
            return None
        times, poses, ranges = zip(*self._rows, strict=True)
        beams, start, step, reach = self._fan
        return Scans(
            self.topic, np.array(times), np.array(poses), np.array(ranges), start, step * (-(-beams // MAX_BEAMS)),
            min(reach, 1e6) if math.isfinite(reach) else 30.0, found=self.found,
        )  # fmt: skip


class ImageCollector(Collector):
    """`sensor_msgs/Image`: reduced in size, one per second."""

    types = ("sensor_msgs/Image",)
    period = 1.0

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        super().__init__(topic, frames, number)
        self._times: list[float] = []
        self._images: list[NDArray[np.uint8]] = []

    def take(self, time: float, message: Any) -> None:
        """Store a small copy."""
        image = reduced_image(pixels_of(message))
        if self._images and image.shape != self._images[0].shape:
            raise ViewError("an image differs in size from the first one")
        self._times.append(time)
        self._images.append(image)

    def result(self) -> Frames | None:
        """Return the layer."""
        if not self._images:
            return None
        return Images(self.topic, np.array(self._times), tuple(self._images), found=self.found)


class TrackCollector(Collector):
    """`nav_msgs/Odometry` and `turtlesim/Pose`: the trajectory of something."""

    types = ("nav_msgs/Odometry", "turtlesim/Pose")
    of_robot = True
    period = 1 / 30

    def __init__(self, topic: str, frames: RecordedFrames, number: int) -> None:
        super().__init__(topic, frames, number)
        self._rows: list[tuple[float, float, float, float]] = []
        self._loose: list[tuple[float, float, float, float]] = []
        self.frame = ""
        """The frame of the poses if no transform connects it with the fixed frame."""

    def take(self, time: float, message: Any) -> None:
        """Store a pose; if its frame is not connected at that time (odom before amcl starts), in its own frame."""
        rows = self._rows
        if hasattr(message, "theta"):
            pose = (float(message.x), float(message.y), float(message.theta))
            if not all(math.isfinite(part) for part in pose):
                raise ViewError("a pose is not finite (nan or infinite)")
        else:
            header = message.header
            pose = planar_pose(message.pose.pose)
            place = self.frames.pose(header.frame_id, header.stamp.to_nsec())
            if place is None:
                rows = self._loose
                self.frame = header.frame_id.lstrip("/")
            else:
                pose = compose(place, pose)
        rows.append((time, *pose))

    def result(self) -> Body | None:
        """Return the trajectory; if the frame was connected only at some times, the poses at those times."""
        if self._rows:
            self.frame = ""
        rows = np.array(self._rows or self._loose)
        if not len(rows):
            return None
        rows[:, 3] = np.unwrap(rows[:, 3])
        return Body(self.topic, rows[:, 0], rows[:, 1:], colour=self.colour)


def moved_to(body: Body, start: Pose) -> Body:
    """Move a body whose frame is not connected with the others, so that it begins at `start`."""
    x, y, heading = body.poses[0].tolist()
    poses = compose(compose(start, inverse((x, y, heading))), body.poses)
    return Body(body.name, body.times, np.asarray(poses), colour=body.colour)


def recorded_types() -> dict[str, float]:
    """Return the types that a recorder records with `layers=True`: everything visible from above, and transforms.

    Each has the shortest interval [s] between two messages that are kept: 0, but for images, which are large.
    """
    shown = {name: 0.0 for name, cls in COLLECTORS.items() if not cls.of_robot}
    return shown | {UPDATE: 0.0, TRANSFORMS[0]: 0.0} | dict.fromkeys(ImageCollector.types, 0.9 * ImageCollector.period)
