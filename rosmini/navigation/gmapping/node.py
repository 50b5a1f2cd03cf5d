"""`gmapping/slam_gmapping`: the filter as a node (http://wiki.ros.org/gmapping).

It subscribes to `scan` and `tf`, and publishes `map`, `map_metadata`, `~entropy` and the transform from the map to the
odometry frame; the service `dynamic_map` returns the map. A scan waits until its transforms are available.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph import Node
from rosmini.core.tf import Buffer, TransformBroadcaster, TransformException, TransformListener
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class, service_class
from rosmini.navigation.kernels import prepare
from rosmini.navigation.nav_core.poses import planar_transform

from .extent import first_extent, published
from .parameters import GmappingParameters
from .slam import MAX_STEP, GridSlam

TRANSFORM_TIMEOUT = 0.5
"""Maximum time that a scan waits for its transforms [s]."""

SHORTEST_PERIOD = 0.001
"""Shortest interval between two transforms [s]; with a shorter or negative one, the original never pauses."""


class SlamGmapping:
    """The node `slam_gmapping`, which runs a `GridSlam` on the scans that it receives."""

    def __init__(self, node: Node) -> None:
        prepare(node)
        self.node = node
        self.parameters = p = GmappingParameters.read(node)
        self.slam: GridSlam | None = None
        """The filter, or None before the first scan."""
        self._extent = first_extent(p.xmin, p.ymin, p.xmax, p.ymax, p.delta, node.logwarn)
        self._upside_down = False
        self._beams = self._scans = 0
        self._correction: Pose = (0.0, 0.0, 0.0)
        self._last_map: int | None = None
        self._last_stamp_ns = 0
        self._map: Any = None
        self._last_transform_stamp = Time(0)
        """Stamp of the last transform."""
        self.buffer = Buffer(node)
        self.listener = TransformListener(node, self.buffer)
        self.broadcaster = TransformBroadcaster(node)
        grid, numbers = message_class("nav_msgs/OccupancyGrid"), message_class("nav_msgs/MapMetaData")
        self._entropy = node.publisher("~entropy", message_class("std_msgs/Float64"), queue_size=1, latch=True)
        self._maps = node.publisher("map", grid, queue_size=1, latch=True)
        self._metadata = node.publisher("map_metadata", numbers, queue_size=1, latch=True)
        node.service("dynamic_map", service_class("nav_msgs/GetMap"), self._dynamic_map)
        node.subscriber("scan", message_class("sensor_msgs/LaserScan"), self._scan, queue_size=5)
        if period := p.transform_publish_period:
            if period < SHORTEST_PERIOD:
                node.logwarn(f"~transform_publish_period is {period} s: it is limited to {SHORTEST_PERIOD} s")
            node.timer(max(period, SHORTEST_PERIOD), self._broadcast)

    # -- scans ---------------------------------------------------------------------------------------------------

    def _scan(self, message: Any) -> None:
        self._scans += 1
        if self._scans % self.parameters.throttle_scans:
            return
        p, stamp = self.parameters, message.header.stamp
        try:
            check(message, p.maxRange)
            if self.slam is None:
                self.slam = self._create_filter(message)
            odometry = planar_transform(
                self.buffer.lookup_transform(p.odom_frame, p.base_frame, stamp, TRANSFORM_TIMEOUT)
            )
        except TransformException as error:
            self.node.logwarn(f"a scan of {message.header.frame_id} is ignored: {error}", throttle=5.0)
            return
        except RosminiError as error:
            self.node.logerr(error, throttle=5.0)
            return
        if len(message.ranges) != self._beams:
            self.node.logerr(
                f"a scan of {message.header.frame_id} has {len(message.ranges)} ranges, but the first one had "
                f"{self._beams}: it is ignored",
                throttle=5.0,
            )
            return
        self._process(self.slam, message, odometry)

    def _create_filter(self, message: Any) -> GridSlam:
        """Create the filter from the first scan, which gives the laser's pose and range."""
        p, frame = self.parameters, message.header.frame_id.lstrip("/")
        found = self.buffer.lookup_transform(p.base_frame, frame, Time(0), TRANSFORM_TIMEOUT)
        q = found.transform.rotation
        up = 1 - 2 * (q.x * q.x + q.y * q.y)
        if abs(1 - abs(up)) > 1e-3:
            raise RosminiError(
                f"Laser has to be mounted planar! Z-coordinate has to be 1 or -1, but gave: {up:.5f} (the z axis of "
                f"{frame} in {p.base_frame}): it cannot be used for mapping"
            )
        self._upside_down = up < 0
        odometry = planar_transform(
            self.buffer.lookup_transform(p.odom_frame, p.base_frame, message.header.stamp, TRANSFORM_TIMEOUT)
        )
        self.node.loginfo(f"Laser is mounted {'upside down' if self._upside_down else 'upwards'}.")
        self._beams = len(message.ranges)
        return GridSlam(
            p.settings(message.range_max),
            laser=planar_transform(found),
            start=odometry,
            random=self.node.graph.rng(f"{self.node.name}/particles"),
        )

    def _process(self, slam: GridSlam, message: Any, odometry: Pose) -> None:
        ranges = np.asarray(message.ranges, dtype=np.float64)
        # A range below the laser's minimum would count as a hit; the mapper treats it as no hit.
        ranges = np.where(ranges < message.range_min, message.range_max, ranges)
        bearings = message.angle_min + message.angle_increment * np.arange(len(ranges))
        bearings = -bearings if self._upside_down else bearings
        before, self._last_stamp_ns = self._last_stamp_ns, message.header.stamp.to_nsec()
        if self._last_stamp_ns < before:
            self.node.logwarn(
                f"scans jump back in time, from {before * 1e-9:.3f} s to {message.header.stamp.to_sec():.3f} s: the "
                "map continues from the current odometry; restart the node for a new one"
            )
        if slam.jumps_to(odometry):
            self.node.logwarn(
                f"the odometry jumps by more than {MAX_STEP:.0f} m to x {odometry[0]:.2f} m, y {odometry[1]:.2f} m: "
                "the map continues from there, and is likely to be distorted"
            )
        try:
            if slam.process(ranges, bearings, odometry, message.header.stamp.to_sec()) is None:
                return
            x, y, yaw = slam.poses[slam.best]
            self._correction = compose((float(x), float(y), float(yaw)), inverse(odometry))
            since = None if self._last_map is None else (self._last_stamp_ns - self._last_map) * 1e-9
            if since is None or not 0 <= since <= self.parameters.map_update_interval:
                self._last_map = self._last_stamp_ns
                self._publish(slam)
        except RosminiError as error:
            self.node.logerr(error, throttle=5.0)

    # -- results -------------------------------------------------------------------------------------------------

    def _publish(self, slam: GridSlam) -> None:
        p = self.parameters
        self._entropy.publish(message_class("std_msgs/Float64")(data=slam.entropy))
        cells, self._extent = published(slam, self._extent, p.occ_thresh)
        grid = message_class("nav_msgs/OccupancyGrid")()
        grid.header.frame_id, grid.header.stamp = p.map_frame, self.node.now()
        info = grid.info
        info.map_load_time, info.resolution = grid.header.stamp, p.delta
        info.height, info.width = cells.shape
        info.origin.position.x, info.origin.position.y = (self._extent.column * p.delta, self._extent.row * p.delta)
        info.origin.orientation.w = 1.0
        grid.data = cells.ravel()
        self._map = grid
        self._maps.publish(grid)
        self._metadata.publish(info)

    def _dynamic_map(self, _: Any) -> Any:
        if self._map is None:
            raise RosminiError("there is no map yet: no scan has been processed")
        return {"map": self._map}

    def _broadcast(self, _: Any) -> None:
        p = self.parameters
        delay = p.transform_publish_period if p.tf_delay is None else p.tf_delay
        when = self.node.now() + Duration.from_sec(delay)
        if when == self._last_transform_stamp:  # a slow /clock may not advance between two calls of the timer
            return
        self._last_transform_stamp = when
        self.broadcaster.send_rigid(p.map_frame, p.odom_frame, from_yaw(*self._correction), when)


def check(message: Any, longest: float | None) -> None:
    """Raise `RosminiError` for a scan with unusable numbers; `longest` is ~maxRange [m], or None."""
    reach = message.range_max if longest is None else min(message.range_max, longest)
    numbers = message.angle_min, message.angle_increment, message.range_min, reach
    if (
        len(message.ranges) < 2
        or not all(map(math.isfinite, numbers))
        or message.angle_increment == 0
        or message.range_max <= 0
    ):
        raise RosminiError(
            f"a scan of {message.header.frame_id} has {len(message.ranges)} ranges, the angle_min {message.angle_min}, "
            f"the angle_increment {message.angle_increment} and ranges from {message.range_min} to "
            f"{message.range_max}: it cannot be used for mapping"
        )
