"""Plans that run in one graph, in simulated time."""

from __future__ import annotations

import io
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rosmini import Graph
from rosmini.msgs import message_class
from rosmini.ros.launch import Launch, read
from rosmini.ros.launch.running import in_graph

from .workspace import make


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph(strict=False) as made:
        yield made


def started(graph: Graph, inside: str, folder: Path, monkeypatch: Any) -> tuple[Launch, io.StringIO, list[str]]:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(make(folder)))
    said: list[str] = []
    out = io.StringIO()
    plan = read(text=f"<launch>\n{inside}\n</launch>")
    make_handle = in_graph(graph, stdout=out, stderr=out)
    launch = Launch(plan, graph, make_handle, say=said.append, warn=said.append)
    launch.start()
    return launch, out, said


def test_nodes_run_with_their_names_environment_and_parameters(
    graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    launch, out, said = started(
        graph,
        """<group ns="robot1"><remap from="chatter" to="news"/>
        <node pkg="speaking" type="talker.py" name="first"><env name="NUMBER" value="1"/>
          <param name="greeting" value="good morning"/></node></group>
        <node pkg="speaking" type="talker.py" name="second"><env name="NUMBER" value="2"/></node>""",
        tmp_path,
        monkeypatch,
    )
    heard: list[str] = []
    graph.node("ear").subscriber("/robot1/news", message_class("std_msgs/String"), lambda m: heard.append(m.data))
    graph.run(1.0)
    assert heard == ["good morning"]
    assert "[robot1/first] /robot1/first 1 /robot1/news" in out.getvalue().replace("[first]", "[robot1/first]")
    assert "/second 2 /chatter" in out.getvalue()
    assert said == ["process[robot1/first-1]: started", "process[second-2]: started"]
    state = launch.stop()
    assert [code for _, code in state.codes] == [0, 0]
    assert out.getvalue().count("shut down") == 2
    assert said[-2:] == ["[second-2] killing on exit", "[robot1/first-1] killing on exit"]


def test_a_node_finds_its_namespace_in_its_environment(
    graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Tools that it starts resolve relative names there."""
    monkeypatch.setenv("ROS_NAMESPACE", "/elsewhere")
    folder = make(tmp_path)
    script = '#!/usr/bin/env python3\nimport os\nprint(os.environ["ROS_NAMESPACE"], flush=True)\n'
    (folder / "speaking" / "scripts" / "talker.py").write_text(script, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder))
    node = '<node pkg="speaking" type="talker.py" name="talker" output="screen"/>'
    plan = read(text=f'<launch>{node}<group ns="robot1"><group ns="arm">{node}</group></group></launch>', namespace="/")
    out = io.StringIO()
    Launch(plan, graph, in_graph(graph, stdout=out, stderr=out)).start()
    graph.run(1.0)
    assert {line.split()[-1] for line in out.getvalue().splitlines()} == {"/", "/robot1/arm"}


def test_a_node_is_respawned_after_its_delay(graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    node = '<node pkg="speaking" type="ending.py" name="n" args="1 3" respawn="true" respawn_delay="2"/>'
    launch, out, said = started(graph, node, tmp_path, monkeypatch)
    launch.wait(8.5)  # 1 s of life, 2 s of rest
    assert out.getvalue().count("ends") == 3
    assert said.count("[n-1] restarting process") == 3
    assert launch["n"].poll() is None
    launch.stop()
    assert launch.over()


def test_the_end_of_a_required_node_ends_all(graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    launch, _, said = started(
        graph,
        '<node pkg="speaking" type="talker.py" name="talker"/>\n'
        '<node pkg="speaking" type="ending.py" name="boss" args="1 3" required="true"/>',
        tmp_path,
        monkeypatch,
    )
    state = launch.wait()
    assert dict(state.codes) == {"/talker": 0, "/boss": 3}
    assert state.status == 3
    assert any("REQUIRED process [boss-2] has died!" in line for line in said)
    assert launch.required_ended is not None


def test_the_end_of_the_graph_is_no_death_of_a_required_node(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with Graph(strict=False) as graph:
        boss = '<node pkg="speaking" type="talker.py" name="boss" required="true"/>'
        launch, _, said = started(graph, boss, tmp_path, monkeypatch)
        graph.run(0.1)
    assert dict(launch.state().codes) == {"/boss": 0}
    assert not [line for line in said if "has died" in line]


def test_a_node_that_cannot_be_started_is_told_and_the_others_run(
    graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    launch, _, said = started(
        graph,
        '<node pkg="speaking" type="tlaker.py" name="a"/>\n<node pkg="speaking" type="ending.py" name="b" args="1 0"/>',
        tmp_path,
        monkeypatch,
    )
    assert launch.wait().status == 1
    assert said[0].startswith(
        "ERROR: cannot launch node of type [speaking/tlaker.py]: <text>:2: there is no executable"
    )
    assert "did you mean talker.py?" in said[0]
    assert [node.name for node in launch.failed] == ["a"]


def test_a_script_that_ignores_signals_is_killed(graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    node = '<node pkg="speaking" type="stubborn.py" name="n"/>'
    launch, _, _ = started(graph, node, tmp_path, monkeypatch)
    graph.run(1.0)
    before = graph.now().to_sec()
    assert [code for _, code in launch.stop().codes] == [-9]
    assert graph.now().to_sec() - before == pytest.approx(17.0)  # 15 s after SIGINT and 2 s after SIGTERM


def test_parameters_are_cleared_deleted_and_dumped_before_the_nodes_start(graph: Graph, tmp_path: Path) -> None:
    master = graph.ask_as("/test")
    for name in ("/old/a", "/gone", "/kept"):
        master.ask("setParam", name, 1)
    file = tmp_path / "before.yaml"
    plan = read(
        text=f"""<launch><group ns="old" clear_params="true"><param name="b" value="2"/></group>
        <rosparam command="delete" param="gone"/><rosparam command="dump" file="{file}" param="old"/></launch>"""
    )
    Launch(plan, graph, in_graph(graph)).start()
    assert master.ask("getParam", "/old") == {"b": 2}
    assert "/gone" not in master.ask("getParamNames")
    assert master.ask("getParam", "/kept") == 1
    assert file.read_text(encoding="utf-8") == "a: 1\n"


def test_what_one_process_cannot_do_is_told(tmp_path: Path) -> None:
    from rosmini.ros.launch.running import differences

    plan = read(
        text='<launch><machine name="far" address="far.example.com" user="robot" ssh-port="2222"/>'
        '<node pkg="a" type="b" name="c" machine="far" launch-prefix="gdb --args"/></launch>'
    )
    prefix, machine = differences(plan)
    assert "gdb --args" in prefix
    here = read(
        text='<launch><env name="LEVEL" value="3"/><node pkg="tf" type="tf_monitor" name="m"/>'
        '<node pkg="speaking" type="talker.py" name="t" cwd="node"/></launch>'
    )
    (folder,) = differences(here)
    assert 'cwd="node" is for a process: in one graph /t works in the folder of this one' in folder
    assert "There: ssh -p 2222 robot@far.example.com rosrun a b __name:=c __ns:=/" in machine
    hostile = read(
        text='<launch><machine name="far" address="far; touch mark"/>'
        '<node pkg="a" type="b" name="c" machine="far" args="$ (touch mark)"/></launch>'
    )
    (machine,) = differences(hostile)
    # It can be copied: two shells, one here and one there, leave the words as they are.
    shown = machine.partition("There: ssh ")[2]
    here, *there = shlex.split(shown)
    assert here == "far; touch mark"
    assert shlex.split(" ".join(there))[:5] == ["rosrun", "a", "b", "$", "(touch"]
