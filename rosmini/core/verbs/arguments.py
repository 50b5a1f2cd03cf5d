"""Common code of the tools: names as typed, and the duration of a verb."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.names import canonicalize, resolve_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from optparse import Values

    from .options import Parser
    from .tool import Call

DURATION_S = 5.0
"""Default duration of a verb in Python that runs until Ctrl-C in a terminal [s]."""


def global_name(name: str) -> str:
    """Return the global name for a name on a command line; relative ones are in ``ROS_NAMESPACE``."""
    namespace = canonicalize("/" + os.environ.get("ROS_NAMESPACE", ""))
    return resolve_for(name, f"{namespace.rstrip('/')}/tool")


def dashed_remapping(words: Iterable[str]) -> str:
    """Return the error in the first word like ``--name:=x``, or an empty text: ROS uses ``__name:=x``."""
    found = next((word for word in words if word.startswith("-") and ":=" in word), "")
    return (
        f"{found} is no remapping; ROS's own names begin with two underscores: __{found.lstrip('-')}"
        if found
        else ""
    )


def below_here(call: Call) -> Callable[[str], object]:
    """Return a function that prints a text; in Python it shortens paths below the working directory."""
    here = str(Path.cwd())
    return (
        call.say
        if call.in_terminal
        else lambda text: call.say(text.replace(here + os.sep, "").replace(here, "."))
    )


def add_duration(parser: Parser) -> None:
    """Add the option for the duration of a verb."""
    parser.add_option(
        "--duration",
        type="float",
        metavar="S",
        help=f"end after S seconds of graph time (not in ROS; in Python {DURATION_S:g}, in a terminal: at Ctrl-C)",
    )


def duration_ns(given: Values, call: Call) -> int | None:
    """Return the duration of the verb [ns]; None: until Ctrl-C."""
    seconds: float | None = given.duration
    if seconds is None and not call.in_terminal:
        seconds = DURATION_S
        if call.tells_time and not getattr(given, "count", None):
            call.say(
                f"({DURATION_S:g} s of graph time; --duration says how many, in a terminal it is until Ctrl-C)"
            )
    return None if seconds is None else round(max(seconds, 0.0) * 1e9)
