"""ROS's own command line tools on our nodes and under our roscore: what they say of our node they say of a real one.

Both nodes do the same, so a tool's output about one, with names, ports and times taken out, is its output about the
other.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import pytest
import yaml

from ...processes import wait_until
from ..conftest import SYSTEM_PYTHON
from .harness import ALL_REAL, PACKAGE, ROSMINI

if TYPE_CHECKING:
    from .harness import Peer, Stage

pytestmark = pytest.mark.ros

Peers = tuple["Peer", "Peer"]
INFO = "sensor_msgs/SetCameraInfo"


@pytest.fixture
def busy(core: Stage, pair: Peers) -> Peers:
    """The two nodes: each publishes ten times a second, listens to the other, and serves."""
    idle = [(peer, other) for peer, other in (pair, pair[::-1]) if not peer.is_busy]
    for peer, other in idle:
        peer.ask("advertise", f"{peer.node}/count", "std_msgs/Int32")
        peer.ask("every", f"{peer.node}/count")
        peer.ask("advertise", f"{peer.node}/latched", "std_msgs/String", latch=True)
        peer.ask("publish", f"{peer.node}/latched", ["käse"])
        peer.ask("serve", f"{peer.node}/set_info", INFO, {"success": True, "status_message": "set"})
        peer.ask("subscribe", f"{peer.node}/inbox", "std_msgs/String")
        peer.ask("subscribe", f"{other.node}/count", "std_msgs/Int32", what="header")
    for peer, other in idle:
        peer.is_busy = True
        peer.ask("hear", f"{other.node}/count")
        core.wait_for(f"{peer.node}/count", "subscribers", other.node)
    return pair


def same(texts: list[str]) -> str:
    """Take out of two outputs what may differ, assert that they are equal, and return that."""
    found = []
    for text, one, other in ((texts[0], "ours", "theirs"), (texts[1], "theirs", "ours")):
        plain = re.sub(rf"\b{one}\b", "ONE", re.sub(rf"\b{other}\b", "OTHER", text))
        ports = r" \(\d+ - 127\.0\.0\.1:\d+\) \[\d+\]"
        plain = re.sub(rf"(outbound){ports}", r"\1 (PORT - HOST:PORT) [FD]", plain)
        plain = re.sub(rf"(inbound){ports}", r"\1", plain)  # as roscpp; rospy does not know its own socket there
        plain = re.sub(r"(127\.0\.0\.1|localhost):\d+", "HOST:PORT", plain)
        plain = re.sub(r"Pid: \d+", "Pid: N", plain)
        found.append("\n".join(sorted(plain.splitlines())))
    assert found[0] == found[1]
    return texts[0]


def both(core: Stage, busy: Peers, *words: str) -> str:
    """Ask a tool of both nodes; `{}` in a word is the node. Return what it said of ours."""
    return same([core.tool(*(word.format(peer.node) for word in words)) for peer in busy])


def test_rosnode(core: Stage, busy: Peers) -> None:
    listed = core.tool("rosnode", "list").splitlines()
    assert listed == sorted(core.nodes())
    assert {"/ours", "/rosout", "/theirs"} <= set(listed)
    assert core.tool("rosnode", "list", "-u").split().count(busy[0].uri) == 1
    info = both(core, busy, "rosnode", "info", "{}")
    assert " * /ours/count [std_msgs/Int32]\n" in info
    assert " * /ours/set_info\n" in info
    assert re.search(r" \* topic: /ours/count\n    \* to: /theirs\n    \* direction: outbound", info)
    assert re.search(r" \* topic: /theirs/count\n    \* to: /theirs \(http", info)
    assert core.tool("rosnode", "machine", "127.0.0.1").split() == listed
    for peer in busy:
        said = core.tool("rosnode", "ping", "-c", "2", peer.node)
        assert len(re.findall(rf"xmlrpc reply from {peer.uri}\ttime=[\d.]+ms", said)) == 2, said


def test_rostopic_about_topics(core: Stage, busy: Peers) -> None:
    listed = core.tool("rostopic", "list", "-v")
    for peer in busy:
        assert f" * {peer.node}/count [std_msgs/Int32] 1 publisher\n" in listed
        assert f" * {peer.node}/inbox [std_msgs/String] 1 subscriber\n" in listed
    info = both(core, busy, "rostopic", "info", "{}/count")
    assert f"Publishers: \n * /ours ({busy[0].uri})\n\nSubscribers: \n * /theirs ({busy[1].uri})" in info
    assert both(core, busy, "rostopic", "type", "{}/inbox") == "std_msgs/String\n"
    assert {"/ours/inbox", "/theirs/inbox", "/ours/latched"} <= set(
        core.tool("rostopic", "find", "std_msgs/String").split()
    )


def test_rostopic_echo_hz_and_bw(core: Stage, busy: Peers) -> None:
    assert yaml.safe_load(both(core, busy, "rostopic", "echo", "-n1", "{}/latched").replace("---", "")) == {
        "data": "käse"
    }
    running = [
        (core.start("hz", ["rostopic", "hz", *(f"{peer.node}/count" for peer in busy)]), r"/ours/count +1?\d\.\d"),
        (core.start("bw", ["rostopic", "bw", "/ours/count"]), r"average: \d+\.\d\dB/s"),
        (core.start("echo", ["rostopic", "echo", "/ours/count"]), r"data: (\d+)\n---\n(.*\n)*data: \d+\n---\n"),
    ]
    for tool, pattern in running:
        tool.wait_for(pattern)
    hz = running[0][0].wait_for(r"/theirs/count +([\d.]+)")
    assert float(hz[1]) > 0
    assert [tool.interrupt() for tool, _ in running] == [0, 0, 0]
    core.wait_for("/ours/count", "subscribers", "/theirs")


def test_rostopic_pub(core: Stage, busy: Peers) -> None:
    for peer in busy:
        pub = core.start("pub", ["rostopic", "pub", "-r", "20", f"{peer.node}/inbox", "std_msgs/String", "hello"])
        assert peer.ask("hear", f"{peer.node}/inbox", 3)[:3] == [{"data": "hello"}] * 3
        assert pub.interrupt() == 0
        core.wait_for(f"{peer.node}/inbox", "publishers")
        peer.ask("forget", f"{peer.node}/inbox")
        peer.tell("hear", f"{peer.node}/inbox")
        while not peer.has_answered():  # it says it for three seconds
            core.tool("rostopic", "pub", "-1", f"{peer.node}/inbox", "std_msgs/String", "once")
        assert peer.answer() == [{"data": "once"}]


def test_rosservice(core: Stage, busy: Peers) -> None:
    listed = core.tool("rosservice", "list").split()
    assert {f"{peer.node}/{name}" for peer in busy for name in ("get_loggers", "set_logger_level", "set_info")} <= set(
        listed
    )
    info = both(core, busy, "rosservice", "info", "{}/set_info")
    assert info.startswith("Node: /ours\nURI: rosrpc://127.0.0.1:")
    assert info.endswith("\nType: sensor_msgs/SetCameraInfo\nArgs: camera_info\n")
    said = both(core, busy, "rosservice", "call", "{}/set_info", "{{camera_info: {{height: 3}}}}")
    assert yaml.safe_load(said) == {"success": True, "status_message": "set"}
    assert [peer.ask("hear", f"{peer.node}/set_info")[-1]["camera_info"]["height"] for peer in busy] == [3, 3]
    loggers = [core.tool("rosservice", "call", f"{peer.node}/get_loggers") for peer in busy]
    assert ["name: rosout" in text.replace('"', "") for text in loggers] == [True, True]
    assert core.tool("rosservice", "find", INFO).split() == sorted(f"{peer.node}/set_info" for peer in busy)
    same([core.tool("rosservice", "uri", f"{peer.node}/set_info") for peer in busy])


def test_rosparam(core: Stage, busy: Peers) -> None:
    core.tool("rosparam", "set", "/tool/tree", "{a: 1, b: {c: [x, 2.5, true]}}")
    assert busy[0].ask("param", "get_param", "/tool/tree/b") == {"c": ["x", 2.5, True]}
    busy[0].ask("param", "set_param", "/tool/text", "käse")
    assert yaml.safe_load(core.tool("rosparam", "get", "/tool/text")) == "käse"
    file = core.home / "dumped.yaml"
    core.tool("rosparam", "dump", str(file), "/tool")
    core.tool("rosparam", "load", str(file), "/again")
    assert busy[0].ask("param", "get_param", "/again") == busy[0].ask("param", "get_param", "/tool")
    core.tool("rosparam", "delete", "/again")
    assert busy[0].ask("param", "has_param", "/again/text") is False
    listed = core.tool("rosparam", "list").split()
    assert [name for name in listed if name.startswith("/tool")] == ["/tool/text", "/tool/tree/a", "/tool/tree/b/c"]
    assert {"/rosdistro", "/rosversion", "/run_id"} <= set(listed)


def test_rosbag_records_both_and_plays_to_both(core: Stage, busy: Peers) -> None:
    bag = core.home / "both.bag"
    topics = [f"{peer.node}/{name}" for peer in busy for name in ("count", "latched")]
    record = core.start("record", ["rosbag", "record", "-O", bag, *topics])
    core.wait_until_heard("/record", topics)
    for peer, other in (busy, busy[::-1]):
        other.ask("forget", f"{peer.node}/count")
        other.ask("hear", f"{peer.node}/count", 10)
    assert record.interrupt() == 0
    wait_until(bag.is_file, "the end of the recorder, which `rosbag record` waits for a quarter of a second only")
    info = core.tool("rosbag", "info", "-y", str(bag))
    found = {topic["topic"]: topic for topic in yaml.safe_load(info)["topics"]}
    assert {name: (found[name]["type"]) for name in topics} == {
        name: "std_msgs/String" if name.endswith("latched") else "std_msgs/Int32" for name in topics
    }
    assert all(found[f"{peer.node}/latched"]["messages"] == 1 for peer in busy)
    assert all(found[f"{peer.node}/count"]["messages"] >= 3 for peer in busy)
    for peer in busy:
        peer.ask("subscribe", "/played", "std_msgs/String")
    renamed = ["/ours/latched:=/played", "/theirs/latched:=/played", "/ours/count:=/gate"]
    words = ["rosbag", "play", "--wait-for-subscribers", bag, "--topics"]
    words += [name.partition(":")[0] for name in renamed]
    play = core.play([*words, *renamed], "/played", busy)
    for peer in busy:
        assert peer.ask("hear", "/played", 2) == [{"data": "käse"}] * 2
    assert play.ended() == 0


RQT_GRAPH = """
import json, rosgraph.impl.graph
graph = rosgraph.impl.graph.Graph()
graph.set_master_stale(5.0)
graph.set_node_stale(5.0)
graph.update()
edges = sorted({(e.start.strip(), e.label, e.end.strip()) for e in graph.nn_edges})
print(json.dumps([sorted(name.strip() for name in graph.nn_nodes), sorted(n.strip() for n in graph.nt_nodes), edges,
    sorted(graph.bad_nodes)]))
