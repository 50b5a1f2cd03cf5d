"""Logo: programs as text in, drawings and lines of text out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .choice import flock_on
from .compiler import Procedure
from .drawing import Drawing
from .errors import LogoError
from .machine import Limits, Machine
from .primitives import PRIMITIVES
from .reader import read
from .turtles import Paper

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.graph import Node

    from .turtles import Flock

CHUNK = 10_000
"""So many instructions are run at once."""


class Logo:
    """An interpreter of Logo: what a program defines is there for the next one.

    Args:
        flock: the turtles; by default one that draws on paper.
        say: is given each line that is printed.
        pause: is called with the seconds that `wait` is to take.
        seed: of `random`.
        limits: when a program is stopped.

    >>> logo = Logo()
    >>> logo.run("repeat 4 [forward 50 right 90]  print pos")
    0 0
    >>> len(logo.drawing.lines)
    4

    """

    def __init__(
        self,
        flock: Flock | None = None,
        *,
        say: Callable[[str], object] = print,
        pause: Callable[[float], object] = lambda _: None,
        seed: int = 0,
        limits: Limits | None = None,
    ) -> None:
        self.node: Node | None = None
        """Its node, where it is one of a graph."""
        self.flock = Paper() if flock is None else flock
        self.machine = Machine(
            PRIMITIVES, self.flock, say=say, pause=pause, seed=seed, limits=limits or Limits()
        )

    @classmethod
    def on(
        cls,
        node: Node,
        *names: str,
        say: Callable[[str], object] = print,
        seed: int = 0,
        limits: Limits | None = None,
    ) -> Logo:
        """Return an interpreter that drives turtles or robots of the graph, with a node of its own.

        Without ``names`` it takes what is there: the first turtle of turtlesim, or all robots, or a turtle on paper.
        Raises ``LogoError`` for a name that nobody has.
        """
        made = cls(flock_on(node, list(names)), say=say, pause=node.sleep, seed=seed, limits=limits)
        made.node = node
        return made

    def look_around(self) -> None:
        """Drive turtlesim or robots that have come since it began on paper; what was defined stays."""
        if self.node is None or not isinstance(self.flock, Paper):
            return
        found = flock_on(self.node, [])
        if not isinstance(found, Paper):
            self.flock = self.machine.flock = found

    @property
    def drawing(self) -> Drawing:
        """What is drawn."""
        return Drawing.of(self.flock)

    def start(self, program: str, first_line: int = 1) -> None:
        """Prepare to run a program, whose first line has this number in messages; nothing moves yet.

        Raises ``LogoError`` if it is not understood: then nothing of it is defined.
        """
        self.look_around()
        self.flock.look()
        found = read(program, first_line)
        self.machine.define(
            {each.name: Procedure(each.name, each.inputs, each.body, each.line) for each in found.definitions}
        )
        self.machine.start(found.lines)

    def advance(self, steps: int) -> bool:
        """Run so many steps at most; return whether there are more.

        Raises ``LogoError``, and ``LogoStopped`` at a limit; then the program has ended.
        """
        goes_on = False
        try:
            goes_on = self.machine.advance(steps)
        finally:
            if not goes_on:
                self.machine.halt()
        return goes_on

    def run(self, program: str, first_line: int = 1) -> None:
        """Run a program to its end. Raises as `start` and `advance` do; Ctrl-C ends it as well."""
        self.start(program, first_line)
        while self.advance(CHUNK):
            pass

    @property
    def procedures(self) -> list[str]:
        """The names of the procedures that programs have defined."""
        return sorted(self.machine.words.procedures)


__all__ = ["Logo", "LogoError"]
