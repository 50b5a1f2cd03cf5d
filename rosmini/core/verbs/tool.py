"""Verbs: functions that return a result, with two front ends, the terminal and Python.

    TOOL = Tool("rosdemo", "say hello")

    @TOOL.verb("greet somebody", parser=greet_parser)
    def hello(given: Namespace, call: Call) -> Greeting: ...

`rosmini rosdemo hello Ada` prints the result and exits with its status; ``TOOL.run("hello", "Ada", graph=graph)``
returns it, and ``TOOL.on(graph)("hello", "Ada")`` prints it in a notebook.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Protocol, cast

from rosmini.core.errors import CommandError, UsageError, nearest

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from optparse import Values

    from rosmini.core.graph import Graph
    from rosmini.core.peers import Peers
NOT_A_VERB = 64
"""The exit status of ROS's tools if the first word is not a command."""


class VerbError(CommandError):
    """A verb failed; ``status`` is the exit status."""

    def __init__(self, message: str, status: int = 1) -> None:
        super().__init__(message)
        self.status = status


@dataclass(frozen=True, kw_only=True)
class Result:
    """The result of a verb. Its text is the tool's output; ``complaints`` are messages about partial failures."""

    complaints: tuple[str, ...] = ()
    status: int = 0
    """The exit status."""
    end: str = "\n"
    """Printed after the text in a terminal."""
    always_printed: ClassVar[bool] = False
    """True if an empty text is printed as an empty line: ROS's tools do that with lists."""

    def __str__(self) -> str:
        return ""

    def _repr_pretty_(self, printer: Any, _cycle: bool) -> None:
        """Let IPython show the result as a terminal does."""
        printer.text("\n".join(filter(None, (str(self), *self.complaints))))


@dataclass(frozen=True, kw_only=True)
class Lines(Result):
    """A result that consists of lines."""

    lines: tuple[str, ...] = ()

    def __str__(self) -> str:
        return "\n".join(self.lines)


def _to_stderr(text: str) -> None:
    print(text, file=sys.stderr)


@dataclass(frozen=True)
class Call:
    """The context of a verb, in addition to its options.

    ``say`` prints output while the verb runs, ``warn`` prints warnings; ``read_line`` reads input from a
    terminal, and is None if there is none.
    """

    peers: Peers
    """The graph on which the verb acts. A verb that only queries may get just a connection to Master and nodes."""
    say: Callable[[str], object] = print
    warn: Callable[[str], object] = _to_stderr
    read_line: Callable[[], str] | None = None
    tells_time: bool = False
    """True if a verb announces how long it will run."""
    console: Mapping[str, Any] = field(default_factory=dict)
    """Options of the :class:`rosmini.ros.scripts.Console` for nodes that a verb starts."""

    @property
    def graph(self) -> Graph:
        """The graph. Verbs that only query must not use it."""
        return cast("Graph", self.peers)

    @property
    def in_terminal(self) -> bool:
        """True in a terminal, where a verb runs until Ctrl-C; in Python it ends after `DURATION_S` by default."""
        return self.read_line is not None


class Parser(Protocol):
    """The options of a verb."""

    def parse(self, words: Sequence[str], /) -> Any:
        """Return the options. Raises ``UsageError`` or another descriptive error."""

    def format_help(self) -> str:
        """Return the help text."""


class ArgumentParser(argparse.ArgumentParser):
    """A parser of argparse that raises ``UsageError`` instead of exiting, and leaves `--help` to the tool."""

    def __init__(self, prog: str, description: str, **options: Any) -> None:
        super().__init__(prog=prog, description=description, add_help=False, **options)

    def parse(self, words: Sequence[str], /) -> argparse.Namespace:
        """Return the options and arguments. Raises ``UsageError`` if they are wrong."""
        return self.parse_args(list(words))

    def error(self, message: str) -> NoReturn:
        """Raise ``UsageError`` with the message and the usage line."""
        raise UsageError(f"{self.prog}: {message}. {self.format_usage().strip()}")


