"""Check of the exercise in the first steps: a script that stops a robot in front of a wall."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise

from .nodes_and_master import stops_from


@exercise("first_stop", praise="From two different starting points, your robot came near the wall and stopped.")
def stop(answer: Script) -> Any:
    """The robot drives up to the wall and stops in front of it."""
    stops_from(answer, 1.2)
    return stops_from(answer, 0.0)
