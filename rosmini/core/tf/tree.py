"""The tree of frames: who stands where in whom, and where that is in any other frame (http://wiki.ros.org/tf2).

Plain numbers in and out: names, times in whole nanoseconds, transforms as `Rigid`. No node, no message, no clock.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from .errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from .history import History, Samples
from .kernel import FOUND, IDENTITY, Rigid, compiled_walk, compose, walk
from .wording import Complaints, Words

CACHE_NS = 10_000_000_000
"""How much of the past is kept [ns], if nothing else is asked for: tf's 10 s."""

LATEST = 0
"""The time that stands for the latest at which the whole chain is known: `Time(0)`."""

PATHS_KEPT = 4096

LOOKUPS_TO_LOAD = 50_000
"""After so many lookups the walk is compiled.

Loading numba and the code takes 1.6 s, which is what so many lookups take in plain Python.
"""

LOOKUPS_LOADED = 1_000
"""Number of lookups from which the kernel is compiled if numba is loaded: 0.1 s to load, once 0.8 s to compile."""


class Found(NamedTuple):
    """A transform and the time for which it holds [ns]; 0 where nothing on the way moves."""

    transform: Rigid
    stamp_ns: int


class Path(NamedTuple):
    """The edges from a source frame up to a common ancestor, and from the target frame up to it."""

    source: tuple[History, ...]
    target: tuple[History, ...]
    way: Any
    """The numbers of all of them, for `walk`."""


