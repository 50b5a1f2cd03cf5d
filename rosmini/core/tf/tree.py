"""The tree of frames over time, and the transform between any two of them (http://wiki.ros.org/tf2).

It works with plain values (names, times as integers [ns], transforms as `Rigid`), without nodes, messages or clocks.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any, NamedTuple

from rosmini.core.lazy import np

from .errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from .history import History, Samples
from .kernel import FOUND, IDENTITY, Rigid, compiled_walk, compose, walk
from .wording import DataWarnings, ErrorTexts

CACHE_NS = 10_000_000_000
"""Default length of the history [ns]: tf's 10 s."""

LATEST = 0
"""The time 0: a lookup then uses the latest time for which the whole chain is known, as for `Time(0)`."""

PATHS_KEPT = 4096

LOOKUPS_TO_LOAD = 50_000
"""Number of lookups after which the walk is compiled.

Loading numba and the code takes 1.6 s, as long as this number of lookups in plain Python.
"""

LOOKUPS_LOADED = 1_000
"""Number of lookups after which the walk is compiled if numba is loaded: 0.1 s to load, once 0.8 s to compile."""


class Found(NamedTuple):
    """A transform and its time [ns]; 0 if all edges on the path are static."""

    transform: Rigid
    stamp_ns: int


class Path(NamedTuple):
    """The edges from a source frame up to a common ancestor, and from the target frame up to it."""

    source: tuple[History, ...]
    target: tuple[History, ...]
    edge_numbers: Any
    """The numbers of all edges, for `walk`."""


