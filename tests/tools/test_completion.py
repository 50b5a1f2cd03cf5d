"""What words of command lines may become."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from rosmini import Graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.introspection.direct import DirectWire
from rosmini.tools.completion import candidates

from ..processes import free_port
from .transcripts import talkers


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        talkers(made)
        yield made


BECOMES = [
    ("rosno", ["rosnode"]), ("rosmini rosno", ["rosnode"]), ("rosno x", []),
    ("rosnode ", ["cleanup", "info", "kill", "list", "machine", "ping"]), ("rostopic ec", ["echo"]),
    ("rosmini rostopic echo /ch", ["/chatter"]), ("rostopic hz -w 3 /od", ["/odom"]),
    ("rostopic pub /pose ", ["geometry_msgs/PoseStamped"]), ("rostopic pub /n std_msgs/Str", ["std_msgs/String"]),
    ("rostopic pub /pose std_msgs/String ", []), ("rosnode info /t", ["/talker"]),
    ("rosnode kill /poser /ta", ["/talker"]), ("rosservice call /talker/g", ["/talker/get_loggers"]),
    ("rosservice find std_srvs/Set", ["std_srvs/SetBool"]), ("rossrv package std_s", ["std_srvs"]),
    ("rosmsg show geometry_msgs/PoseSt", ["geometry_msgs/PoseStamped"]), ("rosparam get /us", ["/use_sim_time"]),
    ("rostopic echo --no", ["--noarr", "--nostr"]), ("rosbag inf", ["info"]), ("rosnode nothing /t", []),
    ("roslaunch turtlebot3_gaz", ["turtlebot3_gazebo"]), ("rosrun turtlesi", ["turtlesim", "turtlesim_cleaner"]),
    ("roslaunch turtlebot3_gazebo turtlebot3_wo", ["turtlebot3_world.launch"]),
    ("roslaunch turtlebot3_gazebo turtlebot3_world.launch x_pos:=1 mo", ["model:="]),
    ("roslaunch no_such_package ", []), ("rosrun no_such_package ", []),
    ("rosrun turtlesim turtle_te", ["turtle_teleop_key"]),
    ("rqt_graph --mo", ["--mode"]), ("rqt_msg std_msgs/Strin", ["std_msgs/String"]), ("rqt gra", ["graph"]),
    ("rqt_plot /od", ["/odom"]), ("rqt_logger_level /ta", ["/talker"]),
    ("rqt_service_caller /talker/g", ["/talker/get_loggers"]),
    ("nothing at all", []), ("lab x", []), ("rosnode cleanup x", []), ("rosservice no", []),
]  # fmt: skip


@pytest.mark.parametrize(("line", "found"), BECOMES)
def test_what_a_word_may_become(graph: Graph, line: str, found: list[str]) -> None:
    graph.ask_as("/x").ask("setParam", "/use_sim_time", True)
    words = line.split() + ([""] if line.endswith(" ") else [])
    assert candidates(words, graph) == found


def test_without_a_master_there_are_no_names_and_no_complaint(capsys: pytest.CaptureFixture[str]) -> None:
    with DirectWire(f"http://127.0.0.1:{free_port()}") as wire:
        assert candidates(["rostopic", "echo", ""], wire) == []
        assert candidates(["rostopic", "pub", "/x", "std_msgs/Strin"], wire) == ["std_msgs/String"]
        assert candidates(["rostopic", "e"], wire) == ["echo"]
    assert capsys.readouterr() == ("", "")


def test_names_come_and_go(graph: Graph) -> None:
    assert candidates(["rostopic", "echo", "/late"], graph) == []
    publisher = graph.nodes["/talker"].publisher("/late", String)
    assert candidates(["rostopic", "echo", "/late"], graph) == ["/late"]
    publisher.unregister()
    assert candidates(["rostopic", "echo", "/late"], graph) == []
