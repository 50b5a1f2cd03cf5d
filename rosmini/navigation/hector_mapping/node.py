"""`hector_mapping/hector_mapping`: the mapper as a node (http://wiki.ros.org/hector_mapping).

It subscribes to `scan`, and reads the laser's pose on the robot from `tf`; it needs no odometry. It publishes `map`,
`map_metadata`, `slam_out_pose`, `poseupdate`, and on tf the pose and the odometry frame. Unlike the original it sends
no transform from map to odom if it cannot look up the odometry (the original then uses zero), and `poseupdate`
contains the covariance instead of its inverse.
"""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.tf import Buffer, TransformBroadcaster, TransformException, TransformListener
from rosmini.core.tf.messages import set_pose, transform_of
from rosmini.core.tf.rigid import IDENTITY, Rigid, compose, from_yaw, inverse, rpy
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.navigation.kernels import prepare
from rosmini.navigation.nav_core.poses import planar_pose, pose_stamped

from .matching import UNKNOWN_VARIANCE
from .parameters import HectorMappingParameters
from .scans import ends_in_laser_frame, scan_ends
from .slam import HectorSlam

TRANSFORM_TIMEOUT = 0.5
"""Maximum time that a scan waits for a transform [s]."""
MAX_DISORDER_NS = 1_000_000_000
"""A scan older than its predecessor by more than this [ns] is from another run: a bag in a loop, or a clock reset."""
COVARIANCE_INDICES = (0, 1, 5)
"""Indices of x, y and heading in a six by six covariance."""


