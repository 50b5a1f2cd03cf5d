"""Policies that decide by time stamps which messages of several inputs belong together, without nodes and clocks.

A policy receives one message after another, ``add(index, stamp, message, now)``, and returns the sets that this message
completes: tuples with one message of each input, in the order of the inputs. Times are integers [ns]. No message is
output twice. The rules are those of the Python client, http://wiki.ros.org/message_filters; the C++ client's
approximate policy is different.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, ClassVar

from .filters import MessageFilterError, check_size

Queue = dict[int, Any]
"""Messages that wait for partners, by stamp, in order of arrival."""


class Policy(ABC):
    """Keeps up to ``queue_size`` messages of each of ``count`` inputs, and drops those with the oldest stamps.

    A message replaces one of the same input and stamp. With ``reset``, a message that arrives at an earlier clock time
    than the previous message of its input empties the queue of that input first. After such a jump, no sets are
    returned until every input with a later arrival time has received a message again.

    Raises ``MessageFilterError`` for no inputs and for a ``queue_size`` below 1.
    """

    _forgets_all: ClassVar = False
    """If True, a clock that goes back empties all queues without ``reset`` too, including the last message."""

    def __init__(self, count: int, queue_size: int, *, reset: bool = False) -> None:
        if count < 1:
            raise MessageFilterError("there is nothing to synchronise: give a list of filters, one for each topic")
        self.queue_size = check_size("queue_size", queue_size)
        self.reset = reset
        self.queues: list[Queue] = [{} for _ in range(count)]
        self._arrivals = [0] * count
        self._last = 0

    def add(self, index: int, stamp: int, message: Any, now: int = 0) -> list[tuple[Any, ...]]:
        """Add a message of input ``index``, received at ``now``; return the sets that it completes, oldest first."""
        queue = self.queues[index]
        if self.reset and now < self._arrivals[index]:
            queue.clear()
        self._arrivals[index] = now
        queue[stamp] = message
        if self._forgets_all and now < self._last:
            for each in self.queues:
                each.clear()
        self._last = now
        while len(queue) > self.queue_size:
            del queue[min(queue)]
        if self.reset and max(self._arrivals) != now:
            return []
        return [
            tuple(waiting.pop(when) for waiting, when in zip(self.queues, stamps, strict=True))
            for stamps in self._matches(index, stamp)
        ]

    @abstractmethod
    def _matches(self, index: int, stamp: int) -> list[Sequence[int]]:
        """Return the stamps of the sets that are complete after ``stamp`` has arrived from input ``index``."""


class ExactTime(Policy):
    """Combines messages with the same stamp.

    If the stamps of each input increase, those of the sets do too.
    """

    def _matches(self, index: int, stamp: int) -> list[Sequence[int]]:  # noqa: ARG002 - a reset may have delayed others
        common = set.intersection(*(set(queue) for queue in self.queues))
        return [(when,) * len(self.queues) for when in sorted(common)]


class ApproximateTime(Policy):
    """Combines messages whose stamps are all less than ``slop`` nanoseconds apart.

    Each new message looks for partners among the waiting ones, starting with the closest stamps, and takes
    the first set that is close enough: a message does not wait for a better partner that may come later. A clock
    that goes back empties all queues, and the message that reveals it is lost too.

    If the stamps of each input increase by more than ``slop`` from message to message, those of the sets increase
    in each input; with a larger slop, a late message may be paired with an old one that was skipped. Raises
    ``MessageFilterError`` for a slop that is not positive, which would never match anything.
    """

    _forgets_all = True

    def __init__(self, count: int, queue_size: int, slop: int, *, reset: bool = False) -> None:
        super().__init__(count, queue_size, reset=reset)
        if not slop > 0:
            raise MessageFilterError(
                f"slop is {slop / 1e9} s; it must be positive: stamps that differ by less match. "
                "Use TimeSynchronizer for stamps that are equal"
            )
        self.slop = slop

    def _matches(self, index: int, stamp: int) -> list[Sequence[int]]:
        if stamp not in self.queues[index]:  # older than all messages in the full queue
            return []
        choices = [
            [stamp]
            if number == index
            else sorted(
                (other for other in queue if abs(other - stamp) <= self.slop), key=lambda other: abs(other - stamp)
            )
            for number, queue in enumerate(self.queues)
        ]
        found = self._first_close_set(choices, (), stamp, stamp)
        return [] if found is None else [found]

    def _first_close_set(
        self, choices: list[list[int]], chosen: tuple[int, ...], low: int, high: int
    ) -> tuple[int, ...] | None:
        """Return the first combination of stamps within the slop, in the order of `itertools.product`, or None."""
        if high - low >= self.slop:
            return None
        if len(chosen) == len(choices):
            return chosen
        for one in choices[len(chosen)]:
            found = self._first_close_set(choices, (*chosen, one), min(low, one), max(high, one))
            if found is not None:
                return found
        return None
