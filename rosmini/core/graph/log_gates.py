"""Which log calls pass: once, throttled, or only what is new (http://wiki.ros.org/rospy/Overview/Logging)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Hashable

__all__ = ["LogGates"]


class LogGates:
    """What was logged before, by the place of the program that logs."""

    def __init__(self) -> None:
        self._times: dict[Hashable, int] = {}
        self._texts: dict[Hashable, str] = {}
        self._seen: set[Hashable] = set()

    def is_due(self, where: Hashable, now_ns: int, period_ns: int) -> bool:
        """Tell whether more than ``period_ns`` have passed since this place was due; also when time has jumped back."""
        last = self._times.get(where)
        if last is not None and last <= now_ns <= last + period_ns:
            return False
        self._times[where] = now_ns
        return True

    def is_new(self, where: Hashable, text: str) -> bool:
        """Tell whether this place logs another text than last time."""
        changed = self._texts.get(where) != text
        self._texts[where] = text
        return changed

    def is_first(self, where: Hashable) -> bool:
        """Tell whether this place logs for the first time."""
        fresh = where not in self._seen
        self._seen.add(where)
        return fresh
