"""Simulated time across processes: /clock from either side, and from `rosbag play --clock`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from ...processes import wait_until
from ..conftest import SYSTEM_PYTHON

if TYPE_CHECKING:
    from .harness import Peer, Stage

pytestmark = pytest.mark.ros

CLOCK = "rosgraph_msgs/Clock"


@pytest.fixture(scope="module")
def simulated(core: Stage) -> tuple[Peer, Peer]:
    """Our node and a real one that obey /clock."""
    core.master("setParam", "/use_sim_time", True)
    peers = [core.peer(kind, f"sim_{kind}").ready() for kind in ("ours", "real")]
    core.wait_for("/clock", "subscribers", *(peer.node for peer in peers))
    return peers[0], peers[1]


@pytest.mark.parametrize("kind", ["ours", "real"])
def test_time_is_what_clock_says(core: Stage, simulated: tuple[Peer, Peer], kind: str) -> None:
    """It starts with the first message, stands when /clock stands, and jumps back when /clock does."""
    clock = core.peer(kind, f"clock_{kind}").ready()
    clock.ask("advertise", "/clock", CLOCK)
    clock.ask("connected", "/clock", len(core.who("/clock", "subscribers")))
    for seconds in (100.5, 101.0, 50.25):
        clock.ask("tick", "/clock", seconds)
        for peer in simulated:
            assert peer.ask("now_is", seconds) == seconds
    for peer in simulated:
        peer.tell("sleep", 2.0)
    seconds = 51.0
    while not all(peer.has_answered() for peer in simulated):
        clock.ask("tick", "/clock", seconds)
        seconds += 0.5
    for peer in simulated:
        slept = peer.answer()
        assert slept >= 2.0
        assert slept % 0.5 in {0.0, 0.25}  # nothing but /clock moves it
    clock.interrupt()
    core.wait_for("/clock", "publishers")


def test_rosbag_play_drives_the_clock(core: Stage, simulated: tuple[Peer, Peer]) -> None:
    file = core.home / "clock.bag"
    core.tool(SYSTEM_PYTHON, "-c", BAG, str(file))
    for peer in simulated:
        peer.ask("subscribe", "/bagged", "std_msgs/Int32")
    play = core.play(["rosbag", "play", "--clock", "--wait-for-subscribers", "-r", "20", file], "/bagged", simulated)
    for peer in simulated:
        assert [message["data"] for message in peer.ask("hear", "/bagged", 3)] == [1, 2, 3]
    assert play.ended() == 0
    for peer in simulated:
        now = peer.ask("now")
        assert 1000 <= now <= 1003, now
    wait_until(lambda: core.who("/clock", "publishers") == [], "the end of play")


BAG = """
import sys, rosbag, rospy
from std_msgs.msg import Int32
with rosbag.Bag(sys.argv[1], "w") as bag:
    bag.write("/gate", Int32(0), rospy.Time(1000))
    for number in (1, 2, 3):
        bag.write("/bagged", Int32(number), rospy.Time(1000 + number - 1))
"""
