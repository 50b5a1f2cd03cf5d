"""Labels in a still picture, placed so that they never overlap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rosmini.viz.metrics import text_width
from rosmini.viz.rounding import snap

from .primitives import Text
from .projection import Projection

MIN_FONT_SIZE, MAX_FONT_SIZE = 10.0, 15.0
"""Limits of the font size [px]."""
MAX_LABELS = 300
MAX_SHIFTS = 3
"""Maximum number of lines by which a label may be moved down; labels without room are only counted."""


@dataclass(frozen=True)
class Label:
    """A text with its position [px]: the middle, the baseline, and the font size."""

    text: Text
    x: float
    base: float
    size: float
    more: int = 0
    """Number of texts that found no room beside this one."""

    @property
    def shown_text(self) -> str:
        """The text to write."""
        return f"{self.text.text} +{self.more}" if self.more else self.text.text

    def covers(self, other: Label) -> bool:
        """Return True if the two would overlap."""
        halves = (text_width(self.text.text, self.size) + text_width(other.text.text, other.size)) / 2
        return abs(self.x - other.x) < halves and abs(self.base - other.base) < self.size


def place_labels(words: Sequence[Text], projection: Projection, shifts: int = MAX_SHIFTS) -> list[Label]:
    """Place texts below their points, or further down if others are in the way; those without room are counted."""
    found: list[Label] = []
    for text in words[:MAX_LABELS]:
        x, y = projection.pixels(text.position[None])[0].tolist()
        if not (0 <= x <= projection.width and 0 <= y <= projection.height):
            continue
        size = min(max(float(snap(1.4 * text.height * projection.scale, 0.1)), MIN_FONT_SIZE), MAX_FONT_SIZE)
        label = Label(text, x, y + size, size)
        for _ in range(shifts):
            if _overlapped(label, found) is None:
                break
            label = replace(label, base=label.base + 1.05 * size)
        above = _overlapped(label, found)
        if above is None:
            found.append(label)
        else:
            found[above] = replace(found[above], more=found[above].more + 1)
    return found


def _overlapped(label: Label, found: list[Label]) -> int | None:
    """Return the index of the label that is in the way."""
    return next((i for i, other in enumerate(found) if other.covers(label)), None)
