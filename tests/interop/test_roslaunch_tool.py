"""`rosmini roslaunch` beside real roslaunch: the same answers, and real executables started by ours."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest

from ..processes import free_port, run, start, wait_until
from ..ros.launch.workspace import make
from .conftest import need_ros

pytestmark = pytest.mark.processes

ROSMINI = [sys.executable, "-m", "rosmini"]

DEMO = """
<arg name="rate" default="10" doc="how often"/>
<arg name="name"/>
<param name="robot_name" value="$(arg name)"/>
<rosparam>
gains: {p: 1.5, i: 0.1, d: 0.0}
waypoints: [[0, 1], [2, 3]]
</rosparam>
<group ns="robot1">
  <remap from="in" to="chatter"/>
  <param name="nested" value="6"/>
  <node pkg="speaking" type="talker.py" name="talker" args="-r $(arg rate)"/>
  <node pkg="topic_tools" type="relay" name="relay" args="chatter relayed"/>
  <node pkg="speaking" type="program.sh" name="program" args="a 'b c'"><env name="NUMBER" value="5"/></node>
</group>
"""


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """Where both look for the package `speaking`, and where they write."""
    need_ros("roslaunch", "/usr/lib/topic_tools/relay", modules="roslaunch")
    source = make(tmp_path, demo=DEMO)
    program = source / "speaking" / "scripts" / "program.sh"
    program.write_text("#!/bin/sh\nexit 0\n", encoding="utf-8")
    program.chmod(0o755)
    kept = {name: text for name, text in os.environ.items() if not name.startswith(("ROS_", "PYTHON"))}
    return {
        **kept,
        "PATH": f"/usr/bin:/bin:{os.environ['PATH']}",
        "PYTHONUNBUFFERED": "1",
        "ROS_PACKAGE_PATH": os.pathsep.join([str(source), "/usr/share"]),
        "ROS_HOME": str(tmp_path / "home"),
        "ROS_MASTER_URI": f"http://localhost:{free_port()}",
    }


@pytest.mark.parametrize(
    "words",
    [
        ["--nodes", "speaking", "demo.launch", "name:=tb3"],
        ["--files", "speaking", "demo.launch", "name:=tb3"],
        ["--dump-params", "speaking", "demo.launch", "name:=tb3"],
        ["--ros-args", "speaking", "demo.launch"],
        ["--args", "/robot1/program", "speaking", "demo.launch", "name:=tb3"],
    ],
    ids=lambda words: words[0],
)
def test_the_answers_are_the_same(environment: dict[str, str], words: list[str]) -> None:
    real = run(["/usr/bin/roslaunch", *words], env=environment)
    ours = run([*ROSMINI, "roslaunch", *words], env=environment)
    assert (ours.stdout, ours.returncode) == (real.stdout, real.returncode), (real.stderr, ours.stderr)
    assert real.stdout


def test_a_real_executable_is_started_and_hears_ours(environment: dict[str, str], tmp_path: Path) -> None:
    said = tmp_path / "said"
    heard = tmp_path / "heard"
    with ExitStack() as stack:
        file, other = (stack.enter_context(path.open("w", encoding="utf-8")) for path in (said, heard))
        words = [*ROSMINI, "roslaunch", "speaking", "demo.launch", "name:=tb3", "--screen"]
        launcher = stack.enter_context(start(words, stdout=file, stderr=file, env=environment))
        wait_until(lambda: "/robot1/talker None" in said.read_text(encoding="utf-8"), "the talker", launcher)
        echo = [*ROSMINI, "rostopic", "echo", "-n", "1", "/robot1/relayed"]
        stack.enter_context(start(echo, stdout=other, env=environment))
        # real relay latches what is latched for it
        wait_until(lambda: "hello" in heard.read_text(encoding="utf-8"), "message of the relay", launcher)
