"""The planner of dwa_local_planner: samples, critics, and the state kept between cycles."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.core.parameters import parameter
from rosmini.navigation.base_local_planner.limits import LocalPlannerLimits
from rosmini.navigation.base_local_planner.map_grid import MapGrid, grid_from, plan_cells
from rosmini.navigation.base_local_planner.scored_sampling import (
    Oscillation,
    Sampling,
    combined_scores,
    footprint_scales,
    roll_out,
    twirling,
)
from rosmini.navigation.base_local_planner.trajectory import Samples
from rosmini.navigation.costmap_2d.costmap import Costmap2D

Floats = NDArray[np.float64]

CRITICS = ("oscillation", "obstacle", "goal_front", "alignment", "path", "goal", "twirling")
"""The critics in the order in which `DWAPlanner` applies them."""


@dataclass(frozen=True)
class DWAPlannerParameters(LocalPlannerLimits):
    """The parameters of `dwa_local_planner/DWAPlannerROS` that can change at run time."""

    dynamic = True

    sim_time: float = parameter(1.7, "the duration of simulated trajectories", unit="s", minimum=0.0)
    sim_granularity: float = parameter(0.025, "distance between two points of a trajectory", unit="m", minimum=0.0)
    angular_sim_granularity: float = parameter(
        0.1, "angle between the headings of two points of a trajectory", unit="rad", minimum=0.0
    )
    path_distance_bias: float = parameter(32.0, "weight of the distance to the plan", minimum=0.0)
    goal_distance_bias: float = parameter(24.0, "weight of the distance to the local goal", minimum=0.0)
    occdist_scale: float = parameter(0.01, "weight of the costs under the footprint", minimum=0.0)
    twirling_scale: float = parameter(0.0, "weight of turning", minimum=0.0)
    stop_time_buffer: float = parameter(0.2, "not used, as in ROS", unit="s", minimum=0.0)
    oscillation_reset_dist: float = parameter(
        0.05, "distance after which the robot may reverse its direction again", unit="m", minimum=0.0
    )
    oscillation_reset_angle: float = parameter(
        0.2, "turn after which the robot may turn back again", unit="rad", minimum=0.0
    )
    forward_point_distance: float = parameter(
        0.325, "distance from the centre to the nose, which should be on the plan", unit="m"
    )
    scaling_speed: float = parameter(0.25, "the footprint grows above this speed", unit="m/s", minimum=0.0)
    max_scaling_factor: float = parameter(0.2, "maximum growth, as a fraction of the footprint", minimum=0.0)
    vx_samples: int = parameter(3, "number of forward velocities to sample", minimum=1)
    vy_samples: int = parameter(10, "number of sideways velocities to sample", minimum=1)
    vth_samples: int = parameter(20, "number of turning speeds to sample", minimum=1)
    use_dwa: bool = parameter(True, "try only velocities within reach of one cycle, not of sim_time")
    restore_defaults: bool = parameter(False, "reset all parameters to their initial values")

    def sampling(self, sim_period: float) -> Sampling:
        """Return the sampling parameters; `sim_period` [s] is the time between two commands."""
        return Sampling(
            self.sim_time,
            self.sim_granularity,
            self.angular_sim_granularity,
            self.use_dwa,
            sim_period,
            (self.vx_samples, self.vy_samples, self.vth_samples),
        )


class DWAPlanner:
    """Chooses the velocity of each control cycle; call `reconfigure` to change the parameters between two cycles."""

    def __init__(self, parameters: DWAPlannerParameters, sim_period: float = 0.05, cheat_factor: float = 1.0) -> None:
        self.sim_period = sim_period
        self.cheat_factor = cheat_factor
        self.oscillation = Oscillation()
        self.plan: Floats = np.empty((0, 3))
        self.footprint: Floats = np.empty((0, 2))
        self.grids: tuple[MapGrid, MapGrid, MapGrid] | None = None
        self._nose = True
        self.reconfigure(parameters)

    def reconfigure(self, parameters: DWAPlannerParameters) -> None:
        """Set the parameters. Raises `ParameterError` for values that give no valid trajectories."""
        self.sampling = parameters.sampling(self.sim_period)
        self.parameters = parameters
        self.oscillation.reset_distance = parameters.oscillation_reset_dist
        self.oscillation.reset_angle = parameters.oscillation_reset_angle

    def update_plan(self, grid: Costmap2D, pose: Pose, plan: Floats, footprint: Floats) -> bool:
        """Set the plan (n, 3), in the costmap's frame, and the footprint (n, 2), in the base frame.

        Returns True if any part of the plan is on known cells of the costmap.
        """
        shift = self.parameters.forward_point_distance
        self.plan, self.footprint = plan, footprint
        x, y = plan[-1, 0] - pose[0], plan[-1, 1] - pose[1]
        ahead = plan.copy()
        # The nose's target lies beyond the end; otherwise a robot that has to turn round there would keep moving.
        towards = math.atan2(y, x)
        ahead[-1, :2] += shift * math.cos(towards), shift * math.sin(towards)
        # Near the goal the nose need not stay on the plan.
        self._nose = x * x + y * y > shift * shift * self.cheat_factor
        cells = plan_cells(grid, plan)
        end, front = cells[-1:], plan_cells(grid, ahead)[-1:]
        goal = grid_from(grid, end)
        # If the plan leaves the costmap before its end, both are the same.
        same = np.array_equal(end, front)
        self.grids = (grid_from(grid, cells), goal, goal if same else grid_from(grid, front))
        return len(cells) > 0

    def scales(self, resolution: float) -> Floats:
        """Return the critics' weights (k); `resolution` [m] converts the weights per metre to weights per cell."""
        p = self.parameters
        path, goal = resolution * p.path_distance_bias, resolution * p.goal_distance_bias
        return np.array([1.0, p.occdist_scale, goal, path if self._nose else 0.0, path, goal, p.twirling_scale])

    def find_best(self, grid: Costmap2D, pose: Pose, velocity: Floats) -> Samples:
        """Return scored samples around `velocity` (3), with the cheapest one chosen.

        The choice is recorded for the oscillation critic. `best` is None if all samples are rejected.
        """
        p = self.parameters
        goal = (float(self.plan[-1, 0]), float(self.plan[-1, 1]), float(self.plan[-1, 2]))
        velocities = self.sampling.velocities(pose, velocity, goal, p)
        steps = self.sampling.steps(velocities, p)
        driven = steps > 0
        samples = self._scored(grid, pose, velocity, velocities[driven], steps[driven], int((~driven).sum()))
        if samples.best is not None:
            self.oscillation.update(pose, samples.commands[samples.best], p.min_vel_trans)
        return samples

    def driven(self, grid: Costmap2D, pose: Pose, velocity: Floats, velocities: Floats) -> Samples:
        """Return scored samples of given velocities (n, 3), starting at `velocity` (3), without recording any."""
        return self._scored(grid, pose, velocity, velocities, self.sampling.steps(velocities, self.parameters), 0)

    def why_not(self, grid: Costmap2D, pose: Pose, velocity: Floats, command: Floats) -> str:
        """Return the reason why a critic rejects a command (3), or an empty text.

        As in `checkTrajectory` of ROS, this resets the oscillation critic, so going back is allowed.
        """
        self.oscillation.reset()
        return self.driven(grid, pose, velocity, command[None, :]).reason(0)

    def _scored(
        self, grid: Costmap2D, pose: Pose, velocity: Floats, velocities: Floats, steps: NDArray[np.int64], refused: int
    ) -> Samples:
        if self.grids is None:
            raise RuntimeError("there is no plan: call update_plan first")
        p = self.parameters
        commands = self.sampling.starts(velocities, velocity, steps, p)
        sizes = footprint_scales(commands, p.max_vel_trans, p.max_scaling_factor, p.scaling_speed)
        found = roll_out(
            grid,
            self.grids,
            pose,
            (commands, velocities, p.accelerations),
            self.sampling.sim_time,
            steps,
            self.footprint,
            sizes,
            p.forward_point_distance,
        )
        count = len(velocities)
        raw = np.column_stack([self.oscillation.score(commands), found.raw, twirling(commands)])
        nowhere = np.full((count, 1), -1)
        scales = self.scales(grid.resolution)
        totals, rejected_by = combined_scores(raw, scales)
        best = None
        if (rejected_by < 0).any():
            best = int(np.argmin(np.where(rejected_by < 0, totals, np.inf)))
        return Samples(
            CRITICS,
            scales,
            velocities,
            commands,
            found.points,
            found.lengths,
            raw,
            np.hstack([nowhere, found.where, nowhere]),
            totals,
            rejected_by,
            best,
            refused,
            pose,
        )
