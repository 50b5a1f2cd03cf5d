"""Turtles with pens, on paper: the middle is [0 0], heading 0 is up, and right is clockwise.

Lengths are in turtle steps, headings in degrees. A `Flock` makes turtles and knows which are active. This one draws
on paper in memory; `rosmini.sim.logo.turtlesim` and `rosmini.sim.logo.floor` drive turtles and robots of a graph.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

from rosmini.core.graph.show import show

from .values import LogoError, suggestion

Colour: TypeAlias = tuple[int, int, int]
"""Red, green, blue, from 0 to 255."""

MAX_DISTANCE = 1e9
"""Maximum distance of a turtle from the middle [steps]."""

SHORTEST = 1e-6
"""Minimum length of a line [steps]; a shorter stroke is the rounding error of a sine."""

BACKGROUND: Colour = (69, 86, 255)
PEN: Colour = (179, 184, 255)
"""Initial colours in turtlesim (turtlesim/src/turtle_frame.cpp, turtle.cpp)."""


@dataclass(frozen=True)
class Pen:
    """A turtle's pen; its size is in steps."""

    down: bool = True
    colour: Colour = PEN
    size: int = 3


class Pose(NamedTuple):
    """A turtle's position [steps] and heading [degrees clockwise from up, 0 to 360]."""

    x: float
    y: float
    heading: float


HOME = Pose(0.0, 0.0, 0.0)


class Stroke(NamedTuple):
    """A straight movement of a turtle, which has drawn a line if its pen was down."""

    turtle: str
    start: Pose
    end: Pose
    pen: Pen


class Turtle:
    """A turtle on paper; subclasses drive other turtles. Raises ``LogoError`` for a pose that it cannot reach."""

    def __init__(self, name: str, strokes: list[Stroke]) -> None:
        self.name = name
        self.strokes = strokes
        self.goal = HOME
        """The sum of its commands."""
        self.pen = Pen()

    @property
    def pose(self) -> Pose:
        """The current pose."""
        return self.goal

    def place(self, pose: Pose) -> None:
        """Move the turtle of the graph, if there is one, to a pose. Raises ``LogoError``."""

    def send_pen(self) -> None:
        """Send the pen to the turtle of the graph, if there is one. Raises ``LogoError``."""

    def set_pen(self, pen: Pen) -> None:
        """Change the pen."""
        if pen != self.pen:
            self.pen = pen
            self.send_pen()

    def move(self, pose: Pose) -> None:
        """Move to a pose, drawing a line if the pen is down."""
        if max(abs(pose.x), abs(pose.y)) > MAX_DISTANCE:
            raise LogoError(f"turtle out of bounds: {self.name} would be {MAX_DISTANCE:g} steps away")
        before = self.goal
        self.place(pose)
        self.goal = pose
        if pose != before:
            self.strokes.append(Stroke(self.name, before, pose, self.pen))

    def forward(self, distance: float) -> None:
        """Move straight ahead, or back if the distance is negative."""
        x, y, heading = self.goal
        self.move(Pose(x + distance * sine(heading), y + distance * cosine(heading), heading))

    def right(self, degrees: float) -> None:
        """Turn clockwise."""
        self.face(self.goal.heading + degrees)

    def face(self, heading: float) -> None:
        """Turn to a heading."""
        self.move(Pose(self.goal.x, self.goal.y, heading % 360.0))

    def home(self) -> None:
        """Return to the initial pose."""
        self.move(Pose(HOME.x, HOME.y, self.goal.heading))
        self.face(HOME.heading)


class Flock:
    """All turtles, and the active ones: commands go to each of the active ones, questions to the first."""

    metre = 45.0
    """Steps in a metre of turtlesim's window."""
    middle = 249.5 / metre
    """Position of [0 0] in that window, in x and y [m]; 0 for turtles outside it."""
    place = "the window"

    def __init__(self) -> None:
        self.strokes: list[Stroke] = []
        """All movements since the paper was cleared."""
        self.turtles: dict[str, Turtle] = {}
        self.active: list[Turtle] = []

    def make(self, name: str) -> Turtle:
        """Return a new turtle in the middle. Raises ``LogoError``."""
        return Turtle(name, self.strokes)

    def refresh(self) -> None:
        """Update poses and turtles that have changed since the last program."""

    def find(self, name: str) -> Turtle:
        """Return the turtle with this name. Raises ``LogoError``."""
        found = self.turtles.get(name)
        if found is None:
            guess = suggestion(name, self.turtles) or f'; newturtle "{name} makes one'
            raise LogoError(f"there is no turtle {name}{guess}")
        return found

    def add(self, name: str) -> Turtle:
        """Add a new turtle. Raises ``LogoError`` if the name is taken."""
        if name in self.turtles:
            raise LogoError(f"there is a turtle {name} already")
        self.turtles[name] = self.make(name)
        return self.turtles[name]

    def clean(self) -> None:
        """Erase the drawing; the turtles stay where they are."""
        self.strokes.clear()


class Paper(Flock):
    """A sheet of paper in memory with one turtle."""

    def __init__(self) -> None:
        super().__init__()
        self.active = [self.add("turtle1")]


@dataclass(frozen=True)
class Drawing:
    """A drawing in turtle steps: all movements, and the turtles' poses at the end."""

    strokes: tuple[Stroke, ...]
    turtles: dict[str, Pose]
    metre: float
    middle: float
    place: str
    """See `Flock`."""

    @classmethod
    def of(cls, flock: Flock) -> Drawing:
        """Return what these turtles have drawn."""
        poses = {turtle.name: turtle.pose for turtle in flock.turtles.values()}
        return cls(tuple(flock.strokes), poses, flock.metre, flock.middle, flock.place)

    @property
    def lines(self) -> tuple[Stroke, ...]:
        """The strokes that left a line."""
        return tuple(stroke for stroke in self.strokes if stroke.pen.down and _length(stroke) > SHORTEST)

    @property
    def length(self) -> float:
        """Total length of all lines [steps]."""
        return sum(map(_length, self.lines))

    def show(self, **options: Any) -> Any:
        """Show how the drawing grew: a player in a page, a still picture elsewhere.

        Options and their defaults:
            title=None: a caption, and the first words of the text form
            speed=200.0: speed of the turtles [steps/s]; a long drawing is drawn faster
        """
        return show("logo", self, **options)


def _length(stroke: Stroke) -> float:
    return math.dist(stroke.start[:2], stroke.end[:2])


def sine(degrees: float) -> float:
    """Return the sine, exact at multiples of 90 degrees."""
    return cosine(degrees - 90.0)


def cosine(degrees: float) -> float:
    """Return the cosine, exact at multiples of 90 degrees."""
    folded = degrees % 360.0
    return _QUARTERS.get(folded, math.cos(math.radians(folded)))


_QUARTERS = {0.0: 1.0, 90.0: 0.0, 180.0: -1.0, 270.0: 0.0}
