"""The result of a rule, and how ``roswtf`` prints it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

Level = Literal["WARNING", "ERROR"]


@dataclass(frozen=True)
class Finding:
    """A probable fault: its severity, description, places, and how to fix it."""

    rule: str
    """Short name of the fault, the same for every graph: ``no_clock``."""
    level: Level
    what: str
    where: tuple[str, ...] = ()
    """Places, one per line; a line that begins with a space belongs to the one above it."""
    advice: str = ""

    def __str__(self) -> str:
        lines = [f"{self.level} {self.what}"]
        lines += [f"  {place}" if place.startswith(" ") else f" * {place}" for place in self.where]
        if self.advice:
            lines.append(f"   -> {self.advice}")
        return "\n".join(lines)


_INTRODUCTION = {
    "WARNING": "Found {} warning(s).\nWarnings are things that may be just fine, but are sometimes at fault\n",
    "ERROR": "Found {} error(s).\n",
}


def summary(title: str, findings: Sequence[Finding]) -> str:
    """Return findings as ROS's tool prints them: warnings first, then errors, each kind with its count."""
    parts = [f"{title} checks summary:\n"]
    for level, introduction in _INTRODUCTION.items():
        found = [each for each in findings if each.level == level]
        if found:
            parts += [introduction.format(len(found)), *map(str, found), ""]
    if not findings:
        parts.append("No errors or warnings")
    return "\n".join(parts).rstrip("\n")