@dataclass(frozen=True)
class Verb:
    """One verb: its summary, its options, and the function that runs it."""

    name: str
    summary: str
    parser: Callable[[], Parser]
    act: Callable[[Any, Call], Result]
    needs_graph: bool = False
    only_asks: bool | Callable[[Any], bool] = False
    """True if the verb (perhaps depending on its options) only queries Master and nodes, and needs no node itself."""
    in_terminal: Callable[[Sequence[str]], int] | None = None
    """Replaces a verb that runs nodes until Ctrl-C in a terminal: takes the words, and returns the exit status."""
    is_listed: bool = True
    """True if it appears in the list of verbs."""
    takes: str = ""
    """Kinds of its arguments, for completion: see `rosmini.tools.completion`; the last one may repeat."""

    def do(self, given: Any, call: Call) -> Result:
        """Run the verb. Raises ``VerbError`` for a file that cannot be opened, and the errors of the verb."""
        try:
            return self.act(given, call)
        except OSError as error:
            if error.filename is None:
                raise
            raise VerbError(f"ERROR: cannot open {error.filename}: {error.strerror}") from error


@dataclass(frozen=True)
class Overview:
    """The output of a ROS tool if the first word is not a command."""

    has_heading: bool = True
    closing: str = "Type {tool} <command> -h for more detailed usage, e.g. '{tool} {example} -h'"
    status: int = NOT_A_VERB
    """The exit status without any words."""
    unknown_status: int = NOT_A_VERB
    """The exit status if the first word is not a command."""


@dataclass(frozen=True)
class Tool:
    """A tool and the table of its verbs.

    Args:
        name: the name of the command.
        summary: one line for the help texts.
        usage_status: the exit status for a wrong command line.
        elsewhere: commands of ROS's tool that rosmini does not have.
        why_elsewhere: the reason, for the error message.
        example: the node to start with `+` in examples.
        purpose: one line for the ``overview``; a tool that has it acts on the graph of the Master at
            ``ROS_MASTER_URI``.
        overview: what the tool prints if the first word is not a command.
        failure_status: the exit status if no Master responds.
        needs_graph: False if the tool only reads files.
        reads_files: the tool only reads files in a terminal, except for verbs with an ``in_terminal`` function.
        only_verb: the verb of a tool that does one thing, such as roswtf; it is not typed.
        takes_arguments: words of the form ``name:=value`` are arguments of launch files, not remappings.
        is_magic: the tool is also a line magic of notebooks.
        group: its heading in `rosmini --help`, if not "ROS's own commands".
        verbs: the verbs, by name; see :meth:`verb`.

    """

    name: str
    summary: str
    usage_status: int = 2
    elsewhere: tuple[str, ...] = ()
    why_elsewhere: str = ""
    example: str = "rosmini_sim/simulator"
    purpose: str = ""
    overview: Overview = field(default_factory=Overview)
    failure_status: int = 1
    needs_graph: bool = True
    reads_files: bool = False
    only_verb: str = ""
    takes_arguments: bool = False
    is_magic: bool = True
    group: str = ""
    verbs: dict[str, Verb] = field(default_factory=dict)

    def verb(
        self,
        summary: str,
        *,
        parser: Callable[[], Parser],
        name: str | None = None,
        needs_graph: bool = False,
        only_asks: bool | Callable[[Any], bool] = False,
        in_terminal: Callable[[Sequence[str]], int] | None = None,
        is_listed: bool = True,
        takes: str = "",
    ) -> Callable[[Callable[[Any, Call], Result]], Callable[[Any, Call], Result]]:
        """Add the decorated function as a verb, by default under the function's name."""

        def add(act: Callable[[Any, Call], Result]) -> Callable[[Any, Call], Result]:
            known = name or act.__name__
            self.verbs[known] = Verb(known, summary, parser, act, needs_graph, only_asks, in_terminal, is_listed, takes)
            return act

        return add

    def find(self, name: str) -> Verb:
        """Return a verb. Raises ``UsageError``, with similar names, if there is none of this name."""
        if name in self.verbs:
            return self.verbs[name]
        if name in self.elsewhere:
            reason = f": {self.why_elsewhere}" if self.why_elsewhere else ""
            raise UsageError(
                f"`{self.name} {name}` is a command of the original tool, which rosmini does not have{reason}"
            )
        hint = nearest(name, self.verbs) or f"there are: {', '.join(self.verbs)}"
        raise UsageError(f"Unknown command: '{name}'\n{self.name}: there is no command {name!r}; {hint}")

    def help(self) -> str:
        """Return the help text of the tool, with the list of its verbs."""
        width = max(map(len, self.verbs))
        listed = "\n".join(f"   {verb.name:<{width}}   {verb.summary}" for verb in self.verbs.values())
        return (
            f"usage: rosmini {self.name} <verb> [options] [args]\n\n{self.summary}\n\n"
            f"verbs:\n{listed}\n\n`rosmini {self.name} <verb> -h` says more about one."
        )

    # -- in Python -----------------------------------------------------------------------------------------------

    def run(
        self,
        *words: object,
        graph: Graph | None = None,
        say: Callable[[str], object] = print,
        warn: Callable[[str], object] = _to_stderr,
        tells_time: bool = False,
        console: Mapping[str, Any] | None = None,
    ) -> Result:
        """Run the command given by the words on ``graph`` (None: the default graph), and return its result.

        For the other arguments, see :class:`Call`. Raises ``UsageError`` for wrong words, and the errors of the verb.
        """
        text = [os.fspath(word) if isinstance(word, os.PathLike) else str(word) for word in words]
        text = self.with_verb(text)
        help_text = self.help_for(text)
        if help_text is not None:
            return Lines(lines=(help_text,))
        verb = self.find(text[0])
        given = verb.parser().parse(text[1:])
        if not self.needs_graph:
            return verb.do(given, Call(cast("Peers", None), say, warn))
        from rosmini.core.graph import running_graph

        used = running_graph() if graph is None else graph
        return verb.do(given, Call(used, say, warn, tells_time=tells_time, console=console or {}))

    def alone(self, verb: str) -> Tool:
        """Return a tool that only runs this verb: ``rqt_graph`` for ``graph`` of ``rqt``."""
        summary = f"{self.name}: {self.verbs[verb].summary}"
        return replace(self, name=f"{self.name}_{verb}", summary=summary, only_verb=verb)

    def on(self, graph: Graph | None = None) -> Prompt:
        """Return a callable that runs verbs on ``graph`` in a notebook."""
        return Prompt(self, graph)

    def with_verb(self, words: Sequence[str]) -> list[str]:
        """Return the words, with the implied verb added in front."""
        return [self.only_verb, *words] if self.only_verb else list(words)

    def help_for(self, words: Sequence[str]) -> str | None:
        """Return the help text if the words ask for it, otherwise None."""
        helps = {"-h", "--help", "help"}
        if not words or (words[0] in helps and len(words) == 1):
            return self.help()
        if words[0] in helps:
            return self.find(words[1]).parser().format_help()
        if {"-h", "--help"} & set(words[1:]):
            return self.find(words[0]).parser().format_help()
        return None


