"""Real roslaunch reads the same launch files: the plans are equal."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest

from rosmini.ros.launch import NodePlan, Plan, TestPlan, read

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

ROOT = Path(__file__).resolve().parents[2]
PEER = Path(__file__).with_name("roslaunch_peer.py")
OURS = ROOT / "assets" / "ros"
SHAPES = ROOT / "tests" / "ros" / "launch" / "data" / "shapes"


@pytest.fixture
def environment(monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Our packages only; xacro is ours, by the Python of this test."""
    need_ros(modules="roslaunch")
    monkeypatch.setenv("PATH", os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(OURS))
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    return dict(os.environ)


def real(requests: list[list[str]], environment: dict[str, str]) -> list[dict[str, Any]]:
    done = run([SYSTEM_PYTHON, PEER, "-"], stdin=json.dumps(requests), env=environment, check=True)
    found: list[dict[str, Any]] = json.loads(done.stdout)
    return found


def described(node: NodePlan) -> dict[str, Any]:
    return {
        "package": node.package,
        "type": node.type,
        "name": node.name,
        "namespace": node.namespace,
        "args": node.args,
        "remaps": [list(pair) for pair in node.remappings],
        "env": dict(node.environment),
        "respawn": [node.respawn, node.respawn_delay],
        "required": node.required,
        "output": node.output,
        "cwd": node.cwd,
        "prefix": node.launch_prefix,
        "machine": node.machine,
    }


def compare(plan: Plan, expected: dict[str, Any]) -> None:
    assert "error" not in expected, expected
    values = {
        name: value.decode("latin-1") if isinstance(value, bytes) else value for name, value in plan.parameters.items()
    }
    for text in [name for name in values if name.endswith("robot_description")]:
        assert "<robot" in values.pop(text) and "<robot" in expected["params"].pop(text)
    assert values == expected["params"]
    assert [type(value) for value in values.values()] == [type(expected["params"][name]) for name in values]
    assert [described(node) for node in plan.all_nodes()] == expected["nodes"]
    assert [os.path.realpath(file) for file in plan.files()] == [os.path.realpath(file) for file in expected["files"]]
    assert plan.cleared == expected["cleared"]
    assert sorted(plan.machines) == expected["machines"]


def arguments(words: list[str]) -> dict[str, str]:
    return dict(word.split(":=") for word in words)


@pytest.mark.parametrize(
    "words",
    [
        ["navigation.launch"],
        ["navigation.launch", "open_rviz:=false", "move_forward_only:=true", "map_file:=/maps/home.yaml"],
        ["slam.launch"],
        ["slam.launch", "set_base_frame:=base"],
        ["many_robots.launch"],
        ["many_robots.launch", "count:=5", "prefix:=robot"],
        ["values.launch", "n:=given"],
    ],
    ids=" ".join,
)
def test_public_shapes_mean_the_same(environment: dict[str, str], words: list[str]) -> None:
    file = str(SHAPES / words[0])
    (expected,) = real([[file, *words[1:]]], environment)
    plan = read(file, args=arguments(words[1:]))
    compare(plan, expected)
    assert len(plan.tests) == (words[0] == "values.launch")
    assert all(isinstance(test, TestPlan) for test in plan.tests)


NEEDED = {f"multi_turtlebot3_{what}.launch": ["ns:=tb3_0"] for what in ("navigation", "slam")}
"""The arguments that launch files have no defaults for."""


@pytest.mark.nightly
def test_our_own_launch_files_mean_the_same(environment: dict[str, str]) -> None:
    files = [file for file in sorted(OURS.rglob("*.launch")) if "standalone" not in file.name]
    assert len(files) > 8
    given = [NEEDED.get(file.name, []) for file in files]
    commands = [[str(file), *words] for file, words in zip(files, given, strict=True)]
    for file, words, expected in zip(files, given, real(commands, environment), strict=True):
        compare(read(file, args=arguments(words)), expected)


def body(inside: str) -> str:
    return f"<launch>{inside}</launch>"


WRONG = {
    "no type": '<node pkg="rospy" name="n"/>',
    "no name": '<node pkg="rospy" type="n"/>',
    "a namespace in a name": '<node pkg="rospy" type="n" name="a/b"/>',
    "two of a name": '<node pkg="a" type="b" name="c"/><node pkg="a" type="b" name="c"/>',
    "respawn and required": '<node pkg="a" type="b" name="c" respawn="true" required="true"/>',
    "output": '<node pkg="a" type="b" name="c" output="print"/>',
    "bad truth": '<node pkg="a" type="b" name="c" respawn="maybe"/>',
    "bad if": '<group if="perhaps"/>',
    "if and unless": '<group if="1" unless="0"/>',
    "two values": '<param name="a" value="1" textfile="x"/>',
    "no value": '<param name="a"/>',
    "bad int": '<param name="a" value="x" type="int"/>',
    "bad type": '<param name="a" value="x" type="integer"/>',
    "arg twice": '<arg name="a" value="1"/><arg name="a" value="1"/>',
    "arg value and default": '<arg name="a" value="1" default="2"/>',
    "arg not set": '<arg name="a"/><param name="b" value="$(arg a)"/>',
    "no such arg": '<param name="b" value="$(arg a)"/>',
    "env": '<param name="b" value="$(env NOBODY_HAS_THIS)"/>',
    "command": '<param name="b" value="$(where am i)"/>',
    "nested": '<arg name="a" value="x"/><param name="b" value="$(find $(arg a))"/>',
    "package": '<param name="b" value="$(find no_such_package)"/>',
    "remap": '<remap from="a b" to="c"/>',
    "empty remap": '<remap from="" to="c"/>',
    "yaml": "<rosparam>a: [1, 2</rosparam>",
    "not a dictionary": "<rosparam>[1, 2]</rosparam>",
    "rosparam command": '<rosparam command="look"/>',
    "no file": '<rosparam file="/no/such.yaml"/>',
    "no include": '<include file="/no/such.launch"/>',
    "empty ns": '<group ns=""/>',
    "clear without ns": '<group clear_params="true"/>',
    "unknown machine": None,
    "two machines": '<machine name="a" address="b"/><machine name="a" address="c"/>',
    "test output": '<test test-name="a" pkg="b" type="c" output="screen"/>',
    "time limit": '<test test-name="a" pkg="b" type="c" time-limit="-1"/>',
    "unclosed": "<group>",
}


def test_what_real_roslaunch_refuses_is_refused_with_its_line(environment: dict[str, str], tmp_path: Path) -> None:
    cases = {name: text for name, text in WRONG.items() if text is not None}
    paths = {}
    for number, (name, text) in enumerate(cases.items()):
        paths[name] = tmp_path / f"case_{number}.launch"
        paths[name].write_text(body("\n\n" + text), encoding="utf-8")
    answers = real([[str(path)] for path in paths.values()], environment)
    for (name, path), answer in zip(paths.items(), answers, strict=True):
        assert "error" in answer, name
        with pytest.raises(Exception, match=f"{path.name}:3: ") as caught:
            read(path)
        assert type(caught.value).__name__ == "LaunchError", name
