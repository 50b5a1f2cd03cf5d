"""Motion of particles: samples of the odometry motion model.

Thrun, Burgard and Fox, Probabilistic Robotics (2005), section 5.4, and http://wiki.ros.org/amcl#Overall_filter_parameters
for the meaning of the alphas. Like the original, the models `diff` and `omni` use variances as standard deviations;
`diff-corrected` and `omni-corrected` do not.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose, compose, inverse

Floats = NDArray[np.float64]

MODELS = ("diff", "omni", "diff-corrected", "omni-corrected")

MIN_DISTANCE = 0.01
"""Over shorter distances [m] the robot counts as turning on the spot, since the direction is unreliable."""


def sample_motion_model(
    particles: Floats, before: Pose, after: Pose, alphas: Sequence[float], noise: Floats, model: str = "diff"
) -> Floats:
    """Return particles (n, 3) after a motion reported by the odometry, each with a random error.

    Args:
        particles: poses (n, 3) [m, m, rad].
        before: the odometry pose before the motion.
        after: the odometry pose after the motion.
        alphas: five numbers: rotation error from rotation, rotation from translation, translation from translation,
            translation from rotation, and, for `omni`, sideways translation from translation.
        noise: standard normal numbers (n, 3).
        model: one of `MODELS`.

    Raises:
        RosminiError: the model is unknown.

    """
    if model not in MODELS:
        hint = nearest(model, MODELS)
        raise RosminiError(f"unknown odometry model {model!r}; the models are {', '.join(MODELS)}. {hint}".rstrip())
    x, y, turn = compose(inverse(before), after)
    turn = normalize_angle(turn)
    sample = _diff if model.startswith("diff") else _omni
    return sample(particles, (x, y, turn), alphas, noise, corrected=model.endswith("corrected"))


def _diff(particles: Floats, motion: Pose, alphas: Sequence[float], noise: Floats, *, corrected: bool) -> Floats:
    """Return the particles (n, 3) after a sampled rotation, translation and second rotation (differential drive)."""
    x, y, turn = motion
    distance = math.hypot(x, y)
    first = 0.0 if distance < MIN_DISTANCE else math.atan2(y, x)
    last = normalize_angle(turn - first)
    # Driving backwards does not count as a half turn.
    turn1, turn2 = (min(abs(angle), math.pi - abs(angle)) for angle in (first, last))
    variances = (
        alphas[0] * turn1**2 + alphas[1] * distance**2,
        alphas[2] * distance**2 + alphas[3] * (turn1**2 + turn2**2),
        alphas[0] * turn2**2 + alphas[1] * distance**2,
    )
    spread = np.sqrt(variances) if corrected else np.array(variances)
    turned, driven, last_turned = (np.array((first, distance, last)) - noise * spread).T
    heading = particles[:, 2] + turned
    return np.column_stack(
        [
            particles[:, 0] + driven * np.cos(heading),
            particles[:, 1] + driven * np.sin(heading),
            normalize_angle(heading + last_turned),
        ]
    )


def _omni(particles: Floats, motion: Pose, alphas: Sequence[float], noise: Floats, *, corrected: bool) -> Floats:
    """Return the particles (n, 3) after a sampled translation in any direction and rotation (omnidirectional drive)."""
    x, y, turn = motion
    distance = math.hypot(x, y)
    a1, a2, a3, a4, a5 = alphas
    if corrected:
        variances = (a3 * distance**2 + a4 * turn**2, a4 * turn**2 + a5 * distance**2, a1 * turn**2 + a2 * distance**2)
        spread = np.sqrt(variances)
    else:
        spread = np.array(
            (a3 * distance**2 + a1 * turn**2, a1 * turn**2 + a5 * distance**2, a4 * turn**2 + a2 * distance**2)
        )
    along, aside, turned = (np.array((distance, 0.0, turn)) + noise * spread).T
    bearing = math.atan2(y, x) + particles[:, 2]
    cos, sin = np.cos(bearing), np.sin(bearing)
    return np.column_stack(
        [
            particles[:, 0] + along * cos + aside * sin,
            particles[:, 1] + along * sin - aside * cos,
            normalize_angle(particles[:, 2] + turned),
        ]
    )
