"""Rules for messages received for a while: transforms on ``/tf``, and errors and warnings on ``/rosout``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from .findings import Finding

MAX_SHOWN = 10
"""Maximum number of log lines shown."""


class Transform(NamedTuple):
    """A received transform: its frame and its sender."""

    child: str
    authority: str


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


RULES: tuple[Callable[[Heard], Iterator[Finding]], ...] = (logged_errors, logged_warnings, repeated_senders)


def _counted(logged: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Return the first lines of a log, sorted, without duplicates."""
    counts: dict[str, int] = {}
    for node, text in logged:
        line = f"{node}: {' '.join(text.split())[:160]}"
        counts[line] = counts.get(line, 0) + 1
    shown = [line if count == 1 else f"{line} ({count} times)" for line, count in sorted(counts.items())]
    return tuple(shown[:MAX_SHOWN])
