"""Errors of Stage world files, with their location."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from rosmini.sim.world import WorldError


class Place(NamedTuple):
    """A line of a file."""

    path: Path
    line: int
    included: bool = False
    """True if the file is one that the world file includes."""

    def __str__(self) -> str:
        return f"{self.path}:{self.line}"


class StageError(WorldError):
    """A world file cannot be read or used; the message begins with the file and the line.

    An include may name any file of the user's, so an error in an included file does not quote it: `unquoted` is the
    message for that case.
    """

    def __init__(self, place: Place, what: str, unquoted: str = "") -> None:
        if place.included:
            what = unquoted or "this line cannot be used; `rosmini world check` of the file itself may tell why"
        super().__init__(f"{place}: {what}")
        self.place = place
