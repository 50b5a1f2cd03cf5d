"""`rosmini rostopic echo` beside the real one, on real publishers; `wire/test_our_tools.py` has the other verbs."""

from __future__ import annotations

import re
import sys
import xmlrpc.client
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

from ..processes import run, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros

if TYPE_CHECKING:
    from .conftest import Tools

need_ros("rostopic", modules="rospy, std_msgs.msg, geometry_msgs.msg, sensor_msgs.msg")

PUBLISHER = """
import rospy
from std_msgs.msg import String
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import LaserScan, Image
rospy.init_node("publisher")
def latched(topic, message):
    made = rospy.Publisher(topic, type(message), latch=True, queue_size=1)
    if message._has_header:
        message.header.stamp, message.header.frame_id = rospy.Time(1234, 5678), "map"
    made.publish(message)
    return made
kept = [latched("/word", String("caf\\u00e9 \\"x\\"")),
        latched("/odom", PoseWithCovarianceStamped()),
        latched("/scan", LaserScan(ranges=[1.5, float("inf"), float("nan"), 1e-7], range_max=3.5)),
        latched("/image", Image(height=1, width=2, encoding="mono8", data=b"\\x00\\xff"))]
chatter = rospy.Publisher("/chatter", String, queue_size=5)
rospy.set_param("/ready", True)
while not rospy.is_shutdown():
    chatter.publish("x" * 29)
    rospy.sleep(0.05)
"""


def ask(env: dict[str, str], method: str, *words: str) -> Any:
    """What the Master answers."""
    with xmlrpc.client.ServerProxy(env["ROS_MASTER_URI"]) as server:
        answer: Any = getattr(server, method)("/test", *words)
    return answer[2]


@pytest.fixture(scope="module")
def graph(master: dict[str, str]) -> Iterator[dict[str, str]]:
    """A real publisher at a real Master."""
    with start([SYSTEM_PYTHON, "-c", PUBLISHER], env=master) as process:
        wait_until(lambda: ask(master, "hasParam", "/ready"), "publisher", process)
        yield master


def tool(*words: str) -> list[str]:
    return [sys.executable, "-m", "rosmini", "rostopic", *words]


ECHO = [
    "/word", "/word/data", "/odom", "--noarr /odom", "--nostr /odom", "-p /odom", "-p --noarr --nostr /odom",
    "-w 8 /odom", "/odom/pose/pose/orientation", "/odom/header/stamp", "/scan", "-p /scan", "/scan/ranges",
    "/scan/ranges[0:2]", "/scan/ranges[-1]", "/image", "--filter 'm.range_max > 3' /scan/range_max",
]  # fmt: skip


@pytest.mark.usefixtures("graph")
@pytest.mark.parametrize("words", ECHO)
def test_it_echoes_what_the_real_one_does(tools: Tools, words: str) -> None:
    real, ours = tools.both(f"rostopic echo -n 1 {words}", env={"LANG": "C.UTF-8"})
    assert (ours.returncode, ours.stderr, real.returncode) == (0, "", 0)
    assert unnumbered(ours.stdout) == unnumbered(real.stdout)


def unnumbered(text: str) -> str:
    """The text without ``header.seq``: rospy numbers a latched message anew for each subscriber."""
    return re.sub(r"^(  seq: +|[1-9]\d*,)\d+", r"\1N", text, flags=re.MULTILINE)


def test_it_ends_with_what_reads_its_output(graph: dict[str, str]) -> None:
    words = "set -o pipefail; " + " ".join(tool("echo", "/chatter")) + " | head -n 1"
    done = run(["bash", "-c", words], env=graph)
    assert (done.returncode, done.stdout, done.stderr) == (0, f'data: "{"x" * 29}"\n', "")
