"""`base_local_planner/TrajectoryPlannerROS`: parameters, topics and odometry for `TrajectoryPlanner`."""

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
from rosmini.navigation.nav_core import BaseLocalPlanner, planar_pose

from .following import Following, OdometryHelper, Publications, no_command, rename, sim_period, twist
from .goal_functions import turn_to_goal
from .latched_stop_rotate import LatchedStopRotate
from .limits import LocalPlannerLimits
from .trajectory import Samples
from .trajectory_planner import TrajectoryPlanner, TrajectoryPlannerParameters

Floats = NDArray[np.float64]

STOPPED_SPEED = 1e-2
"""Up to this speed [m/s] and turning speed [rad/s] the robot counts as stopped."""

RENAMED = {
    "acc_lim_th": "acc_lim_theta",
    "max_rotational_vel": "max_vel_theta",
    "min_in_place_rotational_vel": "min_in_place_vel_theta",
    "pdist_scale": "path_distance_bias",
    "gdist_scale": "goal_distance_bias",
}
"""Names from earlier releases, which are still accepted."""


@dataclass(frozen=True)
class TrajectoryPlannerSettings(TrajectoryPlannerParameters):
    """All parameters of `base_local_planner/TrajectoryPlannerROS`, including those that are read only once."""

    controller_frequency: float | None = parameter(
        None, "rate at which commands are computed; by default that of move_base", unit="Hz"
    )
    prune_plan: bool = parameter(True, "drop the part of the plan more than 1 m behind the robot")
    yaw_goal_tolerance: float = parameter(0.05, "tolerance of the heading at the goal", unit="rad")
    xy_goal_tolerance: float = parameter(0.1, "tolerance of the position at the goal", unit="m")
    latch_xy_goal_tolerance: bool = parameter(False, "having reached the goal's position once is sufficient")
    stop_time_buffer: float = parameter(0.2, "not used, as in ROS", unit="s")
    meter_scoring: bool = parameter(False, "weigh distances in metres instead of cells")
    world_model: str = parameter("costmap", "the model of the world", choices=("costmap",))
    publish_cost_grid_pc: bool = parameter(False, "publish the cost of each cell")
    global_frame_id: str = parameter("odom", "not used: clouds are in the costmap's frame")
    odom_topic: str = parameter("odom", "the topic of the odometry")

    allowed = tuple(RENAMED)


