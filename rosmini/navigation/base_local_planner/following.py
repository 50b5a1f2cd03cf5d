"""The part of local planners that uses the graph: the plan, odometry, topics, clouds and parameters.

It does the work of `LocalPlannerUtil`, `OdometryHelperRos`, `MapGridVisualizer` and `goal_functions`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph import MessageFactory, Node
from rosmini.core.tf import Buffer, TransformException
from rosmini.msgs import message_class
from rosmini.msgs.template import template
from rosmini.navigation.costmap_2d.costmap import INSCRIBED_INFLATED_OBSTACLE
from rosmini.navigation.nav_core import ControlFailure, NoValidCommand, TransformMissing, pose_stamped
from rosmini.navigation.nav_core.clouds import point_cloud

from .goal_functions import passed_count, slice_in_reach
from .map_grid import MapGrid
from .trajectory import Samples

Floats = NDArray[np.float64]

_VARYING = ("pose.position.x", "pose.position.y", "pose.orientation.z", "pose.orientation.w")
"""The fields in which the poses of a path differ."""


class Following:
    """The plan being followed, and the part of it that is near the local costmap."""

    def __init__(self, buffer: Buffer, costmap: Any) -> None:
        self.buffer, self.costmap = buffer, costmap
        self.poses: Floats = np.empty((0, 3))
        """The remaining plan (n, 3), in `frame`."""
        self.frame = ""

    def set_plan(self, plan: Sequence[Any]) -> None:
        """Set the plan: poses (`geometry_msgs/PoseStamped`), all in the frame of the first one."""
        self.frame = plan[0].header.frame_id.lstrip("/") if plan else ""
        rows = []
        for stamped in plan:
            p, q = stamped.pose.position, stamped.pose.orientation
            rows.append((p.x, p.y, 2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)))
        made = np.array(rows, dtype=np.float64).reshape(-1, 4)
        self.poses = np.column_stack([made[:, :2], np.arctan2(made[:, 2], made[:, 3])])

    def goal(self) -> Pose:
        """Return the end of the plan in the costmap's frame.

        Raises `ControlFailure` without a plan, and `TransformMissing` if the plan's frame cannot be transformed.
        """
        if not len(self.poses):
            raise ControlFailure("Received plan with zero length: there is no goal to drive to")
        x, y, theta = self.poses[-1].tolist()
        return compose(self._frame_pose(), (x, y, theta))

    def local(self, robot: Pose, *, prune: bool) -> Floats:
        """Return the part (n, 3) of the plan within the costmap's reach, in its frame; `prune` drops passed poses.

        Raises `ControlFailure` if no pose is within reach, and `TransformMissing` as `goal`.
        """
        if not len(self.poses):
            raise ControlFailure("Received plan with zero length: the local planner has nothing to follow")
        frame = self._frame_pose()
        here = compose(inverse(frame), robot)
        part = compose(frame, self.poses[slice_in_reach(self.poses, here, self.costmap.grid)])
        if prune and len(part):
            passed = passed_count(part, robot)
            part, self.poses = part[passed:], self.poses[passed:]
        if not len(part):
            size = self.costmap.grid.size_m
            away = float(np.hypot(*(self.poses[:, :2] - here[:2]).T).min()) if len(self.poses) else float("nan")
            raise ControlFailure(
                f"Received an empty transformed plan: its nearest pose is {away:.2f} m from the robot, out of "
                f"reach of the local costmap of {size[0]:.2f} m x {size[1]:.2f} m",
                distance=away,
            )
        return np.asarray(part)

    def _frame_pose(self) -> Pose:
        """Return the pose of the plan's frame in the costmap's frame."""
        if self.frame == self.costmap.global_frame:
            return 0.0, 0.0, 0.0
        try:
            found = self.buffer.tree.lookup(self.costmap.global_frame, self.frame)
        except TransformException as error:
            raise TransformMissing(
                f"Could not transform the global plan to the frame of the controller: {error}", frame=self.frame
            ) from error
        x, y, _, qx, qy, qz, qw = found.transform
        return x, y, float(np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz)))


class Publications:
    """The topics of a local planner, in its namespace; messages are created only if there are subscribers."""

    def __init__(self, node: Node, name: str, frame: str) -> None:
        path, cloud = message_class("nav_msgs/Path"), message_class("sensor_msgs/PointCloud2")
        self.node, self.frame = node, frame
        self.global_plan = node.publisher(f"~{name}/global_plan", path, queue_size=1)
        self.local_plan = node.publisher(f"~{name}/local_plan", path, queue_size=1)
        self.cost_cloud = node.publisher(f"~{name}/cost_cloud", cloud, queue_size=1)

    def path(self, publisher: Any, poses: Floats) -> None:
        """Publish poses (n, 3) as a `nav_msgs/Path`; as in ROS, an empty plan is not published."""
        if not len(poses) or not publisher.num_connections():
            return
        now = self.node.now()
        message = message_class("nav_msgs/Path")()
        message.header.frame_id, message.header.stamp = self.frame, now
        make = template(pose_stamped(self.frame, now, (0.0, 0.0, 0.0)), *_VARYING)
        message.poses = [make(x, y, math.sin(yaw / 2), math.cos(yaw / 2)) for x, y, yaw in poses.tolist()]
        publisher.publish(MessageFactory(lambda: message, is_frozen=True))

    def costs(self, grid: Any, path: MapGrid, goal: MapGrid, scales: tuple[float, float, float]) -> None:
        """Publish a cloud with each cell's distances to path and goal, its cost, and their sum weighted by `scales`.

        Cells in obstacles and unreachable cells are omitted.
        """
        if not self.cost_cloud.num_connections():
            return
        lost = (path.distances >= path.obstacle) | (grid.costs >= INSCRIBED_INFLATED_OBSTACLE)
        # Column by column, as in the original.
        mx, my = np.nonzero(~lost.T)
        parts = [each[my, mx].astype(np.float32) for each in (path.distances, goal.distances, grid.costs)]
        x = grid.origin[0] + (mx + 0.5) * grid.resolution
        y = grid.origin[1] + (my + 0.5) * grid.resolution
        total = sum(scale * part for scale, part in zip(scales, parts, strict=True))
        names = ("x", "y", "z", "path_cost", "goal_cost", "occ_cost", "total_cost")
        self._cloud(self.cost_cloud, names, np.column_stack([x, y, np.zeros(len(x)), *parts, total]))

    def trajectories(self, publisher: Any, samples: Samples) -> None:
        """Publish a cloud with the points and costs of all trajectories that were not rejected."""
        if not publisher.num_connections():
            return
        rows = [
            np.column_stack([points[:, :2], np.zeros(len(points)), points[:, 2], np.full(len(points), cost)])
            for points, cost in (
                (samples.trajectory(int(n)), samples.totals[n]) for n in np.flatnonzero(samples.accepted)
            )
        ]
        self._cloud(publisher, ("x", "y", "z", "theta", "cost"), np.vstack(rows) if rows else np.empty((0, 5)))

    def _cloud(self, publisher: Any, names: Sequence[str], rows: Floats) -> None:
        publisher.publish(point_cloud(self.frame, self.node.now(), names, rows))


class OdometryHelper:
    """Subscribes to `nav_msgs/Odometry`; `velocity` (3) is the latest one: x [m/s], y [m/s], theta [rad/s]."""

    def __init__(self, node: Node, topic: str = "odom") -> None:
        self.velocity: NDArray[np.float64] = np.zeros(3)
        self._warn = node.logwarn
        self._warned = False
        if topic:
            node.subscriber(topic, message_class("nav_msgs/Odometry"), self._on_odometry, queue_size=1)

    def _on_odometry(self, message: Any) -> None:
        twist = message.twist.twist
        values = (twist.linear.x, twist.linear.y, twist.angular.z)
        if all(map(math.isfinite, values)):
            self.velocity = np.array(values)
        elif not self._warned:
            self._warned = True
            self._warn(
                f"the odometry reports the velocity {values}, which is not finite: using the last finite one, without "
                "further warnings"
            )


# -- parameters --------------------------------------------------------------------------------------------------------


def sim_period(node: Node, label: str) -> float:
    """Return the time between two commands [s], from `controller_frequency` in a planner's or a parent namespace.

    `label` is the planner's namespace, with a slash at the end. Raises `ParameterError` if it is not a number.
    """
    for name in (label + "controller_frequency", "~controller_frequency"):
        if node.has_param(name):
            break
    else:
        name = node.search_param("controller_frequency") or ""
    frequency = node.get_param(name) if name else 20.0
    if isinstance(frequency, bool) or not isinstance(frequency, int | float):
        raise ParameterError(f"parameter {node.resolve_parameter(name)} is {frequency!r}; it must be a number [Hz]")
    if frequency <= 0:
        node.logwarn("A controller_frequency less than 0 has been set. Ignoring the parameter, assuming a rate of 20Hz")
        frequency = 20.0
    node.loginfo(f"Sim period is set to {1 / frequency:.2f}")
    return 1 / frequency


def rename(node: Node, label: str, old: str, new: str) -> None:
    """Copy the parameter `label` + `old` to its new name, with ROS's warning, unless the new one is set."""
    if not node.has_param(label + old):
        return
    if not node.has_param(label + new):
        node.logwarn(f"Parameter {old} is deprecated. Please use the name {new} instead.")
        node.set_param(label + new, node.get_param(label + old))


def no_command(text: str, samples: Samples) -> NoValidCommand:
    """Return the error for a cycle without a valid sample, with the number of samples that each critic rejected."""
    counts = samples.counts()
    listed = [f"{name} rejected {count}" for name, count in counts.items() if name != "generator"]
    tried = len(samples) + samples.refused
    if samples.refused:
        number = str(samples.refused) if len(samples) else "all"
        listed += [f"{number} are slower than the minimum velocities of the robot, or faster than the maximum"]
    return NoValidCommand(f"{text}: of {tried} sampled velocities, {', '.join(listed)}", sampled=tried, rejected=counts)


def twist(command: Floats) -> Any:
    """Return a velocity (3) as a `geometry_msgs/Twist`."""
    message = message_class("geometry_msgs/Twist")()
    message.linear.x, message.linear.y, message.angular.z = (float(value) for value in command)
    return message
