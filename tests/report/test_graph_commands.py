"""The report's command lines on the computation graph (3.3, 8.2), typed as printed with the placeholders filled in.

Each works, or its error names the right form: the report's slips (`roscpp info`, `rosmmsg`, `roslaunch` for `rosrun`).
"""

import os
import re
import sys

import pytest

from ..processes import free_port, listens, run, start, wait_until

pytestmark = pytest.mark.nightly

ROSMINI = (sys.executable, "-m", "rosmini")

MANIFEST = """<package format="2"><name>example_pkg</name><version>0.0.1</version><description>x</description>
<maintainer email="ada@example.org">Ada</maintainer><license>BSD</license><exec_depend>rospy</exec_depend></package>"""

TALKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse

rospy.init_node("talker")
chatter = rospy.Publisher("chatter", String, queue_size=10)
rospy.Service("switch", SetBool, lambda request: SetBoolResponse(True, "on"))
rospy.set_param("/rate", 10)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    chatter.publish("hello")
    rate.sleep()
"""


@pytest.fixture(scope="module")
def shell(tmp_path_factory):
    """The environment of a terminal in which a Master and a talker run."""
    home = tmp_path_factory.mktemp("report")
    scripts = home / "src" / "example_pkg" / "scripts"
    scripts.mkdir(parents=True)
    (scripts.parent / "package.xml").write_text(MANIFEST, encoding="utf-8")
    (scripts / "talker.py").write_text(TALKER, encoding="utf-8")
    (scripts / "talker.py").chmod(0o755)
    port = free_port()
    env = {
        **os.environ,
        "HOME": str(home),
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_PACKAGE_PATH": str(home / "src"),
    }
    with start([*ROSMINI, "roscore", "-p", str(port)], env=env) as master:
        wait_until(lambda: listens(port), "roscore", master)
        with start([*ROSMINI, "rosrun", "example_pkg", "talker.py"], env=env) as talker:
            services = [*ROSMINI, "rosparam", "get", "/rate"]
            wait_until(lambda: run(services, env=env).returncode == 0, "the talker", talker)
            yield env


WORKS = [
    # 3.3.1: the report writes `roscpp info`, `roscpp kill` and `roscpp list`; rosnode does it
    ("rosnode list", "^/talker$"),
    ("rosnode info /talker", r"Publications:.*\n \* /chatter \[std_msgs/String\]"),
    ("rosnode machine", "^127.0.0.1$"),
    ("rosnode ping -c 1 /talker", "xmlrpc reply from http://127.0.0.1:"),
    ("rosnode cleanup", "^$"),
    # 3.3.3: the report writes `rosmmsg`
    ("rosmsg show std_msgs/String", "^string data$"),
    ("rosmsg list", "^std_msgs/String$"),
    ("rosmsg md5 std_msgs/String", "^992ce8a1687cec8c8bd883ec73ca41d1$"),
    ("rosmsg package std_msgs", "^std_msgs/String$"),
    ("rosmsg packages", "std_msgs"),
    # 3.3.4
    ("rostopic echo -n 1 /chatter", 'data: "hello"'),
    ("rostopic find std_msgs/String", "^/chatter$"),
    ("rostopic info /chatter", r"Type: std_msgs/String[\s\S]*\* /talker"),
    ("rostopic list", "^/chatter$"),
    ("rostopic pub -1 /news std_msgs/String hello", "publishing and latching message for"),
    ("rostopic type /chatter", "^std_msgs/String$"),
    ("rostopic echo -h", "Usage: rostopic echo"),
    # 3.3.5
    ("rosservice call /switch true", 'message: "on"'),
    ("rosservice find std_srvs/SetBool", "^/switch$"),
    ("rosservice info /switch", "Node: /talker"),
    ("rosservice list", "^/switch$"),
    ("rosservice type /switch", "^std_srvs/SetBool$"),
    ("rosservice uri /switch", "^rosrpc://127.0.0.1:"),
    ("rossrv show std_srvs/SetBool", "^bool success$"),
    # 3.6.4 and 8.2, as they have to be written
    ("rospack find example_pkg", "example_pkg$"),
]

MEASURES = [
    ("rostopic bw /chatter --duration 2.5", "average: .*B/s"),
    ("rostopic hz /chatter --duration 2.5", "average rate: (9|10)"),
]

NAMES_THE_RIGHT_FORM = [
    ("roscpp info /talker", "rosnode"),
    ("roscpp list", "rosnode"),
    ("rosmmsg show example_pkg/Num", "rosmsg"),
    ("rostop node list", "`rosnode list`"),
    ("roslaunch example_pkg talker.py", "rosrun example_pkg talker.py"),
    ("roslaunch turtlesim turtlesim_node", "rosrun turtlesim turtlesim_node"),
    ("roslaunch turtlesim turtle_teleop_key", "rosrun turtlesim turtle_teleop_key"),
    ("roslaunch map_server map_saver -f my map", "rosrun map_server map_saver -f my map"),
    ("roslaunch ping my_turtle", "rosnode ping my_turtle"),
    ("roslaunch example_pkg talker.py --name:=my_turtle", "__name:=my_turtle"),
    ("roslaunch frontier-exploration global_map.launch", "frontier_exploration"),
    ("roslaunch explore_lite global_map.launch", "explore.launch"),
]


@pytest.mark.parametrize(("line", "pattern"), WORKS, ids=[line for line, _ in WORKS])
def test_a_command_line_of_the_report_works(shell, line, pattern):
    done = run([*ROSMINI, *line.split()], env=shell)
    assert re.search(pattern, done.stdout, re.MULTILINE), done.stdout + done.stderr
    assert done.returncode == 0


@pytest.mark.parametrize(("line", "pattern"), MEASURES, ids=[line for line, _ in MEASURES])
def test_a_measurement_of_the_report_says_what_the_talker_does(shell, line, pattern):
    """A busy machine may leave the talker or the tool no time, so it is asked until both had their share."""

    def says():
        done = run([*ROSMINI, *line.split()], env=shell)
        assert done.returncode == 0, done.stdout + done.stderr
        return re.search(pattern, done.stdout, re.MULTILINE) is not None

    wait_until(says, pattern)


@pytest.mark.parametrize(("line", "text"), NAMES_THE_RIGHT_FORM, ids=[line for line, _ in NAMES_THE_RIGHT_FORM])
def test_a_slip_of_the_report_is_answered_with_the_right_form(shell, line, text):
    done = run([*ROSMINI, *line.split()], env=shell)
    assert done.returncode != 0
    assert text in done.stderr


def test_a_dashed_name_is_told_and_the_program_gets_it(shell):
    words = [*ROSMINI, "rosrun", "example_pkg", "talker.py", "--name:=x", "__name:=second"]
    with start(words, env=shell, stderr=-1) as process:
        line = process.stderr.readline()
    assert "--name:=x is no remapping; ROS's own names begin with two underscores: __name:=x" in line


def test_a_bag_is_recorded_and_played(shell, tmp_path):
    """3.3.6: `rosbag record [topic] -o [bag]` and `rosbag play [bag]`."""
    env = {**shell, "PWD": str(tmp_path)}
    words = [*ROSMINI, "rosbag", "record", "/chatter", "-o", "house", "-l", "3"]
    recorded = run(words, env=env, cwd=tmp_path)
    bags = list(tmp_path.glob("house_*.bag"))
    assert len(bags) == 1, recorded.stdout + recorded.stderr
    played = run([*ROSMINI, "rosbag", "play", str(bags[0]), "-r", "100"], env=env)
    assert played.returncode == 0, played.stdout + played.stderr
    assert "messages:    3" in run([*ROSMINI, "rosbag", "info", str(bags[0])], env=env).stdout
