"""`Costmap2DROS`: a costmap with parameters and topics; `move_base` has two (http://wiki.ros.org/costmap_2d).

Both its parameters and its topics are in the node's private namespace under the costmap's name, `~global_costmap/...`.
"""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.errors import ParameterError
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.graph.show import show
from rosmini.core.tf import Buffer, TransformException
from rosmini.core.tf.rigid import compose, from_yaw, rpy
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.nav_core.failures import TransformMissing
from rosmini.navigation.nav_core.poses import planar_pose, pose_stamped

from . import footprint as outlines
from .costmap import Costmap2D, fill
from .layer import Layer
from .layered import LayeredCostmap
from .migration import inherit, migrate
from .parameters import CostmapConfig, CostmapParameters, name_above
from .publisher import Costmap2DPublisher

WARN_PERIOD = 5.0
"""Interval between warnings while the robot's transform is missing [s]."""
DYNAMIC_NAMES = tuple(each.name for each in fields(CostmapConfig))
"""Names of the parameters that can change while the costmap runs."""
POLL_PERIOD = 0.01
"""Interval between checks for the first update [s]."""


class Costmap2DROS:
    """A costmap that its layers keep up to date.

    The constructor blocks until the robot's pose in the global frame is known and, with a static layer, until a map has
    arrived. Raises `ParameterError` for an invalid parameter and `PluginError` for an unknown layer type.
    """

    def __init__(self, name: str, buffer: Buffer, node: Node) -> None:
        self.name, self.node, self.buffer = name, node, buffer
        self.namespace = f"~{name}/"
        self._read_parameters()
        settings = self._settings
        self.global_frame = self._frame("global_frame", settings.global_frame)
        self.base_frame = self._frame("robot_base_frame", settings.robot_base_frame)
        self._wait_for_robot()
        self.layered = LayeredCostmap(
            self.global_frame,
            rolling_window=settings.rolling_window,
            track_unknown_space=settings.track_unknown_space,
            report=self._report_failure,
        )
        self.stopped = False
        self._paused = False
        self._initialized = True
        self._timer: Any = None
        self._last_publish: int | None = None
        self._padding = 0.0
        self._unpadded: NDArray[np.float64] = np.zeros((0, 2))
        self._old = CostmapConfig()
        self._tolerance_ns = round(settings.transform_tolerance * 1e9)
        self._add_layers()
        self._publish_footprint()
        self._publisher = Costmap2DPublisher(
            node,
            self.grid,
            self.global_frame,
            self.namespace + "costmap",
            always_send_full=settings.always_send_full_costmap,
        )
        self._server = Server(node, CostmapConfig, self._reconfigure, namespace=self.namespace)

    def __repr__(self) -> str:
        names = ", ".join(layer.name for layer in self.layers)
        return f"<Costmap2DROS {self.name} of {self.node.name}: {self.grid!r}, layers {names}>"

    # -- setup ---------------------------------------------------------------------------------------------------

    def _read_parameters(self) -> None:
        """Convert old parameter forms to the current one, and read the parameters."""
        node, namespace = self.node, self.namespace
        migrate_sizes(node, namespace)
        tracks_unknown = node.get_param(namespace + "track_unknown_space", False, expect=bool)
        self._initial_footprint = footprint_of_parameters(node, namespace)
        migrate(node, namespace, self.name)
        self._settings = CostmapParameters.read(node, namespace, track_unknown_space=tracks_unknown)
        if not self._settings.resolution > 0:
            raise ParameterError(
                f"parameter {node.resolve(namespace + 'resolution')} is {self._settings.resolution:g}: it must be "
                "the side of a cell in metres, greater than 0"
            )

    def _frame(self, parameter: str, frame: str) -> str:
        if frame.startswith("/"):
            self.node.logwarn(
                f"parameter {self.node.resolve(self.namespace + parameter)} is '{frame}': frame names no "
                f"longer have a leading slash, using '{frame.lstrip('/')}'"
            )
        return frame.lstrip("/")

    def _wait_for_robot(self) -> None:
        """Block until the robot's pose is known."""
        while not self.buffer.wait_for_transform(self.global_frame, self.base_frame, timeout=WARN_PERIOD):
            why = self.buffer.tree.why_not(self.global_frame, self.base_frame)
            self.node.logwarn(
                f"Timed out waiting for transform from {self.base_frame} to {self.global_frame} to become available "
                f"before running costmap, tf error: {why}"
            )

    def _add_layers(self) -> None:
        for entry in self._settings.plugins:
            self.node.loginfo(f'{self.name}: Using plugin "{entry.name}"')
            inherit(self.node, self.namespace, entry.name, entry.type)
            layer = Layer.create(entry.type)
            self.layered.add(layer)
            layer.initialize(self.layered, entry.name, f"{self.namespace}{entry.name}/", self.node, self.buffer)

    def _publish_footprint(self) -> None:
        """Subscribe to footprints, advertise the placed footprint, and set the footprint given by parameters."""
        settings, node = self._settings, self.node
        node.subscriber(
            self._topic_name(settings.footprint_topic),
            message_class("geometry_msgs/Polygon"),
            lambda polygon: self._take_footprint(outlines.points_of(polygon)),
            queue_size=1,
            skip_own_mismatch=True,
        )
        self._footprints = node.publisher(
            self._topic_name(settings.published_footprint_topic),
            message_class("geometry_msgs/PolygonStamped"),
            queue_size=1,
        )
        self._footprints.expect_nobody()
        self.set_footprint(self._initial_footprint)

    def _topic_name(self, topic: str) -> str:
        return topic if topic.startswith(("/", "~")) else self.namespace + topic

    def _reconfigure(self, config: Any, _: int) -> Any:
        """Apply the parameters that can change at any time."""
        new = CostmapConfig(**{name: config[name] for name in DYNAMIC_NAMES})
        self._tolerance_ns = round(new.transform_tolerance * 1e9)
        if not self.layered.is_size_locked and new.resolution > 0:
            # As in the original: truncated, so a window of 0.15 m at 0.05 m is three cells wide.
            width, height = (int(side / new.resolution + 1e-9) for side in (new.width, new.height))
            size = (width, height, new.resolution, (new.origin_x, new.origin_y))
            if self.layered.is_rolling and self.grid.geometry[:3] == size[:3]:
                size = (*size[:3], self.grid.origin)
            if self.grid.geometry != size:
                self.layered.resize(*size)
        if new.footprint_padding != self._padding:
            self._padding = new.footprint_padding
            self.set_footprint(self._unpadded)
        self._reconfigure_footprint(new)
        self._old = new
        self._restart(new.update_frequency, new.publish_frequency)
        return config

    def _reconfigure_footprint(self, new: CostmapConfig) -> None:
        """Apply the new footprint or radius if either has changed; otherwise keep one that came from a topic."""
        if (new.footprint, new.robot_radius) == (self._old.footprint, self._old.robot_radius) and len(self._unpadded):
            return
        name = self.node.resolve(self.namespace + "footprint")
        if new.footprint in ("", "[]"):
            self.set_footprint(outlines.footprint_from_radius(new.robot_radius))
            return
        try:
            self.set_footprint(outlines.footprint_from_text(new.footprint, name))
        except ParameterError as error:
            self.node.logerr(f"Invalid footprint string from dynamic reconfigure: {error}")

    def _restart(self, update_frequency: float, publish_frequency: float) -> None:
        """Start updating and publishing at these rates, with one update immediately."""
        if self._timer is not None:
            self._timer.shutdown()
            self._timer = None
        self._publish_ns = round(1e9 / publish_frequency) if publish_frequency > 0 else 0
        if update_frequency > 0:
            self._timer = self.node.timer(1 / update_frequency, lambda _: self._update_and_publish())
            self._update_and_publish()

    # -- queries -------------------------------------------------------------------------------------------------

    @property
    def grid(self) -> Costmap2D:
        """The master grid; the same object for the lifetime of the costmap."""
        return self.layered.grid

    @property
    def layers(self) -> list[Layer]:
        """The layers, lowest first."""
        return self.layered.layers

    @property
    def footprint(self) -> NDArray[np.float64]:
        """The padded footprint's vertices (n, 2) [m] in the base frame."""
        return self.layered.footprint

    @property
    def inscribed_radius(self) -> float:
        """The distance [m] from the robot's centre to the nearest point of the padded footprint."""
        return self.layered.inscribed_radius

    @property
    def circumscribed_radius(self) -> float:
        """The distance [m] from the robot's centre to the farthest point of the padded footprint."""
        return self.layered.circumscribed_radius

    @property
    def is_current(self) -> bool:
        """True if every layer has received sensor data within its expected period."""
        return self.layered.is_current

    def robot_pose(self) -> Any:
        """Return the robot's latest pose in the global frame (`PoseStamped`).

        Raises `TransformMissing` if the pose is unknown or older than `transform_tolerance`.
        """
        pose, stamp_ns = self._robot()
        return pose_stamped(self.global_frame, Time.from_nsec(stamp_ns), pose)

    def to_global(self, pose: Any) -> Any:
        """Return a `PoseStamped` in the global frame, by the latest transform. Raises `TransformMissing` if none."""
        frame = pose.header.frame_id.lstrip("/")
        if frame == self.global_frame:
            return pose
        try:
            found = self.buffer.tree.lookup(self.global_frame, frame)
        except TransformException as error:
            raise TransformMissing(
                f"a pose in the frame '{frame}' cannot be transformed to '{self.global_frame}': {error}",
                frame=frame,
                global_frame=self.global_frame,
            ) from error
        moved = compose(found.transform, from_yaw(*planar_pose(pose)))
        return pose_stamped(self.global_frame, Time.from_nsec(found.stamp_ns), (moved[0], moved[1], rpy(moved)[2]))

    def show(self, *, title: str | None = None) -> Any:
        """Draw the costs and the robot, with a title below. Raises `TransformMissing` if its pose is unknown."""
        return show("costmap", self.grid, robot=self._robot()[0], footprint=self.footprint, name=self.name, title=title)

    # -- changes -------------------------------------------------------------------------------------------------

    def set_footprint(self, footprint: ArrayLike) -> None:
        """Set an unpadded footprint (n, 2) [m]."""
        self._unpadded = np.asarray(footprint, dtype=np.float64).reshape(-1, 2)
        self.layered.set_footprint(outlines.padded(self._unpadded, self._padding))

    def set_costs(self, polygon: ArrayLike, cost: int) -> bool:
        """Set the cost of all cells in a convex polygon (n, 2) [m] in the global frame, until they are next updated.

        Returns False, and changes nothing, if a vertex is outside the grid.
        """
        return fill(self.grid, polygon, cost)

    def update(self) -> bool:
        """Update once now; return False while the costmap is paused or the robot's pose is unknown."""
        if self._paused:
            return False
        try:
            pose, _ = self._robot()
        except TransformMissing as error:
            self.node.logwarn(str(error), throttle=1.0)
            return False
        self._publisher.changed(self.layered.update_map(pose))
        self._send_footprint(pose)
        self._initialized = True
        return True

    def start(self) -> None:
        """Resume after `stop` or `pause`, and block until an update has completed."""
        if self.stopped:
            for layer in self.layers:
                layer.activate()
            self.stopped = False
        self.resume()

    def stop(self) -> None:
        """Stop updating, and unsubscribe the layers from their topics."""
        self.pause()
        for layer in self.layers:
            layer.deactivate()
        self.stopped = True

    def pause(self) -> None:
        """Stop updating."""
        self._paused = True
        self._initialized = False

    def resume(self) -> None:
        """Start updating again, and block until an update has completed."""
        self._paused = False
        if self._timer is not None and not self._initialized:
            self.update()
        while self._timer is not None and not self._initialized:
            self.node.sleep(POLL_PERIOD)

    def reset_layers(self) -> None:
        """Clear all costs, including those in the layers."""
        self.layered.reset()

    def shutdown(self) -> None:
        """Stop updating permanently."""
        self.pause()
        if self._timer is not None:
            self._timer.shutdown()
            self._timer = None
        for layer in self.layers:
            layer.deactivate()

    # -- updates -------------------------------------------------------------------------------------------------

    def _update_and_publish(self) -> None:
        self.update()
        if not self._publish_ns or not self.layered.is_initialized:
            return
        now = self.node.clock.now_ns()
        # Simulated times are exact: at equal rates every update is published, not every other one.
        if self._last_publish is None or not 0 <= now - self._last_publish < self._publish_ns:
            self._last_publish = now
            self._publisher.publish()

    def _robot(self) -> tuple[Pose, int]:
        """Return the robot's pose in the global frame and the time of that pose [ns]. Raises as `robot_pose`."""
        now = self.node.clock.now_ns()
        tree = self.buffer.tree
        try:
            found = tree.lookup(self.global_frame, self.base_frame)
            if found.stamp_ns > now:  # a transform may be dated in the future, but the robot's pose may not
                found = tree.lookup(self.global_frame, self.base_frame, now)
        except TransformException as error:
            raise TransformMissing(
                f"No Transform available Error looking up robot pose: {error}",
                global_frame=self.global_frame,
                base_frame=self.base_frame,
            ) from error
        if found.stamp_ns and now - found.stamp_ns > self._tolerance_ns:
            raise TransformMissing(
                f"Costmap2DROS transform timeout. Current time: {now * 1e-9:.4f}, global_pose stamp: "
                f"{found.stamp_ns * 1e-9:.4f}, tolerance: {self._tolerance_ns * 1e-9:.4f}",
                global_frame=self.global_frame,
                base_frame=self.base_frame,
                age=(now - found.stamp_ns) * 1e-9,
            )
        x, y, *_ = found.transform
        return (x, y, rpy(found.transform)[2]), found.stamp_ns

    def _send_footprint(self, pose: Pose) -> None:
        if not self._footprints.num_connections():
            return
        message = message_class("geometry_msgs/PolygonStamped")()
        message.header.frame_id, message.header.stamp = self.global_frame, self.node.now()
        point = message_class("geometry_msgs/Point32")
        message.polygon.points = [point(x=x, y=y) for x, y in outlines.placed(self.footprint, pose).tolist()]
        self._footprints.publish(message)

    def _take_footprint(self, footprint: NDArray[np.float64]) -> None:
        if len(footprint) < 3 or not np.isfinite(footprint).all():
            self.node.logerr(
                f"ignoring a footprint of {len(footprint)} points from a topic: it needs at least three "
                "points with finite numbers"
            )
            return
        self.set_footprint(footprint)

    def _report_failure(self, layer: Layer, error: Exception) -> None:
        self.node.logerr(
            f"{self.name}: the layer {layer.name} ({type(layer).__name__}) failed and is missing from this update: "
            f"{type(error).__name__}: {error}",
            throttle=1.0,
        )


