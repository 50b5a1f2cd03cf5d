"""`amcl/amcl`: the filter as a node (http://wiki.ros.org/amcl).

It subscribes to `scan`, `tf`, `initialpose` and a map, and publishes `amcl_pose`, `particlecloud` and the transform
from the map to the odometry frame. A scan waits until its transforms are available.
"""

from __future__ import annotations

import math
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.errors import RosminiError, ServiceException
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph import MessageFactory, Node
from rosmini.core.maps.grid_map import GridMap
from rosmini.core.tf import Buffer, TransformBroadcaster, TransformException, TransformListener
from rosmini.core.tf.messages import set_pose
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class, service_class
from rosmini.msgs.template import template
from rosmini.navigation.kernels import prepare
from rosmini.navigation.nav_core.poses import planar_pose, planar_transform

from .laser import Scan
from .localizer import Estimate, Localizer
from .motion import MODELS
from .parameters import LASERS, AmclConfig, AmclParameters

TRANSFORM_TIMEOUT = 0.5
"""Maximum time that a scan waits for its transforms [s]."""
MAP_RETRY_PERIOD = 0.5
"""Interval between requests for the map [s]."""
SCAN_TIMEOUT = 15.0
"""Time without a scan after which there is a warning [s]."""
MAX_DISORDER_NS = 1_000_000_000
"""Scans of several lasers may be out of order by less than this [ns]; more is a jump back in time."""
MAX_MAP_ROTATION = 1e-3
"""A map counts as rotated if its origin's heading exceeds this angle [rad]."""
MAX_JUMP = 5.0
"""Maximum plausible distance between two updates [m]."""
DIAGNOSTICS_PERIOD = 1.0
"""Interval between messages on `/diagnostics` [s]."""
COVARIANCE_INDICES = ((0, 0), (0, 1), (1, 0), (1, 1))
"""Indices of x and y in a six by six covariance; that of the heading is (5, 5)."""

DEVIATION_AXES = ("x", "y", "yaw")
_POSE = template(
    message_class("geometry_msgs/Pose")(), "position.x", "position.y", "orientation.z", "orientation.w"
)  # of a particle


