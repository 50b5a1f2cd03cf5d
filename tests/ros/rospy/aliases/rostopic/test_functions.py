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
from rostopic import ROSTopicHz, get_topic_type
rospy.init_node("listener")
cls, topic, field = rostopic.get_topic_class("/pose/header/frame_id", blocking=True)
print(cls._type, topic, repr(field(cls())))
hz, two = ROSTopicHz(-1), rostopic.ROSTopicHz(5, filter_expr=lambda m: True, use_wtime=True)
bw, delay = rostopic.ROSTopicBandwidth(), rostopic.ROSTopicDelay(-1)
rospy.Subscriber(topic, cls, hz.callback_hz, callback_args=topic)
rospy.Subscriber(topic, cls, two.callback_hz)
rospy.Subscriber(topic, cls, delay.callback_delay)
print(hz.get_hz(topic))
rospy.sleep(2)
print("%.3f %.3f" % hz.get_hz(topic)[:2])
print(hz.get_hz(topic), len(hz.get_times(topic)) > 10)
two.print_hz()
two.print_hz()
for _ in range(3):
    bw.callback(rospy.AnyMsg().deserialize(b"12345"))
    rospy.sleep(0.1)
bw.print_bw()
delay.print_delay()
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
    assert printed[1] == "None"
    assert printed[2] == "10.000 0.100"
    assert printed[3] == "None True"
    assert printed[4] == "average rate: 10.000"
    assert printed[6] == "no new messages"
    assert printed[7] == "average: 50.00B/s"
    assert printed[9] == "average delay: 0.000"
    assert printed[-1] == "(None, None, None)"
    assert "WARNING: topic [/pose/header/frame_id] does not appear to be published yet" in done.err


def test_what_there_is(graph: Graph) -> None:
    rostopic._check_master()
    published, subscribed = rostopic.get_topic_list()
    assert ("/pose", "geometry_msgs/PoseStamped", ["/talker"]) in published
    assert ("/chatter", "std_msgs/String", ["/ear"]) in subscribed
    assert rostopic.find_by_type("geometry_msgs/PoseStamped") == ["/pose"]
    assert ["/pose", "geometry_msgs/PoseStamped"] in rostopic._master_get_topic_types(None)
    assert rostopic._get_topic_type("/pose")[:2] == ("geometry_msgs/PoseStamped", "/pose")
    assert rostopic.get_api(None, "/talker") == graph.nodes["/talker"].uri
    assert rostopic.get_api(None, "/nobody") == "unknown address /nobody"
    assert rostopic.get_info_text("/chatter").startswith("Type: std_msgs/String\n\nPublishers: None\n\nSubscribers: \n")
    with pytest.raises(rostopic.ROSTopicException, match="Unknown topic /nope"):
        rostopic.get_info_text("/nope")


def test_a_type_that_is_not_known_here(graph: Graph) -> None:
    graph.ask_as("/far").ask("registerPublisher", "/odd", "their_pkg/Odd", "http://127.0.0.1:1/")
    with pytest.raises(rostopic.ROSTopicException, match=r"Cannot load message class for \[their_pkg/Odd\]"):
        rostopic.get_topic_class("/odd")
    with pytest.raises(rostopic.ROSTopicException, match="invalid message type: their_pkg/Odd"):
        rostopic.create_publisher("/odd", "their_pkg/Odd", latch=False)


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
    choose = rostopic.create_field_filter(echo_nostr=True, echo_noarr=True)
    assert list(choose(PoseStamped().header)) == ["seq", "stamp"]


PUBLISHER = """
import rostopic
pub, cls = rostopic.create_publisher("/news", "std_msgs/Header", True)
rostopic.publish_message(pub, cls, [{"stamp": "now", "frame_id": "map"}], once=True, verbose=False)
try:
    rostopic.publish_message(pub, cls, [{"frame": "map"}], once=True)
except rostopic.ROSTopicException as error:
    print(str(error).splitlines()[-1])
rostopic.publish_message(pub, cls, [1, "now", "odom"], rate=10)
"""


def test_publishing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, ear = tmp_path / "publisher.py", tmp_path / "ear.py"
    path.write_text(PUBLISHER, encoding="utf-8")
    ear.write_text(
        "import rospy\nfrom std_msgs.msg import Header\nrospy.init_node('ear')\n"
        "rospy.Subscriber('/news', Header, lambda m: print(m.frame_id))\nrospy.spin()\n",
        encoding="utf-8",
    )
    run_scripts([ScriptSpec(str(ear)), ScriptSpec(str(path))], simulated=True, duration=1.0)
    said = [line.removeprefix("[rostopic_1_1000000] ") for line in capsys.readouterr().out.splitlines()]
    assert "publishing and latching message for 3.0 seconds" in said
    assert "Args are: [seq stamp frame_id]" in said
    assert said.count("[ear] odom") >= 5
