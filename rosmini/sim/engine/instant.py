"""The time of an engine, and the interface of objects with a pose."""

from __future__ import annotations

from typing import Protocol

from rosmini.core.geometry.poses import Pose

SECOND = 1_000_000_000
"""One second [ns]."""

STEP_NS = 5_000_000
"""Duration of one physics step [ns]: step k starts at k * STEP_NS."""

STEP = STEP_NS / SECOND
"""The same [s]."""


class Instant:
    """The current time, shared by all objects of an engine."""

    def __init__(self) -> None:
        self.ns = 0
        """Nanoseconds since the engine began."""
        self.seconds = 0.0
        """The same in seconds, exactly as requested: it may differ by a fraction of a nanosecond."""


class Placed(Protocol):
    """An object with a pose."""

    @property
    def pose(self) -> Pose:
        """Its current pose."""
        ...


def between_poses(begin: Pose, end: Pose, part: float) -> Pose:
    """Interpolate linearly between two poses; `part` is from 0 (`begin`) to 1 (`end`). Headings are not wrapped."""
    x, y, theta = (a + part * (b - a) for a, b in zip(begin, end, strict=True))
    return (x, y, theta)


def to_ns(seconds: float) -> int:
    """Convert seconds to whole nanoseconds."""
    return round(seconds * SECOND)