class TrajectoryPlannerROS(BaseLocalPlanner, plugin="base_local_planner/TrajectoryPlannerROS"):
    """The local planner of `base_local_planner` as a plugin: follows a plan by simulating trajectories."""

    samples: Samples | None = None
    """The trajectories of the last cycle, or None before the first."""

    def initialize(self, name: str, buffer: Buffer, costmap: Any) -> None:
        """Read the parameters, advertise the topics, and subscribe to the odometry."""
        super().initialize(name, buffer, costmap)
        self.node, label = costmap.node, f"~{name}/"
        for old, new in RENAMED.items():
            rename(self.node, label, old, new)
        settings = TrajectoryPlannerSettings.read(self.node, label)
        self._settings = settings
        self.publications = Publications(self.node, name, costmap.global_frame)
        self.following = Following(buffer, costmap)
        dynamic = {each.name: getattr(settings, each.name) for each in fields(TrajectoryPlannerParameters)}
        self.planner = TrajectoryPlanner(
            TrajectoryPlannerParameters(**dynamic), sim_period(self.node, label), meter_scoring=settings.meter_scoring
        )
        self.odometry = OdometryHelper(self.node, settings.odom_topic)
        self.latch = LatchedStopRotate(settings.latch_xy_goal_tolerance)
        self._reached = False
        self._initial_config: dict[str, Any] | None = None
        self._server = Server(self.node, TrajectoryPlannerParameters, self._reconfigure, namespace=label)

    def _reconfigure(self, config: Any, _: int) -> Any:
        names = [each.name for each in fields(TrajectoryPlannerParameters)]
        if self._initial_config is None:
            self._initial_config = {name: config[name] for name in names}
        elif config["restore_defaults"]:
            config.update({**self._initial_config, "restore_defaults": False})
        self.planner.reconfigure(TrajectoryPlannerParameters(**{name: config[name] for name in names}))
        self._reached = False
        return config

    @property
    def parameters(self) -> TrajectoryPlannerParameters:
        """The current parameters."""
        return self.planner.parameters

    # -- the interface -------------------------------------------------------------------------------------------

    def set_plan(self, plan: Sequence[Any]) -> None:
        """Follow this plan, a sequence of `geometry_msgs/PoseStamped`, from now on."""
        self.following.set_plan(plan)
        self.latch.reset()
        self._reached = False

    def is_goal_reached(self) -> bool:
        """Return whether the robot has reached the end of the plan and its heading."""
        return self._reached

    def compute_velocity_commands(self) -> Any:
        """Return the next `geometry_msgs/Twist`: follow the plan or, at its end, stop and turn to the heading.

        Raises `NoValidCommand` if all trajectories are rejected, `ControlFailure` if the plan is out of reach or the
        final rotation would collide, and `TransformMissing` if a transform is missing.
        """
        pose = planar_pose(self.costmap.robot_pose())
        plan = self.following.local(pose, prune=self._settings.prune_plan)
        goal = (float(plan[-1, 0]), float(plan[-1, 1]), float(plan[-1, 2]))
        if self.latch.is_position_reached(pose, goal, self._limits()):
            command = self._at_goal(pose, goal, plan)
            self.publications.path(self.publications.global_plan, plan)
            return twist(command)
        samples = self._sample(pose, plan)
        if samples.best is None:
            self.publications.path(self.publications.global_plan, plan)
            raise no_command("The rollout planner failed to find a valid plan", samples)
        self.publications.path(self.publications.global_plan, plan)
        self.publications.path(self.publications.local_plan, samples.trajectory(samples.best))
        return twist(samples.commands[samples.best])

    def _sample(self, pose: Pose, plan: Floats) -> Samples:
        grid = self.costmap.grid
        if not self.planner.update_plan(grid, pose, plan, self.costmap.footprint):
            self.node.logerr(
                "None of the points of the global plan were in the local costmap, global plan points too far from robot"
            )
        self.samples = samples = self.planner.find_best(grid, pose, self.odometry.velocity)
        if self._settings.publish_cost_grid_pc and self.planner.path and self.planner.goal:
            occupied, path, goal = (float(scale) for scale in samples.scales[:3])
            self.publications.costs(grid, self.planner.path, self.planner.goal, (path, goal, occupied))
        return samples

    def _at_goal(self, pose: Pose, goal: Pose, plan: Floats) -> Floats:
        if abs(turn_to_goal(pose, goal)) <= self._settings.yaw_goal_tolerance:
            self.latch.reset()
            self._reached = True
        else:
            # Update the distances that the check of the command uses.
            self._sample(pose, plan)
        return self.latch.command(
            pose,
            self.odometry.velocity,
            goal,
            self._limits(),
            self.planner.sim_period,
            lambda command: self._why_not(pose, command),
        )

    def _limits(self) -> LocalPlannerLimits:
        """Return the parameters in the form that `LatchedStopRotate` takes."""
        p, own = self.parameters, self._settings
        return LocalPlannerLimits(
            max_vel_theta=p.max_vel_theta,
            min_vel_theta=p.min_in_place_vel_theta,
            acc_lim_x=p.acc_lim_x,
            acc_lim_y=p.acc_lim_y,
            acc_lim_theta=p.acc_lim_theta,
            xy_goal_tolerance=own.xy_goal_tolerance,
            yaw_goal_tolerance=own.yaw_goal_tolerance,
            trans_stopped_vel=STOPPED_SPEED,
            theta_stopped_vel=STOPPED_SPEED,
        )

    def _why_not(self, pose: Pose, command: Floats) -> str:
        return self.planner.driven(self.costmap.grid, pose, self.odometry.velocity, command[None, :]).reason(0)
