"""What turtles did over time."""

import math

import pytest

from rosmini.sim.turtlesim import TurtleError
from rosmini.sim.turtlesim import tape as module
from rosmini.sim.turtlesim.frame import Frame
from rosmini.sim.turtlesim.paper import Pen
from rosmini.sim.turtlesim.tape import Tape
from rosmini.sim.turtlesim.turtle import STEP_S


class Played:
    """A frame and a tape by one clock."""

    def __init__(self, turtles=1):
        self.frame, self.updates = Frame(), 0
        self.turtles = [self.frame.spawn(2.0, 2.0 + number, 0.0) for number in range(turtles)]
        self.tape = Tape("/turtlesim", 0.0, self.frame)

    @property
    def now(self):
        return self.updates * STEP_S

    def run(self, updates, linear=0.0, angular=0.0):
        for _ in range(updates):
            for turtle in self.turtles:
                turtle.command(linear, 0.0, angular)
            self.updates += 1
            self.frame.step(self.now)
            self.tape.note(self.now, self.frame)


def test_lines_end_where_the_pen_changes_and_where_the_paper_is_cleared():
    played = Played()
    played.run(10, 1.0)
    played.turtles[0].set_pen(255, 0, 0, 5, 0)
    played.run(10, 1.0)
    played.turtles[0].set_pen(0, 0, 0, 0, 1)
    played.run(10, 1.0)
    played.turtles[0].set_pen(0, 255, 0, 1, 0)
    played.run(10, 1.0)
    played.frame.paper.clear()
    played.run(10, 1.0)
    lines = list(played.tape.lines())
    assert [(line.pen, len(line.points), round(line.until_s / STEP_S, 6)) for line in lines] == [
        (Pen(), 11, 40.0), (Pen((255, 0, 0), 5), 11, 40.0), (Pen((0, 255, 0), 1), 11, 40.0),
        (Pen((0, 255, 0), 1), 11, math.inf),
    ]  # fmt: skip
    assert lines[-1].points[-1] == pytest.approx((2.0 + 50 * STEP_S, 2.0), abs=1e-6)
    assert sum(len(line.points) - 1 for line in lines[3:]) == played.frame.paper.count


def test_turtles_come_and_go_and_come_again():
    played = Played(2)
    played.run(5, 1.0)
    played.frame.kill("turtle2")
    played.run(5)
    played.turtles[1] = played.frame.spawn(5.0, 5.0, 0.0, "turtle2")
    played.run(5)
    spans = [(track.turtle.name, track.came_s, track.gone_s) for track in played.tape.tracks]
    assert spans == [
        ("turtle1", 0.0, math.inf),
        ("turtle2", 0.0, pytest.approx(6 * STEP_S)),
        ("turtle2", pytest.approx(11 * STEP_S), math.inf),
    ]
    played.tape.stop()
    played.run(5)
    assert played.tape.end_s == pytest.approx(15 * STEP_S)


def test_a_full_tape_stops_and_an_empty_one_is_not_played(monkeypatch):
    monkeypatch.setattr(module, "MAX_SAMPLES", 20)
    played = Played()
    played.run(100, 1.0)
    assert (played.tape.is_full, played.tape.is_running) == (True, False)
    with pytest.raises(TurtleError, match="there was no turtle"):
        Tape("/turtlesim", 0.0, Frame()).replay()
