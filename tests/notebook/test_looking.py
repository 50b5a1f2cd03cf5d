"""``%show``, ``%record``, ``%replay``, ``%drag`` and ``%click``, and the option ``--quiet``."""

from __future__ import annotations

from pathlib import Path

import pytest

from ..conftest import nightly
from .conftest import Notebook

ROBOT = "%rosrun rosmini_sim simulator _world:=room"
DRIVE = "%rostopic pub -1 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.2}}'"


@pytest.mark.nightly
def test_a_robot_is_shown_recorded_and_replayed(notebook: Notebook) -> None:
    notebook.ok(f"import rosmini\n{ROBOT}")
    assert "burger: pose (0.00, 0.00" in notebook.ok("%show")
    assert "3D: burger" in notebook.ok("%show /simulator --3d")
    notebook.ok(f"%record\n{DRIVE}\nrosmini.wait(2)")
    written = notebook.ok("run = %replay\nprint(round(run.recording.truth[-1][0], 1))")
    assert "Replay of burger in room" in written and "0.1\n" in written
    assert "3D replay: burger" in notebook.ok("%replay --3d")  # the same recording again


def test_topics_become_layers_of_the_replay(notebook: Notebook) -> None:
    notebook.ok(f"import rosmini\n{ROBOT}\n%record")
    notebook.ok("%rostopic pub -1 /path nav_msgs/Path '{header: {frame_id: odom}, poses: [{}, {}]}'\nrosmini.wait(1)")
    assert "/path" not in notebook.ok("%replay")
    assert "/path" in notebook.ok("%replay /path")
    assert "/path" in notebook.ok('%replay "*"')
    assert "opens at the end" in notebook.ok("run = %replay --end\nprint('opens at the', run.view.data['opens'])")


def test_turtles_of_two_windows_are_replayed_side_by_side(notebook: Notebook) -> None:
    notebook.ok("import rosmini\n%rosrun turtlesim turtlesim_node\n%rosrun turtlesim turtlesim_node __ns:=/b")
    written = notebook.ok("%record\nrosmini.wait(1)\n%replay")
    assert "2 runs" in written and "/b/turtlesim" in written
    assert "turtle1: pose" in notebook.ok("%show b/turtlesim")
    assert "/b/turtlesim, /turtlesim" in notebook.fails("%show")
    notebook.ok(ROBOT)
    assert "either turtles or robots" in notebook.fails("%record")


def test_a_bag_is_replayed(notebook: Notebook, tmp_path: Path) -> None:
    bag = tmp_path / "drive.bag"
    notebook.ok(f"{ROBOT}\n%rosbag record --duration 1 -O {bag} /odom\nimport rosmini\nrosmini.wait(2)")
    assert "/odom" in notebook.ok(f"%replay --robot burger {bag}")
    assert "/odom" in notebook.ok(f'run = %replay {bag} "*"')
    assert "rosbag.Bag" in notebook.fails("run.recording")


@pytest.mark.parametrize(
    ("cell", "named"),
    [
        ("%show", "%rosrun rosmini_sim simulator"),
        ("%replay", "%record"),
        (f"{ROBOT}\n%show /simulater", "/simulator"),
        (f"{ROBOT}\n%show /rosout", "/simulator"),
        ('%click "2D Nav Gaol" 1 2 0', "2D Nav Goal"),
        (f'{ROBOT}\n%drag "crat" 1 0.5', "burger"),
        *nightly(
            ("%rosrun turtlesim turtlesim_node\n%show --3d", "/turtlesim"),
            ("%rosrun turtlesim turtlesim_node\n%record\n%replay --3d", "without arguments"),
            (f"import rosmini\n{ROBOT}\n%record\nrosmini.wait(1)\n%replay --3d --end", "without --3d"),
            ('%click "2D Nav Goal" 1', "yaw"),
            ("%click 1 2", "tool"),
            (f'{ROBOT}\n%drag "crate"', "heading"),
            (f'{ROBOT}\n%drag "sofa" 1 0.5', "fixed"),
            ("%drag crate 1 0", "no simulation"),
            ("%rosrun turtlesim turtlesim_node\n%drag turtle1 1 2", "dragged"),
        ),
    ],
)
def test_an_error_names_what_to_do(notebook: Notebook, cell: str, named: str) -> None:
    assert named in notebook.fails(cell)


def test_robots_and_objects_are_dragged(notebook: Notebook) -> None:
    notebook.ok(f"import rosmini\n{ROBOT}")
    written = notebook.ok('%drag "crate" 1.1 -0.05\n%drag burger 0.5 -0.1 1.57\nrosmini.wait(0.5)\n%show')
    assert "burger: pose (0.50, -0.10" in written
    notebook.ok("import rospy\nfrom sensor_msgs.msg import LaserScan\nrospy.init_node('reader')")
    written = notebook.ok("print(rospy.wait_for_message('scan', LaserScan).ranges[270] < 0.6)")
    assert written == "True\n"


def test_a_click_is_a_message_of_rviz_and_waits_for_a_subscriber(notebook: Notebook) -> None:
    notebook.ok(
        "import rosmini\nimport rospy\nfrom geometry_msgs.msg import PoseStamped, PointStamped\n"
        "rospy.init_node('reader')\ngoals, points = [], []\n"
        "_ = rospy.Subscriber('/move_base_simple/goal', PoseStamped, goals.append)\n"
        "_ = rospy.Subscriber('/clicked_point', PointStamped, points.append)"
    )
    written = notebook.ok('done = %click "2D Nav Goal" -2.5 3 1.57 -f world')
    assert "Frame:world, Position(-2.500, 3.000, 0.000)" in written and "Angle: 1.570" in written
    notebook.ok('assert "1.570" in done.text\n%click "Publish Point" 1 -2\nrosmini.wait(0.1)')
    assert notebook.ok("print(goals[0].header.frame_id, goals[0].pose.position.x)") == "world -2.5\n"
    assert notebook.ok("print(points[0].header.frame_id, points[0].point.y)") == "odom -2.0\n"
    assert "/rviz" in notebook.ok("%rosnode list")
    assert "/rviz" not in notebook.ok("%roscore\n%rosnode list")


def test_quiet_hides_what_programs_log_while_they_start(notebook: Notebook) -> None:
    log = "rospy.loginfo('i')\nrospy.logwarn('early')\nrospy.sleep(4)\nrospy.loginfo('i')\nrospy.logwarn('late')"
    cell = f"%%node late.py {{}}\nimport rospy\nrospy.init_node('n')\n{log}"
    notebook.ok('%%launch l.launch\n<launch><node pkg="notebook" type="late.py" name="n" output="screen"/></launch>')
    assert "early" in notebook.ok(cell.format(""))
    for start in (cell.format("--quiet"), "%roslaunch --quiet notebook l.launch", "%rosrun notebook late.py --quiet"):
        notebook.ok("import rosmini\n%roscore")
        assert notebook.ok(start) == ""
        written = notebook.ok("rosmini.wait(5)")
        assert "late" in written and "[INFO]" not in written
    assert "ZeroDivisionError" in notebook.ok("%%node broken.py --quiet\n1 / 0")


def test_a_click_is_made_in_the_open_window(notebook: Notebook) -> None:
    notebook.ok('window = %rviz --live -f odom\n%click "2D Nav Goal" 1 2 0')
    listed = notebook.ok("%rosnode list").split()
    assert [name for name in listed if name.startswith("/rviz")] == ["/rviz"]
    notebook.ok('%click "2D Nav Goal" 1 2 0 -f world')
    assert len([name for name in notebook.ok("%rosnode list").split() if name.startswith("/rviz")]) == 2
