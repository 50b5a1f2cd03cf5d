"""Our command line tools beside ROS's own, at one Master: they say the same of our node and of a real one."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
import yaml

from ..conftest import SYSTEM_PYTHON
from .harness import ROSMINI

if TYPE_CHECKING:
    from .harness import Peer, Stage

pytestmark = pytest.mark.ros

Peers = tuple["Peer", "Peer"]


@pytest.fixture
def busy(core: Stage, pair: Peers) -> Peers:
    """The two nodes: each counts and listens to the other."""
    idle = [(peer, other) for peer, other in (pair, pair[::-1]) if not peer.is_busy]
    for peer, other in idle:
        peer.ask("advertise", f"{peer.node}/count", "std_msgs/Int32")
        peer.ask("every", f"{peer.node}/count")
        peer.ask("advertise", f"{peer.node}/latched", "std_msgs/String", latch=True)
        peer.ask("publish", f"{peer.node}/latched", ["käse"])
        peer.ask("subscribe", f"{other.node}/count", "std_msgs/Int32")
        peer.ask("subscribe", f"{peer.node}/inbox", "std_msgs/String")
    for peer, other in idle:
        peer.is_busy = True
        peer.ask("hear", f"{other.node}/count")
        core.wait_for(f"{peer.node}/count", "subscribers", other.node)
    return pair


def plain(text: str) -> list[str]:
    """Return the lines of an output without what each look makes differ, sorted: ROS's order is a dictionary's."""
    return sorted(re.sub(r" \(\d+ - [\w.]+:\d+\) \[\d+\]|time=[\d.]+ms|average: [\d.]+ms", "", text).splitlines())


@pytest.mark.parametrize(
    "words",
    [
        "rosnode list", "rosnode list -a", "rosnode list -u", "rosnode info {}", "rosnode info -q {}",
        "rosnode machine 127.0.0.1", "rosnode ping -c 2 {}", "rostopic list", "rostopic list -v", "rostopic list -s",
        "rostopic info {}/count", "rostopic type {}/inbox", "rostopic find std_msgs/String",
        "rostopic echo -n 1 {}/latched",
    ],
)  # fmt: skip
def test_our_tools_say_what_ros_own_say(core: Stage, busy: Peers, words: str) -> None:
    for peer in busy if "{}" in words else busy[:1]:
        asked = words.format(peer.node).split()
        ours, theirs = core.our_tool(*asked), core.tool(*asked)
        assert plain(ours) == plain(theirs)


def test_our_rates_and_publications(core: Stage, busy: Peers) -> None:
    for peer in busy:
        hz = core.start("hz", [*ROSMINI, "rostopic", "hz", f"{peer.node}/count"])
        assert float(hz.wait_for(r"average rate: ([\d.]+)")[1]) > 0
        bw = core.start("bw", [*ROSMINI, "rostopic", "bw", f"{peer.node}/count"])
        bw.wait_for(r"average: [\d.]+\w?B/s")
        for tool in (hz, bw):
            tool.interrupt()
        peer.tell("hear", f"{peer.node}/inbox")
        while not peer.has_answered():  # it says it for three seconds
            core.our_tool("rostopic", "pub", "-1", f"{peer.node}/inbox", "std_msgs/String", "data: hello")
        assert peer.answer() == [{"data": "hello"}]  # once, though it is latched


def test_our_rostopic_shows_types_that_only_the_publisher_knows(core: Stage) -> None:
    """Which ROS's own cannot: the definition comes with the connection."""
    odd = core.start("odd", [SYSTEM_PYTHON, "-c", ODD])
    core.wait_for("/odd", "publishers", "/odd_publisher")
    said = core.our_tool("rostopic", "echo", "-n", "1", "/odd")
    assert yaml.safe_load(said.replace("---", "")) == {"text": "käse", "values": [1.5, 2.0]}
    assert core.our_tool("rostopic", "echo", "-n", "1", "/odd/values[1]") == "2.0\n---\n"
    odd.interrupt()


ODD = """
import rospy
from genpy.dynamic import generate_dynamic
Odd = generate_dynamic("odd_pkg/Odd", "string text\\nfloat64[] values\\n")["odd_pkg/Odd"]
rospy.init_node("odd_publisher")
publisher = rospy.Publisher("/odd", Odd, latch=True, queue_size=1)
publisher.publish(Odd("käse", [1.5, 2.0]))
rospy.spin()
"""


def test_our_rosbag_records_both(core: Stage, busy: Peers) -> None:
    bag = core.home / "ours_of_both.bag"
    topics = [f"{peer.node}/{name}" for peer in busy for name in ("count", "latched")]
    record = core.start("record", [*ROSMINI, "rosrun", "rosbag", "record", "-O", bag, *topics])
    core.wait_until_heard("/record", topics)
    for peer, other in (busy, busy[::-1]):
        other.ask("forget", f"{peer.node}/count")
        other.ask("hear", f"{peer.node}/count", 10)
    record.interrupt()
    found = {each["topic"]: each for each in yaml.safe_load(core.tool("rosbag", "info", "-y", bag))["topics"]}
    assert set(found) == set(topics)
    assert all(found[f"{peer.node}/latched"]["messages"] == 1 for peer in busy)
    assert all(found[f"{peer.node}/count"]["messages"] >= 3 for peer in busy)
    assert found["/theirs/latched"]["type"] == "std_msgs/String"
