"""What Logo drives: turtles with pens, where the middle of the paper is [0 0], heading 0 is up, and right is clockwise.

Lengths are turtle steps, headings degrees. A `Flock` makes turtles and knows which of them listen; `Paper` is the one
that draws lines and nothing else. Those that are nodes of a graph are in `rosmini.logo.turtlesim` and
`rosmini.logo.floor`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import NamedTuple, TypeAlias

from .errors import LogoError, suggestion

Colour: TypeAlias = tuple[int, int, int]
"""Red, green, blue, from 0 to 255."""

FARTHEST = 1e9
"""No turtle goes farther from the middle [steps]."""

BACKGROUND: Colour = (69, 86, 255)
PEN: Colour = (179, 184, 255)
"""The colours that turtlesim begins with (turtlesim/src/turtle_frame.cpp, turtle.cpp)."""


@dataclass(frozen=True)
class Pen:
    """What a turtle draws with; its size is in steps."""

    down: bool = True
    colour: Colour = PEN
    size: int = 3


class Pose(NamedTuple):
    """Where a turtle is [steps], and where it looks [degrees clockwise from up, 0 to 360]."""

    x: float
    y: float
    heading: float


HOME = Pose(0.0, 0.0, 0.0)


class Stroke(NamedTuple):
    """A straight line that a turtle has drawn, or, where ``pen`` is up, has gone."""

    turtle: str
    start: Pose
    end: Pose
    pen: Pen


@dataclass
class Sheet:
    """What has been drawn since it was last cleared."""

    strokes: list[Stroke] = field(default_factory=list)
    background: Colour = BACKGROUND


class Turtle(ABC):
    """One turtle. Raises ``LogoError`` where it cannot go."""

    def __init__(self, name: str, sheet: Sheet) -> None:
        self.name = name
        self.sheet = sheet
        self.visible = True
        self._pen = Pen()

    @property
    @abstractmethod
    def pose(self) -> Pose:
        """Where it is."""

    @abstractmethod
    def forward(self, distance: float) -> None:
        """Go straight ahead, or back."""

    @abstractmethod
    def right(self, degrees: float) -> None:
        """Turn clockwise."""

    @abstractmethod
    def go(self, x: float, y: float) -> None:
        """Go to a point in a straight line, and look where it looked before."""

    @abstractmethod
    def take(self, pen: Pen) -> None:
        """Learn that the pen is another one."""

    @abstractmethod
    def face(self, heading: float) -> None:
        """Look in a direction."""

    @property
    def pen(self) -> Pen:
        """What it draws with."""
        return self._pen

    @pen.setter
    def pen(self, pen: Pen) -> None:
        if pen != self._pen:
            self._pen = pen
            self.take(pen)

    def home(self) -> None:
        """Go to where it began."""
        self.go(HOME.x, HOME.y)
        self.face(HOME.heading)

    def lift(self) -> None:
        """Put the pen up."""
        self.pen = replace(self.pen, down=False)

    def trace(self, start: Pose) -> None:
        """Note the line from there to here."""
        self.sheet.strokes.append(Stroke(self.name, start, self.pose, self._pen))


class ExactTurtle(Turtle):
    """A turtle that is where it is told to be: `place` puts it there."""

    def __init__(self, name: str, sheet: Sheet, pose: Pose = HOME) -> None:
        super().__init__(name, sheet)
        self._pose = pose

    @property
    def pose(self) -> Pose:
        """Where it is."""
        return self._pose

    def place(self, pose: Pose) -> None:
        """Put it there, drawing a line if its pen is down. Raises ``LogoError`` where it cannot be."""

    def take(self, pen: Pen) -> None:
        """Learn that the pen is another one."""

    def forward(self, distance: float) -> None:
        """Go straight ahead, or back."""
        x, y, heading = self._pose
        self._move(Pose(x + distance * sine(heading), y + distance * cosine(heading), heading))

    def right(self, degrees: float) -> None:
        """Turn clockwise."""
        self.face(self._pose.heading + degrees)

    def go(self, x: float, y: float) -> None:
        """Go to a point."""
        self._move(Pose(x, y, self._pose.heading))

    def face(self, heading: float) -> None:
        """Look in a direction."""
        self._move(Pose(self._pose.x, self._pose.y, heading % 360.0))

    def _move(self, pose: Pose) -> None:
        before = self._pose
        if max(abs(pose.x), abs(pose.y)) > FARTHEST:
            raise LogoError(f"turtle out of bounds: {self.name} would be {FARTHEST:g} steps away")
        self.place(pose)
        self._pose = pose
        if pose[:2] != before[:2] or pose.heading != before.heading:
            self.trace(before)


class Flock(ABC):
    """All turtles that there are, and those that listen: commands go to each of these, questions to the first."""

    metre = 45.0
    """So many steps are a metre of turtlesim's window."""
    middle = 249.5 / metre
    """Where [0 0] is in that window [m]."""
    place = "the window"

    def __init__(self) -> None:
        self.sheet = Sheet()
        self.turtles: dict[str, Turtle] = {}
        self.active: list[Turtle] = []
        self.told: list[Turtle] = []
        """Those of the last `tell`."""

    @abstractmethod
    def make(self, name: str) -> Turtle:
        """Make a turtle in the middle. Raises ``LogoError``."""

    def look(self) -> None:  # noqa: B027 - on paper nothing changes by itself
        """Find out what has changed since the last program."""

    def known(self) -> list[str]:
        """The names of turtles that are there."""
        return sorted(self.turtles)

    def find(self, name: str) -> Turtle:
        """The turtle of this name. Raises ``LogoError`` if there is none."""
        found = self.turtles.get(name)
        if found is None:
            guess = suggestion(name, self.known()) or f'; newturtle "{name} makes one'
            raise LogoError(f"there is no turtle {name}{guess}")
        return found

    def add(self, name: str) -> Turtle:
        """Make a turtle. Raises ``LogoError`` if the name is taken."""
        if name in self.known():
            raise LogoError(f"there is a turtle {name} already")
        self.turtles[name] = self.make(name)
        return self.turtles[name]

    def tell(self, turtles: list[Turtle]) -> None:
        """Let these listen from now on."""
        self.active = self.told = turtles

    def reset(self) -> None:
        """Let those of the last `tell` listen, whatever was stopped."""
        self.active = self.told

    def clean(self) -> None:
        """Erase what is drawn; turtles stay where they are."""
        self.sheet.strokes.clear()

    def paint(self, colour: Colour) -> None:
        """Change the background."""
        self.sheet.background = colour


class Paper(Flock):
    """A sheet of paper in memory, with one turtle to begin with."""

    def __init__(self, names: tuple[str, ...] = ("turtle1",)) -> None:
        super().__init__()
        self.tell([self.add(name) for name in names])

    def make(self, name: str) -> Turtle:
        """Make a turtle in the middle."""
        return ExactTurtle(name, self.sheet)


def sine(degrees: float) -> float:
    """The sine, exact at multiples of 90 degrees."""
    return cosine(degrees - 90.0)


def cosine(degrees: float) -> float:
    """The cosine, exact at multiples of 90 degrees."""
    folded = degrees % 360.0
    return _QUARTERS.get(folded, math.cos(math.radians(folded)))


_QUARTERS = {0.0: 1.0, 90.0: 0.0, 180.0: -1.0, 270.0: 0.0}
