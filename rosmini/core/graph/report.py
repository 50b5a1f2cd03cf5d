"""Reports of how a run of a graph ended."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from rosmini.core.errors import GraphEnded


class Waiting(NamedTuple):
    """A lane that was still parked when a run ended, and the reason why."""

    lane: str
    reason: str

    def __str__(self) -> str:
        return f"{self.lane} was waiting for {self.reason}"


class RunReport(NamedTuple):
    """How a run ended: ``reason`` is "time", "condition", "drained" or "stopped"; ``now`` is the graph time in seconds.

    The text of the report lists the parked lanes only if no event is left ("drained"), since otherwise it is normal
    that nodes wait.
    """

    reason: str
    now: float
    waiting: tuple[Waiting, ...] = ()

    def __str__(self) -> str:
        why = {
            "time": "the time is over",
            "condition": "the condition holds",
            "drained": "nothing is left to happen",
            "stopped": "it was stopped",
        }[self.reason]
        lines = [f"the run ended at {self.now:.3f} s: {why}"]
        if self.reason == "drained":
            lines += [f"  {waiting}" for waiting in self.waiting]
        return "\n".join(lines)

    def __repr__(self) -> str:
        return str(self)

    def _ipython_display_(self) -> None:
        """Print the report at the end of a notebook cell, unless the run lasted as long as requested."""
        if self.reason != "time":
            print(self)


def ended(reason: str, waiting: Iterable[Waiting]) -> GraphEnded:
    """Return the error for code that waited for ``reason`` when nothing was left to happen."""
    lines = [f"waited for {reason}, but nothing is left to happen in simulated time"]
    lines += [f"  {lane}" for lane in waiting]
    lines.append("Start the node that should answer before waiting for it, or give a timeout.")
    return GraphEnded("\n".join(lines))
