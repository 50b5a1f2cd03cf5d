"""The commands of the README and of the boxes in the chapters run: typed in a `%%terminal`, in a graph like the box's.

A command that cannot run here is in `SKIPPED`, with the reason. One that fails and is not there is a failure, and so is
an entry of `SKIPPED` that no page shows any more. The page on commands has its own test, `test_command_page.py`.
"""

from __future__ import annotations

import io
import json
import re
import shlex
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from rosmini.tools.main import COMMANDS, main

from ..notebook.conftest import notebook, shell  # noqa: F401 - fixtures

ROOT = Path(__file__).resolve().parents[2]

_FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.DOTALL | re.MULTILINE)
_BOX = re.compile(r"^<blockquote>\n(.*?)^</blockquote>", re.DOTALL | re.MULTILINE)
_COMMAND = re.compile(r"^\$ ((?:.*\\\n)*.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)
_ALIASES = re.compile(r'^eval "\$\((?:uv run )?rosmini aliases\)" && ')
_WORD = re.compile(r"(^|; |&& |\w=\S* )(?:uv run )?rosmini (?=ros|rqt|catkin)")


class Line(NamedTuple):
    """A command of a page, and what the page shows below it."""

    command: str
    shown: str


class Block(NamedTuple):
    """The commands of one fence."""

    page: str
    lines: tuple[Line, ...]


def blocks() -> list[Block]:
    """Return the fences with commands, in the order of the pages."""
    pages = [("README", (ROOT / "README.md").read_text(encoding="utf-8"))]
    for path in sorted((ROOT / "notebooks").rglob("*.ipynb")):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        prose = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
        pages += [(path.stem[3:], box) for text in prose for box in _BOX.findall(text)]
    found = []
    for page, text in pages:
        for language, code in _FENCE.findall(text):
            if language in {"console", "bash"}:
                lines = _COMMAND.findall(code)
                joined = (Line(re.sub(r"\\\n\s*", "", command), shown) for command, shown in lines)
                found.append(Block(page, tuple(joined)))
    return found


BLOCKS = blocks()

TALKER = """%%node talker.py
import rospy
from std_msgs.msg import Float32, String
from std_srvs.srv import Empty, SetBool, SetBoolResponse

def fail(request):
    raise RuntimeError("deliberate failure")

rospy.init_node("talker")
chatter = rospy.Publisher("chatter", String, queue_size=10)
news = rospy.Publisher("news", String, queue_size=10)
warmth = rospy.Publisher("temperature", Float32, queue_size=10)
rospy.Service("drive", SetBool, lambda request: SetBoolResponse(True, "got it"))
rospy.Service("fails", Empty, fail)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    chatter.publish("hello")
    news.publish("news")
    warmth.publish(31)
    rate.sleep()
"""
DRIVER = """
from dataclasses import dataclass
from rosmini import default_graph
from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.parameters import Parameters, parameter

@dataclass(frozen=True)
class Knobs(Parameters):
    max_speed: float = parameter(0.2, "speed limit", unit="m/s", minimum=0.0, maximum=0.22)
    lights: bool = parameter(False, "lamps on or off")

server = Server(default_graph().node("driver"), Knobs, lambda config, level: config)
default_graph().node("beacon");
"""
DRIVE = "drive_2026-11-20-23-46-38_0.bag"
RECORDED = f"""%%terminal
rosbag record -a --duration=1 -O {DRIVE}
sleep 2
cp {DRIVE} {DRIVE}.active
cp {DRIVE} news.bag
"""
SHELF = "%rosrun --quiet tf2_ros static_transform_publisher 1.5 1.0 0 0 0 0 odom shelf"
ROBOT = "%rosrun rosmini_sim simulator _world:=room"
FILES = """%%terminal
cat > robot.yaml << 'EOF'
max_speed: 0.22
wheel: {radius: 0.033, separation: 0.16}
heading: deg(90)
EOF
rosparam load robot.yaml /robot1
rosparam set /max_speed 0.22
cp /opt/ros/noetic/share/stage_ros/world/boxes.world yard.world
cp -r /opt/ros/noetic/share/stage_ros/world/include .
cp /opt/ros/noetic/share/rosmini_sim/maps/house* .
"""

FLAG = """%%terminal
cp /opt/ros/noetic/share/turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro flag.urdf.xacro
"""

STACK = "%roslaunch --quiet rosmini_sim navigation.launch\nimport rosmini\nrosmini.wait(1)"
GRAPHS: dict[str, tuple[str, ...]] = {
    "topics_and_messages": (ROBOT, TALKER),
    "services": (ROBOT, TALKER),
    "parameter_server": (ROBOT, FILES),
    "dynamic_reconfigure": (DRIVER,),
    "bags": (ROBOT, RECORDED),
    "simulation_and_stage": (FILES,),
    "frames": (ROBOT, SHELF),
    "maps": (FILES,),
    "odometry": ("%rosrun rosmini_sim simulator _board:=true",),
    "turtlebot3": (ROBOT,),
    "family_and_description": (FLAG,),
    "costmaps": (STACK,),
    "global_planners": (STACK,),
}
"""What runs and which files there are, by page, when the commands of a box are typed."""

INSTALLS = "installs uv; CI runs it"
ROBOTS_OWN = "a program of the robot itself, or of ROS packages that rosmini does not have"
READERS_OWN = "a package or script that the reader wrote in the chapter"
BY_HAND = "a page or a prompt that waits for the reader; tested in tests/viz/live and tests/browser"

SKIPPED = {
    "pip install uv && uv run rosmini book": INSTALLS,
    "pip install uv && uv run pytest": INSTALLS,
    "python -m pip install uv": INSTALLS,
    "python -m uv run rosmini book": INSTALLS,
    "uv run rosmini run rosmini_sim/simulator _world:=room + circle.py --duration 13": "run in tests/test_readme.py",
    "ssh ubuntu@ROBOT roslaunch turtlebot3_bringup turtlebot3_robot.launch": ROBOTS_OWN,
    "python3 circle.py": READERS_OWN,
    "rosmini rosrun first circle.py": READERS_OWN,
    "roslaunch turtlebot3_bringup turtlebot3_robot.launch": ROBOTS_OWN,
    (
        "ROS_NAMESPACE=tb3_0 roslaunch turtlebot3_bringup turtlebot3_robot.launch multi_robot_name:=tb3_0 "
        "set_lidar_frame_id:=tb3_0/base_scan"
    ): ROBOTS_OWN,
    **{
        f"cd ~/example_ws; {build}source devel/setup.bash; rosmini rosrun example_pkg {script}": READERS_OWN
        for build, script in (("rosmini catkin_make; ", "listener.py"), ("", "talker.py"))
    },
    "check_urdf flag.urdf": ROBOTS_OWN,
    "rosrun joint_state_publisher_gui joint_state_publisher_gui": ROBOTS_OWN,
    "python3 errand.py": READERS_OWN,
    "python3 patrol.py": READERS_OWN,
    "roslaunch patrol_robot patrol.launch": READERS_OWN,
    "rostest patrol_robot patrol.test": READERS_OWN,
    "roslaunch twist_mux twist_mux.launch": ROBOTS_OWN,
    "rosrun joy joy_node": ROBOTS_OWN,
    "rosrun teleop_twist_joy teleop_node": ROBOTS_OWN,
    "rosrun topic_tools mux cmd_vel joy_vel auto_vel": ROBOTS_OWN,
    "rosrun topic_tools mux_select mux joy_vel": ROBOTS_OWN,
    "roslaunch turtlebot3_ds my_multi_turtlebot3.launch": READERS_OWN,
    "roslaunch turtlebot3_ds turtlebot3_teleop_key_tb3_0.launch": READERS_OWN,
    "roslaunch turtlebot3_ds turtlebot3_teleop_key_tb3_1.launch": READERS_OWN,
    "rosmini logo": BY_HAND,
    "rosmini rosrun turtlesim_cleaner move.py": BY_HAND,
    "rosrun actionlib_tools axclient.py /drive": ROBOTS_OWN,
    "rosrun actionlib_tools axserver.py /drive my_robot/DriveAction": ROBOTS_OWN,
}


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: f"{block.page}-{block.lines[0].command[:40]}")
def test_the_commands_run(block, monkeypatch, notebook):  # noqa: F811 - the fixture
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    monkeypatch.setattr(sys, "stdin", io.StringIO())
    for cell in GRAPHS.get(block.page, ()):
        notebook.ok(cell)
    for line in block.lines:
        reason = SKIPPED.get(line.command)
        if reason is None and not line.command.startswith("ros2 "):
            status, written = typed(line.command, notebook)
            fails = "error" in line.shown.lower()
            assert bool(status) == fails, f"{line.command}\n{written}"


def typed(command, notebook):  # noqa: F811
    """Type a command; return its exit status and what it wrote."""
    bare = _WORD.sub(r"\1", _ALIASES.sub("", command)).removeprefix("uv run ")
    if bare.startswith("rosmini "):
        name, *words = shlex.split(bare)[1:]
        if COMMANDS[name].is_magic:
            error, written = notebook.run(f"%{bare.partition(' ')[2]}")
            return int(error is not None), written
        bound = ["--duration", "2"] if name == "run" and "--duration" not in words else []
        return main([name, *words, *bound]), ""
    error, written = notebook.run(f'%%terminal\n{bare}\necho "status: $?"')
    assert error is None, written
    return int(written.rpartition("status: ")[2]) or written.count(" has ended with exit status "), written


def test_what_is_skipped_is_on_a_page():
    shown = {line.command for block in BLOCKS for line in block.lines}
    assert SKIPPED.keys() - shown == set()
