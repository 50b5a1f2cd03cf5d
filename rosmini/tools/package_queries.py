"""Queries of `rospack` and `rosstack`, which are nearly the same (http://docs.ros.org/independent/api/rospkg)."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import DefinitionError, RosminiError, UnknownPackage, UsageError, nearest
from rosmini.core.packages import PackageIndex
from rosmini.core.verbs import ArgumentParser, Call, Lines, Result, Tool, VerbError
from rosmini.tools.dependencies import Dependencies

from .terminal import Terminal

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True)
class Queries:
    """One of the two tools, and its queries on the packages that can be found."""

    tool: Tool
    stacks: bool

    @property
    def noun(self) -> str:
        """Kind of its subjects."""
        return "stack" if self.stacks else "package"

    def known(self) -> Dependencies:
        """Return all packages or stacks that can be found."""
        return Dependencies(PackageIndex(), self.stacks)

    def error(self, text: str) -> VerbError:
        """Return an error in the form of the original tool."""
        return VerbError(f"[{self.tool.name}] Error: {text}")

    @contextmanager
    def original_errors(self, missing: str) -> Iterator[None]:
        """Raise errors in the form of the original tool; ``missing`` is its text for an unknown name."""
        try:
            yield
        except UnknownPackage as error:
            raise self.error(f"{missing}\n{error}".rstrip()) from error
        except VerbError:
            raise
        except RosminiError as error:
            raise self.error(str(error)) from error

    def name(self, given: argparse.Namespace, known: Dependencies) -> str:
        """Return the requested package or stack; by default the one around the working folder."""
        if given.name:
            return str(given.name)
        here = Path.cwd()
        around = {known.path(name).resolve(): name for name in known.names()}
        for folder in (here, *here.parents):
            if folder.resolve() in around:
                return around[folder.resolve()]
        raise self.error(f"no {self.noun} given")

    def lines(self, given: argparse.Namespace, ask: Callable[[Dependencies, str], Sequence[str]]) -> Lines:
        """Return the answer to a query on one of them."""
        known = self.known()
        name = self.name(given, known)
        with self.original_errors(f"no such {self.noun} {name}"):
            return Lines(lines=tuple(ask(known, name)))

    def parser(self, verb: str, *options: str, named: str = "") -> Callable[[], ArgumentParser]:
        """Return the parser of a verb with these options; ``named`` describes the name that it takes, if any."""

        def make() -> ArgumentParser:
            epilog = f"for example: rosmini {self.tool.name} {verb}{' std_msgs' if named else ''}"
            parser = ArgumentParser(f"rosmini {self.tool.name} {verb}", self.tool.verbs[verb].summary, epilog=epilog)
            if named:
                parser.add_argument("name", nargs="?", help=f"the {named}; by default that of the working folder")
            for option in options:
                parser.add_argument(f"--{option}")
            return parser

        return make

    def register(self) -> None:
        """Register the verbs common to both tools, under all their names."""
        noun = self.noun

        def add(names: str, summary: str, act: Callable[[argparse.Namespace, Call], Result], named: str = noun) -> None:
            for name in names.split():
                self.tool.verb(summary, name=name, parser=self.parser(name, named=named))(act)

        add("find", f"print the folder of a {noun}", self._find)
        add("list", f"list {noun}s and their folders", self._list, named="")
        add("list-names", f"list the names of {noun}s", self._list_names, named="")
        add("depends deps", f"list all that a {noun} needs", self._depends)
        add("depends1 deps1", f"list what a {noun} needs directly", self._depends1)
        add("depends-on", f"list all {noun}s that need one", self._depends_on)
        add("depends-on1", f"list the {noun}s that need one directly", self._depends_on1)

    # -- verbs -------------------------------------------------------------------------------------------------

    def _find(self, given: argparse.Namespace, _call: Call) -> Lines:
        known = self.known()
        name = self.name(given, known)
        with self.original_errors(f"{self.noun} '{name}' not found"):
            return Lines(lines=(str(known.path(name)),))

    def _list(self, _given: argparse.Namespace, _call: Call) -> Lines:
        known = self.known()
        return Lines(
            lines=tuple(f"{name} {known.path(name)}" for name in known.names()), complaints=self._broken(known)
        )

    def _list_names(self, _given: argparse.Namespace, _call: Call) -> Lines:
        known = self.known()
        return Lines(lines=tuple(known.names()), complaints=self._broken(known))

    def _broken(self, known: Dependencies, more: Sequence[DefinitionError] = ()) -> tuple[str, ...]:
        """Return messages about manifests that could not be read."""
        return tuple(f"[{self.tool.name}] Warning: {each}" for each in (*known.index.problems(), *more))

    def _depends(self, given: argparse.Namespace, _call: Call) -> Lines:
        return self.lines(given, lambda known, name: known.all_of(name))

    def _depends1(self, given: argparse.Namespace, _call: Call) -> Lines:
        return self.lines(given, lambda known, name: known.direct(name))

    def _depends_on(self, given: argparse.Namespace, _call: Call) -> Lines:
        return self._dependents(given, direct=False)

    def _depends_on1(self, given: argparse.Namespace, _call: Call) -> Lines:
        return self._dependents(given, direct=True)

    def _dependents(self, given: argparse.Namespace, *, direct: bool) -> Lines:
        known = self.known()
        name = self.name(given, known)
        with self.original_errors(f"no such {self.noun} {name}"):
            known.path(name)
            found, broken = known.dependents(name, direct=direct)
        return Lines(lines=tuple(found), complaints=self._broken(known, broken))

    # -- in a terminal ------------------------------------------------------------------------------------------

    def main(self, args: argparse.Namespace) -> int:
        """Run a command line in the form of the original tool: `-q` anywhere, options before the verb."""
        words = [word for word in args.words if word != "-q"]
        quiet = len(words) < len(args.words)
        verb = next((word for word in words if not word.startswith("-")), None)
        if quiet:
            sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115, PTH123 (until the process ends)
        if verb is None and not {"-h", "--help"} & set(words):
            print(f"[{self.tool.name}] Error: no command given.  Try '{self.tool.name} help'", file=sys.stderr)
            return 0
        if verb is None or verb == "help":
            print(self.tool.help())
            raise SystemExit(0)  # like argparse after a help text
        if verb not in self.tool.verbs:
            hint = nearest(verb, self.tool.verbs)
            print(f"[{self.tool.name}] Error: command {verb} not implemented", file=sys.stderr)
            print(hint or f"Try 'rosmini {self.tool.name} help'", file=sys.stderr)
            return 1
        words.remove(verb)
        try:
            return Terminal(self.tool).main(argparse.Namespace(words=[verb, *words]))
        except UsageError as error:
            print(error, file=sys.stderr)
            return 1
