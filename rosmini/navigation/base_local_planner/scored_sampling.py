"""Velocity sampling, simulation and scoring: `SimpleTrajectoryGenerator` and its scored planner.

Of the critics, those of points (obstacle, map grids) are in the kernel
`rosmini.navigation.base_local_planner.rollout`, those of velocities alone here.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.poses import Pose
from rosmini.navigation.costmap_2d.costmap import Costmap2D

from .limits import LocalPlannerLimits
from .map_grid import MapGrid
from .rollout import compiled_rollout

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

TOLERANCE = 1e-4
"""Tolerance for velocities outside the limits [m/s, rad/s]."""

MAX_POINTS = 20_000_000
"""Maximum number of points of all trajectories in a cycle; they take half a gigabyte."""

OSCILLATING = -5.0
"""The score of trajectories that the oscillation critic rejects."""


@dataclass(frozen=True)
class Rollouts:
    """The results of the kernel `rosmini.navigation.base_local_planner.rollout.rollout`, which describes the arrays."""

    points: Floats
    lengths: Ints
    raw: Floats
    where: Ints


def roll_out(
    grid: Costmap2D,
    grids: tuple[MapGrid, MapGrid, MapGrid],
    pose: Pose,
    motion: tuple[Floats, Floats, Floats],
    sim_time: float,
    steps: Ints,
    footprint: Floats,
    scales: Floats,
    shift: float,
) -> Rollouts:
    """Simulate all samples with the compiled `rollout`.

    `grids` are the map grids of the path, the goal and the point in front (`front` in `rollout`). `motion` contains
    start velocities (n, 3), target velocities (n, 3) and accelerations (3). Raises `ParameterError` for more than
    `MAX_POINTS` points.
    """
    starts, targets, limits = motion
    count, most = len(targets), int(steps.max(initial=1))
    if count * most > MAX_POINTS:
        raise ParameterError(
            f"{count} trajectories of up to {most} points exceed the limit of {MAX_POINTS:,} points a cycle: use a "
            "larger sim_granularity or angular_sim_granularity, a shorter sim_time or fewer samples"
        )
    points = np.zeros((count, most, 3))
    raw, where = np.zeros((count, 5)), np.zeros((count, 5), dtype=np.int64)
    compiled_rollout()(
        np.ascontiguousarray(grid.costs).reshape(-1),
        grid.width,
        grid.height,
        *grid.origin,
        grid.resolution,
        np.asarray(pose, dtype=np.float64),
        np.ascontiguousarray(starts),
        np.ascontiguousarray(targets),
        np.asarray(limits, dtype=np.float64),
        float(sim_time),
        steps,
        np.ascontiguousarray(footprint, dtype=np.float64),
        scales,
        *(each.distances.reshape(-1) for each in grids),
        float(shift),
        points,
        raw,
        where,
    )
    return Rollouts(points, steps, raw, where)


@dataclass(frozen=True)
class Sampling:
    """The parameters of sampling and simulation in `SimpleTrajectoryGenerator`.

    Raises `ParameterError` for a granularity of 0.
    """

    sim_time: float
    """Duration of a trajectory [s]."""
    sim_granularity: float
    """Maximum distance between two points [m]."""
    angular_sim_granularity: float
    """Maximum angle between two points [rad]."""
    use_dwa: bool
    sim_period: float
    """Time between two commands [s]."""
    counts: tuple[int, int, int]
    """Numbers of samples in x, y and theta."""

    def __post_init__(self) -> None:
        for name in ("sim_granularity", "angular_sim_granularity"):
            if getattr(self, name) <= 0:
                raise ParameterError(
                    f"{name} is {getattr(self, name):g}: trajectories are checked in steps of this size, so it must "
                    "be greater than 0"
                )

    def velocities(self, pose: Pose, velocity: Floats, goal: Pose, limits: LocalPlannerLimits) -> Floats:
        """Return the velocities (n, 3) to try from the current `velocity` (3).

        With `use_dwa` they are within reach in one period, otherwise in `sim_time`, and then not so fast that the robot
        would pass the `goal`.
        """
        low = np.array([limits.min_vel_x, limits.min_vel_y, -limits.max_vel_theta])
        high = np.array([limits.max_vel_x, limits.max_vel_y, limits.max_vel_theta])
        if not self.use_dwa:
            enough = math.hypot(goal[0] - pose[0], goal[1] - pose[1]) / self.sim_time
            high[:2] = np.maximum(np.minimum(high[:2], enough), low[:2])
        gain = limits.accelerations * (self.sim_period if self.use_dwa else self.sim_time)
        high, low = np.minimum(high, velocity + gain), np.maximum(low, velocity - gain)
        ends = zip(low.tolist(), high.tolist(), self.counts, strict=True)
        axes = [velocity_samples(*three) for three in ends]
        made = np.empty((*(len(axis) for axis in axes), 3))
        made[..., 0], made[..., 1], made[..., 2] = axes[0][:, None, None], axes[1][:, None], axes[2]
        return made.reshape(-1, 3)

    def steps(self, velocities: Floats, limits: LocalPlannerLimits) -> Ints:
        """Return the number of steps of each velocity (n, 3); 0 for velocities that the robot cannot follow."""
        speeds, turns = np.hypot(velocities[:, 0], velocities[:, 1]), np.abs(velocities[:, 2])
        slow = (speeds + TOLERANCE < limits.min_vel_trans) & (turns + TOLERANCE < limits.min_vel_theta)
        fast = speeds - TOLERANCE > limits.max_vel_trans
        steps = np.ceil(
            np.maximum(
                speeds * self.sim_time / self.sim_granularity, turns * self.sim_time / self.angular_sim_granularity
            )
        )
        return np.where(slow | fast, 0, steps).astype(np.int64)

    def starts(self, velocities: Floats, velocity: Floats, steps: Ints, limits: LocalPlannerLimits) -> Floats:
        """Return for each of the sampled `velocities` (n, 3) the velocity at its start, which is the command.

        Without `use_dwa`, it differs from the current `velocity` (3) by at most the acceleration in one step.
        """
        if self.use_dwa:
            return velocities
        gain = limits.accelerations * (self.sim_time / np.maximum(steps, 1))[:, None]
        return np.clip(velocities, velocity - gain, velocity + gain)


def velocity_samples(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Return `count` evenly spaced values (at least two) from `low` to `high`, and 0 if it lies between two of them.

    If `low` and `high` are equal, return only that value.

    >>> velocity_samples(-1.0, 2.0, 3).tolist()
    [-1.0, 0.0, 0.5, 2.0]
    """
    if low == high:
        return np.array([low])
    count = max(2, count)
    values = low + (high - low) / (count - 1) * np.arange(count, dtype=np.float64)
    values[-1] = high
    after = int(np.searchsorted(values, 0.0))
    if 0 < after < count and values[after] > 0 > values[after - 1]:
        values = np.concatenate([values[:after], (0.0,), values[after:]])
    return values


