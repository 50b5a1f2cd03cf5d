"""Executables by their ROS names: built-in nodes of an installed package, and scripts of a workspace."""

import io

import pytest

from rosmini import Graph, rosrun, set_default_graph
from rosmini.core.errors import RosminiError, ScriptError, UnknownPackage
from rosmini.core.graph import Node
from rosmini.msgs.std_msgs.msg import Int32
from rosmini.ros.scripts import find
from rosmini.tools.main import main

NODES = """
from rosmini.msgs.std_msgs.msg import Int32


class Counter:
    def __init__(self, node, step=1):
        self.node = node
        self.value = node.get_param("~start", 0)
        self.publisher = node.publisher("count", Int32)
        node.timer(node.get_param("~period", 1.0), self.tick)
        self.step = int(step)

    def tick(self, event):
        self.value += self.step
        self.publisher.publish(self.value)


def patient(node):
    return node.wait_for_message("count", Int32).data


def chatty(node):
    print("I can print")
    node.timer(1.0, lambda _: print("and I go on") or node.logwarn("and I warn"))


def broken(node):
    node.publisher("count", Int32)
    raise ValueError("no such thing")
"""

SCRIPT = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32
rospy.init_node("listener")
for _ in range(3):
    print("got", rospy.wait_for_message("count", Int32).data)
"""


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A distribution with built-in nodes of the package `counting`, and a workspace with that package."""
    site = tmp_path / "site"
    info = site / "counting-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: counting\nVersion: 1.0\n", encoding="utf-8")
    names = {"counter": "Counter", "patient": "patient", "broken": "broken", "chatty": "chatty"}
    lines = [f"counting/{name} = counting_nodes:{target}" for name, target in names.items()]
    (info / "entry_points.txt").write_text("\n".join(["[rosmini.nodes]", *lines]) + "\n", encoding="utf-8")
    (site / "counting_nodes.py").write_text(NODES, encoding="utf-8")
    monkeypatch.syspath_prepend(str(site))
    scripts = tmp_path / "ws" / "counting" / "scripts"
    scripts.mkdir(parents=True)
    (scripts.parent / "package.xml").write_text(
        "<package format='2'><name>counting</name><version>1.0.0</version><description>d</description>"
        "<maintainer email='a@b.cd'>a</maintainer><license>Apache-2.0</license></package>",
        encoding="utf-8",
    )
    (scripts / "listener.py").write_text(SCRIPT, encoding="utf-8")
    (scripts / "listener.py").chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    yield scripts
    import sys

    sys.modules.pop("counting_nodes", None)


@pytest.fixture
def graph():
    with Graph() as made:
        before = set_default_graph(made)
        yield made
        set_default_graph(before)


def heard(graph):
    values = []
    graph.node("ear").subscriber("/robot1/tally", Int32, lambda message: values.append(message.data))
    return values


@pytest.mark.usefixtures("workspace")
def test_a_built_in_node_takes_ros_arguments_and_gives_its_object(graph):
    values = heard(graph)
    arguments = ["__name:=sheep", "__ns:=robot1", "_start:=10", "_period:=0.5", "count:=tally", "2"]
    counter = rosrun("counting", "counter", *arguments).instance()
    assert isinstance(counter.node, Node)
    assert counter.node.name == "/robot1/sheep"
    assert graph.master.getParam("/me", "/robot1/sheep/start")[2] == 10
    began = graph.now()
    graph.run(1.7)
    assert values == [12, 14, 16]
    assert (graph.now() - began).to_sec() == pytest.approx(1.7)


def test_a_path_is_an_argument_like_its_text(graph, tmp_path):
    path = tmp_path / "small.world"
    path.write_text('position( name "alone" )', encoding="utf-8")
    assert rosrun("stage_ros", "stageros", path).instance().world.name == "small"
    with Graph() as other:
        assert rosrun("stage_ros", "stageros", str(path), graph=other).instance().world.name == "small"
    assert list(graph.nodes) == ["/rosout", "/stageros"]


@pytest.mark.usefixtures("workspace")
def test_starting_takes_no_time_unless_the_node_waits(graph):
    began = graph.now()
    rosrun("counting", "counter", graph=graph).instance()
    assert graph.now() == began
    assert rosrun("counting", "patient", graph=graph).instance() == 1
    assert (graph.now() - began).to_sec() == pytest.approx(1.0)


