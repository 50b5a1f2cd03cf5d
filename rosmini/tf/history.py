"""Where one frame stood in its parent over time: the newest `cache_ns` of samples, and what lies between two of them."""

from __future__ import annotations

from bisect import bisect_left
from typing import Literal, NamedTuple

from .rigid import Rigid, interpolate

Outcome = Literal["kept", "repeated", "old"]


class Sample(NamedTuple):
    """Where a frame stood in its parent at one moment, and who said so."""

    parent: str
    transform: Rigid
    authority: str


class OutOfRange(LookupError):
    """The samples say nothing about the moment that was asked for."""


class History:
    """The samples of one frame, oldest first. A static frame has one, for all times.

    Attributes:
        stamps: when [ns]; `samples` are what was there then.
        static: it does not change with time.
        steady: every sample has the same parent.

    """

    __slots__ = ("_cache_ns", "frame", "samples", "stamps", "static", "steady")

    def __init__(self, frame: str, cache_ns: int, *, static: bool) -> None:
        self.frame = frame
        self.static = static
        self.steady = True
        self.stamps: list[int] = []
        self.samples: list[Sample] = []
        self._cache_ns = cache_ns

    @property
    def newest(self) -> Sample:
        """The last sample."""
        return self.samples[-1]

    @property
    def span_ns(self) -> int:
        """From the oldest sample to the newest [ns]."""
        return self.stamps[-1] - self.stamps[0]

    @property
    def rate(self) -> float:
        """Samples a second, as tf counts them: over the time that is buffered, but at least 0.1 ms."""
        return len(self.stamps) / max(self.span_ns / 1e9, 1e-4)

    def add(self, stamp_ns: int, sample: Sample) -> Outcome:
        """Take a sample, in any order; one that is older than all that is kept, or of a moment that is there already, is refused."""
        stamps, samples = self.stamps, self.samples
        if self.static:
            self.stamps, self.samples = [stamp_ns], [sample]
            return "kept"
        same = not samples or sample.parent == samples[-1].parent
        if not stamps or stamp_ns > stamps[-1]:
            stamps.append(stamp_ns)
            samples.append(sample)
        else:
            if stamp_ns < stamps[-1] - self._cache_ns:
                return "old"
            place = bisect_left(stamps, stamp_ns)
            if stamps[place] == stamp_ns:
                return "repeated"
            stamps.insert(place, stamp_ns)
            samples.insert(place, sample)
        first = stamps[-1] - self._cache_ns
        if stamps[0] < first:
            gone = bisect_left(stamps, first)
            del stamps[:gone], samples[:gone]
        if not (self.steady and same):
            self.steady = all(other.parent == sample.parent for other in samples)
        return "kept"

    def sample_at(self, stamp_ns: int) -> Sample:
        """The sample of this moment [ns]. Raises `LookupError` if there is none."""
        place = bisect_left(self.stamps, stamp_ns)
        if self.static or place == len(self.stamps) or self.stamps[place] != stamp_ns:
            raise LookupError(stamp_ns)
        return self.samples[place]

    def parent_at(self, stamp_ns: int) -> str:
        """Under whom it was [ns]: where the parent changes between two samples, under the earlier one; the nearest at either end."""
        if self.steady:
            return self.samples[-1].parent
        place = bisect_left(self.stamps, stamp_ns)
        if place < len(self.stamps) and self.stamps[place] == stamp_ns:
            return self.samples[place].parent
        return self.samples[max(0, place - 1)].parent

    def at(self, stamp_ns: int) -> Rigid:
        """Where it stood [ns], between two samples. Raises `OutOfRange` before the oldest and after the newest."""
        stamps = self.stamps
        if self.static:
            return self.samples[0].transform
        place = bisect_left(stamps, stamp_ns)
        if place == len(stamps):
            raise OutOfRange
        after = self.samples[place]
        later = stamps[place]
        if later == stamp_ns:
            return after.transform
        if place == 0:
            raise OutOfRange
        before = self.samples[place - 1]
        if before.parent != after.parent:
            return before.transform
        earlier = stamps[place - 1]
        return interpolate(before.transform, after.transform, (stamp_ns - earlier) / (later - earlier))
