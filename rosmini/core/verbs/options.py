"""Command lines of the tools in the style of ROS: options, usage and errors, names, and the duration of a verb."""

from __future__ import annotations

import os
from optparse import IndentedHelpFormatter, Option, OptionParser, Values
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from rosmini.core.errors import UsageError
from rosmini.core.names import canonicalize, resolve_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from .tool import Call


class _Formatter(IndentedHelpFormatter):
    """A help formatter that preserves the lines of examples."""

    def format_epilog(self, epilog: str | None) -> str:
        """Return the text below the options."""
        return f"\n{epilog}\n" if epilog else ""


class Parser(OptionParser):
    """An option parser in the style of ROS's tools, which raises instead of exiting; the caller handles ``-h``.

    Args:
        tool: the name of the tool.
        usage: the usage line.
        description: a description of the command.
        example: one or more command lines, shown below the options.
        failure: returns the error to raise for a message.

    """

    def __init__(
        self,
        tool: str,
        usage: str,
        description: str | None = None,
        *,
        example: str = "",
        failure: Callable[[str], UsageError] = UsageError,
    ) -> None:
        epilog = f"Example:\n{example}" if example else None
        super().__init__(usage=usage, description=description, prog=tool, epilog=epilog, formatter=_Formatter())
        self._failure = failure

    def error(self, msg: str) -> NoReturn:
        """Raise the error ``failure(...)``, which contains the usage line and the message."""
        raise self._failure(f"{self.get_usage().rstrip()}\n\n{self.prog}: error: {msg}")

    def flag(self, *names: str, help: str, dest: str | None = None) -> None:
        """Add an option that is True if given."""
        self.add_option(Option(*names, action="store_true", default=False, help=help, dest=dest))

    def whole(self, text: str | None, problem: str) -> int | None:
        """Return an integer, or None for None. Raises ``UsageError`` with ``problem`` for any other text."""
        try:
            return None if text is None else int(text)
        except ValueError:
            self.error(problem)

    def parse(self, words: Sequence[str], /) -> Values:
        """Return the options, with the other arguments as ``words`` and the command line as ``argv``.

        Raises ``UsageError`` for an unknown or incomplete option.
        """
        values, rest = self.parse_args(list(words))
        values.words, values.argv = rest, list(words)
        return values


DURATION_S = 5.0
"""Default duration of a verb in Python that runs until Ctrl-C in a terminal [s]."""


def global_name(name: str) -> str:
    """Return the global name for a name on a command line; relative ones are in ``ROS_NAMESPACE``."""
    namespace = canonicalize("/" + os.environ.get("ROS_NAMESPACE", ""))
    return resolve_for(name, f"{namespace.rstrip('/')}/tool")


def dashed_remapping(words: Iterable[str]) -> str:
    """Return an error message for the first word like ``--name:=x``, which ROS spells ``__name:=x``; empty if none."""
    found = next((word for word in words if word.startswith("-") and ":=" in word), "")
    return (
        f"{found} is no remapping; ROS's own names begin with two underscores: __{found.lstrip('-')}" if found else ""
    )


def below_here(call: Call) -> Callable[[str], object]:
    """Return ``call.say``; for a verb called from Python, a variant that shortens paths below the working directory."""
    here = str(Path.cwd())
    return call.say if call.in_terminal else lambda text: call.say(text.replace(here + os.sep, "").replace(here, "."))


def add_duration(parser: Parser) -> None:
    """Add the option ``--duration``, the time after which a verb ends [s]."""
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
            call.say(f"({DURATION_S:g} s of graph time; --duration says how many, in a terminal it is until Ctrl-C)")
    return None if seconds is None else round(max(seconds, 0.0) * 1e9)
