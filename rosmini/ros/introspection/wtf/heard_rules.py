"""Rules for messages received for a while: transforms on ``/tf``, and errors and warnings on ``/rosout``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from .findings import Finding

MAX_SHOWN = 10
"""Maximum number of log lines shown."""

OLD_NS = 10_000_000_000
"""Maximum age of a transform that is not static [ns]; the default length of a buffer."""


class Transform(NamedTuple):
    """A received transform: frames, sender, stamp and arrival time [ns].

    ``heard_ns`` is None while no time is known.
    """

    parent: str
    child: str
    authority: str
    stamp_ns: int
    heard_ns: int | None
    is_static: bool


@dataclass(frozen=True)
class Heard:
    """Messages received by ``roswtf``: transforms, and (node, text) of errors and warnings in the log."""

    transforms: list[Transform] = field(default_factory=list)
    errors: list[tuple[str, str]] = field(default_factory=list)
    warnings: list[tuple[str, str]] = field(default_factory=list)


def logged_errors(heard: Heard) -> Iterator[Finding]:
    """Find errors that nodes logged: after an exception in a callback, a node logs it and continues."""
    shown = _counted(heard.errors)
    if shown:
        yield Finding(
            "logged_errors", "ERROR", "Nodes logged errors in this time:", shown,
            "rospy logs what a callback raises and goes on: `bad callback` names the function. The whole text is in "
            "the node's console and in rqt_console.",
        )  # fmt: skip


def logged_warnings(heard: Heard) -> Iterator[Finding]:
    """Find warnings that nodes logged: lost first messages, repeated transforms, planners without a path."""
    shown = _counted(heard.warnings)
    if shown:
        yield Finding("logged_warnings", "WARNING", "Nodes logged warnings in this time:", shown)


def repeated_senders(heard: Heard) -> Iterator[Finding]:
    """Find frames whose transform several nodes send, the cause of TF_REPEATED_DATA and of jumping robots."""
    senders: dict[str, set[str]] = {}
    for each in heard.transforms:
        senders.setdefault(each.child, set()).add(each.authority)
    found = [f"{child}: {', '.join(sorted(who))}" for child, who in sorted(senders.items()) if len(who) > 1]
    if found:
        yield Finding(
            "repeated_senders", "ERROR", "Several nodes send the transform of the same frame:", tuple(found),
            "The frame jumps between them. Let one send it: two robots need a tf_prefix or frame names of their own, "
            "and of a simulator, robot_localization and an odometry node only one may publish odom -> base.",
        )  # fmt: skip


def several_parents(heard: Heard) -> Iterator[Finding]:
    """Find frames with several parents; tf is a tree."""
    parents: dict[str, set[str]] = {}
    for each in heard.transforms:
        parents.setdefault(each.child, set()).add(each.parent)
    found = [f"{child}: {', '.join(sorted(over))}" for child, over in sorted(parents.items()) if len(over) > 1]
    if found:
        yield Finding(
            "several_parents", "ERROR", "Frames have several parents, and tf is a tree:", tuple(found),
            "The last one sent counts, and the tree changes all the time. Send one of these transforms the other way "
            "round, or not at all.",
        )  # fmt: skip


def several_trees(heard: Heard) -> Iterator[Finding]:
    """Find frames in separate trees, between which no transform exists."""
    parent = {each.child: each.parent for each in heard.transforms}
    trees: dict[str, set[str]] = {}
    for frame in {*parent, *parent.values()}:
        trees.setdefault(_root(frame, parent), set()).add(frame)
    if len(trees) > 1:
        found = [f"{root}: {', '.join(sorted(frames))}" for root, frames in sorted(trees.items())]
        yield Finding(
            "several_trees", "ERROR", f"The frames on /tf are {len(trees)} trees:", tuple(found),
            "Nothing can be transformed from one into another. The missing link is often map -> odom (amcl or a SLAM "
            "node), odom -> base_footprint (the robot or its simulator), or a robot_state_publisher that is not there.",
        )  # fmt: skip


def loops(heard: Heard) -> Iterator[Finding]:
    """Find frames that are their own ancestors."""
    parent = {each.child: each.parent for each in heard.transforms}
    found = sorted(frame for frame in parent if _is_in_loop(frame, parent))
    if found:
        yield Finding(
            "tf_loop", "ERROR", "These frames are their own ancestors:", (", ".join(found),),
            "One of these transforms must not be sent.",
        )  # fmt: skip


def old_transforms(heard: Heard) -> Iterator[Finding]:
    """Find transforms with stamps far from the time: two clocks, or simulated time that some nodes ignore."""
    worst: dict[tuple[str, str], int] = {}
    for each in heard.transforms:
        if not each.is_static and each.heard_ns is not None:
            late = each.heard_ns - each.stamp_ns
            key = (each.child, each.authority)
            worst[key] = max(worst.get(key, late), late, key=abs)
    found = [
        f"{child}, sent by {who}: {abs(late) / 1e9:.1f} s {'old' if late > 0 else 'ahead'}"
        for (child, who), late in sorted(worst.items())
        if abs(late) > OLD_NS
    ]
    if found:
        yield Finding(
            "old_transforms", "WARNING", "Transforms have stamps far from the time:", tuple(found),
            "Look-ups at the present time fail with an extrapolation error. Give all nodes the same clock: "
            "/use_sim_time before they start, or the clocks of the machines (chrony).",
        )  # fmt: skip


RULES: tuple[Callable[[Heard], Iterator[Finding]], ...] = (
    logged_errors,
    logged_warnings,
    repeated_senders,
    several_parents,
    several_trees,
    loops,
    old_transforms,
)


def _counted(logged: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Return the first lines of a log, sorted, without duplicates."""
    counts: dict[str, int] = {}
    for node, text in logged:
        line = f"{node}: {' '.join(text.split())[:160]}"
        counts[line] = counts.get(line, 0) + 1
    shown = [line if count == 1 else f"{line} ({count} times)" for line, count in sorted(counts.items())]
    return tuple(shown[:MAX_SHOWN])


def _root(frame: str, parent: dict[str, str]) -> str:
    """Return the root above a frame; in a loop, the alphabetically first of its frames."""
    seen: list[str] = []
    while frame in parent and frame not in seen:
        seen.append(frame)
        frame = parent[frame]
    return frame if frame not in seen else min(seen[seen.index(frame) :])


def _is_in_loop(frame: str, parent: dict[str, str]) -> bool:
    above, steps = parent.get(frame), 0
    while above is not None and above != frame and steps <= len(parent):
        above, steps = parent.get(above), steps + 1
    return above == frame