class HectorMapping:
    """The node `hector_mapping`, which runs a `HectorSlam` on the scans that it receives."""

    def __init__(self, node: Node) -> None:
        prepare(node)
        self.node = node
        self.parameters = p = HectorMappingParameters.read(node)
        self.slam = HectorSlam(p.settings())
        for level, grid in enumerate(self.slam.maps):
            height, width = grid.odds.shape
            node.loginfo(f"HectorSM map lvl {level}: cellLength: {grid.resolution:g} res x:{width} res y: {height}")
        if len(self.slam.maps) < p.map_multi_res_levels:
            node.logwarn(
                f"~map_multi_res_levels is {p.map_multi_res_levels}: a map of {p.map_size} cells can only be halved to "
                f"{len(self.slam.maps)} levels"
            )
        self.paused = False
        self._start: Pose | None = None
        """The pose given by a user, until the next scan."""
        self._correction: Rigid | None = None
        """The pose of the odometry frame in the map."""
        self._last_stamp_ns = 0
        self._map: Any = None
        self._mapped_updates: int | None = None
        """The number of map updates when the message was created."""
        self.buffer = Buffer(node)
        self.listener = TransformListener(node, self.buffer)
        self.broadcaster = TransformBroadcaster(node)
        self._advertise()
        node.subscriber(
            p.scan_topic,
            message_class("sensor_msgs/LaserScan"),
            self._scan,
            queue_size=p.scan_subscriber_queue_size if p.scan_subscriber_queue_size > 0 else None,
        )
        node.subscriber(p.sys_msg_topic, message_class("std_msgs/String"), self._command, queue_size=2)
        posed = message_class("geometry_msgs/PoseWithCovarianceStamped")
        node.subscriber("initialpose", posed, self._initial_pose, queue_size=2)
        node.timer(p.map_pub_period, lambda _: self._publish_map())
        self._publish_map()

    def _advertise(self) -> None:
        node, p = self.node, self.parameters
        grid, numbers = message_class("nav_msgs/OccupancyGrid"), message_class("nav_msgs/MapMetaData")
        posed = message_class("geometry_msgs/PoseWithCovarianceStamped")
        self._maps = node.publisher("map", grid, queue_size=1, latch=True)
        self._metadata = node.publisher("map_metadata", numbers, queue_size=1, latch=True)
        self._pose_update = node.publisher(p.pose_update_topic, posed, queue_size=1)
        self._pose = node.publisher("slam_out_pose", message_class("geometry_msgs/PoseStamped"), queue_size=1)
        self._cloud = node.publisher("slam_cloud", message_class("sensor_msgs/PointCloud"), queue_size=1)
        if p.pub_odometry:
            self._odometry = node.publisher("scanmatch_odom", message_class("nav_msgs/Odometry"), queue_size=50)
            self._odometry.expect_nobody()
        for publisher in (self._pose_update, self._pose):
            publisher.expect_nobody()
        if p.advertise_map_service:
            node.service("dynamic_map", service_class("nav_msgs/GetMap"), self._dynamic_map)
        node.service("reset_map", service_class("std_srvs/Trigger"), self._reset_map)
        node.service("pause_mapping", service_class("std_srvs/SetBool"), self._pause)
        node.service("restart_mapping_with_new_pose", service_class("hector_mapping/ResetMapping"), self._restart)

    # -- scans ---------------------------------------------------------------------------------------------------

    def _scan(self, message: Any) -> None:
        if self.paused:
            return
        began = time.perf_counter()
        self._reset_after_time_jump(message.header.stamp)
        try:
            ends, laser = self._ends(message)
        except TransformException as error:
            self.node.logwarn(f"a scan of {message.header.frame_id} is ignored: {error}", throttle=5.0)
            return
        except RosminiError as error:
            self.node.logerr(error, throttle=5.0)
            return
        known = self.parameters.map_with_known_poses
        guess = self._guess(message.header.stamp)
        self.slam.update(ends, laser, guess=guess, matching=not known)
        if self.parameters.output_timing:
            taken = (time.perf_counter() - began) * 1e3
            self.node.loginfo(f"HectorSLAM Iter took: {taken:f} milliseconds")
        self._warn_outside()
        if not known:
            self._publish_pose(message.header.stamp)

    def _reset_after_time_jump(self, stamp: Time) -> None:
        before, self._last_stamp_ns = self._last_stamp_ns, stamp.to_nsec()
        if self._last_stamp_ns < before - MAX_DISORDER_NS:
            self.node.logwarn(
                f"scans jump back in time, from {before * 1e-9:.3f} s to {stamp.to_sec():.3f} s: the robot may "
                "be anywhere on this map, so mapping restarts with an empty one"
            )
            self._reset()

    def _ends(self, message: Any) -> tuple[NDArray[np.float64], tuple[float, float]]:
        """Return the beam ends (n, 2) of a scan, and the laser's position, in the robot's frame [m].

        Raises `RosminiError` for an invalid scan, and `TransformException` if the laser's pose is unknown.
        """
        p, frame = self.parameters, message.header.frame_id.lstrip("/")
        ranges = np.asarray(message.ranges, dtype=np.float64)
        numbers = (message.angle_min, message.angle_increment, message.range_min, message.range_max)
        if not len(ranges) or not np.isfinite(numbers).all() or (len(ranges) > 1 and not message.angle_increment):
            raise RosminiError(
                f"a scan of {frame} has {len(ranges)} ranges, the angle_increment {message.angle_increment} and "
                f"ranges from {message.range_min} to {message.range_max}: it cannot be used for mapping"
            )
        bearings = message.angle_min + message.angle_increment * np.arange(len(ranges))
        span = float(message.range_min), float(message.range_max)
        mount = IDENTITY
        if p.use_tf_scan_transformation:
            mount = self._lookup(p.base_frame, frame, message.header.stamp)
            ends = scan_ends(ranges, bearings, span, mount, p.limits())
            if self._cloud.num_connections():
                self._publish_cloud(message.header, ends_in_laser_frame(ranges, bearings, span))
        else:
            ends = ends_in_laser_frame(ranges, bearings, span)
        if not len(ends):
            self.node.logwarn(
                f"no beam of {frame} ended within the limits (from {max(span[0], p.laser_min_dist):.2f} to "
                f"{min(span[1], p.laser_max_dist):.2f} m): the robot's pose is unchanged",
                throttle=5.0,
            )
        return ends, mount[:2]

    def _lookup(self, target: str, source: str, stamp: Time) -> Rigid:
        return transform_of(self.buffer.lookup_transform(target, source, stamp, TRANSFORM_TIMEOUT))

    def _guess(self, stamp: Time) -> Pose | None:
        """Return the start of the search, or None to start at the last pose.

        The estimate from tf is the odometry added to this node's last result. The original looks up the full transform
        at the scan's time, which does not exist yet if this node publishes it, and then starts at the last pose.
        """
        p, start = self.parameters, self._start
        if start is not None:
            self._start = None
            return start
        if not (p.use_tf_pose_start_estimate or p.map_with_known_poses):
            return None
        own = p.pub_map_odom_transform and not p.map_with_known_poses
        if own and self._correction is None:
            return None
        try:
            if own and self._correction is not None:
                found = compose(self._correction, self._lookup(p.odom_frame, p.base_frame, stamp))
            else:
                found = self._lookup(p.map_frame, p.base_frame, stamp)
        except TransformException as error:
            self.node.logerr(f"Transform from {p.map_frame} to {p.base_frame} failed: {error}", throttle=5.0)
            return None
        return found[0], found[1], rpy(found)[2]

    def _warn_outside(self) -> None:
        x, y, _ = self.slam.pose
        if (x, y) not in self.slam.maps[0]:
            self.node.logwarn(
                f"the robot is at ({x:.1f}, {y:.1f}), outside the map, {self._map_bounds_text()}: "
                "nothing is mapped there; increase ~map_size, or move ~map_start_x and ~map_start_y",
                throttle=5.0,
            )

    def _map_bounds_text(self) -> str:
        grid = self.slam.maps[0]
        (left, low), side = grid.origin, grid.resolution * grid.odds.shape[0]
        return f"which reaches from ({left:.1f}, {low:.1f}) to ({left + side:.1f}, {low + side:.1f})"

    # -- results -------------------------------------------------------------------------------------------------

    def _publish_pose(self, stamp: Time) -> None:
        p = self.parameters
        self._pose.publish(pose_stamped(p.map_frame, stamp, self.slam.pose))
        message = message_class("geometry_msgs/PoseWithCovarianceStamped")()
        message.header.frame_id, message.header.stamp = p.map_frame, stamp
        placed = from_yaw(*self.slam.pose)
        set_pose(message.pose.pose, placed)
        message.pose.covariance = self._covariance().ravel()
        self._pose_update.publish(message)
        if p.pub_odometry:
            odometry = message_class("nav_msgs/Odometry")()
            odometry.header, odometry.child_frame_id, odometry.pose = (message.header, p.base_frame, message.pose)
            self._odometry.publish(odometry)
        if p.pub_map_odom_transform:
            try:
                odom_to_base = self._lookup(p.odom_frame, p.base_frame, stamp)
            except TransformException as error:
                self.node.logerr(
                    f"Transform failed during publishing of map_odom transform: {error}; without odometry, set "
                    f"~odom_frame to {p.base_frame}, or ~pub_map_odom_transform to false",
                    throttle=5.0,
                )
            else:
                self._correction = compose(placed, inverse(odom_to_base))
                self.broadcaster.send_rigid(p.map_frame, p.odom_frame, self._correction, stamp)
        if p.pub_map_scanmatch_transform:
            self.broadcaster.send_rigid(p.map_frame, p.tf_map_scanmatch_transform_frame_name, placed, stamp)

    def _covariance(self) -> NDArray[np.float64]:
        """Return the covariance (6, 6); zeros before the first match, and if a user gave the pose."""
        found = np.zeros((6, 6))
        if self.slam.matched is not None:
            found[np.ix_(COVARIANCE_INDICES, COVARIANCE_INDICES)] = np.clip(
                self.slam.matched.covariance, -UNKNOWN_VARIANCE, UNKNOWN_VARIANCE
            )
        return found

    def _publish_map(self) -> None:
        if self._mapped_updates != self.slam.updates:
            self._mapped_updates = self.slam.updates
            self._map = self.slam.maps[0].as_map().to_message(self.parameters.map_frame)
            self._map.info.map_load_time = self.node.now()
            self._metadata.publish(self._map.info)
        self._map.header.stamp = self.node.now()
        self._maps.publish(self._map)

    def _publish_cloud(self, header: Any, ends: NDArray[np.float64]) -> None:
        """Publish the beam ends (n, 2), in the laser's frame."""
        point = message_class("geometry_msgs/Point32")
        cloud = message_class("sensor_msgs/PointCloud")(header=header)
        cloud.points = [point(x=x, y=y) for x, y in ends.tolist()]
        self._cloud.publish(cloud)

    # -- services and user input ---------------------------------------------------------------------------------

    def _dynamic_map(self, _: Any) -> Any:
        self.node.loginfo("HectorSM Map service called")
        return {"map": self._map}

    def _command(self, message: Any) -> None:
        self.node.loginfo(f"HectorSM sysMsgCallback, msg contents: {message.data}")
        if message.data == "reset":
            self.node.loginfo("HectorSM reset")
            self._reset()

    def _reset_map(self, _: Any) -> Any:
        self.node.loginfo("HectorSM Reset map service called")
        self._reset()
        return {"success": True, "message": "the map is empty, and the robot at its origin"}

    def _reset(self) -> None:
        self.slam.reset()
        self._mapped_updates, self._start, self._correction = None, None, None

    def _pause(self, request: Any) -> Any:
        self._set_paused(request.data)
        return {"success": True}

    def _set_paused(self, paused: bool) -> None:
        if paused != self.paused:
            self.node.loginfo(f"[HectorSM]: Mapping {'paused' if paused else 'no longer paused'}")
        self.paused = paused

    def _restart(self, request: Any) -> Any:
        pose = self._checked(request.initial_pose)
        self.node.loginfo("HectorSM Reset map")
        self._reset()
        self._set_start(pose)
        self._set_paused(False)
        return {}

    def _initial_pose(self, message: Any) -> None:
        frame, own = message.header.frame_id.lstrip("/"), self.parameters.map_frame.lstrip("/")
        try:
            if frame and frame != own:
                raise RosminiError(f'its frame is "{frame}", but must be "{own}"')
            self._set_start(self._checked(message.pose.pose))
        except RosminiError as error:
            self.node.logwarn(f"an initial pose is ignored: {error}")

    def _checked(self, message: Any) -> Pose:
        pose = planar_pose(message)
        if not all(map(math.isfinite, pose)):
            raise RosminiError(f"the pose {pose} has numbers that are not finite")
        if pose[:2] not in self.slam.maps[0]:
            raise RosminiError(f"({pose[0]:.2f}, {pose[1]:.2f}) is outside the map, {self._map_bounds_text()}")
        return pose

    def _set_start(self, pose: Pose) -> None:
        self._start = pose
        self.node.loginfo(
            f"[HectorSM]: Setting initial pose with world coords x: {pose[0]:f} y: {pose[1]:f} yaw: {pose[2]:f}"
        )
