"""`roswtf` finds what beginners lose days to, on a graph of this process and in a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.errors import UsageError
from rosmini.msgs.geometry_msgs.msg import TransformStamped
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.tf2_msgs.msg import TFMessage
from rosmini.tools.roswtf import TOOL, Diagnosis

from ..processes import free_port
from ..ros.launch.workspace import make


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph(strict=False) as made:
        yield made


def look(graph: Graph, *words: str) -> Diagnosis:
    result = TOOL.run(*words, graph=graph, say=lambda _: None)
    assert isinstance(result, Diagnosis)
    return result


def rules(diagnosis: Diagnosis) -> list[str]:
    return [each.rule for each in diagnosis.findings]


def test_a_graph_that_is_well(graph: Graph) -> None:
    graph.node("talker").publisher("chatter", String)
    graph.node("listener").subscriber("chatter", String, print)
    found = look(graph)
    assert found.findings == ()
    assert str(found).count("No errors or warnings") == 2


def misspelt(graph: Graph) -> None:
    graph.node("talker").publisher("chatter", String)
    graph.node("listener").subscriber("chater", String, print)


def a_callback_that_fails(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("chatter", String)
    graph.node("listener").subscriber("chatter", String, lambda message: message.dat)
    graph.node("clockwork").timer(0.2, lambda _: publisher.publish("x"))


def a_first_message_that_is_lost(graph: Graph) -> None:
    node = graph.node("talker")
    publisher = node.publisher("chatter", String)
    node.timer(0.7, lambda _: publisher.publish("x"), oneshot=True)


def no_way_for_the_robot(graph: Graph) -> None:
    node = graph.node("move_base")
    node.timer(0.3, lambda _: node.logwarn("DWA planner failed to produce path."))


def transforms(*links: tuple[str, str, str]) -> Callable[[Graph], None]:
    """Nodes that send transforms: (node, parent, child)."""

    def make(graph: Graph) -> None:
        for name, parent, child in links:
            node = graph.node(name)
            publisher = node.publisher("/tf", TFMessage)

            def send(_: Any, publisher: Any = publisher, parent: str = parent, child: str = child) -> None:
                one = TransformStamped(child_frame_id=child)
                one.header.frame_id, one.header.stamp = parent, graph.now()
                one.transform.rotation.w = 1.0
                publisher.publish(TFMessage([one]))

            node.timer(0.1, send)

    return make


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (misspelt, ["no_publisher"]),
        (a_callback_that_fails, ["logged_errors"]),
        (transforms(("one", "map", "odom"), ("two", "map", "odom")), ["repeated_senders"]),
        (a_first_message_that_is_lost, ["logged_warnings"]),
        (no_way_for_the_robot, ["logged_warnings"]),
    ],
    ids=lambda each: getattr(each, "__name__", None),
)
def test_it_finds_what_beginners_lose_days_to(graph: Graph, make: Callable[[Graph], None], expected: list[str]) -> None:
    make(graph)
    graph.run(0.5)
    assert rules(look(graph)) == expected


def test_a_launch_file_is_looked_at_too(graph: Graph, tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    file.write_text('<launch><node pkg="turtlebot3_nope" type="x" name="x"/></launch>', encoding="utf-8")
    assert rules(look(graph, str(file))) == ["launch_missing"]
    assert rules(look(graph, str(file.with_name("b.launch")))) == ["launch_file"]
    file.write_text('<launch><arg name="which"/><param name="x" value="$(arg which)"/></launch>', encoding="utf-8")
    assert rules(look(graph, str(file), "which:=1")) == []
    assert rules(look(graph, str(file))) == ["launch_missing"]


def test_a_workspace_that_the_terminal_was_not_set_up_for(
    graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "ws" / "src" / "mine"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>mine</name><version>0.0.1</version><description>x</description>'
        '<maintainer email="a@example.org">A</maintainer><license>BSD</license></package>',
        encoding="utf-8",
    )
    (package.parent / "CMakeLists.txt").write_text("", encoding="utf-8")
    monkeypatch.chdir(package)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    (finding,) = look(graph, "--offline").findings
    assert finding.rule == "unused_workspace"
    assert "catkin_make, and then" in finding.advice
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(package.parent))
    assert rules(look(graph, "--offline")) == []


def test_it_takes_as_long_as_it_is_told_and_leaves_nothing(graph: Graph) -> None:
    before, nodes = graph.now().to_sec(), list(graph.nodes)
    look(graph, "--duration", "2.5")
    assert graph.now().to_sec() - before == pytest.approx(2.5)
    assert list(graph.nodes) == nodes
    look(graph, "--offline")
    assert graph.now().to_sec() - before == pytest.approx(2.5)


def test_without_a_master_only_the_environment_is_looked_at(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "gone"))
    monkeypatch.chdir(tmp_path)
    assert cli.main(["roswtf", "--offline"]) == 0
    printed = capsys.readouterr().out
    assert "No package or stack in the current directory" in printed
    assert "Found 1 error(s)." in printed
    assert cli.main(["roswtf"]) == 1
    out, err = capsys.readouterr()
    assert uri in out + err


def test_words_that_make_no_sense(graph: Graph) -> None:
    with pytest.raises(UsageError):
        look(graph, "--nope")


def test_scripts_after_a_plus_are_looked_at(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    scripts = make(tmp_path) / "speaking" / "scripts"
    text = (scripts / "talker.py").read_text(encoding="utf-8")
    ear = text.replace('"talker"', '"ear"').replace("String", "Int32").replace('"hello"', "5")
    (scripts / "ear.py").write_text(ear, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    assert cli.main(["roswtf", "+", "speaking/talker.py", "+", "speaking/ear.py"]) == 0
    printed = capsys.readouterr().out
    assert "Nodes disagree about the type of a topic" in printed
    assert "std_msgs/Int32: /ear" in printed
