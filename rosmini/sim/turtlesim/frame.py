"""The turtles of one window and their paper, without a node. `node.py` connects it to a graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosmini.core.errors import nearest

from .paper import SIZE, Colour, Paper
from .turtle import METRE, Turtle, TurtleError

MAX_TURTLES = 1000
"""Maximum number of turtles in a window."""


class Frame:
    """The contents of a turtlesim window.

    Args:
        background: the colour of the paper.
        choose: returns the index of a new turtle's drawing; that of the first one by default.

    """

    def __init__(self, background: Colour | None = None, choose: Callable[[], int] = lambda: 0) -> None:
        self.paper = Paper() if background is None else Paper(background)
        self.turtles: dict[str, Turtle] = {}
        """By name, sorted; this is also the order of the updates."""
        self.updates = 0
        """Number of updates so far."""
        self._choose = choose
        self._counter = 0

    def free_name(self) -> str:
        """Return the next free name of turtle1, turtle2, ...; each is returned once, until a reset."""
        while True:
            self._counter += 1
            if (name := f"turtle{self._counter}") not in self.turtles:
                return name

    def spawn(self, x: float, y: float, theta: float, name: str = "", *, holonomic: bool = True) -> Turtle:
        """Add a turtle at a pose [m, m, rad]; outside the window, the next update moves it to the border.

        Raises `TurtleError` if the name is taken, if a number is not finite, and if there are too many turtles.
        """
        if name in self.turtles:
            raise TurtleError(f"there is a turtle {name} already: give another name, or none to get a new one")
        if len(self.turtles) >= MAX_TURTLES:
            raise TurtleError(f"there are {MAX_TURTLES} turtles, and no window has more: kill one, or reset")
        turtle = Turtle(name, x, y, theta, kind=self._choose())
        turtle.name = name or self.free_name()
        turtle.holonomic = holonomic
        self.turtles[turtle.name] = turtle
        self.turtles = dict(sorted(self.turtles.items()))
        return turtle

    def kill(self, name: str) -> Turtle:
        """Remove a turtle and keep its drawing. Raises `TurtleError` if there is no turtle of this name."""
        if name not in self.turtles:
            hint = nearest(name, self.turtles) or f"there are {', '.join(list(self.turtles)[:8]) or 'none'}"
            raise TurtleError(f"there is no turtle {name!r}: {hint}")
        return self.turtles.pop(name)

    def reset(self) -> list[Turtle]:
        """Remove all turtles and restart numbering at 1, but keep the paper. Return the removed turtles."""
        gone, self.turtles, self._counter = list(self.turtles.values()), {}, 0
        return gone

    def step(self, now_s: float) -> None:
        """Update all turtles."""
        for turtle in self.turtles.values():
            turtle.move(now_s, self.paper)
            turtle.draw(self.paper)
        self.updates += 1

    def state(self, since: int = 0, clears: int | None = None) -> dict[str, Any]:
        """Return the data for drawing the window on a canvas: numbers, texts, lists and dictionaries.

        Args:
            since: the number of the first stroke that the caller does not have: `next` of its last state.
            clears: `clears` of its last state; if the paper was cleared since then, `since` counts as 0.

        Returns:
            `size` of the window [px], `metre` [px], `background` [r, g, b], `clears`, `updates`; `strokes`, each
            `[x1, y1, x2, y2, r, g, b, width]` [px, y down], beginning with number `first`; `next`; and
            `turtles`, each with `name`, `x`, `y` [px, y down], `theta` [rad, counter-clockwise], `kind`
            (`drawings.DRAWINGS`), `pen` [r, g, b, width], `pen_on`, `pose` [x [m], y [m] up, theta] and
            `velocity` [m/s, rad/s].

        """
        paper = self.paper
        first = max(since if clears in (None, paper.clears) else 0, paper.first)
        return {
            "size": SIZE,
            "metre": METRE,
            "background": list(paper.background),
            "clears": paper.clears,
            "updates": self.updates,
            "first": first,
            "next": paper.count,
            "strokes": [
                [round(x1, 2), round(y1, 2), round(x2, 2), round(y2, 2), *pen.colour, pen.width]
                for x1, y1, x2, y2, pen, _ in paper.strokes(first)
            ],
            "turtles": [
                {
                    "name": turtle.name,
                    "x": round(turtle.pixel[0], 2),
                    "y": round(turtle.pixel[1], 2),
                    "theta": turtle.theta,
                    "kind": turtle.kind,
                    "pen": [*turtle.pen.colour, turtle.pen.width],
                    "pen_on": turtle.pen_on,
                    "pose": [turtle.x, turtle.y, turtle.theta],
                    "velocity": [turtle.linear_velocity, turtle.angular_velocity],
                }
                for turtle in self.turtles.values()
            ],
        }