@pytest.mark.usefixtures("workspace")
def test_what_a_node_raises_while_it_is_set_up_is_raised_and_the_node_ends(graph):
    with pytest.raises(ValueError, match="no such thing"):
        rosrun("counting", "broken", graph=graph).instance()
    assert "/broken" not in graph.nodes
    publishers, _, services = graph.master.getSystemState("/me")[2]
    assert all("/broken" not in holders for _, holders in (*publishers, *services))


@pytest.mark.usefixtures("workspace")
@pytest.mark.parametrize(
    ("package", "executable", "arguments", "error", "says"),
    [
        ("countin", "counter", (), UnknownPackage, "did you mean counting"),
        ("counting", "countr", (), ScriptError, "did you mean counter"),
        ("counting", "counter", ("1", "2"), ScriptError, r"does not take the arguments \['1', '2'\]"),
        ("counting", "counter", ("_start:=[",), RosminiError, "not YAML"),
    ],
)
def test_bad_calls_say_what_is_there(graph, package, executable, arguments, error, says):
    with pytest.raises(error, match=says):
        rosrun(package, executable, *arguments, graph=graph).instance()
    assert set(graph.nodes) == {"/rosout"}


@pytest.mark.parametrize("name", ["counter", "a/b/c", "/counter", "counting/"])
def test_names_have_two_parts(name):
    with pytest.raises(ScriptError, match="PACKAGE/EXECUTABLE"):
        find(name)


@pytest.mark.usefixtures("workspace")
def test_a_script_of_a_package_goes_on_with_the_graph(graph):
    rosrun("counting", "counter", graph=graph)
    out = io.StringIO()
    handle = rosrun("counting", "listener.py", graph=graph, stdout=out)
    graph.run(1.5)
    assert handle.poll() is None
    assert out.getvalue() == "[listener] got 1\n"
    assert handle.wait() == 0
    assert out.getvalue() == "[listener] got 1\n[listener] got 2\n[listener] got 3\n"
    assert "/counter" in graph.nodes


@pytest.mark.usefixtures("workspace")
def test_what_a_built_in_node_says_goes_where_its_starter_wants_it(graph, capfd):
    handle = rosrun("counting", "chatty", graph=graph, capture_output=True, prefix=False)
    given, warned = io.StringIO(), io.StringIO()
    rosrun("counting", "chatty", "__name:=other", graph=graph, stdout=given, stderr=warned)
    graph.run(1.5)
    lines = handle.output.splitlines()
    assert lines[:2] == ["I can print", "and I go on"]
    assert lines[2].endswith("]: and I warn")
    assert given.getvalue() == "[other] I can print\n[other] and I go on\n"
    assert warned.getvalue().startswith("[other] [WARN]")
    assert capfd.readouterr() == ("", "")


@pytest.mark.usefixtures("workspace")
def test_built_in_nodes_run_beside_scripts_and_end_with_them(capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    words = ["counting/counter", "_start:=7", "+", "counting/listener.py"]
    assert main(["run", "--sim-time", *words]) == 0
    assert capsys.readouterr().out.splitlines() == [f"[listener] got {n}" for n in (8, 9, 10)]


@pytest.mark.usefixtures("workspace")
def test_a_node_that_cannot_be_set_up_fails_the_run(capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    assert main(["run", "--sim-time", "counting/broken"]) == 1
    shown = capsys.readouterr().err
    assert "[broken] ValueError: no such thing" in shown
    assert "rosmini/ros/scripts" not in shown


def test_unknown_names_on_the_command_line(capsys):
    assert main(["run", "beginer_tutorials/simulator"]) == 1
    assert "did you mean beginner_tutorials" in capsys.readouterr().err
    assert main(["run", "nowhere/at_all.py"]) == 1
    assert "at_all.py" in capsys.readouterr().err


def test_a_node_that_outlives_the_stream_of_who_started_it_ends_in_peace():
    graph, stream = Graph(), io.StringIO()
    words = ["1", "2", "0", "0", "0", "0", "a", "b"]
    handle = rosrun("tf2_ros", "static_transform_publisher", *words, graph=graph, stdout=stream)
    handle.instance()
    stream.close()
    graph.shutdown()
    assert handle.poll() == 0
