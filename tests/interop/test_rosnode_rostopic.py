"""`rosmini rosnode` and `rosmini rostopic` beside the real tools, at one real Master with real nodes."""

from __future__ import annotations

import re
import xmlrpc.client
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

from ..processes import free_port, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros

if TYPE_CHECKING:
    from .conftest import Tools

need_ros("rosnode", "rostopic", modules="rospy, std_msgs.msg, geometry_msgs.msg")

NODE = """
import sys, rospy
from std_msgs.msg import String
from geometry_msgs.msg import PoseStamped
rospy.init_node(sys.argv[1])
if sys.argv[1] == "talker":
    chatter = rospy.Publisher("chatter", String, queue_size=5)
    pose = rospy.Publisher("/robot1/pose", PoseStamped, queue_size=5, latch=True)
    while not chatter.get_num_connections():
        rospy.sleep(0.05)
else:
    rospy.Subscriber("chatter", String, lambda _: None)
rospy.set_param("/ready_" + sys.argv[1], True)
rospy.spin()
"""


def ask(env: dict[str, str], method: str, *words: str) -> Any:
    """What the Master answers."""
    with xmlrpc.client.ServerProxy(env["ROS_MASTER_URI"]) as server:
        answer: Any = getattr(server, method)(*words)
    return answer[2]


def is_ready(env: dict[str, str], name: str) -> bool:
    return bool(ask(env, "hasParam", "/test", f"/ready_{name}"))


@pytest.fixture(scope="module")
def nodes(master: dict[str, str]) -> Iterator[dict[str, str]]:
    """A real talker and a real listener, connected."""
    words = [SYSTEM_PYTHON, "-c", NODE]
    with start([*words, "talker"], env=master) as talker, start([*words, "listener"], env=master) as listener:
        for name, process in (("talker", talker), ("listener", listener)):
            wait_until(lambda name=name: is_ready(master, name), name, process)
        yield master


def masked(text: str) -> str:
    return re.sub(r"(time=|average: )[\d.]+", r"\1TIME", text)


SAME = [
    "rosnode list", "rosnode list -a", "rosnode list -u", "rosnode list /talker", "rosnode info /talker",
    "rosnode info -q listener", "rosnode info talker listener", "rosnode ping -c 2 /talker", "rosnode machine",
    "rosnode machine localhost", "rosnode cleanup", "rosnode info", "rosnode", "rosnode -h",
    "rostopic list", "rostopic list -v", "rostopic list -p", "rostopic list -s",
    "rostopic list -v -p", "rostopic list -v -s", "rostopic list /robot1",
    "rostopic list /nope", "rostopic info /chatter", "rostopic info robot1/pose", "rostopic type /chatter",
    "rostopic type /robot1/pose/pose/position", "rostopic find std_msgs/String", "rostopic find nope/Nope",
    "rostopic",
]  # fmt: skip


@pytest.mark.usefixtures("nodes")
@pytest.mark.parametrize("line", SAME)
def test_the_same_line_prints_the_same(tools: Tools, line: str) -> None:
    real, ours = tools.both(line)
    assert masked(ours.stdout) == masked(real.stdout)
    assert (ours.returncode, ours.stderr) == (real.returncode, real.stderr)


MORE = [
    "rosnode info /nope", "rosnode ping -c 1 /nope", "rosnode kill /nope", "rosnode machine no.such.host.invalid",
    "rosnode bogus", "rostopic info /nope", "rostopic type /nope", "rostopic bogus",
]  # fmt: skip


@pytest.mark.usefixtures("nodes")
@pytest.mark.parametrize("line", MORE)
def test_our_hint_follows_the_error_of_the_real_tool(tools: Tools, line: str) -> None:
    real, ours = tools.both(line)
    assert (ours.returncode, ours.stdout) == (real.returncode, real.stdout)
    assert ours.stderr.startswith(real.stderr)
    assert len(ours.stderr) > len(real.stderr)


@pytest.mark.parametrize("line", ["rosnode list", "rosnode info /x", "rostopic list", "rostopic info /x"])
def test_no_master(tools: Tools, line: str) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    real, ours = tools.both(line, env={"ROS_MASTER_URI": uri})
    rule = "-" * 80 + "\n"
    assert (ours.returncode, ours.stdout.replace(rule, "")) == (1, real.stdout.replace(rule, ""))
    assert ours.stderr.startswith(real.stderr)
    assert uri in ours.stderr


def test_ours_cleans_up_and_kills(tools: Tools, master: dict[str, str]) -> None:
    gone = f"http://127.0.0.1:{free_port()}/"
    ask(master, "registerPublisher", "/gone", "/old", "std_msgs/String", gone)
    ask(master, "registerService", "/gone", "/gone/srv", gone.replace("http", "rosrpc"), gone)
    cleaned = tools.ours("rosnode cleanup", stdin="y\n")
    assert cleaned.returncode == 0
    assert f"ERROR: connection refused to [{gone}]" in cleaned.stderr
    assert cleaned.stdout.endswith("Please type y or n to continue:\nUnregistering /gone\ndone\n")
    assert "/gone" not in tools.real("rosnode list").stdout
    with start([SYSTEM_PYTHON, "-c", NODE, "victim"], env=master) as victim:
        wait_until(lambda: is_ready(master, "victim"), "victim", victim)
        assert tools.ours("rosnode kill victim").stdout == "killing /victim\nkilled\n"
        victim.wait()
    assert "/victim" not in tools.ours("rosnode list").stdout
