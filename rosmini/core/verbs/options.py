"""Command lines in the style of ROS's tools: options, usage and errors."""

from __future__ import annotations

from optparse import IndentedHelpFormatter, Option, OptionParser, Values
from typing import TYPE_CHECKING, NoReturn

from rosmini.core.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


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
        failure: makes the error from its text.

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
        super().__init__(
            usage=usage, description=description, prog=tool, epilog=epilog, formatter=_Formatter()
        )
        self._failure = failure

    def error(self, msg: str) -> NoReturn:
        """Raise ``UsageError``."""
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
        """Return the options, with the arguments as ``words``, and everything as ``argv``. Raises ``UsageError``."""
        values, rest = self.parse_args(list(words))
        values.words, values.argv = rest, list(words)
        return values
