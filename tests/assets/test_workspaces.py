"""The workspace of the report (7.7) builds without a finding, and runs as far as there is what it needs."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest

from rosmini.ros.catkin import Workspace, make
from rosmini.tools.main import main

from ..processes import run

LISTENER = """#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist
rospy.init_node("turtle")
speeds = []
rospy.Subscriber("/turtle1/cmd_vel", Twist, lambda message: speeds.append(message.linear.x))
while not speeds or speeds[-1]:
    rospy.sleep(0.1)
print("driven", set(speeds[:-1]), 0.9 < sum(speeds) / -20 < 1.2)
"""


@pytest.fixture
def workspace(tmp_path: Path, root: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(root / "assets/workspaces/report_ws", tmp_path / "ws")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws/src"))
    monkeypatch.setenv("TURTLEBOT3_MODEL", "waffle")
    return tmp_path / "ws"


def test_it_builds_without_a_finding(workspace: Path) -> None:
    report = make(Workspace.at(workspace), environ={}, say=lambda _: None)
    assert (report.status, report.findings) == (0, [])
    assert report.built == ["gazebo_models", "turtlesim_cleaner", "turtlebot3_ds"]


def test_the_house_has_its_walls_and_its_furniture(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["world", "check", str(workspace / "src/turtlebot3_ds/worlds/turtlebot3_house.world")]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert line.endswith("the world 'turtlebot3_house': 8 obstacles, 1 start, 8.2 m by 5.2 m")


def test_the_launch_files_find_all_that_they_start(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("my_multi_turtlebot3", "turtlebot3_teleop_key_tb3_0", "turtlebot3_teleop_key_tb3_1"):
        assert main(["roslaunch", "turtlebot3_ds", f"{name}.launch", "--check"]) == 0
        assert "all is there" in capsys.readouterr().out


@pytest.mark.processes
def test_the_turtle_is_driven_along_a_line(workspace: Path) -> None:
    listener = workspace / "listener.py"
    listener.write_text(LISTENER, encoding="utf-8")
    script = workspace / "src/turtlesim_cleaner/scripts/move.py"
    words = [sys.executable, "-m", "rosmini", "run", "--sim-time", script, "+", listener]
    done = run(words, env=dict(os.environ), stdin="2\n1\nn\n", check=True)
    assert "moved 1.00 backward" in done.stdout + done.stderr
    assert "driven {-2.0} True" in done.stdout
