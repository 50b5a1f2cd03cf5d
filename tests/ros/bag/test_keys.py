"""Space and s while a bag is played in a terminal."""

from __future__ import annotations

import io
import sys
import threading

import pytest

from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, Player
from rosmini.ros.bag.nodes import Keys, status_line

from ...processes import PATIENCE

String = message_class("std_msgs/String")


@pytest.fixture
def bag() -> Bag:
    file = io.BytesIO()
    with Bag(file, "w") as bag:
        for i in range(10):
            bag.write("/chatter", String(str(i)), Time(50 + i))
    return Bag(file)


@pytest.mark.skipif(sys.platform == "win32", reason="terminals as POSIX has them")
def test_keys_of_a_terminal(bag):
    import os
    import pty
    import termios

    ours, theirs = pty.openpty()
    before = termios.tcgetattr(theirs)
    shown = io.StringIO()
    with Graph(simulated=False) as graph, os.fdopen(theirs, encoding="utf-8") as stdin:
        player = Player(graph.node("play"), bag, pause=True, quiet=True, rate=100.0)
        Keys(player, stdin, shown)
        assert not termios.tcgetattr(theirs)[3] & termios.ICANON
        for expected in (1, 2):
            os.write(ours, b"s")
            graph.run(PATIENCE, until=lambda expected=expected: player.played == expected)
        assert player.paused
        assert player.position.to_sec() == 51.0
        os.write(ours, b"x ")
        graph.run(PATIENCE, until=lambda: player.done)
        assert player.played == 10
        assert termios.tcgetattr(theirs) == before
    os.close(ours)
    assert shown.getvalue().startswith("\nHit space to toggle paused, or 's' to step.\n\r [PAUSED ]  Bag Time:")
    assert shown.getvalue().endswith("\nDone.\n")


def test_without_a_terminal_nothing_happens(bag):
    shown = io.StringIO()
    before = set(threading.enumerate())  # one of an earlier test may still be about to end
    with Graph() as graph:
        player = Player(graph.node("play"), bag, quiet=True)
        keys = Keys(player, io.StringIO(), shown)
        keys.press(" ")
        assert player.paused
        keys.press(" ")
        graph.run(2.0)
        line = status_line(player)
        assert line.rstrip() == " [RUNNING]  Bag Time:     51.800000   Duration: 1.800000 / 9.000000"
        graph.run()
        keys.close()
    assert "Hit space" not in shown.getvalue()
    assert set(threading.enumerate()) <= before