class Amcl:
    """The node `amcl`, which runs a `Localizer` on the scans and the map that it receives."""

    def __init__(self, node: Node) -> None:
        prepare(node)
        self.node = node
        self.parameters = self._with_known_models(AmclParameters.read(node))
        random = node.graph.rng(f"{node.name}/particles")
        self.localizer = Localizer(self.parameters, random)
        self.buffer = Buffer(node)
        self.listener = TransformListener(node, self.buffer)
        self.broadcaster = TransformBroadcaster(node)
        self._correction: Pose | None = None
        """The pose of the odometry frame in the map."""
        self._map: Any = None
        self._estimate: Estimate | None = None
        self._lasers: dict[str, tuple[Pose, bool]] = {}
        self._last_scan_ns = self._saved_ns = node.clock.now_ns()
        self._last_stamp_ns = 0
        self._initial_config: dict[str, Any] | None = None
        """The initial values of the parameters that can change at run time."""
        self._advertise()
        self._server = Server(node, AmclConfig, self._reconfigure)
        self.localizer.initialize(self._start_pose(), self._start_covariance())
        self._subscribe()

    def _advertise(self) -> None:
        node = self.node
        self._pose = node.publisher(
            "amcl_pose", message_class("geometry_msgs/PoseWithCovarianceStamped"), queue_size=2, latch=True
        )
        self._cloud = node.publisher(
            "particlecloud", message_class("geometry_msgs/PoseArray"), queue_size=2, latch=True
        )
        self._diagnostics = node.publisher(
            "/diagnostics", message_class("diagnostic_msgs/DiagnosticArray"), queue_size=1
        )
        empty = service_class("std_srvs/Empty")
        node.service("global_localization", empty, self._initialize_globally)
        node.service("request_nomotion_update", empty, self._request_update)
        node.service("set_map", service_class("nav_msgs/SetMap"), self._set_map)

    def _subscribe(self) -> None:
        node = self.node
        node.subscriber(
            "initialpose", message_class("geometry_msgs/PoseWithCovarianceStamped"), self._initial_pose, queue_size=2
        )
        node.subscriber("scan", message_class("sensor_msgs/LaserScan"), self._scan, queue_size=100)
        if self.parameters.use_map_topic:
            node.subscriber("map", message_class("nav_msgs/OccupancyGrid"), self._on_map, queue_size=1)
        else:
            node.spawn("map", self._request_map)
        node.timer(SCAN_TIMEOUT, self._check_scans)
        node.timer(DIAGNOSTICS_PERIOD, self._diagnose)
        if self.parameters.save_pose_rate > 0:
            node.on_shutdown(self._save_pose)

    # -- parameters ----------------------------------------------------------------------------------------------

    def _reconfigure(self, config: Any, level: int) -> Any:
        if self._initial_config is None:
            self._initial_config = {**config, "restore_defaults": False}
        elif config["restore_defaults"]:
            config.update(self._initial_config)
        changes = {one.name: config[one.name] for one in fields(AmclConfig)}
        if changes["min_particles"] > changes["max_particles"]:
            self.node.logwarn(
                f"min_particles ({changes['min_particles']}) is above max_particles ({changes['max_particles']}): both "
                "are set to min_particles"
            )
            config["max_particles"] = changes["max_particles"] = changes["min_particles"]
        before = self.parameters
        self.parameters = self._with_known_models(replace(before, **changes))
        self._lasers = {}
        if level != -1 or self.parameters != before:
            self.localizer.configure(self.parameters)
            if self.parameters.laser_likelihood_max_dist != before.laser_likelihood_max_dist and self._map is not None:
                self._take_map(self._map, again=True)
        return config

    def _with_known_models(self, given: AmclParameters) -> AmclParameters:
        """Return the parameters with unknown models replaced by the default, with a warning, as in amcl."""
        if given.odom_model_type not in MODELS:
            self.node.logwarn(f'Unknown odom model type "{given.odom_model_type}"; defaulting to diff model')
            given = replace(given, odom_model_type="diff")
        if given.laser_model_type not in LASERS:
            self.node.logwarn(
                f'Unknown laser model type "{given.laser_model_type}"; defaulting to likelihood_field model'
            )
            given = replace(given, laser_model_type="likelihood_field")
        return given

    def _start_pose(self) -> Pose:
        p = self.parameters
        return p.initial_pose_x, p.initial_pose_y, p.initial_pose_a

    def _start_covariance(self) -> NDArray[np.float64]:
        p = self.parameters
        return np.diag([p.initial_cov_xx, p.initial_cov_yy, p.initial_cov_aa])

    # -- the map -------------------------------------------------------------------------------------------------

    def _request_map(self) -> None:
        """Request the map until a server sends a valid one."""
        client = self.node.service_client("static_map", service_class("nav_msgs/GetMap"))
        self.node.loginfo("Requesting the map...")
        while self._map is None and not self.node.is_shutdown():
            try:
                answer = client()
            except (ServiceException, RosminiError):
                if self.node.is_shutdown():
                    return
                self.node.logwarn("Request for map failed; trying again...")
                self.node.sleep(MAP_RETRY_PERIOD)
            else:
                if not self._take_map(answer.map):
                    self.node.sleep(MAP_RETRY_PERIOD)

    def _on_map(self, grid: Any) -> None:
        if self._map is not None and self.parameters.first_map_only:
            return
        self._take_map(grid)

    def _take_map(self, grid: Any, *, again: bool = False) -> bool:
        """Use a `nav_msgs/OccupancyGrid` as the map; return False if it is invalid."""
        info = grid.info
        self.node.loginfo(f"Received a {info.width} X {info.height} map @ {info.resolution:.3f} m/pix\n")
        if grid.header.frame_id.lstrip("/") != self.parameters.global_frame_id.lstrip("/"):
            self.node.logwarn(
                f"Frame_id of map received:'{grid.header.frame_id}' doesn't match "
                f"global_frame_id:'{self.parameters.global_frame_id}'. This could cause issues with reading published "
                "topics"
            )
        try:
            taken = GridMap.from_message(grid)
            self.localizer.set_map(taken)
        except RosminiError as error:
            self.node.logerr(f"the map cannot be used, keeping the previous one: {error}")
            return False
        if abs(taken.origin[2]) > MAX_MAP_ROTATION:
            self.node.logwarn(
                f"the map's origin is rotated by {math.degrees(taken.origin[2]):.1f} degrees, which amcl ignores: "
                "scans will not fit; use a map whose origin has yaw 0"
            )
        first, self._map = self._map is None, grid
        self._lasers = {}
        if first:
            self._warn_outside(self.localizer.filter.mean().mean)
        elif not again:
            self.localizer.initialize(self._estimated_pose(), self._start_covariance())
        return True

    def _estimated_pose(self) -> Pose:
        return self._start_pose() if self._estimate is None else self.localizer.estimate().pose

    def _set_map(self, request: Any) -> Any:
        taken = self._take_map(request.map)
        if taken:
            self._initial_pose(request.initial_pose)
            if self.parameters.force_update_after_set_map:
                self.localizer.force = True
        return {"success": taken}

    # -- initial poses -------------------------------------------------------------------------------------------

    def _initialize_globally(self, _: Any) -> Any:
        self.node.loginfo("Initializing with uniform distribution")
        self.localizer.initialize_globally()
        self.node.loginfo("Global initialisation done!")
        return {}

    def _request_update(self, _: Any) -> Any:
        self.localizer.force = True
        return {}

    def _initial_pose(self, message: Any) -> None:
        """Restart around a given pose, moved by the robot's odometry since the message's stamp."""
        p, frame = self.parameters, message.header.frame_id
        if not frame:
            self.node.logwarn("Received initial pose with empty frame_id.  You should always supply a frame_id.")
        elif frame.lstrip("/") != p.global_frame_id.lstrip("/"):
            self.node.logwarn(
                f'Ignoring initial pose in frame "{frame}"; initial poses must be in the global frame, '
                f'"{p.global_frame_id}"'
            )
            return
        try:
            pose, covariance = checked_pose(message.pose)
        except RosminiError as error:
            self.node.logwarn(f"ignoring an initial pose: {error}")
            return
        pose = compose(pose, self._motion_since(message.header.stamp))
        self.node.loginfo(f"Setting pose ({self.node.now().to_sec():.6f}): {pose[0]:.3f} {pose[1]:.3f} {pose[2]:.3f}")
        self._warn_outside(pose)
        self.localizer.initialize(pose, covariance)
        if p.force_update_after_initialpose:
            self.localizer.force = True

    def _motion_since(self, stamp: Time) -> Pose:
        """Return the robot's motion since a time from its odometry, as a pose in its old frame; zero if unknown."""
        p = self.parameters
        if stamp.to_nsec() == 0:
            return 0.0, 0.0, 0.0
        try:
            found = self.buffer.lookup_transform_full(
                p.base_frame_id, stamp, p.base_frame_id, self.node.now(), p.odom_frame_id, TRANSFORM_TIMEOUT
            )
        except TransformException as error:
            # Before the first scan the odometry may be missing; the robot has not moved then.
            if self._correction is not None:
                self.node.logwarn(f"Failed to transform initial pose in time ({error})")
            return 0.0, 0.0, 0.0
        return planar_transform(found)

    def _warn_outside(self, pose: Pose) -> None:
        free = self.localizer.free
        if free is not None and pose[:2] not in free:
            self.node.logwarn(
                f"the initial pose ({pose[0]:.2f}, {pose[1]:.2f}) is not in the free space of the map: the particles "
                "may never find the robot; set another pose, or call global_localization"
            )

    # -- scans ---------------------------------------------------------------------------------------------------

    def _scan(self, message: Any) -> None:
        self._last_scan_ns = self.node.clock.now_ns()
        if self.localizer.field is None:
            return
        frame, stamp = message.header.frame_id.lstrip("/"), message.header.stamp
        try:
            laser, upside_down = self._laser(frame)
            odometry = self._odometry(stamp)
            scan = self._checked(message, laser, upside_down)
        except TransformException as error:
            self.node.logwarn(f"a scan of {frame} is ignored: {error}", throttle=5.0)
            return
        except RosminiError as error:
            self.node.logerr(error, throttle=5.0)
            return
        self._restart_after_time_jump(stamp)
        self._warn_of_odometry_jump(odometry)
        has_estimate = self.localizer.update(frame, scan, odometry)
        if has_estimate is not None:
            self._publish_cloud(stamp)
        if has_estimate:
            self._estimate = found = self.localizer.estimate()
            self._publish_pose(found, stamp)
            self._correction = compose(found.pose, inverse(odometry))
        if self._correction is not None:
            self._broadcast(stamp)
            self._maybe_save()

    def _restart_after_time_jump(self, stamp: Time) -> None:
        """Restart at the initial pose if time has jumped back: a bag in a loop, or a simulation that was reset."""
        before, self._last_stamp_ns = self._last_stamp_ns, stamp.to_nsec()
        if self._last_stamp_ns < before - MAX_DISORDER_NS:
            self._saved_ns = self.node.clock.now_ns()
            pose = self._start_pose()
            self.node.logwarn(
                f"scans jump back in time, from {before * 1e-9:.3f} s to {stamp.to_sec():.3f} s: restarting at "
                f"the initial pose ({pose[0]:.2f}, {pose[1]:.2f})"
            )
            self.localizer.initialize(pose, self._start_covariance())

    def _warn_of_odometry_jump(self, odometry: Pose) -> None:
        before = self.localizer.odometry
        if before is not None and math.dist(before[:2], odometry[:2]) > MAX_JUMP:
            self.node.logwarn(
                f"the odometry jumps from ({before[0]:.2f}, {before[1]:.2f}) to ({odometry[0]:.2f}, "
                f"{odometry[1]:.2f}), more than {MAX_JUMP:.0f} m between two scans: the particles move with it; set an "
                "initial pose if the robot did not move"
            )

    def _laser(self, frame: str) -> tuple[Pose, bool]:
        """Return the laser's pose in the robot's frame, and whether it is mounted upside down."""
        if frame not in self._lasers:
            found = self.buffer.lookup_transform(self.parameters.base_frame_id, frame, Time(0), TRANSFORM_TIMEOUT)
            q = found.transform.rotation
            up = 1 - 2 * (q.x * q.x + q.y * q.y)
            self._lasers[frame] = planar_transform(found), up < 0
        return self._lasers[frame]

    def _odometry(self, stamp: Time) -> Pose:
        p = self.parameters
        return planar_transform(
            self.buffer.lookup_transform(p.odom_frame_id, p.base_frame_id, stamp, TRANSFORM_TIMEOUT)
        )

    def _checked(self, message: Any, laser: Pose, upside_down: bool) -> Scan:
        """Return the usable part of a scan. Raises `RosminiError` for an invalid scan."""
        p = self.parameters
        ranges = np.asarray(message.ranges, dtype=np.float64)
        known = all(map(math.isfinite, (message.angle_min, message.angle_increment, message.range_min)))
        if len(ranges) < 2 or not known or message.angle_increment == 0:
            raise RosminiError(
                f"a scan of {message.header.frame_id} has {len(ranges)} ranges, the angle_min {message.angle_min}, the "
                f"angle_increment {message.angle_increment} and the range_min {message.range_min}: it is ignored"
            )
        top = message.range_max if p.laser_max_range <= 0 else min(message.range_max, p.laser_max_range)
        low = message.range_min if p.laser_min_range <= 0 else max(message.range_min, p.laser_min_range)
        if not (math.isfinite(top) and top > 0):
            raise RosminiError(
                f"a scan of {message.header.frame_id} has the range_max {message.range_max}: set ~laser_max_range"
            )
        ranges = np.where(ranges <= low, top, ranges)
        bearings = message.angle_min + message.angle_increment * np.arange(len(ranges))
        return Scan(ranges, bearings, float(top), laser, upside_down)

    def _check_scans(self, _: Any) -> None:
        silent = (self.node.clock.now_ns() - self._last_scan_ns) * 1e-9
        if silent > SCAN_TIMEOUT:
            self.node.logwarn(
                f"No laser scan received (and thus no pose updates have been published) for {silent:f} seconds.  "
                f"Verify that data is being published on the {self.node.resolve('scan')} topic."
            )

    def _diagnose(self, _: Any) -> None:
        if self._estimate is not None and self._diagnostics.num_connections():
            found = deviations(self.node.name, self._estimate.covariance, self.parameters, self.node.now())
            self._diagnostics.publish(found)

    # -- results -------------------------------------------------------------------------------------------------

    def _publish_pose(self, found: Estimate, stamp: Time) -> None:
        message = message_class("geometry_msgs/PoseWithCovarianceStamped")()
        message.header.frame_id, message.header.stamp = self.parameters.global_frame_id, stamp
        set_pose(message.pose.pose, from_yaw(*found.pose))
        whole = np.zeros((6, 6))
        for row, column in COVARIANCE_INDICES:
            whole[row, column] = found.covariance[row, column]
        whole[5, 5] = found.covariance[2, 2]
        message.pose.covariance = whole.ravel().tolist()
        self._pose.publish(message)

    def _publish_cloud(self, stamp: Time) -> None:
        particles, frame = self.localizer.filter.particles.copy(), self.parameters.global_frame_id
        self._cloud.publish(MessageFactory(lambda: cloud(particles, frame, stamp), is_frozen=True))

    def _broadcast(self, stamp: Time) -> None:
        p = self.parameters
        if p.tf_broadcast and self._correction is not None:
            x, y, yaw = self._correction
            when = stamp + Duration.from_sec(p.transform_tolerance)
            self.broadcaster.send_rigid(p.global_frame_id, p.odom_frame_id, from_yaw(x, y, yaw), when)

    def _maybe_save(self) -> None:
        rate, now = self.parameters.save_pose_rate, self.node.clock.now_ns()
        if rate > 0 and (now - self._saved_ns) * 1e-9 >= 1 / rate:
            self._saved_ns = now
            self._save_pose()

    def _save_pose(self) -> None:
        """Write the estimated pose to the parameters from which amcl starts."""
        if self._estimate is None:
            return
        x, y, a = self._estimate.pose
        c = self._estimate.covariance
        values = {"pose_x": x, "pose_y": y, "pose_a": a, "cov_xx": c[0, 0], "cov_yy": c[1, 1], "cov_aa": c[2, 2]}
        for name, value in values.items():
            self.node.set_param(f"~initial_{name}", float(value))


