"""The declaration of a tool of rqt: its names in rqt's menu, in a perspective and on the command line."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from functools import cache
from importlib import import_module
from optparse import Values
from pathlib import Path
from pkgutil import iter_modules
from typing import Any, ClassVar

from rosmini.core.verbs import Call, Parser, global_name
from rosmini.viz.view import View


class Plugin:
    """A tool of rqt. The menu, the table of plugins and the verbs of `rosmini rqt` are derived from the subclasses.

    A new tool is one class in one module of this package, and an entry point of the group `rosmini.verbs`.
    """

    tool: ClassVar[str]
    """Name of the tool and of its command: ``rqt_plot``."""
    heading: ClassVar[str]
    """Name in rqt's menu: ``Plot``."""
    plugin: ClassVar[str]
    """Name in a perspective: ``rqt_plot/Plot``."""
    group: ClassVar[str] = ""
    """Group of rqt's menu; empty if the menu does not list the tool."""
    summary: ClassVar[str]
    """One line about the tool, for the list of verbs."""
    usage: ClassVar[str] = ""
    """Words that its command takes: ``TOPIC``, ``[NODE]``, ``FIELD...``."""
    takes: ClassVar[str] = ""
    """Kind of these words, for completion."""
    example: ClassVar[str] = ""
    """Words and options of an example in the help."""
    listen_s: ClassVar[float | None] = None
    """Default time for which a still listens [s]; None: it only asks the Master, or reads a file."""
    instead: ClassVar[str | None] = None
    """Command that does the same in a terminal, where a form cannot work; None: the terminal shows a still."""

    registered: ClassVar[dict[str, type[Plugin]]] = {}

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "tool" in vars(cls):
            Plugin.registered[cls.tool] = cls

    @classmethod
    def parser(cls) -> Parser:
        """Return the options of its command."""
        line, text = f"{cls.tool} {cls.example}".rstrip(), f"{cls.summary[0].upper()}{cls.summary[1:]}."
        if cls.instead:
            text += f" A form in a notebook: %{cls.tool}. In a terminal do: rosmini {cls.instead}"
        example = f"  rosmini {line}" if cls.instead is None else f"  %{line}"
        parser = Parser("rqt", f"rosmini {cls.tool} [options] {cls.usage}".rstrip(), text, example=example)
        if cls.instead is None:
            parser.add_option(
                "-o", "--output", metavar="FILE", help="write the page (or .svg, .txt) there, and open nothing"
            )
            parser.add_option("--title", metavar="TEXT", help="a caption under the picture")
            parser.flag("--live", help="in a notebook: a panel that keeps running")
        if cls.listen_s is not None:
            parser.add_option(
                "--duration", type="float", default=cls.listen_s, metavar="S",
                help=f"listen for S seconds of graph time (default: {cls.listen_s:g})",
            )  # fmt: skip
        cls.add_options(parser)
        return parser

    @classmethod
    def add_options(cls, parser: Parser) -> None:
        """Add options to those that every tool has."""

    @classmethod
    def check_words(cls, words: Sequence[str]) -> None:
        """Raise ``UsageError`` if the command does not take this number of words."""
        least = int(bool(cls.usage) and not cls.usage.startswith("["))
        most = len(words) if "..." in cls.usage else int(bool(cls.usage))
        if not least <= len(words) <= most:
            cls.parser().error(f"{cls.tool} takes {cls.usage or 'no words'}")

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the arguments of the constructor, after the graph, from words and options of the command."""
        return [global_name(word) for word in given.words], {}

    @classmethod
    def opened(cls, given: Values, call: Call) -> View:
        """Open the tool in a notebook."""
        words, options = cls.arguments(given)
        make: Any = cls
        made: View = make(call.graph, *words, **options)
        return made

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Return the tool's picture or table. Forms have none."""
        raise NotImplementedError(f"{cls.tool} is a form")

    @classmethod
    def in_terminal(cls, words: Sequence[str]) -> int:
        """Name the command that does the same in a terminal, and return the exit status."""
        del words
        print(
            f"{cls.tool} is a form in a notebook (%{cls.tool}). In a terminal do:\n  rosmini {cls.instead}",
            file=sys.stderr,
        )
        return 2


@cache
def plugins() -> tuple[type[Plugin], ...]:
    """Return the tools of rqt, sorted by name: the subclasses of `Plugin` in the modules of this package."""
    for module in iter_modules([str(Path(__file__).parent)], f"{__package__}."):
        import_module(module.name)
    return tuple(found for name, found in sorted(Plugin.registered.items()) if name.startswith("rqt_"))
