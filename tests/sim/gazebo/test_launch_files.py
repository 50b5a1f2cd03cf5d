"""The launch files say what is there, and the keyboard teleoperation does what its keys say.

Real roslaunch reads them in `tests/interop`.
"""

import re
from itertools import pairwise

import pytest

from rosmini import Graph
from rosmini.core.markup import parse_file
from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.msgs import message_class
from rosmini.ros.scripts import ScriptSpec, run_scripts

PACKAGES = "gazebo_ros turtlebot3_gazebo turtlebot3_bringup turtlebot3_teleop turtlesim turtle_tf turtle_tf2"
FILES = sorted(
    path for package in PACKAGES.split() for path in (assets_dir() / "ros" / package / "launch").rglob("*.launch*")
)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_all_that_a_launch_file_names_is_there(path):
    index = PackageIndex()
    root = parse_file(path)
    assert root.tag == "launch"
    for element in root.walk():
        if element.tag == "node":
            kind = element.attribute("type")
            if "$(arg" not in kind:
                index.find_executable(element.attribute("pkg"), kind)
        for value in element.attributes.values():
            for package, rest in re.findall(r"\$\(find (\w+)\)/([^\s$\"]*)", value):
                place = index.path(package) / rest
                assert place.exists() or rest.endswith("turtlebot3_"), f"{path}:{element.line}: {place}"


def test_empty_world_has_the_arguments_of_noetic():
    root = parse_file(assets_dir() / "ros" / "gazebo_ros" / "launch" / "empty_world.launch")
    arguments = {each.get("name"): each.get("default") for each in root.all("arg") if "default" in each.attributes}
    noetic = """paused=false use_sim_time=true extra_gazebo_args= gui=true recording=false headless=false debug=false
        physics=ode verbose=false output=screen world_name=worlds/empty.world respawn_gazebo=false
        use_clock_frequency=false pub_clock_frequency=100 enable_ros_network=true server_required=false
        gui_required=false"""
    assert arguments == dict(word.split("=") for word in noetic.split())


def test_keys_move_a_target_that_is_approached():
    path = PackageIndex().find_executable("turtlebot3_teleop", "turtlebot3_teleop_key").path
    with Graph() as graph:
        heard = []
        graph.node("ear").subscriber("/cmd_vel", message_class("geometry_msgs/Twist"), heard.append)
        more = [(3.5 + i / 4, "wwww") for i in range(10)]
        pieces = [(0.5, "wwa"), (3.0, "s"), *more, (11.0, "\x03")]
        result = run_scripts([ScriptSpec(str(path), ("_model:=burger",))], graph=graph, stdin=pieces, duration=30.0)
    assert (result.status, result.reason) == (0, "ended")
    ahead, turns = [each.linear.x for each in heard], [each.angular.z for each in heard]
    assert max(turns) == pytest.approx(0.1)
    assert 0.02 in ahead  # two keys, of a hundredth each
    steps = [round(b - a, 6) for a, b in pairwise(ahead)]
    assert max(steps) <= 0.005  # it follows by half a step at most
    assert max(ahead) == pytest.approx(0.22)  # and no faster than a Burger
    assert (ahead[-1], turns[-1]) == (0.0, 0.0)  # it stops the robot when it ends


def test_keys_that_are_given_all_at_once_are_read_ten_times_a_second():
    path = PackageIndex().find_executable("turtlebot3_teleop", "turtlebot3_teleop_key").path
    with Graph() as graph:
        heard = []
        ear = graph.node("ear")
        ear.subscriber(
            "/cmd_vel", message_class("geometry_msgs/Twist"), lambda m: heard.append((ear.now(), m.linear.x))
        )
        result = run_scripts([ScriptSpec(str(path))], graph=graph, stdin="w" * 10 + "." * 20, duration=30.0)
    assert (result.status, result.reason) == (0, "ended")
    (begin, first), *_ = heard
    reached = next(time for time, speed in heard if speed >= 0.1)
    assert first == 0.005
    assert (reached - begin).to_sec() == pytest.approx(1.9, abs=0.05)  # 20 steps of 0.005 m/s, one in 0.1 s
    assert heard[-1][1] == 0.0