def cloud(particles: NDArray[np.float64], frame: str, stamp: Time) -> Any:
    """Return particles (n, 3) in `frame` as a `geometry_msgs/PoseArray` that shares nothing with other messages."""
    message = message_class("geometry_msgs/PoseArray")()
    message.header.frame_id, message.header.stamp = frame, Time(stamp.secs, stamp.nsecs)
    message.poses = [_POSE(x, y, math.sin(yaw / 2), math.cos(yaw / 2)) for x, y, yaw in particles.tolist()]
    return message


def checked_pose(posed: Any) -> tuple[Pose, NDArray[np.float64]]:
    """Return pose and covariance (3, 3) of a `PoseWithCovariance`. Raises `RosminiError` for invalid numbers."""
    pose, covariance = planar_pose(posed.pose), planar_covariance(posed.covariance)
    if not (all(map(math.isfinite, pose)) and np.isfinite(covariance).all()):
        raise RosminiError(f"it has numbers that are not finite: {pose}")
    if (covariance.diagonal() < 0).any():
        raise RosminiError(f"it has a variance below 0: {', '.join(f'{v:g}' for v in covariance.diagonal())}")
    return pose, covariance


def planar_covariance(values: Any) -> NDArray[np.float64]:
    """Return the part (3, 3) for x, y and heading of a covariance of 36 numbers, made symmetric."""
    whole = np.asarray(values, dtype=float).reshape(6, 6)
    found = np.zeros((3, 3))
    for row, column in COVARIANCE_INDICES:
        found[row, column] = (whole[row, column] + whole[column, row]) / 2
    found[2, 2] = whole[5, 5]
    return found


