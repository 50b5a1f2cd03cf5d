"""The particle filter: weights from likelihoods, and resampling with an adaptive number of particles.

KLD-sampling: Fox, Adapting the sample size in particle filters through KLD-sampling (IJRR 2003). Recovery:
Probabilistic Robotics, section 8.3.3 (augmented MCL). Random numbers come from the generator passed to the filter.

Two defects of the original are not copied. It divides the average likelihood, from which recovery is triggered, by the
number of particles twice, so that it jumps whenever the number changes. And its clusters end where the heading wraps
around, so that a robot that faces -x has two means; here it has one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose
from rosmini.core.geometry.products import eigen, matrix_product, scalar_product

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CELL_SIZES = (0.5, 0.5, math.radians(10))
"""Dimensions of a histogram cell [m, m, rad]."""
HEADING_CELLS = 36
"""Number of histogram cells along the heading."""
MIN_ERROR = 1e-9
"""Lower bound of `kld_err`: a value of 0 gives the maximum number of particles."""
WEIGHT_UNITS = 1 << 48
"""Weights are rounded to multiples of 1 / WEIGHT_UNITS, so that every machine draws the same particles."""
CONVERGENCE_DISTANCE = 0.5
"""Convergence threshold: all particles lie within this distance [m] of their mean, along x and along y."""

Draw = Callable[[int], Floats]
"""A function that draws a given number of poses (n, 3) from the free cells of a map."""


@dataclass(frozen=True)
class Cluster:
    """A group of neighbouring particles."""

    weight: float
    mean: Pose
    covariance: Floats
    """Covariance (3, 3) of x, y [m2] and heading (circular: minus twice the logarithm of the mean's length)."""
    count: int


def draw_by_weight(weights: Floats, count: int, random: np.random.Generator) -> Ints:
    """Draw `count` indices with probabilities in proportion to `weights` (n,), which add up to 1."""
    ends = np.cumsum(np.rint(weights * WEIGHT_UNITS).astype(np.int64))
    return np.searchsorted(ends, random.integers(ends[-1], size=count), side="right")


class ParticleFilter:
    """Weighted poses that represent the belief about the robot's pose.

    Args:
        fewest, most: bounds of the number of particles.
        error: maximum divergence between the true distribution and that of the particles (`kld_err`).
        quantile: normal quantile of the probability that the divergence is within that bound (`kld_z`).
        slow, fast: decay rates of the long-term and short-term likelihood averages (`recovery_alpha_slow`, `..._fast`);
            0 disables random particles.
        random: the generator of all random numbers.
        selective: resample only if the effective number is below half of the particles (`selective_resampling`).

    """

    def __init__(
        self,
        fewest: int = 100,
        most: int = 5000,
        *,
        error: float = 0.01,
        quantile: float = 0.99,
        slow: float = 0.0,
        fast: float = 0.0,
        random: np.random.Generator,
        selective: bool = False,
    ) -> None:
        if not 1 <= fewest <= most:
            raise RosminiError(f"min_particles ({fewest}) must be at least 1 and at most max_particles ({most})")
        self.fewest, self.most, self.error, self.quantile = fewest, most, error, quantile
        self.slow, self.fast, self.selective = slow, fast, selective
        self.random = random
        self.particles: Floats = np.zeros((most, 3))
        self.weights: Floats = np.full(most, 1 / most)
        self.average_slow = self.average_fast = 0.0
        self.converged = False

    def initialize(self, mean: Pose, covariance: ArrayLike) -> None:
        """Draw all particles from a normal distribution with this mean and covariance (3, 3)."""
        deviations, axes = eigen(covariance)
        spread = axes * np.sqrt(np.maximum(deviations, 0.0))
        drawn = np.asarray(mean) + matrix_product(self.random.standard_normal((self.most, 3)), spread.T)
        drawn[:, 2] = normalize_angle(drawn[:, 2])
        self._set_particles(drawn)

    def initialize_uniform(self, uniform: Draw) -> None:
        """Draw all particles uniformly from the free space, for global localisation."""
        self._set_particles(uniform(self.most))

    def _set_particles(self, particles: Floats) -> None:
        self.particles = particles
        self.weights = np.full(len(particles), 1 / len(particles))
        self.average_slow = self.average_fast = 0.0
        self.converged = False

    # -- the sensor ----------------------------------------------------------------------------------------------

    def update_weights(self, log_likelihoods: Floats) -> None:
        """Multiply the weights by likelihoods, given as logarithms (n,), and normalise them.

        If all likelihoods are 0, the weights become equal.
        """
        top = float(log_likelihoods.max())
        if not math.isfinite(top):
            self.weights = np.full(len(self.weights), 1 / len(self.weights))
            return
        weights = self.weights * np.exp(log_likelihoods - top)
        total = float(weights.sum())
        self.weights = weights / total
        average = total * math.exp(top)
        if self.average_slow == 0.0:
            self.average_slow = self.average_fast = average
        else:
            self.average_slow += self.slow * (average - self.average_slow)
            self.average_fast += self.fast * (average - self.average_fast)

    @property
    def effective(self) -> float:
        """The effective number of particles: 1 over the sum of the squared weights (Neff)."""
        return float(1 / np.square(self.weights).sum())

    @property
    def random_share(self) -> float:
        """The fraction of particles that resampling draws at random; it grows when the likelihood drops."""
        return max(0.0, 1 - self.average_fast / self.average_slow) if self.average_slow > 0 else 0.0

    # -- resampling ----------------------------------------------------------------------------------------------

    def limit(self, bins: Ints) -> Ints:
        """Return the required number of particles for each number of occupied histogram cells in `bins` (n,)."""
        least = np.maximum(bins - 1, 1).astype(float)
        part = 2 / (9 * least)
        root = 1 - part + np.sqrt(part) * self.quantile
        found = np.ceil(least / (2 * max(self.error, MIN_ERROR)) * (root * root * root))
        limits: Ints = np.clip(np.where(bins <= 1, self.most, found), self.fewest, self.most).astype(np.int64)
        return limits

    def resample(self, draw: Draw) -> None:
        """Draw particles by weight until there are enough for the number of histogram cells that they occupy.

        Random particles come from `draw`. With `selective`, do nothing while the effective number is high.
        """
        if self.selective and self.effective > 0.5 * len(self.particles):
            return
        share = self.random_share
        drawn = self.particles[draw_by_weight(self.weights, self.most, self.random)]
        lost = self.random.random(self.most) < share
        if lost.any():
            drawn[lost] = draw(int(lost.sum()))
        new = np.zeros(self.most, dtype=np.int64)
        new[np.unique(cell_numbers(cells(drawn)), return_index=True)[1]] = 1
        enough = np.flatnonzero(np.arange(1, self.most + 1) > self.limit(np.cumsum(new)))
        count = int(enough[0]) + 1 if len(enough) else self.most
        self.particles = drawn[:count]
        self.weights = np.full(count, 1 / count)
        if share > 0:
            self.average_slow = self.average_fast = 0.0
        off = np.abs(self.particles[:, :2] - self.particles[:, :2].mean(axis=0))
        self.converged = bool((off <= CONVERGENCE_DISTANCE).all())

    # -- results -------------------------------------------------------------------------------------------------

    def clusters(self) -> list[Cluster]:
        """Return clusters of particles in adjacent histogram cells, heaviest first."""
        labels = cluster_labels(cells(self.particles))
        found = [
            cluster_of(self.particles[labels == label], self.weights[labels == label])
            for label in range(int(labels.max()) + 1)
        ]
        return sorted(found, key=lambda cluster: -cluster.weight)

    def mean(self) -> Cluster:
        """Return all particles as one cluster."""
        return cluster_of(self.particles, self.weights)


def cells(particles: Floats) -> Ints:
    """Return the histogram cell (n, 3) of each particle."""
    found: Ints = np.floor(particles / np.array(CELL_SIZES)).astype(np.int64)
    found[:, 2] %= HEADING_CELLS
    return found


def cell_numbers(keys: Ints) -> Ints:
    """Return an integer (n,) for each cell (n, 3) that is the same only for equal cells."""
    low = keys.min(axis=0)
    spans = keys.max(axis=0) - low + 1
    shifted = keys - low
    found: Ints = (shifted[:, 0] * spans[1] + shifted[:, 1]) * spans[2] + shifted[:, 2]
    return found


def cluster_labels(keys: Ints) -> Ints:
    """Return the cluster number (n,) of each cell (n, 3); cells that touch, also at corners, share a cluster."""
    _, first, back = np.unique(cell_numbers(keys), return_index=True, return_inverse=True)
    one, other = touching_pairs(keys[first])
    labels = np.arange(len(first))
    while True:
        least = labels.copy()
        np.minimum.at(least, one, labels[other])
        np.minimum.at(least, other, labels[one])
        least = least[least]
        if (least == labels).all():
            break
        labels = least
    found: Ints = np.unique(labels, return_inverse=True)[1][back.ravel()].astype(np.int64)
    return found


def touching_pairs(unique: Ints) -> tuple[Ints, Ints]:
    """Return the indices of both cells in each pair of touching cells, among different cells (n, 3).

    Cells also touch at corners, and the heading wraps around.
    """
    # A margin of one cell makes the number of every neighbour unique.
    low = unique.min(axis=0) - 1
    spans = unique.max(axis=0) - low + 2
    spans[2] = HEADING_CELLS

    def numbers(keys: Ints) -> Ints:
        positions: Ints = (keys[:, 0] - low[0]) * spans[1] + keys[:, 1] - low[1]
        return positions * HEADING_CELLS + keys[:, 2] % HEADING_CELLS

    known = numbers(unique)
    order = np.argsort(known)
    ones, others = [], []
    half = [(a, b, c) for a in (0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1) if (a, b, c) > (0, 0, 0)]
    for step in half:
        neighbours = numbers(unique + np.array(step))
        at = np.minimum(np.searchsorted(known, neighbours, sorter=order), len(known) - 1)
        hit = known[order[at]] == neighbours
        ones.append(np.flatnonzero(hit))
        others.append(order[at[hit]])
    return np.concatenate(ones), np.concatenate(others)


def cluster_of(particles: Floats, weights: Floats) -> Cluster:
    """Return the total weight, and the weighted mean and covariance, of particles (n, 3) with `weights` (n,).

    The variance of the heading is circular.
    """
    weight = float(weights.sum())
    shares = weights / weight if weight > 0 else np.full(len(weights), 1 / len(weights))
    xs, ys, headings = particles.T
    x, y = scalar_product(shares, xs), scalar_product(shares, ys)
    cos, sin = scalar_product(shares, np.cos(headings)), scalar_product(shares, np.sin(headings))
    ahead, aside = xs - x, ys - y
    covariance = np.zeros((3, 3))
    covariance[0, 0] = scalar_product(shares, ahead * ahead)
    covariance[0, 1] = covariance[1, 0] = scalar_product(shares, ahead * aside)
    covariance[1, 1] = scalar_product(shares, aside * aside)
    covariance[2, 2] = -2 * math.log(max(math.hypot(cos, sin), 1e-300))
    return Cluster(weight, (x, y, math.atan2(sin, cos)), covariance, len(particles))
