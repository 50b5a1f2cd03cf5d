"""Error messages and warnings of a `FrameTree`.

Each names the query, the frames and the faulty edge, and suggests a fix.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rosmini.core.errors import nearest

if TYPE_CHECKING:
    from collections.abc import Callable

    from .history import History
    from .kernel import Rigid
    from .tree import FrameTree

NEAR_PERIODS = 5
"""A transform that is missing by fewer periods than this is expected to arrive."""

OTHER_CLOCK_NS = 10_000_000 * 1_000_000_000
"""Times that differ by more than this (116 days) come from different clocks."""

FRAMES_LISTED = 12


def seconds(time_ns: int) -> str:
    """Return a time in seconds, exactly, with at least three decimals.

    >>> seconds(2_500_000_000), seconds(-1_000)
    ('2.500', '-0.000001')
    """
    whole, rest = divmod(abs(time_ns), 1_000_000_000)
    decimals = f"{rest:09d}".rstrip("0")
    return f"{'-' if time_ns < 0 else ''}{whole}.{decimals:0<3}"


class ErrorTexts:
    """Error messages of one tree."""

    def __init__(self, tree: FrameTree, now_ns: Callable[[], int] | None) -> None:
        self._tree = tree
        self._now_ns = now_ns

    def bad_name(self, frame: str, role: str) -> str:
        """Return the error for a name that tf2 does not accept."""
        if not frame:
            return (
                f"Invalid argument passed to lookupTransform argument {role}: in tf2 frame_ids cannot be empty. "
                "Was the header.frame_id of a message never set?"
            )
        return (
            f'Invalid argument "{frame}" passed to lookupTransform argument {role}: in tf2 frame_ids cannot start '
            "with a "
            f"'/'. Use \"{frame.lstrip('/')}\"."
        )

    def unknown(self, frame: str, role: str) -> str:
        """Return the error for an unknown frame."""
        known = sorted(self._tree)
        text = f'"{frame}" passed to lookupTransform argument {role} does not exist. '
        if not known:
            return text + (
                "No transform has been received yet: a listener learns of a frame when its broadcaster sends next "
                "(and of static frames once it is connected), so create it early, and use a timeout. Does any node "
                "publish /tf or /tf_static?"
            )
        hint = nearest(frame, known)
        listed = ", ".join(known[:FRAMES_LISTED]) + (
            f" and {len(known) - FRAMES_LISTED} more" if len(known) > FRAMES_LISTED else ""
        )
        return text + (f"{hint[0].upper()}{hint[1:]} " if hint else "") + f"There are these frames: {listed}."

    def loop(self) -> str:
        """Return the error for a loop."""
        return (
            "The tf tree is invalid because it contains a loop. A frame is below its own child: two broadcasters "
            f"name different parents.\n{self.frames()}"
        )

    def frames(self) -> str:
        """Return a line for each frame that has a parent, in tf's words, with the sender of its transform."""
        return "\n".join(
            f"Frame {frame} exists with parent {history.newest.parent}"
            + (f" (from {history.newest.authority})." if history.newest.authority else ".")
            for frame, history in sorted(self._tree.edges.items())
        )

    def unconnected(self, target: str, source: str) -> str:
        """Return the error for two frames in different trees."""
        top, other = self._tree.root(target), self._tree.root(source)
        return (
            f"Could not find a connection between '{target}' and '{source}' because they are not part of the same "
            f"tree: '{target}' is in that of '{top}', '{source}' in that of '{other}'. Likely cause: the broadcaster "
            "of an edge that would join them is not running, or spells a frame differently. Somebody has to say "
            f"where '{other}' is in a frame of the other tree (or '{top}' in this one).\n{draw(self._tree)}"
        )

    def extrapolation(self, edge: History, stamp_ns: int, target: str, source: str) -> str:
        """Return the error for a time at which an edge is not known."""
        oldest, newest = edge.oldest_ns, edge.newest_ns
        future = stamp_ns > newest
        gap = stamp_ns - newest if future else oldest - stamp_ns
        where = f"when looking up transform from frame [{source}] to frame [{target}]"
        interval = (
            f"only at {seconds(newest)} s" if len(edge) == 1 else f"from {seconds(oldest)} s to {seconds(newest)} s"
        )
        rate = f", {edge.rate:.1f} Hz" if len(edge) > 1 else ""
        sender = f", from {edge.newest.authority}" if edge.newest.authority else ""
        return (
            f"Lookup would require extrapolation {seconds(gap)}s into the {'future' if future else 'past'}, {where}.\n"
            f"Requested: {seconds(stamp_ns)} s. At fault: the edge {edge.newest.parent} -> {edge.frame} is known "
            f"{interval} ({_count(len(edge))}{rate}{sender}).\n"
            f"Likely cause: {self._cause(edge, stamp_ns, gap, future=future)}"
        )

    def _cause(self, edge: History, stamp_ns: int, gap: int, *, future: bool) -> str:
        latest = "Time(0) asks for the latest time that the whole chain has"
        if gap > OTHER_CLOCK_NS:
            return (
                "the two times come from different clocks, real and simulated time: set /use_sim_time before "
                "the nodes start, for all of them or for none."
            )
        if len(edge) == 1:
            return (
                "a single transform cannot be interpolated. If it never changes, send it as a static one; if it "
                f"does, wait for the next ones. {latest}."
            )
        period = edge.span_ns / (len(edge) - 1)
        if not future:
            if edge.span_ns + period > self._tree.cache_ns:
                return (
                    f"the buffer keeps {self._tree.cache_ns / 1e9:g} s, and this is longer ago. Look up sooner, or "
                    f"give the buffer a longer cache_time. {latest}."
                )
            return (
                "this edge was not yet published at that time, or the listener did not exist yet: its buffer is "
                f"empty at first. Create it before the data arrive, and drop older data. {latest}."
            )
        now = None if self._now_ns is None else self._now_ns()
        if now is not None and stamp_ns > now:
            return f"that time is in the future: it is {seconds(now)} s now. {latest}."
        if gap > NEAR_PERIODS * period:
            return (
                f"nothing new came for {seconds(gap)} s, {gap / period:.0f} times the usual: the broadcaster of "
                f"{edge.frame} has stopped, or is held up. {latest}, which is as old as that."
            )
        return (
            "the transform for that time has not arrived yet (a message and the transform for it travel apart). Wait "
            f"for it: give the lookup a timeout. Or: {latest}."
        )


