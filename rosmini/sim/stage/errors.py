"""What can be wrong with a Stage world, and where."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from rosmini.sim.world import WorldError


class Place(NamedTuple):
    """A line of a file."""

    path: Path
    line: int

    def __str__(self) -> str:
        return f"{self.path}:{self.line}"


class StageError(WorldError):
    """A world file cannot be read, or says what is not possible; the message begins with the file and the line."""

    def __init__(self, place: Place, what: str) -> None:
        super().__init__(f"{place}: {what}")
        self.place = place
