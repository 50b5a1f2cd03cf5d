"""`dwa_local_planner/DWAPlannerROS`: parameters, topics and odometry for `DWAPlanner`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.geometry.poses import Pose
from rosmini.core.parameters import parameter
from rosmini.core.tf import Buffer
from rosmini.msgs import message_class
from rosmini.navigation.base_local_planner.following import (
    Following,
    OdometryHelper,
    Publications,
    no_command,
    sim_period,
    twist,
)
from rosmini.navigation.base_local_planner.latched_stop_rotate import LatchedStopRotate
from rosmini.navigation.base_local_planner.trajectory import Samples
from rosmini.navigation.nav_core import BaseLocalPlanner, planar_pose

from .dwa_planner import DWAPlanner, DWAPlannerParameters

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class DWAPlannerSettings(DWAPlannerParameters):
    """All parameters of `dwa_local_planner/DWAPlannerROS`, including those that are read only once."""

    controller_frequency: float | None = parameter(
        None, "rate at which commands are computed; by default that of move_base", unit="Hz"
    )
    latch_xy_goal_tolerance: bool = parameter(False, "having reached the goal's position once is sufficient")
    odom_topic: str = parameter("odom", "the topic of the odometry")
    publish_traj_pc: bool = parameter(False, "publish the trajectories")
    publish_cost_grid_pc: bool = parameter(False, "publish the cost of each cell")
    cheat_factor: float = parameter(
        1.0,
        "alignment is scored where the squared distance to the goal exceeds this times forward_point_distance squared",
    )
    global_frame_id: str = parameter("odom", "not used: clouds are in the costmap's frame")


class DWAPlannerROS(BaseLocalPlanner, plugin="dwa_local_planner/DWAPlannerROS"):
    """The local planner of `dwa_local_planner` as a plugin: follows a plan with the Dynamic Window Approach."""

    samples: Samples | None = None
    """The trajectories of the last cycle, or None before the first."""

    def initialize(self, name: str, buffer: Buffer, costmap: Any) -> None:
        """Read the parameters, advertise the topics, and subscribe to the odometry."""
        super().initialize(name, buffer, costmap)
        self.node, label = costmap.node, f"~{name}/"
        settings = DWAPlannerSettings.read(self.node, label)
        self._settings = settings
        self.publications = Publications(self.node, name, costmap.global_frame)
        self._cloud = self.node.publisher(
            f"{label}trajectory_cloud", message_class("sensor_msgs/PointCloud2"), queue_size=1
        )
        self.following = Following(buffer, costmap)
        self.planner = DWAPlanner(_dynamic(settings), sim_period(self.node, label), settings.cheat_factor)
        # In ROS this controller has no name, and reads the parameter from the node's private namespace.
        latch = bool(self.node.get_param("~latch_xy_goal_tolerance", False)) or settings.latch_xy_goal_tolerance
        self.latch = LatchedStopRotate(latch)
        self.odometry = OdometryHelper(self.node, settings.odom_topic)
        self._initial_config: dict[str, Any] | None = None
        self._server = Server(self.node, DWAPlannerParameters, self._reconfigure, namespace=label)

    def _reconfigure(self, config: Any, _: int) -> Any:
        names = [each.name for each in fields(DWAPlannerParameters)]
        if self._initial_config is None:
            self._initial_config = {name: config[name] for name in names}
        elif config["restore_defaults"]:
            config.update({**self._initial_config, "restore_defaults": False})
        self.planner.reconfigure(DWAPlannerParameters(**{name: config[name] for name in names}))
        return config

    @property
    def parameters(self) -> DWAPlannerParameters:
        """The current parameters."""
        return self.planner.parameters

    # -- the interface -------------------------------------------------------------------------------------------

    def set_plan(self, plan: Sequence[Any]) -> None:
        """Follow this plan, a sequence of `geometry_msgs/PoseStamped`, from now on."""
        self.latch.reset()
        self.node.loginfo("Got new plan")
        self.planner.oscillation.reset()
        self.following.set_plan(plan)

    def is_goal_reached(self) -> bool:
        """Return whether the robot has reached the end of the plan and its heading, and has stopped."""
        pose = planar_pose(self.costmap.robot_pose())
        if not self.latch.is_goal_reached(pose, self.odometry.velocity, self.following.goal(), self.parameters):
            return False
        self.node.loginfo("Goal reached")
        return True

    def compute_velocity_commands(self) -> Any:
        """Return the next `geometry_msgs/Twist`: follow the plan or, at its end, stop and turn to the heading.

        Raises `NoValidCommand` if all trajectories are rejected, `ControlFailure` if the plan is out of reach or the
        final rotation would collide, and `TransformMissing` if a transform is missing.
        """
        pose = planar_pose(self.costmap.robot_pose())
        plan = self.following.local(pose, prune=self.parameters.prune_plan)
        # The map grids are also needed at the goal, to check turns.
        if not self.planner.update_plan(self.costmap.grid, pose, plan, self.costmap.footprint):
            self.node.logerr(
                "None of the points of the global plan were in the local costmap, global plan points too far from robot"
            )
        if self.latch.is_position_reached(pose, self.following.goal(), self.parameters):
            return twist(self._at_goal(pose))
        return twist(self._drive(pose, plan))

    def _at_goal(self, pose: Pose) -> Floats:
        return self.latch.command(
            pose,
            self.odometry.velocity,
            self.following.goal(),
            self.parameters,
            self.planner.sim_period,
            lambda command: self.planner.why_not(self.costmap.grid, pose, self.odometry.velocity, command),
        )

    def _drive(self, pose: Pose, plan: Floats) -> Floats:
        samples = self.planner.find_best(self.costmap.grid, pose, self.odometry.velocity)
        self.samples = samples
        if self._settings.publish_traj_pc:
            self.publications.trajectories(self._cloud, samples)
        if self._settings.publish_cost_grid_pc and self.planner.grids is not None:
            path, goal, _ = self.planner.grids
            scales = self.planner.scales(self.costmap.grid.resolution)
            self.publications.costs(self.costmap.grid, path, goal, (scales[4], scales[5], scales[1]))
        if samples.best is None:
            self.node.logwarn("DWA planner failed to produce path.")
            raise no_command("DWA planner failed to produce path", samples)
        self.publications.path(self.publications.local_plan, samples.trajectory(samples.best))
        self.publications.path(self.publications.global_plan, plan)
        command: Floats = samples.commands[samples.best]
        return command


def _dynamic(settings: DWAPlannerSettings) -> DWAPlannerParameters:
    return DWAPlannerParameters(**{each.name: getattr(settings, each.name) for each in fields(DWAPlannerParameters)})
