"""The command lines of ROS's modules, as scripts call them."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import pytest

from rosmini import Graph, set_default_graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.rospy.aliases.rosbag import rosbagmain
from rosmini.ros.rospy.aliases.rosmsg import MODE_SRV, rosmsgmain
from rosmini.ros.rospy.aliases.rosnode import rosnodemain
from rosmini.ros.rospy.aliases.rosservice import rosservicemain
from rosmini.ros.rospy.aliases.rostopic import rostopicmain


@pytest.fixture(autouse=True)
def graph() -> Iterator[Graph]:
    with Graph() as made:
        before = set_default_graph(made)
        made.node("talker").publisher("chatter", String, latch=True).publish("hello")
        yield made
        set_default_graph(before)


def test_they_print_what_the_tools_do(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    rosnodemain(["rosnode", "list"])
    rostopicmain(["rostopic", "echo", "-n", "1", "/chatter"])
    rosservicemain(["rosservice", "type", "/talker/get_loggers", "__name:=asking"])
    monkeypatch.setattr(sys, "argv", ["rossrv", "show", "std_srvs/Empty"])
    rosmsgmain(MODE_SRV)
    monkeypatch.setattr(sys, "argv", ["rostopic", "type", "/chatter"])
    rostopicmain()
    assert capsys.readouterr().out == (
        '/rosout\n/talker\ndata: "hello"\n---\nroscpp/GetLoggers\n---\n\nstd_msgs/String\n'
    )


def test_a_failure_is_an_exit_status(capsys: pytest.CaptureFixture[str]) -> None:
    for main, words, status in (
        (rostopicmain, ["rostopic", "info", "/nothing"], 1),
        (rostopicmain, ["rostopic", "ecko"], 2),
        (rosbagmain, ["rosbag", "info", "none.bag"], 1),
    ):
        with pytest.raises(SystemExit) as ended:
            main(words)
        assert ended.value.code == status
    said = capsys.readouterr().err
    assert "ERROR: Unknown topic /nothing" in said
    assert "did you mean echo?" in said
    assert "none.bag" in said