def footprint_scales(
    velocities: Floats, max_vel_trans: float, max_scaling_factor: float, scaling_speed: float
) -> Floats:
    """Return the footprint's scale for each velocity (n, 3): above `scaling_speed` [m/s], it grows from 1.

    At `max_vel_trans` [m/s] it is 1 + `max_scaling_factor`.
    """
    speeds = np.hypot(velocities[:, 0], velocities[:, 1])
    fast = speeds > scaling_speed
    room = max_vel_trans - scaling_speed
    scales = np.ones(len(velocities))
    if room:
        scales[fast] += max_scaling_factor * (speeds[fast] - scaling_speed) / room
    return scales


@dataclass
class Oscillation:
    """Rejects velocities that undo the previous motion: forwards and backwards, left and right.

    Once the sign of a velocity has changed twice, only the later sign is allowed until the robot has moved by
    `reset_distance` [m] or turned by `reset_angle` [rad].
    """

    reset_distance: float = 0.05
    reset_angle: float = 0.2
    last: list[int] = field(default_factory=lambda: [0, 0, 0])
    """The sign of the last non-zero velocity in x, y and theta; 0 initially."""
    allowed: list[int] = field(default_factory=lambda: [0, 0, 0])
    """The only allowed sign in x, y and theta; 0 allows both."""
    reset_pose: Pose = (0.0, 0.0, 0.0)

    def score(self, commands: Floats) -> Floats:
        """Return 0 or `OSCILLATING` for each command (n, 3)."""
        forbidden = (np.sign(commands) * np.asarray(self.allowed) < 0).any(axis=1)
        return np.where(forbidden, OSCILLATING, 0.0)

    def update(self, pose: Pose, command: Floats, min_vel_trans: float) -> None:
        """Record the command (3) that was chosen at `pose`; allow all velocities if the robot has moved far enough.

        Sideways velocities and turns only count while the speed ahead is at most `min_vel_trans` [m/s].
        """
        if self._record(command, min_vel_trans):
            self.reset_pose = pose
        if any(self.allowed):
            x, y, theta = (now - then for now, then in zip(pose, self.reset_pose, strict=True))
            if math.hypot(x, y) > self.reset_distance or abs(theta) > self.reset_angle:
                self.reset()

    def _record(self, command: Floats, min_vel_trans: float) -> bool:
        changed = self._sign_changed(0, command[0])
        if abs(command[0]) <= min_vel_trans:
            # Turns and sideways steps count only while the robot is not driving ahead.
            changed = self._sign_changed(1, command[1]) | self._sign_changed(2, command[2]) | changed
        return changed

    def _sign_changed(self, axis: int, velocity: float) -> bool:
        sign = int(np.sign(velocity))
        if sign == 0:
            return False
        turned = self.last[axis] == -sign
        if turned:
            self.allowed[axis] = sign
        self.last[axis] = sign
        return turned

    def reset(self) -> None:
        """Allow all velocities, and forget the last signs."""
        self.last, self.allowed = [0, 0, 0], [0, 0, 0]


def twirling(commands: Floats) -> Floats:
    """Return the turning speed of each command (n, 3) [rad/s]."""
    return np.abs(commands[:, 2])


def combined_scores(raw: Floats, scales: Floats) -> tuple[Floats, Ints]:
    """Return the costs (n) for raw scores (n, k) of k critics, and the index (n) of the critic that rejects, or -1.

    Critics are applied in order, skipping those with scale 0 (`SimpleScoredSamplingPlanner::scoreTrajectory`). The cost
    of a rejected trajectory is the score of its critic.
    """
    used = np.flatnonzero(scales != 0)
    if not len(used):
        return np.zeros(len(raw)), np.full(len(raw), -1)
    given = raw[:, used]
    negative = given < 0
    first = np.argmax(negative, axis=1)
    rejected = negative.any(axis=1)
    totals = np.where(rejected, given[np.arange(len(raw)), first], (given * scales[used]).sum(axis=1))
    return totals, np.where(rejected, used[first], -1)
