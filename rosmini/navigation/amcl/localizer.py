"""amcl's procedure without a graph: move, weight and resample particles, and estimate the pose from them."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.core.maps.grid_map import GridMap

from .field import BeamMixture, LikelihoodField
from .filter import Cluster, ParticleFilter, draw_by_weight
from .laser import BeamSkip, LaserModel, Scan
from .motion import sample_motion_model
from .parameters import AmclParameters

Floats = NDArray[np.float64]

NO_MAP = "there is no map yet: global localisation needs one"


@dataclass(frozen=True)
class Estimate:
    """The estimated pose of the robot, with the clusters of particles."""

    pose: Pose
    """Mean of the heaviest cluster."""
    covariance: Floats
    """Covariance (3, 3) of all particles."""
    clusters: tuple[Cluster, ...]


class FreeSpace:
    """The free cells of a map, from which poses are drawn uniformly. Raises `RosminiError` if there are none."""

    def __init__(self, free: NDArray[np.bool_], resolution: float, origin: tuple[float, float]) -> None:
        self.cells = np.flatnonzero(free)
        if not len(self.cells):
            raise RosminiError("the map has no free cell where the robot could be")
        self.width = free.shape[1]
        self.resolution, self.origin = resolution, origin

    def __contains__(self, point: tuple[float, float]) -> bool:
        """Return whether a point [m] is in a free cell."""
        column, row = (math.floor((v - o) / self.resolution) for v, o in zip(point, self.origin, strict=True))
        cell = row * self.width + column
        index = int(np.searchsorted(self.cells, cell))
        return 0 <= column < self.width and index < len(self.cells) and int(self.cells[index]) == cell

    def draw(self, count: int, random: np.random.Generator) -> Floats:
        """Return random poses (count, 3) at the centres of free cells, with any heading."""
        cells = self.cells[random.integers(len(self.cells), size=count)]
        return np.column_stack(
            [
                self.origin[0] + (cells % self.width + 0.5) * self.resolution,
                self.origin[1] + (cells // self.width + 0.5) * self.resolution,
                random.uniform(-math.pi, math.pi, count),
            ]
        )


class Localizer:
    """A particle filter on a map.

    Args:
        parameters: the parameters of amcl.
        random: the generator of all random numbers.

    """

    def __init__(self, parameters: AmclParameters, random: np.random.Generator) -> None:
        self.random = random
        self.field: LikelihoodField | None = None
        self.free: FreeSpace | None = None
        self.odometry: Pose | None = None
        """The odometry at the last update; None before the first."""
        self.force = False
        """True if the next scan is to be used even if the robot has not moved."""
        self.updates = 0
        self._due: set[str] = set()
        self._lasers: dict[str, None] = {}
        self.configure(parameters)

    def configure(self, parameters: AmclParameters) -> None:
        """Apply parameters: the filter restarts around its current estimate."""
        self.parameters = p = parameters
        before = getattr(self, "filter", None)
        self.filter = ParticleFilter(
            max(1, min(p.min_particles, p.max_particles)),
            max(1, p.max_particles),
            error=p.kld_err,
            quantile=p.kld_z,
            slow=p.recovery_alpha_slow,
            fast=p.recovery_alpha_fast,
            random=self.random,
            selective=p.selective_resampling,
        )
        mixture = {f.name: getattr(p, f"laser_{f.name}") for f in fields(BeamMixture)}
        skip = BeamSkip(p.beam_skip_distance, p.beam_skip_threshold, p.beam_skip_error_threshold)
        self.model = LaserModel(
            p.laser_model_type, BeamMixture(**mixture), p.laser_max_beams, skip if p.do_beamskip else None
        )
        if before is not None:
            mean = before.mean()
            self.initialize(mean.mean, mean.covariance)

    def set_map(self, grid: GridMap) -> None:
        """Use this map from now on; as in the original, the heading of its origin is ignored.

        Raises `RosminiError` if it has no free cell, and then keeps the previous map.
        """
        origin = grid.origin[0], grid.origin[1]
        self.free = FreeSpace(grid.free, grid.resolution, origin)
        farthest = self.parameters.laser_likelihood_max_dist
        self.field = LikelihoodField(grid.occupied, grid.resolution, origin, farthest, grid.free)
        self._lasers = {}

    def initialize(self, pose: Pose, covariance: ArrayLike) -> None:
        """Restart the filter around a pose with a covariance (3, 3)."""
        self.filter.initialize(pose, covariance)
        self.odometry = None

    def initialize_globally(self) -> None:
        """Restart the filter with a uniform distribution. Raises `RosminiError` without a map."""
        self.filter.initialize_uniform(self._uniform)
        self.odometry = None

    def _uniform(self, count: int) -> Floats:
        if self.free is None:
            raise RosminiError(NO_MAP)
        return self.free.draw(count, self.random)

    def _recovery_poses(self, count: int, scan: Scan) -> Floats:
        """Return poses (count, 3) for random particles: uniform, or chosen among candidates by the scan's likelihood.

        Source of the choice: Lenser and Veloso, "Sensor resetting localization for poorly modelled mobile robots", ICRA
        2000.
        """
        each = self.parameters.recovery_candidates
        drawn = self._uniform(count * each)
        if each == 1 or self.field is None:
            return drawn
        found = self.model.log_likelihoods(self.field, drawn, scan)
        top = float(found.max())
        if not math.isfinite(top):
            return drawn[:count]
        weights = np.exp(found - top)
        return drawn[draw_by_weight(weights / weights.sum(), count, self.random)]

    def update(self, laser: str, scan: Scan, odometry: Pose) -> bool | None:
        """Process a scan of the laser `laser`, taken at the pose `odometry`; return whether there is a new estimate.

        There is one after the first scan and after each resampling. Returns None if the scan was not used, because
        there is no map, or the robot has hardly moved since the last scan of this laser that was used.
        """
        if self.field is None:
            return None
        self._lasers[laser] = None
        before, p = self.odometry, self.parameters
        if before is None:
            self._due, self.updates = set(self._lasers), 0
        elif self.force or self._has_moved(before, odometry):
            self._due = set(self._lasers)
        if laser not in self._due:
            return None
        if before is not None and before != odometry:
            noise = self.random.standard_normal((len(self.filter.particles), 3))
            alphas = (p.odom_alpha1, p.odom_alpha2, p.odom_alpha3, p.odom_alpha4, p.odom_alpha5)
            self.filter.particles = sample_motion_model(
                self.filter.particles, before, odometry, alphas, noise, p.odom_model_type
            )
        self.odometry = odometry
        self._due.discard(laser)
        self.force = False
        converged = self.filter.converged
        self.filter.update_weights(
            self.model.log_likelihoods(self.field, self.filter.particles, scan, converged=converged)
        )
        self.updates += 1
        resampled = p.resample_interval > 0 and self.updates % p.resample_interval == 0
        if resampled:
            self.filter.resample(lambda count: self._recovery_poses(count, scan))
        return before is None or resampled

    def _has_moved(self, before: Pose, now: Pose) -> bool:
        """Return whether the motion between two odometry poses exceeds `update_min_d` or `update_min_a`."""
        turned = abs(math.remainder(now[2] - before[2], math.tau))
        distance = max(abs(now[0] - before[0]), abs(now[1] - before[1]))
        return distance > self.parameters.update_min_d or turned > self.parameters.update_min_a

    def estimate(self) -> Estimate:
        """Return the estimated pose of the robot: the mean of the heaviest cluster."""
        clusters = self.filter.clusters()
        return Estimate(clusters[0].mean, self.filter.mean().covariance, tuple(clusters))

    def numbers(self) -> dict[str, Any]:
        """Return statistics of the filter for tables."""
        return {
            "particles": len(self.filter.particles),
            "effective": round(self.filter.effective),
            "random": round(self.filter.random_share, 3),
            "clusters": len(self.filter.clusters()),
        }
