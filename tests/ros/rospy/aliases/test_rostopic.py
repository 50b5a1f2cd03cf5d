"""``import rostopic``, as public scripts use it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rosmini import Graph, set_default_graph
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.rospy.aliases import rostopic
from rosmini.ros.scripts import ScriptSpec, run_scripts

TALKER = """
import rospy
from geometry_msgs.msg import PoseStamped
rospy.init_node("talker")
pub = rospy.Publisher("pose", PoseStamped, queue_size=5)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    pub.publish(header=rospy.Header(stamp=rospy.Time.now()))
    rate.sleep()
"""
LISTENER = """
import rospy, rostopic
from rostopic import get_topic_type
rospy.init_node("listener")
cls, topic, field = rostopic.get_topic_class("/pose/header/frame_id", blocking=True)
print(cls._type, topic, repr(field(cls())))
print(get_topic_type("/nothing"))
"""


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        before = set_default_graph(made)
        made.node("talker").publisher("pose", PoseStamped)
        made.node("ear").subscriber("chatter", String)
        yield made
        set_default_graph(before)


def test_scripts_import_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    paths = []
    for name, text in (("listener", LISTENER), ("talker", TALKER)):
        paths.append(tmp_path / f"{name}.py")
        paths[-1].write_text(text, encoding="utf-8")
    run_scripts([ScriptSpec(str(path)) for path in paths], simulated=True, duration=5.0)
    done = capsys.readouterr()
    printed = [line.removeprefix("[listener] ") for line in done.out.splitlines()]
    assert printed[0] == "geometry_msgs/PoseStamped /pose ''"
    assert printed[-1] == "(None, None, None)"
    assert "WARNING: topic [/pose/header/frame_id] does not appear to be published yet" in done.err


def test_what_there_is(graph: Graph) -> None:
    published, subscribed = rostopic.get_topic_list()
    assert ("/pose", "geometry_msgs/PoseStamped", ["/talker"]) in published
    assert ("/chatter", "std_msgs/String", ["/ear"]) in subscribed
    assert rostopic.find_by_type("geometry_msgs/PoseStamped") == ["/pose"]


def test_a_type_that_is_not_known_here(graph: Graph) -> None:
    graph.ask_as("/far").ask("registerPublisher", "/odd", "their_pkg/Odd", "http://127.0.0.1:1/")
    with pytest.raises(rostopic.ROSTopicException, match=r"Cannot load message class for \[their_pkg/Odd\]"):
        rostopic.get_topic_class("/odd")


def test_fields_by_their_paths(capsys: pytest.CaptureFixture[str]) -> None:
    read = rostopic.msgevalgen("pose/position/x")
    assert read is not None
    assert read(PoseStamped()) == 0.0
    assert rostopic.msgevalgen("") is None
    assert rostopic.msgevalgen("/x[") is None
    wrong: Any = rostopic.msgevalgen("/pose/posture")
    assert wrong(PoseStamped()) is None
    said = capsys.readouterr().err
    assert "missing closing ']'" in said
    assert "no field named posture" in said
