"""Where all that moves was lately: what a laser needs that takes its time for one revolution, while it and others move on.

A trail is a list of legs. On a leg a robot goes on as its wheels were told, so that each of its poses follows from where it began, exactly and whoever asked
in between. Where something is pushed, or pushes, its poses are those at the ends of the steps of the physics, and it went straight from one to the next.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose

Floats = NDArray[np.float64]

Leg = tuple[float, Pose, Any, Any]
"""Since when [s], from where on, in which state, and on which course; without a course it goes straight to where the next leg begins."""

Later = Callable[[Leg, float], Pose]
"""Where something is so long [s] after the begin of a leg with a course."""


class Trails:
    """The trails of all that moves in one engine, by name. Nothing is written down until somebody says how long it is to be remembered."""

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

    def track(self, name: str, times: Iterable[float], now: float, pose: Pose, later: Later | None) -> Floats:
        """Where something was at ascending times (n, 3), of which none is after `now`; it is at `pose` now. Before its trail begins, it was where that begins."""
        legs = self._legs.get(name)
        if not legs:
            return np.array([pose for _ in times])
        ends = [*(leg[:2] for leg in legs[1:]), (now, pose)]
        found: list[Pose] = []
        which = 0
        for time in times:
            while which + 1 < len(legs) and legs[which + 1][0] <= time:
                which += 1
            since, begin, _, course = legs[which]
            if time <= since:
                found.append(begin)
            elif course is not None and later is not None:
                found.append(later(legs[which], time - since))
            else:
                until, end = ends[which]
                part = (time - since) / (until - since) if until > since else 1.0
                x, y, theta = (a + part * (b - a) for a, b in zip(begin, end, strict=True))
                found.append((x, y, theta))
        return np.array(found)

    def state(self) -> dict[str, tuple[Leg, ...]]:
        """All of them, to come back to."""
        return {name: tuple(legs) for name, legs in self._legs.items()}

    def restore(self, state: Mapping[str, tuple[Leg, ...]]) -> None:
        """Remember what was remembered then."""
        self._legs = {name: list(legs) for name, legs in state.items()}


def between(times: Floats, poses: Floats, when: Floats) -> Floats:
    """Poses (n, 3) at `when` (n,), of what moved along an arc from each of `poses` (k, 3), at ascending `times` (k,), to the next: exact where its speeds were constant."""
    leg = np.minimum(np.maximum(np.searchsorted(times, when, side="right") - 1, 0), len(times) - 2)
    part = (when - times[leg]) / (times[leg + 1] - times[leg])
    begin = poses[leg]
    way = poses[leg + 1] - begin
    half = np.where(way[:, 2] == 0.0, 1e-9, way[:, 2] / 2)  # a line is an arc that nobody can tell from one
    # chords of an arc are as the sines of half the turns, and a part of it is turned back by what is left of the turn
    scale = np.sin(part * half) / np.sin(half)
    back = (part - 1) * half
    c, s = scale * np.cos(back), scale * np.sin(back)
    return np.column_stack(
        [
            begin[:, 0] + c * way[:, 0] - s * way[:, 1],
            begin[:, 1] + s * way[:, 0] + c * way[:, 1],
            begin[:, 2] + part * way[:, 2],
        ]
    )
