"""The time of an engine, and what is somewhere at it."""

from __future__ import annotations

from typing import Protocol

from rosmini.core.geometry.poses import Pose

SECOND = 1_000_000_000
"""[ns]"""

STEP_NS = 5_000_000
"""How long one step of the physics is [ns]: step k begins at k times that."""

STEP = STEP_NS / SECOND
"""The same [s]."""


class Instant:
    """The present moment, which everything in an engine shares."""

    def __init__(self) -> None:
        self.ns = 0
        """Since the engine began."""
        self.seconds = 0.0
        """The same [s], as it was asked for: it may differ by a part of a nanosecond."""


class Placed(Protocol):
    """What is somewhere."""

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        ...


def between_poses(begin: Pose, end: Pose, part: float) -> Pose:
    """The pose after so much, from 0 to 1, of a straight way."""
    x, y, theta = (a + part * (b - a) for a, b in zip(begin, end, strict=True))
    return (x, y, theta)


def to_ns(seconds: float) -> int:
    """Seconds as whole nanoseconds."""
    return round(seconds * SECOND)
