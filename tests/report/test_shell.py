"""The report's command lines that need more of a shell than one line: variables, pictures, nodes that are ended."""

import os
import shutil
import signal
import sys
from contextlib import ExitStack
from xmlrpc.client import ServerProxy

import pytest

from rosmini.core.packages import assets_dir

from ..processes import run, start, wait_until
from ..tools.test_catkin_make import WALK
from . import test_graph_commands, test_use_cases
from .command_lines import LINES
from .test_graph_commands import MEASURES, NAMES_THE_RIGHT_FORM, ROSMINI, WORKS, shell

__all__ = ["shell"]  # a fixture

FUNCTIONS = 'rostopic() { "$PYTHON" -m rosmini rostopic "$@"; }\n'

# 7.4, 7.5 and 8.2.3, with the placeholders filled in.
ENVIRONMENT = """
export ROS_ROOT=/home/user/ros/ros
export PATH=$ROS_ROOT/bin:$PATH
export ROS_MASTER_URI=$MASTER/
export ROS_HOSTNAME=127.0.0.1
export PYTHONPATH=$PYTHONPATH:$ROS_ROOT/core/roslib/src
echo "export TURTLEBOT3_MODEL=burger"
printenv | grep ROS
rostopic list
"""


def test_every_line_of_the_report_is_typed_or_says_what_it_waits_for():
    assert len(LINES) == 88
    known = {line for line, _ in (*WORKS, *MEASURES, *NAMES_THE_RIGHT_FORM)} | {
        *vars(test_graph_commands),
        *globals(),
        *vars(test_use_cases),
    }
    for line in LINES:
        assert line.by or line.waits, line
        if line.by.startswith("walk:"):
            assert line.by.removeprefix("walk:") in WALK.splitlines(), line
        elif line.by and not (line.is_slip and "--name:=" in line.by):  # a test of its own
            assert line.by in known, line


TURTLEBOT3 = (
    ("turtlebot3_gazebo turtlebot3_world.launch", "/gazebo"),
    ("turtlebot3_navigation move_base.launch", "/move_base"),
    ("turtlebot3_slam turtlebot3_slam.launch slam_methods:=gmapping open_rviz:=false", "/turtlebot3_slam_gmapping"),
    ("turtlebot3_slam turtlebot3_frontier_exploration.launch open_rviz:=false", "/explore_server"),
)
"""9.5: launch files, and a node by which one sees that each has begun."""


@pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")
def test_the_environment(shell, tmp_path):
    env = {**shell, "PYTHON": sys.executable, "MASTER": shell["ROS_MASTER_URI"], "ROS_MASTER_URI": ""}
    done = run(["bash", "-c", FUNCTIONS + ENVIRONMENT], env=env, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0] == "export TURTLEBOT3_MODEL=burger"
    assert {"ROS_ROOT=/home/user/ros/ros", f"ROS_MASTER_URI={shell['ROS_MASTER_URI']}/"} <= set(lines)
    assert "/chatter" in lines


def test_nodes_are_killed(shell):
    """`roscpp kill [node]`: the error names rosnode, which does it."""
    said = run([*ROSMINI, "roscpp", "kill", "/second"], env=shell)
    assert said.returncode == 2
    assert "`rosnode`" in said.stderr
    listed = [*ROSMINI, "rosnode", "list"]
    with start([*ROSMINI, "rosrun", "example_pkg", "talker.py", "__name:=second"], env=shell) as process:
        wait_until(lambda: "/second\n" in run(listed, env=shell).stdout, "/second", process)
        killed = run([*ROSMINI, "rosnode", "kill", "/second"], env=shell)
        assert "killed" in killed.stdout
        wait_until(lambda: process.poll() is not None, "the end of /second")


def test_pictures_are_written_as_pages(shell, tmp_path):
    done = run([*ROSMINI, "rqt_graph", "-o", str(tmp_path / "graph.txt")], env=shell)
    assert done.returncode == 0, done.stderr
    assert "/talker" in (tmp_path / "graph.txt").read_text(encoding="utf-8")
    recorded = run([*ROSMINI, "rosbag", "record", "/chatter", "-O", "house", "-l", "3"], env=shell, cwd=tmp_path)
    assert (tmp_path / "house.bag").is_file(), recorded.stderr
    done = run([*ROSMINI, "rqt_bag", "house.bag", "-o", "bag.txt"], env=shell, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "/chatter" in (tmp_path / "bag.txt").read_text(encoding="utf-8")


def test_help(shell):
    done = run([*ROSMINI, "rostopic", "-h"], env=shell)
    assert "rostopic echo" in done.stdout
    assert "rostopic bw" in done.stdout


def test_the_workspace_of_the_report(shell, tmp_path):
    """7.7, 9.4.3: the launch file of two robots is read, and all that it names is there."""
    shutil.copytree(assets_dir() / "workspaces" / "report_ws" / "src", tmp_path / "src")
    env = {**shell, "ROS_PACKAGE_PATH": str(tmp_path / "src"), "TURTLEBOT3_MODEL": "burger"}
    for name in ("my_multi_turtlebot3", "turtlebot3_teleop_key_tb3_0", "turtlebot3_teleop_key_tb3_1"):
        done = run([*ROSMINI, "roslaunch", "--check", "turtlebot3_ds", f"{name}.launch"], env=env)
        assert "all is there" in done.stdout, done.stderr


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C is sent otherwise there")
@pytest.mark.nightly
def test_one_turtlebot_explores(shell):
    """9.5: four terminals, one launch in each; the last one starts nodes again, and Ctrl-C ends all of them."""
    env = {**shell, "TURTLEBOT3_MODEL": "burger"}
    keys = [*ROSMINI, "roslaunch", "turtlebot3_teleop", "turtlebot3_teleop_key.launch", "--check"]
    assert "all is there" in run(keys, env=env).stdout
    with ServerProxy(env["ROS_MASTER_URI"]) as master, ExitStack() as terminals:
        processes = []
        for words, node in TURTLEBOT3:
            process = terminals.enter_context(start([*ROSMINI, "roslaunch", *words.split()], env=env))
            wait_until(lambda node=node: master.lookupNode("/test", node)[0] == 1, node, process)
            processes.append(process)
        for process in reversed(processes):
            process.send_signal(signal.SIGINT)
            wait_until(lambda process=process: process.poll() is not None, "the end of a launch")
        assert [node for _, node in TURTLEBOT3 if master.lookupNode("/test", node)[0] == 1] == []