@dataclass(frozen=True)
class Prompt:
    """A tool and the graph on which it acts (None: the default graph). Calling it prints the result."""

    tool: Tool
    graph: Graph | None = None

    def __call__(self, *words: object) -> None:
        """Run the command, and print its result. Raises as `Tool.run` does."""
        result = self.run(*words)
        for line in filter(None, (str(result), *result.complaints)):
            print(line)

    def run(self, *words: object) -> Result:
        """Run the command, and return its result. Raises as `Tool.run` does."""
        return self.tool.run(*words, graph=self.graph)


@dataclass(frozen=True, kw_only=True)
class Shown(Result):
    """A view, the page that it was saved to (None if it was not saved), and whether that is a temporary page.

    The text has the address of a temporary page, which a terminal makes a link.
    """

    view: Any
    path: Path | None = None
    is_temporary: bool = False

    def __str__(self) -> str:
        place = self.path.as_uri() if self.path and self.is_temporary else self.path
        return self.view.text if place is None else f"{self.view.text}\n\n{place}"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        return self.view._repr_mimebundle_(include, exclude)


def shown(view: Any, name: str, given: Values, call: Call) -> Shown:
    """Save the view to the page named by ``--output``, if any, and return it as a result.

    Without that option, a terminal shows a temporary page in the browser.
    """
    if given.output:
        return Shown(view=view, path=view.save(given.output))
    if not call.in_terminal:
        return Shown(view=view)
    import webbrowser

    path = view.save(Path(tempfile.mkdtemp(prefix="rosmini_")) / f"{name}.html")
    webbrowser.open(path.as_uri())
    return Shown(view=view, path=path, is_temporary=True)
