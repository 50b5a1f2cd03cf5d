"""The likelihood of a scan for each particle by amcl's models (http://wiki.ros.org/amcl#Laser_model_parameters)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry.poses import Pose, compose, transform_points

from .field import BeamMixture, LikelihoodField

Floats = NDArray[np.float64]

RANGE_DECIMALS = 3
"""Number of decimals of ranges [m]: rounding hides differences in the last bit between machines."""
LIKELIHOOD_DECIMALS = 9
"""Number of decimals of log-likelihoods, for the same reason."""


@dataclass(frozen=True)
class Scan:
    """A laser scan, as the models need it."""

    ranges: Floats
    """Ranges (b,) [m]; a value that is not finite or not below `range_max` means no hit."""
    bearings: Floats
    """Bearings (b,) [rad] in the laser's frame."""
    range_max: float
    laser: Pose = (0.0, 0.0, 0.0)
    """The laser's pose in the robot's frame."""
    upside_down: bool = False
    """Return whether the laser's z axis points down, which reverses the bearings."""

    @property
    def seen(self) -> Floats:
        """The ranges (b,) [m] that the models use: rounded, with `range_max` for beams without a hit."""
        known: Floats = np.nan_to_num(
            self.ranges.astype(np.float64), nan=self.range_max, posinf=self.range_max, neginf=0.0
        )
        rounded = np.round(np.clip(known, 0.0, self.range_max), RANGE_DECIMALS)
        return np.asarray(rounded, dtype=np.float64)

    @property
    def directions(self) -> Floats:
        """The bearings (b,) [rad] counter-clockwise as seen from above."""
        return -self.bearings if self.upside_down else self.bearings


@dataclass(frozen=True)
class BeamSkip:
    """Omits beams that most particles cannot explain: the parameters of `do_beamskip`."""

    distance: float = 0.5
    """A beam agrees with a particle if it ends within this distance of an obstacle [m]."""
    threshold: float = 0.3
    """Minimum fraction of particles with which a used beam agrees."""
    error_threshold: float = 0.9
    """If a larger fraction of beams would be omitted, the filter has converged to a wrong pose and all are used."""


@dataclass(frozen=True)
class LaserModel:
    """A laser model, its parameters and the number of beams that it uses.

    Raises `RosminiError` when used with an unknown `kind`.
    """

    kind: str = "likelihood_field"
    mixture: BeamMixture = field(default_factory=BeamMixture)
    max_beams: int = 30
    skip: BeamSkip | None = None

    def used_beams(self, count: int) -> slice:
        """Return the slice of `count` beams to use: about `max_beams`, evenly spaced."""
        return slice(0, count, max(1, (count - 1) // max(1, self.max_beams - 1)))

    def log_likelihoods(
        self, world: LikelihoodField, particles: Floats, scan: Scan, *, converged: bool = False
    ) -> Floats:
        """Return the log-likelihood (n,) of a scan for each of the particles (n, 3), up to a constant.

        `skip` applies only when the filter has `converged`. Raises `RosminiError` if the laser model is unknown.
        """
        if self.kind not in _MODELS:
            hint = nearest(self.kind, _MODELS)
            raise RosminiError(
                f"unknown laser model {self.kind!r}; the models are {', '.join(_MODELS)}. {hint}".rstrip()
            )
        used_beams = self.used_beams(len(scan.ranges))
        ranges, bearings = scan.seen[used_beams], scan.directions[used_beams]
        skip = self.skip if converged else None
        found = _MODELS[self.kind](world, particles, scan, ranges, bearings, self.mixture, skip)
        rounded: Floats = np.round(found, LIKELIHOOD_DECIMALS)
        return rounded


def _ends(scan: Scan, ranges: Floats, bearings: Floats) -> Floats:
    """Return the ends (b, 2) [m] of the beams with a hit, in the robot's frame."""
    hit = ranges < scan.range_max
    points = np.column_stack([ranges[hit] * np.cos(bearings[hit]), ranges[hit] * np.sin(bearings[hit])])
    return transform_points(scan.laser, points)


def _likelihood_field(
    world: LikelihoodField,
    particles: Floats,
    scan: Scan,
    ranges: Floats,
    bearings: Floats,
    mixture: BeamMixture,
    _: BeamSkip | None,
) -> Floats:
    cubes, outside = world.densities(mixture, scan.range_max, "cube")
    return np.log1p(world.sums(cubes, outside, particles, _ends(scan, ranges, bearings)))


def _likelihood_field_prob(
    world: LikelihoodField,
    particles: Floats,
    scan: Scan,
    ranges: Floats,
    bearings: Floats,
    mixture: BeamMixture,
    skip: BeamSkip | None,
) -> Floats:
    ends = _ends(scan, ranges, bearings)
    if skip is not None and len(ends):
        agree = world.each(world.distance, world.farthest, particles, ends) < skip.distance
        kept = agree.mean(axis=0) > skip.threshold
        if 1 - kept.mean() < skip.error_threshold:
            ends = ends[kept]
    logs, outside = world.densities(mixture, scan.range_max, "log")
    return world.sums(logs, outside, particles, ends)


def _beam(
    world: LikelihoodField,
    particles: Floats,
    scan: Scan,
    ranges: Floats,
    bearings: Floats,
    mixture: BeamMixture,
    _: BeamSkip | None,
) -> Floats:
    lasers = compose(particles, scan.laser)
    off = ranges - world.ranges(lasers, bearings, scan.range_max)
    chance = mixture.z_hit * np.exp(-(off**2) / (2 * mixture.sigma_hit**2))
    early = mixture.z_short * mixture.lambda_short * np.exp(-mixture.lambda_short * ranges)
    chance += np.where(off < 0, early, 0.0)
    chance += np.where(ranges >= scan.range_max, mixture.z_max, mixture.z_rand / scan.range_max)
    found: Floats = np.log1p((chance * chance * chance).sum(axis=1))
    return found


_Model = Callable[[LikelihoodField, Floats, Scan, Floats, Floats, BeamMixture, "BeamSkip | None"], Floats]

_MODELS: MappingProxyType[str, _Model] = MappingProxyType(
    {"beam": _beam, "likelihood_field": _likelihood_field, "likelihood_field_prob": _likelihood_field_prob}
)
