"""Recent poses of all moving bodies, because the laser and other bodies move while a scan is measured.

A trail is a list of legs. On a leg with a course, a body follows one command, and any pose is computed exactly from the
start of the leg, regardless of other queries. For a body in contact, the trail contains the poses at the ends of the
physics steps, with straight lines between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import cos_sin
from rosmini.core.geometry.poses import Pose

Floats = NDArray[np.float64]

Leg = tuple[float, Pose, Any, Any]
"""Start time [s], pose, state, and course.

Without a course the body moves straight to the start of the next leg.
"""

MAX_ARC_TURN = 1.0
"""Larger turns [rad] are divided into several arcs."""

POSE_TOLERANCE = 1e-11
"""Poses that differ by less [m, rad] count as equal."""

PoseOnLeg = Callable[[Leg, float], Pose]
"""Returns the pose a number of seconds after the beginning of a leg with a course."""


class Trails:
    """The trails of all moving bodies in one engine, by name.

    Nothing is recorded until `remember` sets the duration.
    """

    def __init__(self) -> None:
        self.span = 0.0
        """Duration [s] for which poses are kept."""
        self._legs: dict[str, list[Leg]] = {}

    def remember(self, seconds: float) -> None:
        """Keep the poses of at least this many seconds."""
        self.span = max(self.span, seconds)

    def set_course(self, name: str, now: float, pose: Pose, state: Any, course: Any) -> None:
        """Begin a leg with a course at `pose`, unless the current leg has the same course."""
        legs = self._legs.setdefault(name, [])
        if not legs or legs[-1][3] != course:
            self._add(legs, (now, pose, state, course))

    def add_pose(self, name: str, now: float, pose: Pose) -> None:
        """Record the pose of a body in contact."""
        self._add(self._legs.setdefault(name, []), (now, pose, None, None))

    def _add(self, legs: list[Leg], leg: Leg) -> None:
        legs.append(leg)
        while len(legs) > 1 and legs[1][0] <= leg[0] - self.span:
            legs.pop(0)

    def forget(self, name: str) -> None:
        """Delete the trail of a body that was added, removed or put elsewhere."""
        self._legs.pop(name, None)

    def clear(self) -> None:
        """Delete all trails."""
        self._legs.clear()

    def track(
        self, name: str, times: Sequence[float], pose: Pose, pose_on_leg: PoseOnLeg | None
    ) -> tuple[Sequence[float], list[Pose]] | None:
        """Return poses at as many of the ascending `times` as are needed to describe a body's path by arcs.

        Return None if it did not move. `pose` is its pose at the last of the times, which is now. Before the beginning
        of the trail, the first pose of the trail applies.
        """
        legs = self._legs.get(name)
        if not legs:
            return None
        begin, now = times[0], times[-1]
        if legs[-1][0] <= begin and legs[-1][3] is not None and pose_on_leg is not None:
            leg = legs[-1]
            start, middle = (pose_on_leg(leg, time - leg[0]) for time in (begin, (begin + now) / 2))
            if start == middle == pose:
                return None
            if abs(pose[2] - start[2]) < MAX_ARC_TURN:
                half = arc(*start, pose[0] - start[0], pose[1] - start[1], pose[2] - start[2], 0.5)
                if max(abs(a - b) for a, b in zip(half, middle, strict=True)) < POSE_TOLERANCE:
                    return (begin, now), [start, pose]
        ends = [*(leg[:2] for leg in legs[1:]), (now, pose)]
        found: list[Pose] = []
        which = 0
        for time in times:
            while which + 1 < len(legs) and legs[which + 1][0] <= time:
                which += 1
            since, place, _, course = legs[which]
            if time <= since:
                found.append(place)
            elif course is not None and pose_on_leg is not None:
                found.append(pose_on_leg(legs[which], time - since))
            else:
                until, end = ends[which]
                part = (time - since) / (until - since) if until > since else 1.0
                x, y, theta = (a + part * (b - a) for a, b in zip(place, end, strict=True))
                found.append((x, y, theta))
        return None if all(each == pose for each in found) else (times, found)

    def state(self) -> dict[str, tuple[Leg, ...]]:
        """Return all trails."""
        return {name: tuple(legs) for name, legs in self._legs.items()}

    def restore(self, state: Mapping[str, tuple[Leg, ...]]) -> None:
        """Restore what `state` returned."""
        self._legs = {name: list(legs) for name, legs in state.items()}


def arc(x: float, y: float, theta: float, wx: float, wy: float, turn: float, part: float) -> tuple[float, float, float]:
    """Return the pose at the fraction `part` (0 to 1) of a circular arc.

    The arc starts at (x, y, theta) [m, rad], ends at (x + wx, y + wy) and turns by `turn` [rad].
    """
    half = turn / 2 if turn != 0.0 else 1e-9  # an arc with a turn this small is numerically a line
    # chords are proportional to the sine of half the turn, and that of a partial arc is rotated back by half the rest
    scale, back = math.sin(part * half) / math.sin(half), (part - 1.0) * half
    c, s = scale * math.cos(back), scale * math.sin(back)
    return x + c * wx - s * wy, y + s * wx + c * wy, theta + part * turn


def between(times: Floats, poses: Floats, when: Floats) -> Floats:
    """Return the poses (n, 3) at `when` (n,), along `arc`s between `poses` (k, 3) at ascending `times` (k,)."""
    leg = np.minimum(np.maximum(np.searchsorted(times, when, side="right") - 1, 0), len(times) - 2)
    part = (when - times[leg]) / (times[leg + 1] - times[leg])
    x, y, theta = poses[leg].T
    wx, wy, turn = (poses[leg + 1] - poses[leg]).T
    half = np.where(turn != 0.0, turn / 2, 1e-9)
    scale, back = cos_sin(part * half)[1] / cos_sin(half)[1], (part - 1.0) * half
    cos, sin = cos_sin(back)
    c, s = scale * cos, scale * sin
    return np.column_stack([x + c * wx - s * wy, y + s * wx + c * wy, theta + part * turn])
