"""What makes a measurement differ from the truth: white noise, bias, drift, steps, gaps.

    measured = step * round((truth + b(t) + n) / step),   n ~ N(mean, stddev^2)

b(0) is drawn once for each unit, from N(bias_mean, bias_stddev^2), with either sign; after that it wanders as a
Gauss-Markov process does,

    b(t + dt) = b(t) exp(-dt / tau) + N(0, sigma^2 (tau / 2) (1 - exp(-2 dt / tau))),

and without `drift` (sigma = 0) it stays. These are the numbers that Gazebo's `<noise>` tag gives
(http://sdformat.org/spec?elem=sensor: `type`, `mean`, `stddev`, `bias_mean`, `bias_stddev`, `dynamic_bias_stddev`,
`dynamic_bias_correlation_time`, `precision`); `dropout` is ours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.errors import RosminiError

Floats = NDArray[np.float64]


class NoiseError(RosminiError, ValueError):
    """A noise has a parameter that is not finite, or negative where it must not be; the message names it."""


@dataclass(frozen=True)
class NoiseModel:
    """The parameters of a noise, in the unit of the measurement; all 0: no noise.

    Raises:
        NoiseError: a number is not finite, a deviation is negative, or the chance of a gap is not between 0 and 1.

    """

    stddev: float = 0.0
    """Of each sample."""
    mean: float = 0.0
    bias_stddev: float = 0.0
    """Of the bias, from one unit to another."""
    bias_mean: float = 0.0
    drift: float = 0.0
    """How strongly the bias wanders: sigma, in units a root of a second."""
    drift_time: float = 0.0
    """tau, how long the bias remembers where it was [s]."""
    resolution: float = 0.0
    """Measurements are multiples of this; 0: any number."""
    dropout: float = 0.0
    """The chance that a sample is nan."""

    def __post_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            if not isinstance(value, (int, float)) or not math.isfinite(value):
                raise NoiseError(f"{each.name} of a noise is {value!r}; it has to be a finite number")
            if value < 0 and each.name not in ("mean", "bias_mean"):
                raise NoiseError(f"{each.name} of a noise is {value!r}; it has to be 0 or more")
        if self.dropout > 1:
            raise NoiseError(f"dropout of a noise is {self.dropout!r}; it is a chance, 1 at most")
        if self.drift and not self.drift_time:
            raise NoiseError(
                "a noise with a drift needs drift_time, how long the bias remembers where it was [s]"
            )

    def scaled(self, factor: float) -> NoiseModel:
        """Return the same noise, `factor` times as strong, with the same resolution and dropout."""
        return NoiseModel(
            self.stddev * factor,
            self.mean * factor,
            self.bias_stddev * factor,
            self.bias_mean * factor,
            self.drift * factor,
            self.drift_time,
            self.resolution,
            self.dropout,
        )


class Noise:
    """One unit's noise: of `count` values that are measured together, each with a bias of its own.

    The same generator gives the same noise; what is drawn does not depend on what is measured.
    """

    def __init__(self, model: NoiseModel, rng: np.random.Generator, count: int = 1) -> None:
        self.model = model
        self._rng = rng
        self.bias: Floats = np.zeros(count)
        if model.bias_stddev or model.bias_mean:
            size = rng.normal(model.bias_mean, model.bias_stddev, count)
            self.bias = size * np.where(rng.random(count) < 0.5, -1.0, 1.0)

    def measured(self, truth: ArrayLike, dt: float = 0.0) -> Floats:
        """What is measured of `truth` (..., count), `dt` [s] after the last time."""
        model = self.model
        values = np.asarray(truth, dtype=np.float64)
        if model.drift and dt > 0:
            kept = math.exp(-dt / model.drift_time)
            spread = model.drift * math.sqrt(model.drift_time / 2 * (1 - kept * kept))
            self.bias = self.bias * kept + spread * self._rng.standard_normal(len(self.bias))
        values = values + self.bias
        if model.stddev:
            values = values + model.stddev * self._rng.standard_normal(values.shape)
        values = values + model.mean
        if model.resolution:
            values = np.round(values / model.resolution) * model.resolution
        if model.dropout:
            values = np.where(self._rng.random(values.shape) < model.dropout, np.nan, values)
        return values
