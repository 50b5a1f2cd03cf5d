"""Wrong answers to the exercises of the chapter Local planners."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable


def window(velocity, limits, accelerations, period):
    (v, w), (least, most, turn) = velocity, limits
    gain_v, gain_w = accelerations[0] * period, accelerations[1] * period
    return max(v - gain_v, least), min(v + gain_v, most), max(w - gain_w, -turn), min(w + gain_w, turn)


def _unlimited(velocity, limits, accelerations, period):
    (v, w), gains = velocity, [a * period for a in accelerations]
    return v - gains[0], v + gains[0], w - gains[1], w + gains[1]


def _with(**changed: Any) -> Callable[..., Any]:
    def answer(velocity, limits, accelerations, period):
        given = {"velocity": velocity, "limits": limits, "accelerations": accelerations, "period": period}
        return window(**{**given, **{name: change(given[name]) for name, change in changed.items()}})

    return answer


def _manners(nearest, cost):
    def manners(trajectory, person):
        distances = np.hypot(*(trajectory[:, :2] - person).T)
        distance = nearest(distances)
        return -1 if distance < 0.4 else cost(distance)

    return manners


def _refused(raw, weights, skip=True, last=False):
    found = []
    for row in raw:
        critics = [n for n, given in enumerate(row) if given < 0 and (weights[n] or not skip)]
        found.append(critics[-1 if last else 0] if critics else None)
    return found


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "window": [
        lambda: _unlimited,
        lambda: _with(period=lambda _: 0.1),
        lambda: _with(limits=lambda given: (0.0, *given[1:])),
        lambda: _with(limits=lambda given: (*given[:2], 9.0)),
        lambda: _with(accelerations=lambda given: given[::-1]),
        lambda: lambda *given: window(*given)[:2],
        lambda: lambda *_: 0.1,
    ],
    "manners": [
        lambda: _manners(lambda d: d[-1], lambda d: max(0.0, (1 - d) / 0.6)),
        lambda: _manners(lambda d: d[0], lambda d: max(0.0, (1 - d) / 0.6)),
        lambda: _manners(np.mean, lambda d: max(0.0, (1 - d) / 0.6)),
        lambda: _manners(np.min, lambda d: (1 - d) / 0.6),
        lambda: _manners(np.min, lambda d: max(0.0, 1 - d)),
        lambda: _manners(np.min, lambda d: 0.0),
        lambda: lambda *_: [0.0],
    ],
    "refused_by": [
        lambda: lambda raw, weights: _refused(raw, weights, skip=False),
        lambda: lambda raw, weights: _refused(raw, weights, last=True),
        lambda: lambda raw, weights: [found or None for found in _refused(raw, weights)],
        lambda: lambda raw, weights: [found for found in _refused(raw, weights) if found is not None],
        lambda: lambda raw, weights: np.array([-1 if n is None else n for n in _refused(raw, weights)]),
    ],
    "changes": [
        lambda: {"min_vel_theta": 1.2},
        lambda: {"yaw_goal_tolerance": 0.3},
        lambda: {"min_vel_thet": 0.3},
        lambda: {"min_vel_theta": "slow"},
        lambda: {"xy_goal_tolerance": 0.2},
        lambda: 0.3,
    ],
}
