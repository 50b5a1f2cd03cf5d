"""Wrong answers to the exercises of the chapter How rosmini works."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable


def _scheduler(key: Callable[[Any], Any], *, adds: bool = True, end: Any = None) -> Callable[[Any], Any]:
    def run_events(events: Any) -> Any:
        numbers = count()
        queue = [(when, next(numbers), function) for when, function in events]
        now = None
        while queue:
            queue.sort(key=key)
            now, _, function = queue.pop(0)
            new = function(now)
            if adds:
                queue += [(when, next(numbers), function) for when, function in new]
        return end or now

    return run_events


def _differs(make: Callable[[], list[Any]]) -> int | None:
    one, other = make(), make()
    return next((i for i, (x, y) in enumerate(zip(one, other, strict=False)) if x != y), None)


MISTAKES = {
    "event_queue": [
        lambda: _scheduler(lambda event: event[1]),
        lambda: _scheduler(lambda event: (event[0], -event[1])),
        lambda: _scheduler(lambda event: event[:2], adds=False),
        lambda: _scheduler(lambda event: event[:2], end=3.0),
        lambda: lambda events: [function(0.0) for _, function in events],
    ],
    "lane_order": [
        lambda: "a1 b1 b2 b3 a2",
        lambda: "a1 a2 b1 b2 b3",
        lambda: "b1 a1 b2 a2 b3",
        lambda: "a1 b1 b2 a2",
        lambda: ["a1", "b1", "b2", "a2", "b3"],
    ],
    "first_difference": [
        lambda: _differs,
        lambda: lambda make: make() != make(),
        lambda: lambda make: 2,
        lambda: lambda make: next((i for i, x in enumerate(make()) if x not in make()), None),
    ],
}