class FrameTree:
    """Stores the transforms of frames over time, and computes the transform between any two frames.

    Args:
        cache_ns: length of the history [ns].
        warn: called with a warning about refused data, once per frame and reason.
        now_ns: returns the current time [ns]; only used in error messages.

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
        """The history of each frame that has a parent, by name."""
        self._samples = Samples()
        self._walk: Callable[..., tuple[int, int, Rigid]] = walk
        self._slow_lookups = 0
        self._roots: dict[str, None] = {}
        self._paths: dict[tuple[str, str], Path] = {}
        self._parents_vary = False
        self._warnings = DataWarnings(warn or (lambda _text: None))
        self._texts = ErrorTexts(self, now_ns)

    # -- input --------------------------------------------------------------------------------------------------

    def set(
        self, parent: str, child: str, transform: Rigid, stamp_ns: int, authority: str = "", *, static: bool = False
    ) -> bool:
        """Add the transform of `child` in `parent` at a time [ns], sent by `authority`; return True if accepted.

        As in tf, invalid data (a frame in itself, an empty name, nan, an invalid quaternion) are refused with a
        warning, not an error, and so is a repeated or too old time. A frame that is static at first remains static.
        """
        reason = self._warnings.check(parent, child, transform)
        if reason is not None:
            self._warnings.warn_once(child, authority, reason)
            return False
        history = self.edges.get(child)
        if history is None:
            history = self.edges[child] = History(child, self._samples, self.cache_ns, parent, authority, static=static)
            self._structure_changed(parent, child)
        elif history.newest.parent != parent:
            self._warnings.two_parents(history, parent, authority)
            self._structure_changed(parent, child)
        was_steady = history.steady
        outcome = history.add(parent, transform, stamp_ns, authority)
        if history.steady != was_steady:
            self._parents_vary = not all(other.steady for other in self.edges.values())
        if outcome == "repeated":
            self._warnings.repeated(history, stamp_ns, authority)
        elif outcome == "old":
            self._warnings.old(history, stamp_ns, authority)
        return outcome == "kept"

    def _structure_changed(self, parent: str, child: str) -> None:
        self._paths.clear()
        self._roots.pop(child, None)
        if parent not in self.edges:
            self._roots[parent] = None

    def clear(self) -> None:
        """Remove moving frames, as tf does when time jumps back; static frames remain."""
        for edge in self.edges.values():
            if not edge.static:
                edge.forget()
        self.edges = {frame: edge for frame, edge in self.edges.items() if edge.static}
        self._roots = dict.fromkeys(
            edge.newest.parent for edge in self.edges.values() if edge.newest.parent not in self.edges
        )
        self._paths.clear()
        self._parents_vary = False

    # -- contents ------------------------------------------------------------------------------------------------

    def __contains__(self, frame: object) -> bool:
        return frame in self.edges or frame in self._roots

    def __iter__(self) -> Iterator[str]:
        """Yield all frames, roots first."""
        self._roots = {root: None for root in self._roots if root not in self.edges}
        yield from self._roots
        yield from self.edges

    def parent(self, frame: str) -> str | None:
        """Return a frame's parent in its newest sample, or None for a root."""
        history = self.edges.get(frame)
        return None if history is None else history.newest.parent

    def children(self) -> dict[str, list[str]]:
        """Return the children of each frame, sorted."""
        found: dict[str, list[str]] = {}
        for frame, history in sorted(self.edges.items()):
            found.setdefault(history.newest.parent, []).append(frame)
        return found

    def root(self, frame: str) -> str:
        """Return the root of the tree that contains a frame. Raises `LookupException` for a loop."""
        seen = {frame}
        while (above := self.parent(frame)) is not None:
            if above in seen:
                raise LookupException(self._texts.loop())
            seen.add(above)
            frame = above
        return frame

    def chain(self, target: str, source: str, stamp_ns: int = LATEST) -> list[str]:
        """Return the frames on the path from `source` to `target`, inclusive. Raises the same errors as `lookup`."""
        up, down, _ = self._path(target, source, stamp_ns)
        if not up:
            top = source
        else:
            top = up[-1].parent_at(stamp_ns) if stamp_ns else up[-1].newest.parent
        return [*(edge.frame for edge in up), top, *(edge.frame for edge in reversed(down))]

    def chain_full(self, target: str, target_ns: int, source: str, source_ns: int, fixed: str) -> list[str]:
        """Return the frames on the path through `fixed`, at two times as in `lookup_full`."""
        return self.chain(fixed, source, source_ns) + self.chain(target, fixed, target_ns)[1:]

    # -- queries -------------------------------------------------------------------------------------------------

    def lookup(self, target: str, source: str, stamp_ns: int = LATEST) -> Found:
        """Return the pose of `source` in `target` at a time [ns]: it maps coordinates in `source` to those in `target`.

        `LATEST` is the latest time for which every edge on the path is known.

        Raises:
            InvalidArgumentException: a name is empty or begins with `/`.
            LookupException: a frame does not exist, or the path contains a loop.
            ConnectivityException: the frames are in different trees.
            ExtrapolationException: an edge on the path is not known at that time.

        """
        if target == source and target:
            return Found(IDENTITY, stamp_ns or self._newest(target))
        path, fault, stamp_ns, transform = self._found(target, source, stamp_ns)
        if fault != FOUND:
            edge = (path.source + path.target)[fault]
            raise ExtrapolationException(self._texts.extrapolation(edge, stamp_ns, target, source))
        return Found(transform, stamp_ns)

    def knows(self, target: str, source: str, stamp_ns: int = LATEST) -> bool:
        """Return whether `lookup` would succeed. If it fails often, this is faster than `why_not`."""
        if target == source and target:
            return True
        if target not in self or source not in self:
            return False
        try:
            return self._found(target, source, stamp_ns)[1] == FOUND
        except TransformException:
            return False

    def _found(self, target: str, source: str, stamp_ns: int) -> tuple[Path, int, int, Rigid]:
        """Return the path, the index of an edge that is not known then (or `FOUND`), the time, and the transform."""
        if self._walk is walk:
            self._slow_lookups += 1
            if self._slow_lookups % LOOKUPS_LOADED == 0:
                self._consider_machine_code()
        path = self._paths.get((target, source)) or self._path(target, source, stamp_ns)
        if self._parents_vary and stamp_ns == LATEST:
            stamp_ns = _common(path)
            path = self._path(target, source, stamp_ns)
        return path, *self._walk(*self._samples.columns, path.edge_numbers, len(path.source), stamp_ns)

    def _consider_machine_code(self) -> None:
        """Use compiled code from now on if worthwhile; its results are the same."""
        if _numba_is_loaded() or self._slow_lookups >= LOOKUPS_TO_LOAD:
            with suppress(ImportError):
                self._walk = compiled_walk()
                self._samples.use_arrays()
                self._paths.clear()

    def lookup_full(self, target: str, target_ns: int, source: str, source_ns: int, fixed: str) -> Found:
        """Return the pose of `source` at one time [ns] in `target` at another, if `fixed` does not move in between.

        Raises the same errors as `lookup`.
        """
        for frame, role in ((target, "target_frame"), (source, "source_frame"), (fixed, "fixed_frame")):
            self._check(frame, role)
        seen = self.lookup(fixed, source, source_ns)
        then = self.lookup(target, fixed, target_ns)
        return Found(compose(then.transform, seen.transform), then.stamp_ns)

    def latest_common_time(self, target: str, source: str) -> int:
        """Return the oldest of the newest samples [ns] between two frames; 0 if all edges on the path are static.

        An edge may still be unknown then, if its only sample is newer. Raises the same errors as `lookup` for names and
        paths.
        """
        if target == source and target in self:
            return self._newest(target)
        return _common(self._paths.get((target, source)) or self._path(target, source, LATEST))

    def _newest(self, frame: str) -> int:
        history = self.edges.get(frame)
        return history.newest_ns if history is not None and not history.static else 0

    def why_not(self, target: str, source: str, stamp_ns: int = LATEST) -> TransformException | None:
        """Return the error that `lookup` would raise, or None if it would succeed."""
        try:
            self.lookup(target, source, stamp_ns)
        except TransformException as error:
            return error
        return None

    # -- paths ---------------------------------------------------------------------------------------------------

    def _path(self, target: str, source: str, stamp_ns: int) -> Path:
        """Return the path between two frames at a time [ns]. Raises the errors of `lookup` for names and paths."""
        for frame, role in ((target, "target_frame"), (source, "source_frame")):
            self._check(frame, role)
        up = self._ancestors(source, stamp_ns)
        place = {frame: number for number, frame in enumerate(up)}
        down: list[str] = []
        for frame in self._ancestors(target, stamp_ns):
            if frame in place:
                source_edges = tuple(self.edges[other] for other in up[: place[frame]])
                target_edges = tuple(self.edges[other] for other in down)
                edge_numbers = np.array([edge.number for edge in source_edges + target_edges], dtype=np.int64)
                path = Path(source_edges, target_edges, edge_numbers if self._samples.compiled else edge_numbers.data)
                break
            down.append(frame)
        else:
            raise ConnectivityException(self._texts.unconnected(target, source))
        if not self._parents_vary:
            if len(self._paths) >= PATHS_KEPT:
                self._paths.clear()
            self._paths[target, source] = path
        return path

    def _check(self, frame: str, role: str) -> None:
        if not frame or frame.startswith("/"):
            raise InvalidArgumentException(self._texts.bad_name(frame, role))
        if frame not in self:
            raise LookupException(self._texts.unknown(frame, role))

    def _ancestors(self, frame: str, stamp_ns: int) -> list[str]:
        found = {frame: None}
        while (history := self.edges.get(frame)) is not None:
            frame = history.parent_at(stamp_ns) if stamp_ns else history.newest.parent
            if frame in found:
                raise LookupException(self._texts.loop())
            found[frame] = None
        return list(found)


def _numba_is_loaded() -> bool:
    return "numba" in sys.modules


def _common(path: Path) -> int:
    """Return the oldest of the newest samples [ns] on a path. As in tf2, a sample stamped 0 is valid at all times."""
    return min(
        [edge.newest_ns for edge in path.source + path.target if not edge.static and edge.newest_ns], default=LATEST
    )
