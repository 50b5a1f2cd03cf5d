"""Tools in a terminal: a verb acts on the graph of the Master, on the nodes after a ``+``, or on files."""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from rosmini.core.errors import MasterUnreachable, RosminiError, UsageError, nearest
from rosmini.core.names import is_remapping
from rosmini.core.verbs import Call, Lines, Result, Tool, Verb, VerbError

from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.core.graph import Graph
    from rosmini.core.peers import Peers

SETTLE_S = 0.1
"""How long the nodes after a `+` run before the verb acts [s]."""


@dataclass(frozen=True)
class Terminal:
    """A tool as a subcommand of `rosmini`: it prints its result, and returns an exit status."""

    tool: Tool

    def _overview(self) -> str:
        """Return the list of verbs in the format of ROS's tools."""
        heading = f"{self.tool.name} is a command-line tool for {self.tool.purpose}.\n\n"
        listed = "\n".join(
            f"\t{self.tool.name} {verb.name}\t{verb.summary}" for verb in self.tool.verbs.values() if verb.is_listed
        )
        closing = self.tool.overview.closing.format(tool=self.tool.name, example=self.tool.example)
        return f"{heading if self.tool.overview.has_heading else ''}Commands:\n{listed}\n" + (
            f"\n{closing}\n" if closing else ""
        )

    def add_parser(self, subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
        """Add the tool to the parser of `rosmini`, which treats none of its words as options."""
        parser = subparsers.add_parser(self.tool.name, help=self.tool.summary, add_help=False, prefix_chars="\0")
        parser.add_argument("words", nargs=argparse.REMAINDER)
        return parser

    def main(self, args: argparse.Namespace) -> int:
        """Run the command line, print the result, and return the exit status."""
        words: list[str] = args.words
        own, nodes = _before_plus(words)
        own = self.tool.with_verb(own)
        if self.tool.purpose:
            own = [word for word in own if self.tool.takes_arguments or not is_remapping(word)]
            if not own or (own[0] not in {*self.tool.verbs, *self.tool.elsewhere, "--help", "help"}):
                return self._not_a_verb(own)

        def act() -> Result | int:
            asked = self.tool.help_for(own)
            if asked is not None:
                print(asked)
                if words and not nodes and words[0] in ("-h", "--help"):
                    raise SystemExit(0)  # like argparse after a help text
                return 0
            verb = self.tool.find(own[0])
            if verb.in_terminal is not None:
                verb.parser()
                return verb.in_terminal(self.tool.with_verb(words)[1:])
            return self._in_terminal(verb, own[1:], nodes)

        return self.reported(act)

    def reported(self, act: Callable[[], Result | int]) -> int:
        """Print the result or the error, and return the exit status."""
        try:
            result = act()
        except VerbError as error:
            print(error, file=sys.stderr)
            return error.status
        except UsageError as error:
            print(error, file=sys.stderr)
            return self.tool.usage_status
        except MasterUnreachable as error:
            if not self.tool.purpose:
                raise
            print(f"ERROR: Unable to communicate with master!\n{error}", file=sys.stderr)
            return self.tool.failure_status
        if isinstance(result, int):
            return result
        text = str(result)
        if text or result.always_printed:
            print(text, end=result.end)
        for complaint in result.complaints:
            print(complaint, file=sys.stderr)
        return result.status

    def _not_a_verb(self, words: Sequence[str]) -> int:
        """Print the overview, and a similar verb."""
        print(self._overview())
        if words and words[0] not in ("-h", "--help"):
            hint = nearest(words[0], self.tool.verbs)
            print(f"{self.tool.name}: there is no command {words[0]!r}{f'; {hint}' if hint else ''}", file=sys.stderr)
        return self.tool.overview.unknown_status if words else self.tool.overview.status

    def _in_terminal(self, verb: Verb, own: Sequence[str], nodes: Sequence[str]) -> Result:
        given = verb.parser().parse(own)
        if not self.tool.needs_graph or (self.tool.reads_files and not nodes):
            return verb.do(given, Call(cast("Peers", None), read_line=sys.stdin.readline))
        if self.tool.purpose and not nodes:
            return self._on_wire(verb, given)
        if verb.needs_graph and not nodes:
            raise RosminiError(
                f"{self.tool.name} {verb.name} acts on a graph, and none is running in this process: "
                f"name it after a +, for example `rosmini {' '.join((self.tool.name, verb.name, *own))} + "
                f"{self.tool.example}`"
            )
        from rosmini.core.graph import Graph

        with Graph(strict=False) as graph:  # what goes wrong in a node is told by that node, and the tool goes on
            if nodes:
                _start(nodes, graph)
            return verb.do(given, Call(graph))

    def _on_wire(self, verb: Verb, given: Any) -> Result:
        """Act on the graph of the Master that the environment names."""
        say = partial(print, flush=True)
        only_asks = verb.only_asks(given) if callable(verb.only_asks) else verb.only_asks
        if only_asks:
            from rosmini.ros.introspection.direct import DirectWire
            from rosmini.ros.net.addresses import addresses

            with DirectWire(addresses().master_uri) as wire:
                return verb.do(given, Call(wire, say, read_line=sys.stdin.readline))
        from rosmini.ros.net.connecting import connect

        end_as_ctrl_c()
        with connect(announce=False) as graph:
            try:
                return verb.do(given, Call(graph, say, read_line=sys.stdin.readline))
            except KeyboardInterrupt:  # it came between two waits: not a failure, as in ROS
                return Lines()


def _before_plus(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """Split words at the first `+`: those of the tool, and those of the nodes that it acts on."""
    if "+" not in words:
        return list(words), []
    at = words.index("+")
    return list(words[:at]), list(words[at + 1 :])


def _start(nodes: Sequence[str], graph: Graph) -> None:
    """Start the nodes after a `+`, and let them settle."""
    from rosmini.ros.scripts import NodeHandle, rosrun

    while nodes:
        words, nodes = _before_plus(nodes)
        package, _, executable = words[0].partition("/")
        handle = rosrun(package, executable, *words[1:], graph=graph)
        if isinstance(handle, NodeHandle):
            handle.instance()
    graph.run(SETTLE_S)
