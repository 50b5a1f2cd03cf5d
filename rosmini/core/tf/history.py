"""The samples of all frames of a tree, in flat arrays that `kernel.walk` reads, and the history of each frame."""

from __future__ import annotations

import struct
from typing import Any, Literal, NamedTuple

from rosmini.core.lazy import np

from .kernel import PARENT_SHIFT, Rigid, find

Outcome = Literal["kept", "repeated", "old"]

_PACK = struct.Struct("=7d")
_NEVER = -(1 << 63)
_ROOM = 8
"""Initial capacity of a moving frame [samples]; doubled when it is full."""


class Sample(NamedTuple):
    """The parent frame of a sample, and the node that sent it (its authority)."""

    parent: str
    authority: str


class Samples:
    """The samples of the frames of one tree; those of one frame are contiguous.

    Attributes:
        stamps: the time of each sample [ns].
        origins: parent and broadcaster of each sample: numbers that `source_of` translates.
        values: the transforms, seven numbers each.
        spans: for each frame the start and end of its samples, and 1 if it is static.
        columns: these four in the form for `walk`: memoryviews, or arrays for numba.

    """

    def __init__(self) -> None:
        self.compiled = False
        self._origins: dict[tuple[str, str], int] = {}
        self._sources: list[Sample] = []
        self._parents: dict[str, int] = {}
        self._free: dict[int, list[int]] = {}
        self._free_frames: list[int] = []
        self._frames = self._used = 0
        self._arrays: list[Any] = [np.zeros(0, dtype=kind) for kind in ("i8", "i8", "f8", "i8")]
        self._share()

    def _share(self) -> None:
        # Reading and writing elements of a memoryview is faster than those of an array.
        self.stamps, self.origins, self.values, self.spans = views = [array.data for array in self._arrays]
        self.columns = self._arrays if self.compiled else views

    def use_arrays(self) -> None:
        """Use arrays for `columns` from now on."""
        self.compiled = True
        self._share()

    def _grow(self, number: int, size: int) -> None:
        """Extend the array at index `number` to at least `size` elements."""
        old = self._arrays[number]
        if len(old) < size:
            self._arrays[number] = np.zeros(max(size, 2 * len(old)), dtype=old.dtype)
            self._arrays[number][: len(old)] = old

    def add_frame(self, *, static: bool, room: int) -> tuple[int, int]:
        """Allocate space for `room` samples of a new frame; return its number and the index of the first sample."""
        if self._free_frames:
            frame = self._free_frames.pop()
        else:
            frame, self._frames = self._frames, self._frames + 1
            self._grow(3, 3 * self._frames)
        begin = self.allocate(room)
        self.spans[3 * frame + 2] = static
        self.set_span(frame, begin, begin)
        return frame, begin

    def set_span(self, frame: int, begin: int, end: int) -> None:
        """Set the start and end of a frame's samples."""
        self.spans[3 * frame], self.spans[3 * frame + 1] = begin, end

    def remove_frame(self, frame: int) -> None:
        """Release a frame's number for reuse."""
        self._free_frames.append(frame)

    def allocate(self, room: int) -> int:
        """Allocate `room` contiguous samples; return the index of the first one."""
        free = self._free.get(room)
        begin = free.pop() if free else self._used
        if begin == self._used:
            self._used += room
            for number, width in enumerate((1, 1, 7)):
                self._grow(number, width * self._used)
        self._share()
        return begin

    def release(self, begin: int, room: int) -> None:
        """Release the `room` samples that start at `begin` for reuse."""
        self._free.setdefault(room, []).append(begin)

    def move(self, begin: int, end: int, to: int) -> None:
        """Move the samples `begin:end` to the index `to`; source and destination may overlap."""
        for array, width in zip(self._arrays, (1, 1, 7), strict=False):
            array[width * to : width * (to + end - begin)] = array[width * begin : width * end]

    def origin(self, parent: str, authority: str) -> int:
        """Return the number for a parent and an authority; `PARENT_SHIFT` describes its bits."""
        found = self._origins.get((parent, authority))
        if found is None:
            number = self._parents.setdefault(parent, len(self._parents))
            found = self._origins[parent, authority] = number << PARENT_SHIFT | len(self._sources)
            self._sources.append(Sample(parent, authority))
        return found

    def source_of(self, origin: int) -> Sample:
        """Return the parent and the authority for a number from `origin`."""
        return self._sources[origin & ((1 << PARENT_SHIFT) - 1)]