"""


def test_what_rqt_graph_asks(core: Stage, busy: Peers) -> None:
    nodes, topics, edges, bad = yaml.safe_load(core.tool(SYSTEM_PYTHON, "-c", RQT_GRAPH))
    assert {"/ours", "/theirs", "/rosout"} <= set(nodes)
    assert {"/ours/count", "/theirs/count"} <= set(topics)
    assert bad == []
    for edge in (
        ["/ours", "/ours/count", "/theirs"],
        ["/theirs", "/theirs/count", "/ours"],
        ["/ours", "/rosout", "/rosout"],
    ):
        assert edge in edges


def test_roswtf_finds_nothing_wrong(core: Stage, busy: Peers) -> None:
    _, online = core.tool("roswtf").split("Beginning tests of your ROS graph.")
    assert "ERROR" not in online, online
    assert re.findall(r"The following .*", online) == ["The following node subscriptions are unconnected:"], online


def test_rosnode_kill_and_cleanup(core: Stage, busy: Peers) -> None:
    victims = [core.peer(kind, f"victim_{kind}").ready() for kind in ("ours", "real")]
    for victim in victims:
        said = core.tool("rosnode", "kill", victim.node)
        assert said == f"killing {victim.node}\nkilled\n"
        victim.process.stdin.close()
        assert victim.ended() == 0
        wait_until(lambda node=victim.node: node not in core.nodes(), "unregistering")
    victims = [core.peer(kind, f"dead_{kind}").ready() for kind in ("ours", "real")]
    for victim in victims:
        victim.kill()
    assert {"/dead_ours", "/dead_real"} <= core.nodes()
    cleanup = core.start("cleanup", ["rosnode", "cleanup"])
    cleanup.wait_for("Please type y or n to continue")
    cleanup.process.stdin.write("y\n")
    cleanup.process.stdin.flush()
    assert cleanup.ended() == 0
    assert not {"/dead_ours", "/dead_real"} & core.nodes()
    assert {"/ours", "/theirs"} <= core.nodes()


def test_a_cpp_node_between_ours_and_ours(core: Stage, busy: Peers) -> None:
    """`relay` is roscpp: it subscribes to one of our topics, and what it publishes comes back to us."""
    ours = busy[0]
    ours.ask("subscribe", "/relayed", "std_msgs/String")
    relay = core.start("relay", ["/usr/lib/topic_tools/relay", "/ours/latched", "/relayed"])
    assert ours.ask("hear", "/relayed")[0] == {"data": "käse"}
    throttle = core.start("throttle", ["/usr/lib/topic_tools/throttle", "messages", "/ours/count", "5", "/slow"])
    ours.ask("subscribe", "/slow", "std_msgs/Int32")
    ours.ask("hear", "/slow", 2)
    (name,) = core.who("/relayed", "publishers")
    said: Any = core.tool("rosnode", "info", name)
    assert "topic: /ours/latched" in said
    assert said.count("* to: /ours") == 2
    for child in (relay, throttle):
        child.interrupt()
    wait_until(lambda: name not in core.nodes(), "relay's end")


URDF = """<robot name="arm"><link name="base"/><link name="hand"/>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="hand"/><origin xyz="0.5 0 0"/>
<axis xyz="0 0 1"/></joint></robot>"""


def test_robot_state_publisher_and_tf_echo(core: Stage, busy: Peers) -> None:
    """robot_state_publisher (roscpp) hears our joint states; we hear its transforms, and tf_echo (roscpp) ours."""
    ours = busy[0]
    ours.ask("param", "set_param", "/robot_description", URDF)
    publisher = core.start("state", ["/usr/lib/robot_state_publisher/robot_state_publisher"])
    ours.ask("advertise", "/joint_states", "sensor_msgs/JointState")
    assert ours.ask("connected", "/joint_states") == 1
    ours.ask("every_joint_state", "/joint_states", "shoulder", 0.5)
    assert ours.ask("look_up", "base", "hand") == 0.5
    ours.ask("broadcast", "world", "base", 1.25)
    echo = core.start("tf_echo", ["/usr/lib/tf/tf_echo", "world", "hand"])
    echo.wait_for(r"- Translation: \[1\.750, 0\.000, 0\.000\]")
    echo.wait_for(r"in RPY \(radian\) \[0\.000, -?0\.000, 0\.500\]")
    for child in (publisher, echo):
        child.interrupt()


LAUNCH = """<launch>
  <param name="shared" value="7"/>
  <group ns="fleet">
    <node pkg="{package}" type="peer.py" name="launched" launch-prefix="{prefix}" required="true" output="screen">
      <param name="speed" value="1.5"/><remap from="chatter" to="/news"/>
    </node>
  </group>
</launch>
"""


def test_roslaunch_starts_our_nodes(core: Stage) -> None:
    file = core.home / "ours.launch"
    prefix = SYSTEM_PYTHON if ALL_REAL else " ".join([*ROSMINI, "rosrun", PACKAGE, "peer.py"])
    file.write_text(LAUNCH.format(package=PACKAGE, prefix=prefix), encoding="utf-8")
    launch = core.start("roslaunch", ["roslaunch", "--wait", file], {"PEER_ADVERTISES": "chatter"})
    core.wait_for("/news", "publishers", "/fleet/launched")
    launch.wait_for(r'@ \["ready", "/fleet/launched"')
    assert core.master("getParam", "/fleet/launched/speed") == 1.5
    assert core.master("getParam", "/shared") == 7
    core.tool("rosnode", "kill", "/fleet/launched")
    launch.process.stdin.close()
    launch.wait_for(r"REQUIRED process \[fleet/launched-\d+\] has died!")
    assert launch.ended() == 0
    assert "/fleet/launched" not in core.nodes()
