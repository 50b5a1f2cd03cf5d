"""Where all that moves was lately: what a laser needs that moves on during a revolution, as others do.

A trail is a list of legs. On a leg a robot goes on as its wheels were told, so that each of its poses follows from
where it began, exactly and whoever asked in between. Where something is pushed, or pushes, its poses are those at the
ends of the steps of the physics, and it went straight from one to the next.
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
"""Since when [s], from where on, in which state, and on which course.

Without a course it goes straight to where the next leg begins.
"""

WIDE = 1.0
"""Turns beyond this [rad] are followed in several arcs."""

SAME = 1e-11
"""Poses that differ by less [m, rad] are the same."""

Later = Callable[[Leg, float], Pose]
"""Where something is so long [s] after the begin of a leg with a course."""


class Trails:
    """The trails of all that moves in one engine, by name.

    Nothing is written down until somebody says how long it is to be remembered.
    """

    def __init__(self) -> None:
        self.span = 0.0
        """So long they are remembered [s]."""
        self._legs: dict[str, list[Leg]] = {}

    def remember(self, seconds: float) -> None:
        """Remember at least so much."""
        self.span = max(self.span, seconds)

    def goes(self, name: str, now: float, pose: Pose, state: Any, course: Any) -> None:
        """Note that something goes on from here on a course, if it was not on it before."""
        legs = self._legs.setdefault(name, [])
        if not legs or legs[-1][3] != course:
            self._add(legs, (now, pose, state, course))

    def carried(self, name: str, now: float, pose: Pose) -> None:
        """Note where something is that touches something."""
        self._add(self._legs.setdefault(name, []), (now, pose, None, None))

    def _add(self, legs: list[Leg], leg: Leg) -> None:
        legs.append(leg)
        while len(legs) > 1 and legs[1][0] <= leg[0] - self.span:
            legs.pop(0)

    def forget(self, name: str) -> None:
        """Let it be as if something had always been where it is: it came, went, or was put there."""
        self._legs.pop(name, None)

    def clear(self) -> None:
        """Forget them all."""
        self._legs.clear()

    def track(
        self, name: str, times: Sequence[float], pose: Pose, later: Later | None
    ) -> tuple[Sequence[float], list[Pose]] | None:
        """Return where something was at enough of the ascending `times` to know its way by arcs.

        None if it stood still. It is at `pose` at the last of them, which is now. Before its trail begins, it was where
        that begins.
        """
        legs = self._legs.get(name)
        if not legs:
            return None
        begin, now = times[0], times[-1]
        if legs[-1][0] <= begin and legs[-1][3] is not None and later is not None:
            leg = legs[-1]
            start, middle = (later(leg, time - leg[0]) for time in (begin, (begin + now) / 2))
            if start == middle == pose:
                return None
            if abs(pose[2] - start[2]) < WIDE:
                half = arc(*start, pose[0] - start[0], pose[1] - start[1], pose[2] - start[2], 0.5)
                if max(abs(a - b) for a, b in zip(half, middle, strict=True)) < SAME:
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
            elif course is not None and later is not None:
                found.append(later(legs[which], time - since))
            else:
                until, end = ends[which]
                part = (time - since) / (until - since) if until > since else 1.0
                x, y, theta = (a + part * (b - a) for a, b in zip(place, end, strict=True))
                found.append((x, y, theta))
        return None if all(each == pose for each in found) else (times, found)

    def state(self) -> dict[str, tuple[Leg, ...]]:
        """All of them, to come back to."""
        return {name: tuple(legs) for name, legs in self._legs.items()}

    def restore(self, state: Mapping[str, tuple[Leg, ...]]) -> None:
        """Remember what was remembered then."""
        self._legs = {name: list(legs) for name, legs in state.items()}


def arc(
    x: float, y: float, theta: float, wx: float, wy: float, turn: float, part: float
) -> tuple[float, float, float]:
    """Return the pose after a part of an arc that leads from (x, y, theta) on by (wx, wy, turn)."""
    half = turn / 2 if turn != 0.0 else 1e-9  # a line is an arc that nobody can tell from one
    # chords of an arc are as the sines of half the turns, and a part of it is turned back by what is left of the turn
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
