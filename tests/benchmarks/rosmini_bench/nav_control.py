"""Local planners: what a cycle costs, how that grows with the window, and how well trajectories are predicted.

Nothing is tuned before the last of them is known: the wheels of our TurtleBot3 accelerate at 1 m/s2, and files for the
real one say 2.5.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import shortest_angular_distance
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.navigation.base_local_planner.trajectory import Samples
from rosmini.navigation.base_local_planner.trajectory_planner import TrajectoryPlanner, TrajectoryPlannerParameters
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.dwa_local_planner.dwa_planner import DWAPlanner, DWAPlannerParameters
from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER
from rosmini.sim.world import World

from .sim_engine import rng

Floats = NDArray[np.float64]

FOOTPRINT = np.array(BURGER.footprint)
STEPS = 30
"""Points of each trajectory, where they are all as long."""
PERIOD = 0.1
"""Between two commands [s]: 10 Hz."""


def window(side: int, seed: int) -> Costmap2D:
    """A rolling window of so many cells a side, with costs at random that block nothing."""
    grid = Costmap2D(side, side, 0.05, (-side * 0.025, -side * 0.025))
    grid.costs[:] = np.random.default_rng(seed).integers(0, 60, grid.costs.shape)
    return grid


def plan(grid: Costmap2D) -> Floats:
    """A plan from the middle of a window to its right edge, a pose in every half cell."""
    xs = np.arange(0.0, grid.size_m[0] / 2 - 0.1, grid.resolution / 2)
    return np.column_stack([xs, 0.1 * np.sin(4 * xs), np.zeros_like(xs)])


def dwa(samples: int = 800, speed: float = 0.5) -> DWAPlanner:
    """A planner whose samples (40 turns) all have about `STEPS` points."""
    parameters = DWAPlannerParameters(
        max_vel_trans=speed,
        max_vel_x=speed,
        min_vel_x=speed - 0.02,
        max_vel_y=0.0,
        min_vel_y=0.0,
        min_vel_theta=0.0,
        sim_time=1.5,
        sim_granularity=1.5 * speed / STEPS,
        angular_sim_granularity=1.0,
        vx_samples=samples // 40,
        vy_samples=1,
        vth_samples=39,
    )
    return DWAPlanner(parameters, PERIOD)


def rollout() -> TrajectoryPlanner:
    """Trajectory Rollout with as many samples."""
    return TrajectoryPlanner(
        TrajectoryPlannerParameters(holonomic_robot=False, vx_samples=39, vtheta_samples=20), PERIOD
    )


def cycle(
    side: int = 60, seed: int = 1, planner: DWAPlanner | TrajectoryPlanner | None = None
) -> Callable[[], Samples]:
    """A function that does a cycle of control: map grids, samples, all critics, choice."""
    grid, driver = window(side, seed), planner or dwa()
    path, here, velocity = plan(grid), (0.0, 0.0, 0.0), np.array([0.49, 0.0, 0.0])

    def once() -> Samples:
        driver.update_plan(grid, here, path, FOOTPRINT)
        return driver.find_best(grid, here, velocity)

    return once


def cost_of(action: Callable[[], object], times: int = 40) -> float:
    """The median of its processor time [ms]."""
    action()
    found = []
    for _ in range(times):
        begin = time.thread_time()
        action()
        found.append(time.thread_time() - begin)
    return statistics.median(found) * 1e3


def cycle_cost(side: int = 60, seed: int = 1, times: int = 40) -> float:
    """What a cycle of DWA costs [ms]: 800 samples of 30 points, a polygon's outline, four map grids, all critics."""
    return cost_of(cycle(side, seed), times)


def rollout_cost(side: int = 60, seed: int = 1, times: int = 40) -> float:
    """What a cycle of Trajectory Rollout costs [ms], of 800 samples."""
    return cost_of(cycle(side, seed, rollout()), times)


def growth(seed: int = 1, sides: tuple[int, ...] = (60, 120, 240, 400)) -> list[tuple[int, float]]:
    """The sides of windows [cells], and what a cycle of DWA costs in each [ms]."""
    return [(side, cycle_cost(side, seed)) for side in sides]


# -- predicted and driven ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Miss:
    """How far a driven trajectory ends from the predicted one, for one command."""

    command: tuple[float, float]
    """[m/s], [rad/s]"""
    before: tuple[float, float]
    """How the robot drove when it was commanded."""
    distance: float
    """[m]"""
    heading: float
    """[rad], positive: the robot turned further than predicted"""


def driven(command: tuple[float, float], before: tuple[float, float], seconds: float) -> Pose:
    """Where a simulated burger is after so many seconds of a command, seen from where it was when it got it."""
    engine = Engine(World("plane"), rng)
    engine.add("robot", BURGER, (0.0, 0.0, 0.3))
    engine.command("robot", *before)
    engine.advance(1.0)
    start = engine.robots["robot"].pose
    engine.command("robot", *command)
    engine.advance(1.0 + seconds)
    return compose(inverse(start), engine.robots["robot"].pose)


def predicted(
    command: tuple[float, float], before: tuple[float, float], acceleration: float, *, window: bool
) -> Floats:
    """The pose (3) that the planner foresees after `sim_time`: with `window` it believes in the command at once.

    Without it (`use_dwa: false`) the velocity comes nearer by `acceleration` [m/s2]; turns by what the wheels then can.
    """
    parameters = DWAPlannerParameters(
        max_vel_trans=1.0, min_vel_trans=0.0, min_vel_theta=0.0, max_vel_theta=3.0, sim_time=1.5,
        sim_granularity=0.005, angular_sim_granularity=0.01, use_dwa=window,
        acc_lim_x=acceleration, acc_lim_theta=min(20.0, acceleration / (BURGER.wheel_separation / 2)),
    )  # fmt: skip
    planner = DWAPlanner(parameters, PERIOD)
    grid = Costmap2D(60, 60, 0.05, (-1.5, -1.5))
    planner.update_plan(grid, (0.0, 0.0, 0.0), np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), FOOTPRINT)
    start = np.array([before[0], 0.0, before[1]])
    samples = planner.driven(grid, (0.0, 0.0, 0.0), start, np.array([[command[0], 0.0, command[1]]]))
    return samples.trajectory(0)


def miss(command: tuple[float, float], before: tuple[float, float], acceleration: float, *, window: bool) -> Miss:
    """Compare the two at the last predicted point."""
    track = predicted(command, before, acceleration, window=window)
    after = 1.5 * (len(track) - 1) / len(track)
    x, y, theta = driven(command, before, after)
    return Miss(
        command,
        before,
        float(np.hypot(track[-1, 0] - x, track[-1, 1] - y)),
        shortest_angular_distance(float(track[-1, 2]), theta),
    )


COMMANDS = ((0.22, 0.0), (0.22, 1.0), (0.11, 1.37), (0.0, 1.37), (0.0, 2.75), (-0.11, 0.0))
BEFORE = ((0.0, 0.0), (0.22, 0.0))


def misses(acceleration: float = 2.5, *, window: bool = True) -> list[Miss]:
    """For each command, from a standstill and from full speed."""
    return [miss(command, before, acceleration, window=window) for before in BEFORE for command in COMMANDS]
