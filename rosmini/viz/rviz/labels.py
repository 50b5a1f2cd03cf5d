"""Words in a still: they never overlap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rosmini.viz.metrics import text_width
from rosmini.viz.rounding import snap

from .primitives import Text
from .projection import Look

SMALLEST, LARGEST = 10.0, 15.0
"""Sizes of letters [px]."""
MOST = 300
MOST_SHIFTS = 3
"""Words that would have to be written more lines further below are only counted."""


@dataclass(frozen=True)
class Label:
    """Words with their place [px]: the middle, the base line, and the size of the letters."""

    text: Text
    x: float
    base: float
    size: float
    more: int = 0
    """How many found no room beside these."""

    @property
    def said(self) -> str:
        """What is written."""
        return f"{self.text.text} +{self.more}" if self.more else self.text.text

    def covers(self, other: Label) -> bool:
        """Whether both would be written over one another."""
        halves = (text_width(self.text.text, self.size) + text_width(other.text.text, other.size)) / 2
        return abs(self.x - other.x) < halves and abs(self.base - other.base) < self.size


def placed(words: Sequence[Text], look: Look, shifts: int = MOST_SHIFTS) -> list[Label]:
    """Words below their points, or further below where others are already; what finds no room is counted."""
    found: list[Label] = []
    for text in words[:MOST]:
        x, y = look.pixels(text.position[None])[0].tolist()
        if not (0 <= x <= look.width and 0 <= y <= look.height):
            continue
        size = min(max(float(snap(1.4 * text.height * look.scale, 0.1)), SMALLEST), LARGEST)
        label = Label(text, x, y + size, size)
        for _ in range(shifts):
            if _above(label, found) is None:
                break
            label = replace(label, base=label.base + 1.05 * size)
        above = _above(label, found)
        if above is None:
            found.append(label)
        else:
            found[above] = replace(found[above], more=found[above].more + 1)
    return found


def _above(label: Label, found: list[Label]) -> int | None:
    """Which of the labels is in the way."""
    return next((i for i, other in enumerate(found) if other.covers(label)), None)