def _count(number: int) -> str:
    return "1 transform" if number == 1 else f"{number} transforms"


def draw(tree: FrameTree) -> str:
    """Return the frames as text, each below its parent.

    Branches are drawn as in a file tree; a tree that consists of a loop is not drawn.
    """
    children = tree.children()
    lines: list[str] = []

    for root in sorted(frame for frame in tree if frame not in tree.edges):
        waiting = [(root, "", "")]
        while waiting:
            frame, first, indent = waiting.pop()
            lines.append(first + frame)
            under = children.get(frame, [])
            branches = [("|-- ", "|   ")] * (len(under) - 1) + [("`-- ", "    ")]
            waiting += [
                (child, indent + branch, indent + rest)
                for child, (branch, rest) in reversed(list(zip(under, branches, strict=False)))
            ]
    return "\n".join(lines)


class DataWarnings:
    """Warns about suspicious data, once per frame and kind; in ROS these warnings repeat at the rate of the data."""

    def __init__(self, warn: Callable[[str], object]) -> None:
        self._warn = warn
        self._warned: set[tuple[str, str]] = set()

    def warn_once(self, frame: str, authority: str, text: str) -> None:
        """Warn about the data of a frame, once for each warning code, the part of `text` before the colon."""
        key = (frame, text.partition(":")[0])
        if key not in self._warned:
            self._warned.add(key)
            sender = authority or "an unnamed sender"
            self._warn(text.replace("{sender}", sender) + " (This is said once for this frame.)")

    @staticmethod
    def check(parent: str, child: str, transform: Rigid) -> str | None:
        """Return the warning about an invalid transform, with `{sender}` as a placeholder, or None if it is valid."""
        if parent == child:
            return f'TF_SELF_TRANSFORM: {{sender}} says where frame "{child}" is in itself; ignored.'
        if not child:
            sent = f'{{sender}} sent a transform in frame "{parent}"'
            return f"TF_NO_CHILD_FRAME_ID: {sent} with an empty child_frame_id; ignored."
        if not parent:
            sent = f'{{sender}} sent a transform of frame "{child}"'
            return f"TF_NO_FRAME_ID: {sent} with an empty header.frame_id; ignored."
        if not math.isfinite(sum(transform)) and not all(map(math.isfinite, transform)):
            sent = f'{{sender}} sent a transform of frame "{child}"'
            return f"TF_NAN_INPUT: {sent} with a nan or inf in it, {transform}; ignored."
        _, _, _, x, y, z, w = transform
        if abs(x * x + y * y + z * z + w * w - 1) > 1e-2:
            return (
                f'TF_DENORMALIZED_QUATERNION: {{sender}} sent frame "{child}" with a quaternion that is no rotation, '
                f"x={x:g}, "
                f"y={y:g}, z={z:g}, w={w:g}: its length has to be 1 (a new Quaternion has w=0; no rotation at all is "
                "w=1); ignored."
            )
        return None

    def repeated(self, history: History, stamp_ns: int, authority: str) -> None:
        """Warn about a second transform of a frame for the same time [ns]."""
        first = history.sample_at(stamp_ns).authority
        frame = history.frame
        if first == authority:
            sender = authority or "an unnamed sender"
            why = f"{sender} sent it twice: stamp each transform with the time for which it holds"
        else:
            why = (
                f"{first or 'an unnamed sender'} sent it first, {authority or 'an unnamed sender'} again: two "
                f"broadcasters of one frame; stop one of them"
            )
        self.warn_once(
            frame,
            authority,
            f'TF_REPEATED_DATA: the transform of frame "{frame}" at {seconds(stamp_ns)} s came more than once; the '
            f"first is kept. {why}.",
        )

    def old(self, history: History, stamp_ns: int, authority: str) -> None:
        """Warn about a transform that is older than the history of its frame."""
        frame = history.frame
        self.warn_once(
            frame,
            authority,
            f'TF_OLD_DATA: the transform of frame "{frame}" at {seconds(stamp_ns)} s from {{sender}} is older than '
            "the "
            f"buffer (the newest is from {seconds(history.newest_ns)} s, from "
            f"{history.newest.authority or 'an unnamed sender'}); ignored. Two broadcasters with different clocks, or "
            "a bag played again, are possible causes.",
        )

    def two_parents(self, history: History, parent: str, authority: str) -> None:
        """Warn about a frame for which another sender names another parent."""
        before = history.newest
        if before.authority == authority:
            return  # a sender may move its own frame
        self.warn_once(
            history.frame,
            authority,
            f'TF_TWO_PARENTS: frame "{history.frame}" is under "{before.parent}" by '
            f'{before.authority or "an unnamed sender"}, and under "{parent}" by {{sender}}. A frame has one parent: '
            "the tree jumps from one to the other.",
        )
