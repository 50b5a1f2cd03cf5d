"""What programs have drawn so far: lines, and where the turtles are."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.graph.show import show

from .turtles import Colour, Pen, Pose, Stroke

if TYPE_CHECKING:
    from .turtles import Flock


SHORTEST = 1e-6
"""What is shorter is no line but the noise of sines [steps]."""


@dataclass(frozen=True)
class Standing:
    """A turtle at the end."""

    name: str
    pose: Pose
    pen: Pen
    visible: bool


@dataclass(frozen=True)
class Drawing:
    """A drawing, in turtle steps; ``strokes`` has what was gone without a pen and turned on the spot, too."""

    strokes: tuple[Stroke, ...]
    turtles: tuple[Standing, ...]
    background: Colour
    metre: float
    """How many steps are a metre."""
    middle: float
    """Where [0 0] is in the window of turtlesim, in x and y [m]; 0 where there is no window."""
    place: str
    """Where the turtles are, in words."""

    @classmethod
    def of(cls, flock: Flock) -> Drawing:
        """Return what is on a flock's paper now."""
        standing = tuple(
            Standing(turtle.name, turtle.pose, turtle.pen, turtle.visible)
            for turtle in flock.turtles.values()
        )
        return cls(
            tuple(flock.sheet.strokes),
            standing,
            flock.sheet.background,
            flock.metre,
            flock.middle,
            flock.place,
        )

    @property
    def lines(self) -> tuple[Stroke, ...]:
        """What a pen has drawn."""
        return tuple(
            stroke
            for stroke in self.strokes
            if stroke.pen.down and math.dist(stroke.start[:2], stroke.end[:2]) > SHORTEST
        )

    @property
    def length(self) -> float:
        """How long all lines are together [steps]."""
        return sum(math.dist(line.start[:2], line.end[:2]) for line in self.lines)

    def show(self, **options: Any) -> Any:
        """Show the drawing as it grew: a player in a page, a still picture elsewhere.

        Options, with what they are unless given:
            title=None: a caption, and the first words of the text form
            speed=200.0: how fast turtles go [steps/s]; a long drawing is drawn faster
        """
        return show("logo", self, **options)
