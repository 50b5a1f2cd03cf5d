"""The planner of base_local_planner: Trajectory Rollout, or with `dwa` an older form of the Dynamic Window Approach.

Gerkey and Konolige, "Planning and Control in Unstructured Terrain" (2008). It samples forward velocities, turns on the
spot and, for a holonomic robot, sideways steps; if none is possible, it backs up until the robot is free.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.angles import shortest_angular_distance
from rosmini.core.geometry.poses import Pose
from rosmini.core.parameters import Parameters, parameter
from rosmini.navigation.costmap_2d.costmap import Costmap2D

from .costmap_model import footprint_cells
from .map_grid import MapGrid, grid_from, plan_cells
from .scored_sampling import roll_out
from .trajectory import Samples, concatenated

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CRITICS = ("obstacle", "path", "goal")
COLLISION_COST = -1.0
"""The cost of a trajectory whose footprint touches an obstacle."""
UNREACHABLE_COST = -2.0
"""The cost of a trajectory that ends where no path leads to the plan."""
STRAFE = 0.1
"""A holonomic robot also tries this velocity ahead combined with the same velocity to either side [m/s]."""


@dataclass(frozen=True)
class TrajectoryPlannerParameters(Parameters):
    """The parameters of `base_local_planner/TrajectoryPlannerROS` that can change at run time."""

    dynamic = True

    acc_lim_x: float = parameter(2.5, "acceleration ahead", unit="m/s2", minimum=0.0, maximum=20.0)
    acc_lim_y: float = parameter(2.5, "acceleration to the side", unit="m/s2", minimum=0.0, maximum=20.0)
    acc_lim_theta: float = parameter(3.2, "acceleration of turns", unit="rad/s2", minimum=0.0, maximum=20.0)
    max_vel_x: float = parameter(0.55, "the highest velocity ahead", unit="m/s", minimum=0.0, maximum=20.0)
    min_vel_x: float = parameter(0.0, "the lowest velocity ahead", unit="m/s", minimum=0.0, maximum=20.0)
    max_vel_theta: float = parameter(1.0, "the fastest turn", unit="rad/s", minimum=0.0, maximum=20.0)
    min_vel_theta: float = parameter(-1.0, "the fastest turn to the right", unit="rad/s", minimum=-20.0, maximum=0.0)
    min_in_place_vel_theta: float = parameter(
        0.4, "the slowest turn on the spot", unit="rad/s", minimum=0.0, maximum=20.0
    )
    sim_time: float = parameter(1.7, "the duration of simulated trajectories", unit="s", minimum=0.0, maximum=10.0)
    sim_granularity: float = parameter(
        0.025, "distance between two points of a trajectory", unit="m", minimum=0.0, maximum=5.0
    )
    angular_sim_granularity: float = parameter(
        0.025, "angle between the headings of two points", unit="rad", minimum=0.0, maximum=math.pi / 2
    )
    path_distance_bias: float = parameter(0.6, "weight of the distance to the plan", minimum=0.0, maximum=5.0)
    goal_distance_bias: float = parameter(0.8, "weight of the distance to the local goal", minimum=0.0, maximum=5.0)
    occdist_scale: float = parameter(0.01, "weight of the costs under the footprint", minimum=0.0, maximum=5.0)
    oscillation_reset_dist: float = parameter(
        0.05, "distance after which the robot may turn in the other direction again", unit="m", minimum=0.0, maximum=5.0
    )
    escape_reset_dist: float = parameter(
        0.1, "distance after which the robot counts as having escaped", unit="m", minimum=0.0, maximum=5.0
    )
    escape_reset_theta: float = parameter(
        math.pi / 4, "turn after which the robot counts as having escaped", unit="rad", minimum=0.0, maximum=5.0
    )
    vx_samples: int = parameter(20, "number of forward velocities to sample", minimum=1, maximum=300)
    vtheta_samples: int = parameter(20, "number of turning speeds to sample", minimum=1, maximum=300)
    heading_lookahead: float = parameter(
        0.325, "distance ahead at which a turn on the spot is scored", unit="m", minimum=0.0, maximum=5.0
    )
    holonomic_robot: bool = parameter(True, "whether the robot can move sideways")
    escape_vel: float = parameter(-0.1, "the velocity of backing up", unit="m/s", minimum=-2.0, maximum=2.0)
    dwa: bool = parameter(False, "try only velocities within reach of one cycle, not of sim_time")
    y_vels: str = parameter("-0.3,-0.1,0.1,-0.3", "sideways velocities to try if nothing else is possible")
    restore_defaults: bool = parameter(False, "reset all parameters to their initial values")

    @property
    def accelerations(self) -> Floats:
        """Maximum accelerations in x, y and theta (3) [m/s2, m/s2, rad/s2]."""
        return np.array([self.acc_lim_x, self.acc_lim_y, self.acc_lim_theta])

    def sideways(self) -> list[float]:
        """Return `y_vels` as numbers [m/s]. Raises `ParameterError` if the text is not a list of numbers."""
        try:
            return [float(word) for word in self.y_vels.replace(",", " ").strip(" []").split()]
        except ValueError:
            raise ParameterError(
                f"y_vels is {self.y_vels!r}: it must be numbers [m/s] separated by commas, such as -0.3,0.3"
            ) from None


@dataclass
class Turning:
    """The directions in which the robot has turned or stepped on the spot since it last moved on.

    A robot that has turned right twice may not turn left until it has moved on, and vice versa.
    """

    right: bool = False
    left: bool = False
    stuck_right: bool = False
    stuck_left: bool = False

    def record(self, velocity: float) -> None:
        """Record a velocity to the left (positive) or to the right (negative)."""
        if velocity < 0:
            self.right, self.stuck_right = True, self.stuck_right or self.right
        elif velocity > 0:
            self.left, self.stuck_left = True, self.stuck_left or self.left


class TrajectoryPlanner:
    """Chooses the velocity of each control cycle; call `reconfigure` to change the parameters between two cycles."""

    def __init__(
        self, parameters: TrajectoryPlannerParameters, sim_period: float = 0.05, *, meter_scoring: bool = False
    ) -> None:
        self.sim_period = sim_period
        self.meter_scoring = meter_scoring
        self.plan: Floats = np.empty((0, 3))
        self.footprint: Floats = np.empty((0, 2))
        self.path: MapGrid | None = None
        self.goal: MapGrid | None = None
        self.turning, self.strafing = Turning(), Turning()
        self.escaping = False
        self._turned_at = (0.0, 0.0)
        self._escaped_from: Pose = (0.0, 0.0, 0.0)
        self.reconfigure(parameters)

    def reconfigure(self, parameters: TrajectoryPlannerParameters) -> None:
        """Set the parameters. Raises `ParameterError` for values that give no valid trajectories."""
        for name in ("sim_granularity", "angular_sim_granularity", "sim_time"):
            if getattr(parameters, name) <= 0:
                raise ParameterError(
                    f"{name} is {getattr(parameters, name):g}: it must be greater than 0, because trajectories without "
                    "length or with infinitely many points cannot be scored"
                )
        self.sideways = parameters.sideways()
        self.parameters = parameters

    def update_plan(self, grid: Costmap2D, pose: Pose, plan: Floats, footprint: Floats) -> bool:
        """Set the plan (n, 3), in the costmap's frame, and the footprint (n, 2), in the base frame.

        Returns True if any part of the plan is on known cells of the costmap.
        """
        self.plan, self.footprint = plan, footprint
        here = footprint_cells(grid, pose, footprint, fill=True)
        cells = plan_cells(grid, plan)
        self.path = grid_from(grid, cells, np.array(here, dtype=np.int64).reshape(-1, 2))
        self.goal = grid_from(grid, cells[-1:])
        return len(cells) > 0

    # -- one cycle -----------------------------------------------------------------------------------------------

    def find_best(self, grid: Costmap2D, pose: Pose, velocity: Floats) -> Samples:
        """Return scored samples around `velocity` (3), with the best one chosen, and record its direction.

        This is `createTrajectories` of ROS. `best` is None only if backing up is impossible as well, because no path
        leads to the plan.
        """
        low, high = self.window(pose, velocity)
        turns = evenly(low[1], high[1], self.parameters.vtheta_samples)
        speeds = evenly(low[0], high[0], self.parameters.vx_samples)
        ahead = np.empty((0, 3)) if self.escaping else self._ahead(speeds, turns)
        least = self.parameters.min_in_place_vel_theta
        spot = np.zeros((len(turns), 3))
        spot[:, 2] = np.where(turns > 0, np.maximum(turns, least), np.minimum(turns, -least))
        samples = self._scored(grid, pose, velocity, np.vstack([ahead, spot]))
        step = float(turns[1] - turns[0]) if len(turns) > 1 else math.inf
        best, open_space = self._best_of(grid, samples, len(ahead), turns, step)
        if best is None and self.parameters.holonomic_robot:
            aside = np.zeros((len(self.sideways), 3))
            aside[:, 1] = self.sideways
            more = self._scored(grid, pose, velocity, aside)
            best = self._best_aside(grid, samples, more, open_space)
            samples = concatenated(samples, more)
        if best is None:
            back = np.array([[self.parameters.escape_vel, 0.0, 0.0]])
            return self._escape(pose, samples, self._scored(grid, pose, velocity, back))
        command = samples.commands[best]
        if not command[0] > 0:
            if command[2] != 0:
                self.turning.record(command[2])
            else:
                self.strafing.record(-command[1])
            self._turned_at = pose[:2]
        self._forget(pose)
        return replace(samples, best=best)

    def driven(self, grid: Costmap2D, pose: Pose, velocity: Floats, velocities: Floats) -> Samples:
        """Return scored samples of given velocities (n, 3), starting at `velocity` (3); none is chosen or recorded."""
        return self._scored(grid, pose, velocity, velocities)

    def window(self, pose: Pose, velocity: Floats) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the lowest and the highest velocities to try, each as (ahead [m/s], turn [rad/s]).

        `velocity` (3,) is the robot's current velocity.
        """
        p = self.parameters
        span = self.sim_period if p.dwa else p.sim_time
        fastest = p.max_vel_x
        if len(self.plan):
            fastest = min(fastest, math.dist(self.plan[-1, :2], pose[:2]) / p.sim_time)
        high = max(min(fastest, velocity[0] + p.acc_lim_x * span), p.min_vel_x)
        low = max(p.min_vel_x, velocity[0] - p.acc_lim_x * span)
        left = min(p.max_vel_theta, velocity[2] + p.acc_lim_theta * span)
        right = max(p.min_vel_theta, velocity[2] - p.acc_lim_theta * span)
        return (low, right), (high, left)

    def _ahead(self, speeds: Floats, turns: Floats) -> Floats:
        """Return forward commands (n, 3): each speed with no turn, and with all turns but the last.

        For a holonomic robot two diagonal commands are added.
        """
        angles = np.concatenate([[0.0], turns[:-1]])
        grid = np.stack(np.meshgrid(speeds, [0.0], angles, indexing="ij"), axis=-1).reshape(-1, 3)
        if not self.parameters.holonomic_robot:
            return grid
        return np.vstack([grid, [[STRAFE, STRAFE, 0.0], [STRAFE, -STRAFE, 0.0]]])

    def _best_of(
        self, grid: Costmap2D, samples: Samples, ahead: int, turns: Floats, step: float
    ) -> tuple[int | None, float]:
        """Return the best forward sample or turn on the spot, and the goal distance [cells] ahead of the chosen turn.

        The index is None if all are rejected, the distance inf without a turn. Turns towards open space are preferred.
        """
        best = _cheapest(samples, ahead)
        nearest = math.inf
        for i, turn in enumerate(turns, start=ahead):
            if not samples.accepted[i] or -step <= turn <= step:
                continue
            if best is not None and samples.totals[i] > samples.totals[best] and samples.commands[best, 1] == 0:
                continue
            distance = self._distance_ahead(grid, samples.trajectory(i)[-1])
            allowed = not (self.turning.stuck_left if turn < 0 else self.turning.stuck_right)
            if distance < nearest and allowed:
                best, nearest = i, distance
        return best, nearest

    def _best_aside(self, grid: Costmap2D, first: Samples, more: Samples, nearest: float) -> int | None:
        best = None
        for i, speed in enumerate(self.sideways):
            if not more.accepted[i] or (best is not None and more.totals[i] > more.totals[best]):
                continue
            distance = self._distance_ahead(grid, more.trajectory(i)[-1])
            allowed = not (self.strafing.stuck_left if speed > 0 else self.strafing.stuck_right)
            if distance < nearest and allowed and speed != 0:
                best, nearest = i, distance
        return None if best is None else len(first) + best

    def _distance_ahead(self, grid: Costmap2D, end: Floats) -> float:
        """Return the goal distance [cells] `heading_lookahead` [m] ahead of a trajectory's end; inf off the costmap."""
        reach = self.parameters.heading_lookahead
        cell = grid.world_to_map(end[0] + reach * math.cos(end[2]), end[1] + reach * math.sin(end[2]))
        return math.inf if cell is None or self.goal is None else float(self.goal.distances[cell[1], cell[0]])

    def _escape(self, pose: Pose, samples: Samples, back: Samples) -> Samples:
        """Back up, even into an obstacle, unless no path leads to the plan."""
        cost = float(back.totals[0])
        self._forget_turns(pose)
        if not self.escaping and cost > UNREACHABLE_COST:
            self._escaped_from, self.escaping = pose, True
        self._forget_escape(pose)
        if cost == COLLISION_COST:
            back = replace(back, totals=np.ones(1), rejected_by=np.full(1, -1))
        return concatenated(samples, back, best=len(samples) if back.totals[0] >= 0 else None)

    def _forget(self, pose: Pose) -> None:
        self._forget_turns(pose)
        self._forget_escape(pose)

    def _forget_turns(self, pose: Pose) -> None:
        if math.dist(pose[:2], self._turned_at) > self.parameters.oscillation_reset_dist:
            self.turning, self.strafing = Turning(), Turning()

    def _forget_escape(self, pose: Pose) -> None:
        far = math.dist(pose[:2], self._escaped_from[:2]) > self.parameters.escape_reset_dist
        turn = abs(shortest_angular_distance(self._escaped_from[2], pose[2]))
        if far or turn > self.parameters.escape_reset_theta:
            self.escaping = False

    # -- scoring -------------------------------------------------------------------------------------------------

    def _steps(self, velocities: Floats) -> Ints:
        p = self.parameters
        speeds, turns = np.hypot(velocities[:, 0], velocities[:, 1]), np.abs(velocities[:, 2])
        # As in ROS, a turn is not multiplied by the time.
        steps = np.maximum(speeds * p.sim_time / p.sim_granularity, turns / p.angular_sim_granularity) + 0.5
        return np.maximum(1, steps.astype(np.int64))

    def _scored(self, grid: Costmap2D, pose: Pose, velocity: Floats, velocities: Floats) -> Samples:
        if self.path is None or self.goal is None:
            raise RuntimeError("there is no plan: call update_plan first")
        p, count = self.parameters, len(velocities)
        steps = self._steps(velocities)
        motion = (np.tile(velocity, (count, 1)), velocities, p.accelerations)
        grids = (self.path, self.goal, self.goal)
        found = roll_out(grid, grids, pose, motion, p.sim_time, steps, self.footprint, np.ones(count), 0.0)
        raw, where = found.raw[:, [0, 3, 4]], found.where[:, [0, 3, 4]]
        bias = grid.resolution if self.meter_scoring else 1.0
        scales = np.array([p.occdist_scale, p.path_distance_bias * bias, p.goal_distance_bias * bias])
        totals, rejected_by = _totals(raw, where, scales)
        return Samples(
            CRITICS, scales, velocities, velocities, found.points, steps, raw, where, totals, rejected_by, pose=pose
        )


def evenly(low: float, high: float, count: int) -> Floats:
    """Return `count` evenly spaced values (count,) from `low` to `high`; with a count of 1, only `low`."""
    if count == 1:
        return np.array([low])
    return np.asarray(low + (high - low) / (count - 1) * np.arange(count))


def _cheapest(samples: Samples, count: int) -> int | None:
    if not samples.accepted[:count].any():
        return None
    return int(np.argmin(np.where(samples.accepted[:count], samples.totals[:count], np.inf)))


def _totals(raw: Floats, where: Ints, scales: Floats) -> tuple[Floats, Ints]:
    """Return the costs (n) and the rejecting critics (n), or -1.

    Of several critics, the one with the earliest rejected point counts, and at the same point the obstacle critic.
    """
    first = np.where(raw < 0, where, np.iinfo(np.int64).max)
    critic = np.argmin(first, axis=1)
    rejected = (raw < 0).any(axis=1)
    codes = np.where(critic == 0, COLLISION_COST, UNREACHABLE_COST)
    totals: Floats = np.where(rejected, codes, (raw * scales).sum(axis=1))
    return totals, np.where(rejected, critic, -1)