def deviations(node_name: str, covariance: NDArray[Any], limits: AmclParameters, stamp: Time) -> Any:
    """Return a `diagnostic_msgs/DiagnosticArray` for a covariance (3, 3) of x, y [m2] and heading [rad2]."""
    spread = [math.sqrt(max(0.0, float(covariance[axis, axis]))) for axis in range(3)]
    allowed = [getattr(limits, f"std_warn_level_{axis}") for axis in DEVIATION_AXES]
    status = message_class("diagnostic_msgs/DiagnosticStatus")()
    too_large = any(0 < limit < value for value, limit in zip(spread, allowed, strict=True))
    status.level = status.WARN if too_large else status.OK
    status.name = f"{node_name.lstrip('/')}: Standard deviation"
    status.message = "Too large" if too_large else "OK"
    status.hardware_id = "None"
    pairs = [
        *zip(DEVIATION_AXES, spread, strict=True),
        *((f"warn_level_{a}", v) for a, v in zip(DEVIATION_AXES, allowed, strict=True)),
    ]
    pair = message_class("diagnostic_msgs/KeyValue")
    status.values = [pair(key=f"std_{name}", value=f"{value:.6g}") for name, value in pairs]
    message = message_class("diagnostic_msgs/DiagnosticArray")()
    message.header.stamp = stamp
    message.status = [status]
    return message