def migrate_sizes(node: Node, namespace: str) -> None:
    """Round width and height of the window to whole metres, because roscpp reads these parameters as integers."""
    for name in ("width", "height"):
        value = node.get_param(namespace + name, None)
        if isinstance(value, float) and math.isfinite(value):
            whole = math.floor(value + 0.5)
            if whole != value:
                node.logwarn(
                    f"parameter {node.resolve(namespace + name)} is {value:g} m: the sides of a costmap must be whole "
                    f"metres, using {whole} m"
                )
            node.set_param(namespace + name, whole)


def footprint_of_parameters(node: Node, namespace: str) -> NDArray[np.float64]:
    """Return the footprint from `footprint` or `robot_radius`, here or in a parent namespace; (0, 2) if neither is set.

    The value is copied into this namespace, where dynamic_reconfigure reads it. Raises `ParameterError` if invalid.
    """
    found = name_above(node, namespace, "footprint")
    if found is not None:
        value = node.get_param(found)
        if value not in ("", "[]"):
            made = (
                outlines.footprint_from_text(value, found)
                if isinstance(value, str)
                else outlines.footprint_from_list(value, found)
            )
            crossed = outlines.crossing(made)
            if crossed is not None:
                node.logwarn(
                    f"parameter {found}: the outline crosses itself (the edges after points {crossed[0]} and "
                    f"{crossed[1]}); list its points in order around the robot"
                )
            node.set_param(namespace + "footprint", outlines.footprint_text(made))
            return made
        node.set_param(namespace + "footprint", value)
    found = name_above(node, namespace, "robot_radius")
    if found is None:
        return np.zeros((0, 2))
    radius = node.get_param(found, expect=float)
    node.set_param(namespace + "robot_radius", radius)
    return outlines.footprint_from_radius(radius)
