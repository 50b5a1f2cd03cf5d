"""Recording of a window's turtles for playback: `tape = window().record()`, and later `tape.replay()`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from rosmini.core.graph.show import show

from .frame import Frame
from .paper import Colour, Pen
from .turtle import STEP_S, Turtle, TurtleError

MAX_SAMPLES = 500_000
"""Maximum number of samples; a full tape stops recording."""

Pose = tuple[float, float, float]


@dataclass(eq=False)
class Track:
    """The poses of one turtle at its updates; while it does not move, only the first and the last of them are kept."""

    turtle: Turtle
    came_s: float
    gone_s: float = math.inf
    times: list[float] = field(default_factory=list)
    poses: list[Pose] = field(default_factory=list)
    """x and y (up) [m], and the heading [rad], which is not wrapped."""
    pens: list[Pen | None] = field(default_factory=list)
    """The pen with which the line to each pose was drawn."""

    def note(self, now_s: float) -> int:
        """Record the turtle's pose if it moved; return the number of samples added."""
        turtle, before = self.turtle, len(self.times)
        pose = turtle.x, turtle.y, turtle.theta
        if self.poses:
            last = self.poses[-1]
            pose = *pose[:2], last[2] + math.remainder(pose[2] - last[2], 2 * math.pi)
            if pose == last:
                return 0
            if now_s - self.times[-1] > 1.5 * STEP_S:  # it was at rest until a moment ago
                self._add(now_s - STEP_S, last, self.pens[-1])
        self._add(now_s, pose, turtle.pen if turtle.pen_on else None)
        return len(self.times) - before

    def _add(self, now_s: float, pose: Pose, pen: Pen | None) -> None:
        self.times.append(now_s)
        self.poses.append(pose)
        self.pens.append(pen)


class Line(NamedTuple):
    """A line drawn by one turtle without lifting or changing its pen."""

    pen: Pen
    times: list[float]
    points: list[tuple[float, float]]
    """x and y (up) [m]."""
    until_s: float
    """Time at which the paper was cleared; infinity if it was not."""


class Tape:
    """Records the poses and pens of a window's turtles at each update, until `stop()`.

    Args:
        name: the name of the window.
        start_s: the start time.
        frame: the contents of the window.

    """

    def __init__(self, name: str, start_s: float, frame: Frame) -> None:
        self.name = name
        self.start_s = self.end_s = start_s
        self.background: Colour = frame.paper.background
        self.tracks: list[Track] = []
        self.wipes: list[float] = []
        """Times at which the paper was cleared [s]."""
        self.is_running = True
        self.is_full = False
        self._clears = frame.paper.clears
        self._samples = 0
        self._open: dict[str, Track] = {}
        self.note(start_s, frame)

    def stop(self) -> None:
        """Stop recording."""
        self.is_running = False

    def note(self, now_s: float, frame: Frame) -> None:
        """Record the changes of the last update."""
        if not self.is_running:
            return
        self.end_s = now_s
        if frame.paper.clears != self._clears:  # the paper is cleared before the turtles move
            self._clears, self.background = frame.paper.clears, frame.paper.background
            self.wipes.append(now_s - STEP_S)
        for name, track in list(self._open.items()):
            if frame.turtles.get(name) is not track.turtle:
                track.gone_s = now_s
                del self._open[name]
        for name, turtle in frame.turtles.items():
            if name not in self._open:
                self._open[name] = track = Track(turtle, now_s)
                self.tracks.append(track)
            self._samples += self._open[name].note(now_s)
        if self._samples > MAX_SAMPLES:
            self.is_running, self.is_full = False, True

    def lines(self) -> Iterator[Line]:
        """Yield the lines drawn while the tape ran, turtle by turtle."""
        for track in self.tracks:
            yield from self._lines(track)

    def _lines(self, track: Track) -> Iterator[Line]:
        line: Line | None = None
        for index in range(1, len(track.times)):
            pen, before = track.pens[index], track.times[index - 1]
            until = next((wipe for wipe in self.wipes if wipe > before + STEP_S / 2), math.inf)
            if line is not None and (pen != line.pen or until != line.until_s):
                yield line
                line = None
            if pen is None:
                continue
            if line is None:
                line = Line(pen, [before], [track.poses[index - 1][:2]], until)
            line.times.append(track.times[index])
            line.points.append(track.poses[index][:2])
        if line is not None:
            yield line

    def replay(self, **options: Any) -> Any:
        """Return a player of the drawing in a page, and a still picture with text form elsewhere.

        Options and their defaults:
            title=None: a caption under the player, and the first words of its text form

        Raises `TurtleError` if there was no turtle.
        """
        if not self.tracks:
            raise TurtleError(f"there was no turtle in {self.name} while the tape ran: nothing is to be played")
        return show("turtle_replay", self, **options)
