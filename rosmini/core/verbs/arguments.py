"""What the tools on the wire have in common: names as they are typed, and how long a verb goes on."""

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
"""How long a verb that goes on until Ctrl-C in a terminal does so in Python [s]."""


def global_name(name: str) -> str:
    """Return the global name that a name on a command line means: relative ones are in ``ROS_NAMESPACE``."""
    namespace = canonicalize("/" + os.environ.get("ROS_NAMESPACE", ""))
    return resolve_for(name, f"{namespace.rstrip('/')}/tool")


def dashed_remapping(words: Iterable[str]) -> str:
    """Return what is wrong with the first word like ``--name:=x``, or nothing: ROS takes ``__name:=x`` for itself."""
    found = next((word for word in words if word.startswith("-") and ":=" in word), "")
    return (
        f"{found} is no remapping; ROS's own names begin with two underscores: __{found.lstrip('-')}"
        if found
        else ""
    )


def below_here(call: Call) -> Callable[[str], object]:
    """Return what prints a text with paths; in Python those below the working folder are relative to it."""
    here = str(Path.cwd())
    return (
        call.say
        if call.in_terminal
        else lambda text: call.say(text.replace(here + os.sep, "").replace(here, "."))
    )


def add_duration(parser: Parser) -> None:
    """Add the option that says how long a verb goes on."""
    parser.add_option(
        "--duration",
        type="float",
        metavar="S",
        help=f"end after S seconds of graph time (not in ROS; in Python {DURATION_S:g}, in a terminal: at Ctrl-C)",
    )


def duration_ns(given: Values, call: Call) -> int | None:
    """Return how long the verb goes on [ns]; None: until Ctrl-C."""
    seconds: float | None = given.duration
    if seconds is None and not call.in_terminal:
        seconds = DURATION_S
        if call.tells_time and not getattr(given, "count", None):
            call.say(
                f"({DURATION_S:g} s of graph time; --duration says how many, in a terminal it is until Ctrl-C)"
            )
    return None if seconds is None else round(max(seconds, 0.0) * 1e9)
