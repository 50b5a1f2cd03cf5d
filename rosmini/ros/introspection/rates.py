"""Statistics of message rate, delay and size, for ``rostopic hz``, ``delay`` and ``bw``."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from typing import NamedTuple

MAX_WINDOW = 50_000
"""Number of messages in a window without a limit."""


class Statistics(NamedTuple):
    """Mean, minimum, maximum and standard deviation of some durations [s], and the number of messages."""

    mean: float
    smallest: float
    largest: float
    deviation: float
    window: int

    @property
    def rate(self) -> float:
        """Messages per second, if the durations are those between messages."""
        return 1 / self.mean if self.mean > 0 else 0.0


class Samples:
    """The last of some durations [ns]; ``window`` is the maximum number of messages (negative: very many)."""

    def __init__(self, window: int) -> None:
        size = MAX_WINDOW if window < 0 else window
        self.values: deque[int] = deque(maxlen=max(size - 1, 0))
        self._last: int | None = None
        self._last_reported: int | None = None

    def tick(self, now_ns: int) -> int | None:
        """Record a message's arrival; return the time since the last one, None for the first and if time jumps back.

        A jump back discards earlier samples. At time zero, which means that no time is known yet, nothing counts.
        """
        last, self._last = self._last, now_ns or None
        if last is None or now_ns < last:
            self.values.clear()
            return None
        return now_ns - last

    def statistics(self) -> Statistics | None:
        """Return the statistics; None if no message came since the last call."""
        if not self.values or self._last == self._last_reported:
            return None
        self._last_reported = self._last
        values = self.values
        count = len(values)
        mean = sum(values) / count
        deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / count)
        return Statistics(mean / 1e9, min(values) / 1e9, max(values) / 1e9, deviation / 1e9, count + 1)


class Arrivals(Samples):
    """Times between messages."""

    def heard(self, now_ns: int) -> None:
        """Record the arrival of a message at a time."""
        span = self.tick(now_ns)
        if span is not None:
            self.values.append(span)


class Delays(Samples):
    """Delays between the stamps of messages and their arrival."""

    def heard(self, now_ns: int, stamp_ns: int) -> None:
        """Record the arrival of a message with a stamp at a time."""
        if self.tick(now_ns) is not None:
            self.values.append(now_ns - stamp_ns)


class Weight(NamedTuple):
    """Bytes per second, and the mean, smallest and largest size [B] of ``window`` messages."""

    rate: float
    mean: float
    smallest: float
    largest: float
    window: int

    def __str__(self) -> str:
        unit, name = next(
            ((size, name) for size, name in ((1, "B"), (1000, "KB")) if self.rate < 1000 * size), (1_000_000, "MB")
        )
        rate, mean, smallest, largest = (f"{value / unit:.2f}{name}" for value in self[:4])
        return f"average: {rate}/s\n\tmean: {mean} min: {smallest} max: {largest} window: {self.window}"


class Sizes:
    """Sizes and arrival times of the last messages."""

    def __init__(self, window: int) -> None:
        self._heard: deque[tuple[float, int]] = deque(maxlen=window)

    def heard(self, now: float, size: int) -> None:
        """Record the arrival of a message of a size [B] at a time [s]."""
        self._heard.append((now, size))

    def weight(self, now: float) -> Weight | None:
        """Return the statistics at a time; None before the second message."""
        sizes = [size for _, size in self._heard]
        if len(sizes) < 2 or now <= self._heard[0][0]:
            return None
        total = sum(sizes)
        return Weight(total / (now - self._heard[0][0]), total / len(sizes), min(sizes), max(sizes), len(sizes))


def rate_text(found: Statistics) -> str:
    """Return the output of ``rostopic hz`` for one topic."""
    return f"average rate: {found.rate:.3f}\n\t{_spread(found)}"


def delay_text(found: Statistics) -> str:
    """Return the output of ``rostopic delay``."""
    return f"average delay: {found.mean:.3f}\n\t{_spread(found)}"


def _spread(found: Statistics) -> str:
    low, high, deviation = f"{found.smallest:.3f}s", f"{found.largest:.3f}s", f"{found.deviation:.5f}s"
    return f"min: {low} max: {high} std dev: {deviation} window: {found.window}"


def rate_table(found: Mapping[str, Statistics]) -> str:
    """Return the table of ``rostopic hz`` for several topics."""
    header = ("topic", "rate", "min_delta", "max_delta", "std_dev", "window")
    rows = [
        (topic, *(f"{value:.4}" for value in (one.rate, one.smallest, one.largest, one.deviation)), str(one.window))
        for topic, one in found.items()
    ]
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]

    def joined(cells: Sequence[str]) -> str:
        return "   ".join(cells)

    head = joined([title.center(width) for title, width in zip(header, widths, strict=True)])
    body = [joined([cell.ljust(width) for cell, width in zip(row, widths, strict=True)]) for row in rows]
    return "\n".join([head, "=" * (sum(widths) + 3 * (len(header) - 1)), *body]) + "\n"