class FrameTree:
    """Frames, each under its parent, over time.

    Args:
        cache_ns: how much of the past is kept [ns].
        warn: is told of data that are refused, once for each frame and reason.
        now_ns: tells the time; only messages of errors look at it.

    """

    def __init__(
        self,
        cache_ns: int = CACHE_NS,
        *,
        warn: Callable[[str], object] | None = None,
        now_ns: Callable[[], int] | None = None,
    ) -> None:
        self.cache_ns = cache_ns
        self.edges: dict[str, History] = {}
        """What is known of each frame that has a parent, by its name."""
        self._samples = Samples()
        self._walk: Callable[..., tuple[int, int, Rigid]] = walk
        self._slow_lookups = 0
        self._roots: dict[str, None] = {}
        self._paths: dict[tuple[str, str], Path] = {}
        self._wandering = False
        self._complaints = Complaints(warn or (lambda _text: None))
        self._words = Words(self, now_ns)

    # -- what is told -------------------------------------------------------------------------------------------

    def set(
        self,
        parent: str,
        child: str,
        transform: Rigid,
        stamp_ns: int,
        authority: str = "",
        *,
        static: bool = False,
    ) -> bool:
        """Take the transform of `child` in `parent` at a moment [ns], told by `authority`; whether it was taken.

        As in tf, what cannot be right (a frame under itself, no name, nan, a quaternion that is no rotation) is refused
        with a warning and not with an error, so are a moment that is there already and one that is too long ago. A
        frame that was static at first stays so.
        """
        reason = self._complaints.check(parent, child, transform)
        if reason is not None:
            self._complaints.say(child, authority, reason)
            return False
        history = self.edges.get(child)
        if history is None:
            history = self.edges[child] = History(
                child, self._samples, self.cache_ns, parent, authority, static=static
            )
            self._structure_changed(parent, child)
        elif history.newest.parent != parent:
            self._complaints.two_parents(history, parent, authority)
            self._structure_changed(parent, child)
        was_steady = history.steady
        outcome = history.add(parent, transform, stamp_ns, authority)
        if history.steady != was_steady:
            self._wandering = not all(other.steady for other in self.edges.values())
        if outcome == "repeated":
            self._complaints.repeated(history, stamp_ns, authority)
        elif outcome == "old":
            self._complaints.old(history, stamp_ns, authority)
        return outcome == "kept"

    def _structure_changed(self, parent: str, child: str) -> None:
        self._paths.clear()
        self._roots.pop(child, None)
        if parent not in self.edges:
            self._roots[parent] = None

    def clear(self) -> None:
        """Forget what moves, as tf does when time jumps back; static frames stay."""
        for edge in self.edges.values():
            if not edge.static:
                edge.forget()
        self.edges = {frame: edge for frame, edge in self.edges.items() if edge.static}
        self._roots = dict.fromkeys(
            edge.newest.parent for edge in self.edges.values() if edge.newest.parent not in self.edges
        )
        self._paths.clear()
        self._wandering = False

    # -- what is there -------------------------------------------------------------------------------------------

    def __contains__(self, frame: object) -> bool:
        return frame in self.edges or frame in self._roots

    def __iter__(self) -> Iterator[str]:
        """All frames: those without a parent first."""
        self._roots = {root: None for root in self._roots if root not in self.edges}
        yield from self._roots
        yield from self.edges

    def parent(self, frame: str) -> str | None:
        """Under whom a frame is by its newest sample; None for a root."""
        history = self.edges.get(frame)
        return None if history is None else history.newest.parent

    def children(self) -> dict[str, list[str]]:
        """The frames under each frame, sorted."""
        found: dict[str, list[str]] = {}
        for frame, history in sorted(self.edges.items()):
            found.setdefault(history.newest.parent, []).append(frame)
        return found

    def root(self, frame: str) -> str:
        """The top of the tree that a frame is in. Raises `LookupException` for a loop."""
        seen = {frame}
        while (above := self.parent(frame)) is not None:
            if above in seen:
                raise LookupException(self._words.loop())
            seen.add(above)
            frame = above
        return frame

    def chain(self, target: str, source: str, stamp_ns: int = LATEST) -> list[str]:
        """The frames on the way from `source` to `target`, both included. Raises as `lookup` does."""
        up, down, _ = self._path(target, source, stamp_ns)
        if not up:
            top = source
        else:
            top = up[-1].parent_at(stamp_ns) if stamp_ns else up[-1].newest.parent
        return [*(edge.frame for edge in up), top, *(edge.frame for edge in reversed(down))]

    def chain_full(self, target: str, target_ns: int, source: str, source_ns: int, fixed: str) -> list[str]:
        """The frames on the way by way of `fixed`, at two times as in `lookup_full`."""
        return self.chain(fixed, source, source_ns) + self.chain(target, fixed, target_ns)[1:]

    # -- what is asked -------------------------------------------------------------------------------------------

    def lookup(self, target: str, source: str, stamp_ns: int = LATEST) -> Found:
        """The pose of `source` in `target` at a time [ns]: it maps coordinates in `source` to coordinates in `target`.

        `LATEST` is the newest time at which every edge on the way is known.

        Raises:
            InvalidArgumentException: a name is empty or begins with `/`.
            LookupException: a frame does not exist, or the way is a loop.
            ConnectivityException: the frames are in different trees.
            ExtrapolationException: an edge on the way is not known at that time.

        """
        if target == source and target:
            return Found(IDENTITY, stamp_ns or self._newest(target))
        path, fault, stamp_ns, transform = self._found(target, source, stamp_ns)
        if fault != FOUND:
            edge = (path.source + path.target)[fault]
            raise ExtrapolationException(self._words.extrapolation(edge, stamp_ns, target, source))
        return Found(transform, stamp_ns)

    def knows(self, target: str, source: str, stamp_ns: int = LATEST) -> bool:
        """Whether `lookup` would answer: quicker than `why_not` where it often would not."""
        if target == source and target:
            return True
        if target not in self or source not in self:
            return False
        try:
            return self._found(target, source, stamp_ns)[1] == FOUND
        except TransformException:
            return False

    def _found(self, target: str, source: str, stamp_ns: int) -> tuple[Path, int, int, Rigid]:
        """The way, the edge on it that is not known at that time or `FOUND`, the time, and the transform."""
        if self._walk is walk:
            self._slow_lookups += 1
            if self._slow_lookups % LOOKUPS_LOADED == 0:
                self._consider_machine_code()
        path = self._paths.get((target, source)) or self._path(target, source, stamp_ns)
        if self._wandering and stamp_ns == LATEST:
            stamp_ns = _common(path)
            path = self._path(target, source, stamp_ns)
        return path, *self._walk(*self._samples.columns, path.way, len(path.source), stamp_ns)

    def _consider_machine_code(self) -> None:
        """Walk in machine code from now on if it is worth it; the numbers that it finds are the same."""
        if _numba_is_loaded() or self._slow_lookups >= LOOKUPS_TO_LOAD:
            with suppress(ImportError):
                self._walk = compiled_walk()
                self._samples.use_arrays()
                self._paths.clear()

    def lookup_full(self, target: str, target_ns: int, source: str, source_ns: int, fixed: str) -> Found:
        """The pose of `source` at one time [ns] in `target` at another, if `fixed` did not move in between.

        Raises as `lookup` does.
        """
        for frame, role in ((target, "target_frame"), (source, "source_frame"), (fixed, "fixed_frame")):
            self._check(frame, role)
        seen = self.lookup(fixed, source, source_ns)
        then = self.lookup(target, fixed, target_ns)
        return Found(compose(then.transform, seen.transform), then.stamp_ns)

    def latest_common_time(self, target: str, source: str) -> int:
        """The oldest of the newest samples [ns] between two frames; 0 if nothing on the way moves.

        Not every edge need be known then: one whose only sample is newer is not. Raises as `lookup` does for the names
        and the way.
        """
        if target == source and target in self:
            return self._newest(target)
        return _common(self._paths.get((target, source)) or self._path(target, source, LATEST))

    def _newest(self, frame: str) -> int:
        history = self.edges.get(frame)
        return history.newest_ns if history is not None and not history.static else 0

    def why_not(self, target: str, source: str, stamp_ns: int = LATEST) -> TransformException | None:
        """The error that `lookup` would raise; None if it would answer."""
        try:
            self.lookup(target, source, stamp_ns)
        except TransformException as error:
            return error
        return None

    # -- the way -------------------------------------------------------------------------------------------------

    def _path(self, target: str, source: str, stamp_ns: int) -> Path:
        """The edges between two frames at a time."""
        for frame, role in ((target, "target_frame"), (source, "source_frame")):
            self._check(frame, role)
        up = self._ancestors(source, stamp_ns)
        place = {frame: number for number, frame in enumerate(up)}
        down: list[str] = []
        for frame in self._ancestors(target, stamp_ns):
            if frame in place:
                source_edges = tuple(self.edges[other] for other in up[: place[frame]])
                target_edges = tuple(self.edges[other] for other in down)
                way = np.array([edge.number for edge in source_edges + target_edges], dtype=np.int64)
                path = Path(source_edges, target_edges, way if self._samples.compiled else way.data)
                break
            down.append(frame)
        else:
            raise ConnectivityException(self._words.unconnected(target, source))
        if not self._wandering:
            if len(self._paths) >= PATHS_KEPT:
                self._paths.clear()
            self._paths[target, source] = path
        return path

    def _check(self, frame: str, role: str) -> None:
        if not frame or frame.startswith("/"):
            raise InvalidArgumentException(self._words.bad_name(frame, role))
        if frame not in self:
            raise LookupException(self._words.unknown(frame, role))

    def _ancestors(self, frame: str, stamp_ns: int) -> list[str]:
        found = {frame: None}
        while (history := self.edges.get(frame)) is not None:
            frame = history.parent_at(stamp_ns) if stamp_ns else history.newest.parent
            if frame in found:
                raise LookupException(self._words.loop())
            found[frame] = None
        return list(found)


def _numba_is_loaded() -> bool:
    return "numba" in sys.modules


def _common(path: Path) -> int:
    """The oldest of the newest samples [ns] on a way. A sample stamped 0 counts as one for all times, as in tf2."""
    return min(
        [edge.newest_ns for edge in path.source + path.target if not edge.static and edge.newest_ns],
        default=LATEST,
    )