class History:
    """The samples of one frame over the newest `cache_ns`, oldest first. A static frame has one, for all times.

    Attributes:
        newest: parent and broadcaster of the newest sample.
        newest_ns: the time of the newest sample [ns].
        number: its index in `Samples.spans`.
        static: True if it does not change with time.
        steady: True if all samples have the same parent.

    """

    __slots__ = (
        "_begin",
        "_cache_ns",
        "_end",
        "_limit",
        "_origin",
        "_room",
        "_samples",
        "frame",
        "newest",
        "newest_ns",
        "number",
        "static",
        "steady",
    )

    def __init__(
        self, frame: str, samples: Samples, cache_ns: int, parent: str, authority: str, *, static: bool
    ) -> None:
        self.frame = frame
        self.static = static
        self.steady = True
        self.newest = Sample(parent, authority)
        self.newest_ns = _NEVER
        self._samples = samples
        self._cache_ns = cache_ns
        self._room = 1 if static else _ROOM
        self.number, self._begin = samples.add_frame(static=static, room=self._room)
        self._end, self._limit = self._begin, self._begin + self._room
        self._origin = samples.origin(parent, authority)

    def __len__(self) -> int:
        return self._end - self._begin

    @property
    def oldest_ns(self) -> int:
        """Time of the oldest sample [ns]."""
        oldest: int = self._samples.stamps[self._begin]
        return oldest

    @property
    def span_ns(self) -> int:
        """Time between the oldest and the newest sample [ns]."""
        return self.newest_ns - self.oldest_ns

    @property
    def rate(self) -> float:
        """Samples per second, as tf calculates it: divided by the buffered time, or by 0.1 ms if that is shorter."""
        return len(self) / max(self.span_ns / 1e9, 1e-4)

    def add(self, parent: str, transform: Rigid, stamp_ns: int, authority: str) -> Outcome:
        """Add a sample, in any order, and return "kept"; in a static frame it replaces the old one.

        Returns "old" for a sample older than the history, and "repeated" for one with the stamp of another.
        """
        samples = self._samples
        before, origin = self.newest, self._origin
        known = parent == before.parent and authority == before.authority
        if not known:
            origin = samples.origin(parent, authority)
        place = self._end
        if stamp_ns > self.newest_ns or self.static:
            if self.static:
                place = self._begin
            elif place == self._limit:
                self._make_room()
                place = self._end
            self.newest_ns = stamp_ns
            if not known:
                self.newest, self._origin = samples.source_of(origin), origin
        else:
            if stamp_ns < self.newest_ns - self._cache_ns:
                return "old"
            place = find(samples.stamps, self._begin, place, stamp_ns)
            if samples.stamps[place] == stamp_ns:
                return "repeated"
            if self._end == self._limit:
                after = place - self._begin
                self._make_room()
                place = self._begin + after
            samples.move(place, self._end, place + 1)
        stamps = samples.stamps
        stamps[place] = stamp_ns
        samples.origins[place] = origin
        _PACK.pack_into(samples.values, 56 * place, *transform)
        if not self.static or self._end == self._begin:
            self._end += 1
            samples.spans[3 * self.number + 1] = self._end
        oldest = self.newest_ns - self._cache_ns
        if stamps[self._begin] < oldest and not self.static:
            self._begin = find(stamps, self._begin, self._end, oldest)
            samples.spans[3 * self.number] = self._begin
        if not (self.steady and parent == before.parent):
            kept = samples.origins[self._begin : self._end]
            self.steady = all(one >> PARENT_SHIFT == origin >> PARENT_SHIFT for one in kept)
        return "kept"

    def _make_room(self) -> None:
        """Move to the start of the space, or to one of twice the size if this one is more than half full."""
        samples, room = self._samples, self._room
        count, first = self._end - self._begin, self._limit - room
        if 2 * count > room:
            samples.release(first, room)
            self._room *= 2
            first = samples.allocate(self._room)
        samples.move(self._begin, self._end, first)
        self._begin, self._end, self._limit = first, first + count, first + self._room
        samples.set_span(self.number, self._begin, self._end)

    def forget(self) -> None:
        """Release the space; this history cannot be used any more."""
        self._samples.release(self._limit - self._room, self._room)
        self._samples.remove_frame(self.number)

    def sample_at(self, stamp_ns: int) -> Sample:
        """Return parent and authority of the sample at this time [ns]. Raises `LookupError` if there is none."""
        place = find(self._samples.stamps, self._begin, self._end, stamp_ns)
        if self.static or place == self._end or self._samples.stamps[place] != stamp_ns:
            raise LookupError(stamp_ns)
        return self._samples.source_of(self._samples.origins[place])

    def parent_at(self, stamp_ns: int) -> str:
        """Return the parent at a time [ns]; between two samples, that of the earlier one.

        Outside the history, that of the nearest sample.
        """
        if self.steady:
            return self.newest.parent
        samples = self._samples
        place = find(samples.stamps, self._begin, self._end, stamp_ns)
        if place == self._end or samples.stamps[place] != stamp_ns:
            place = max(self._begin, place - 1)
        return samples.source_of(samples.origins[place]).parent
