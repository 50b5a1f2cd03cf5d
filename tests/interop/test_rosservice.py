"""`rosmini rosservice` beside the real tool, at one real Master with a real server."""

from __future__ import annotations

import re
import xmlrpc.client
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from ..processes import free_port, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros

if TYPE_CHECKING:
    from .conftest import Tools

need_ros("rosservice", modules="rospy, roscpp.srv, sensor_msgs.srv, tf2_msgs.srv")

NODE = """
import rospy
from roscpp.srv import Empty, EmptyResponse
from sensor_msgs.srv import SetCameraInfo, SetCameraInfoResponse
from tf2_msgs.srv import FrameGraph, FrameGraphResponse

def bad(request):
    raise ValueError("deliberate failure")

rospy.init_node("server")
rospy.Service("frames", FrameGraph, lambda request: FrameGraphResponse("here"))
rospy.Service("~empty", Empty, lambda request: EmptyResponse())
rospy.Service("/robot1/info", SetCameraInfo, lambda r: SetCameraInfoResponse(True, str(r.camera_info.width)))
rospy.Service("fails", FrameGraph, bad)
rospy.set_param("/ready", True)
rospy.spin()
"""


@pytest.fixture(scope="module")
def server(master: dict[str, str]) -> Iterator[dict[str, str]]:
    """The environment of a Master with a real node that offers services."""
    with (
        start([SYSTEM_PYTHON, "-c", NODE], env=master) as process,
        xmlrpc.client.ServerProxy(master["ROS_MASTER_URI"]) as proxy,
    ):
        wait_until(lambda: proxy.hasParam("/test", "/ready")[2], "server", process)  # type: ignore[index]
        yield master


SAME = [
    "list", "list -n", "list /robot1", "list /robot1/info", "list /nope", "type /frames", "type robot1/info",
    "uri /frames", "args /robot1/info", "args /server/empty", "info /robot1/info",
    "find tf2_msgs/FrameGraph", "find nope/Nope", "call /frames", "call /server/empty",
    "call -v /robot1/info 'camera_info: {width: 3}'", "call --wait /frames",
    "call /server/set_logger_level rosout warn", "list a b", "find", "info", "type", "bogus",
]  # fmt: skip


pytestmark = pytest.mark.usefixtures("server")


@pytest.mark.parametrize("line", SAME)
def test_the_same_line_prints_the_same(tools: Tools, line: str) -> None:
    real, ours = tools.both(f"rosservice {line}")
    assert (ours.stdout, ours.returncode) == (real.stdout, real.returncode)
    assert ours.stderr.startswith(real.stderr)


@pytest.mark.parametrize("line", ["type /nope", "uri /nope", "info /nope", "call /nope", "args /nope", "call /fails"])
def test_errors_begin_as_the_real_ones(tools: Tools, line: str) -> None:
    real, ours = tools.both(f"rosservice {line}")
    assert (ours.stdout, ours.returncode) == (real.stdout, real.returncode)
    assert ours.stderr.startswith(re.sub(r"b'(.*)'$", r"\1", real.stderr, flags=re.MULTILINE))


def test_no_master(tools: Tools) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    real, ours = tools.both("rosservice list", env={"ROS_MASTER_URI": uri})
    assert (ours.stdout, ours.returncode) == (real.stdout, real.returncode)
    assert ours.stderr.startswith(real.stderr)


def test_a_tool_leaves_nothing_behind(tools: Tools, server: dict[str, str]) -> None:
    with xmlrpc.client.ServerProxy(server["ROS_MASTER_URI"]) as proxy:
        before = proxy.getSystemState("/test")
        assert tools.ours("rosservice call /frames").returncode == 0
        assert proxy.getSystemState("/test") == before
