"""How likely a scan is from each particle, by one of amcl's three models (http://wiki.ros.org/amcl#Laser_model_parameters)."""

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

MILLIMETRES = 3
"""To so many digits ranges are rounded: what machines compute differently in the last bit changes nothing then."""
DIGITS = 9
"""To so many digits logarithms of likelihoods are rounded, for the same reason."""


@dataclass(frozen=True)
class Scan:
    """What a laser saw."""

    ranges: Floats
    """(b,) [m]; what is not finite or not below `range_max` hit nothing."""
    bearings: Floats
    """(b,) [rad], in the laser's own frame."""
    range_max: float
    laser: Pose = (0.0, 0.0, 0.0)
    """Where the laser is on the robot."""
    upside_down: bool = False
    """Whether its z axis points down: then bearings count the other way round."""

    @property
    def seen(self) -> Floats:
        """The ranges as the models take them: rounded, and `range_max` where nothing was hit."""
        known: Floats = np.nan_to_num(
            self.ranges.astype(np.float64), nan=self.range_max, posinf=self.range_max, neginf=0.0
        )
        rounded = np.round(np.clip(known, 0.0, self.range_max), MILLIMETRES)
        return np.asarray(rounded, dtype=np.float64)

    @property
    def directions(self) -> Floats:
        """The bearings as seen from above."""
        return -self.bearings if self.upside_down else self.bearings


@dataclass(frozen=True)
class BeamSkip:
    """Beams that most particles cannot explain are left out: `do_beamskip` and its parameters."""

    distance: float = 0.5
    """A beam agrees with a particle if it ends so near to something [m]."""
    threshold: float = 0.3
    """The share of particles that a beam has to agree with."""
    error_threshold: float = 0.9
    """If more beams than this share would be left out, the filter has converged to a wrong place: none is."""


@dataclass(frozen=True)
class LaserModel:
    """A model, and how many beams it looks at.

    Raises `RosminiError` when it is used under a name that is none.
    """

    kind: str = "likelihood_field"
    mixture: BeamMixture = field(default_factory=BeamMixture)
    max_beams: int = 30
    skip: BeamSkip | None = None

    def chosen(self, count: int) -> slice:
        """Which of `count` beams it looks at: about `max_beams`, evenly spread."""
        return slice(0, count, max(1, (count - 1) // max(1, self.max_beams - 1)))

    def log_likelihoods(
        self, world: LikelihoodField, particles: Floats, scan: Scan, *, converged: bool = False
    ) -> Floats:
        """The logarithm of each particle's likelihood (n,), up to what is the same for all.

        Beams are left out by `skip` only when the filter has `converged`.
        """
        if self.kind not in _MODELS:
            hint = nearest(self.kind, _MODELS)
            raise RosminiError(
                f"there is no laser model {self.kind!r} but {', '.join(_MODELS)}. {hint}".rstrip()
            )
        chosen = self.chosen(len(scan.ranges))
        ranges, bearings = scan.seen[chosen], scan.directions[chosen]
        skip = self.skip if converged else None
        found = _MODELS[self.kind](world, particles, scan, ranges, bearings, self.mixture, skip)
        rounded: Floats = np.round(found, DIGITS)
        return rounded


def _ends(scan: Scan, ranges: Floats, bearings: Floats) -> Floats:
    """The ends (b, 2) of the beams that hit something, in the robot's frame."""
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
    {
        "beam": _beam,
        "likelihood_field": _likelihood_field,
        "likelihood_field_prob": _likelihood_field_prob,
    }
)
