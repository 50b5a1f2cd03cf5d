"""Trials: scripts in a graph of their own with a robot, and what becomes of those that fail."""

from __future__ import annotations

import pytest

from rosmini import Graph, default_graph, set_default_graph
from rosmini.book.checks import Script, Status, Wrong, exercise, is_stub
from rosmini.book.trials import StageTrial, Trial
from rosmini.sim.recording import Recording
from rosmini.viz.view import ViewError

DRIVE = """
import rospy
from geometry_msgs.msg import Twist

def drive(event):
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
command.linear.x = 0.2
rospy.Timer(rospy.Duration(0.1), drive)
rospy.spin()
"""


def test_a_script_drives_the_robot_of_its_trial_alone():
    with Graph() as own:
        before = set_default_graph(own)
        try:
            with Trial("room", "_x:=0.5") as trial:
                trial.start(Script("drive.py", DRIVE))
                trial.run(5.0)
                x, _, _ = trial.robot.truth()
                view = trial.view()
            assert default_graph() is own
            assert list(own.nodes) == ["/rosout"]
        finally:
            set_default_graph(before)
    assert 1.2 < x < 1.6
    assert "run" not in view.text.splitlines()[0]
    assert view.text.startswith("What the robot did: 0.9")


def test_arguments_are_those_of_rosrun():
    with Trial("empty") as trial:
        trial.start(Script("drive.py", DRIVE), "__name:=other", "cmd_vel:=wish")
        trial.run(2.0)
        assert "/other" in trial.graph.nodes
        assert trial.robot.truth()[0] == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("x = 1 / 0", "bad.py ended with an error in line 1: ZeroDivisionError: division by zero"),
        ("import sys\nprint('no')\nsys.exit(3)", "bad.py ended with an error: no"),
        ("import sys\nsys.exit(3)", "bad.py ended with an error: exit status 3"),
    ],
)
def test_a_script_that_fails_is_wrong(source, said):
    with Trial("empty") as trial:
        trial.start(Script("bad.py", source))
        with pytest.raises(Wrong) as error:
            trial.run(1.0)
    assert str(error.value) == said


def test_a_script_that_never_blocks_has_an_end():
    with Trial("empty") as trial:
        handle = trial.start(Script("busy.py", "n = 0\nwhile True:\n    n += 1"))
        trial.run(0.5)
        assert handle.poll() is None


def test_what_is_wrong_comes_with_the_picture_and_the_first_error():
    failing = DRIVE.replace("cmd_vel.publish(command)", "cmd_vel.publish(commmand)")
    with pytest.raises(Wrong, match="It stands still") as error, Trial("empty") as trial:
        trial.start(Script("drive.py", failing))
        trial.run(1.0)
        raise Wrong("It stands still.", "drive")
    assert "Your script logged: " in str(error.value)
    assert "NameError" in str(error.value)
    assert str(error.value).endswith("(line 6)")
    assert error.value.view.text.startswith("What the robot did: 0.00 m")
    assert error.value.hint == "drive"


def test_what_is_wrong_with_a_script_that_never_sleeps_says_so():
    said = r"stood still\. Your script logged: busy\.py, line 3: this loop never sleeps\.$"
    with pytest.raises(Wrong, match=said), Trial("empty") as trial:
        trial.start(Script("busy.py", "import rospy\nrospy.init_node('busy')\nwhile True:\n    pass"))
        trial.run(4.0)
        raise Wrong("It stood still.")


def test_where_the_robot_has_no_part_no_picture_is_shown():
    with pytest.raises(Wrong) as error, Trial("empty", is_shown=False) as trial:
        trial.run(1.0)
        raise Wrong("It said nothing.")
    assert error.value.view is None


@pytest.mark.parametrize(
    ("source", "is_one"),
    [
        ("def on_scan(scan):\n    ...\n", True),
        ("x = 1\n...\n", True),
        ("x = ...\n", False),
        ("rate = 1\n", False),
        ("def broken(:", False),
    ],
)
def test_a_script_with_a_gap_is_a_stub(source, is_one):
    assert is_stub(Script("stop.py", source)) is is_one


@exercise("98.9", praise="It drives.")
def drives(answer):
    with Trial("empty") as trial:
        trial.start(answer)
        trial.run(2.0)
        if trial.robot.truth()[0] < 0.1:
            raise Wrong("It stands still.")
        return trial.view()


def test_a_verdict_shows_what_the_robot_did():
    right = drives.grade(Script("drive.py", DRIVE))
    assert (right.status, right.text) == (Status.RIGHT, "Exercise 98.9: right. It drives.")
    assert right.view.text.startswith("What the robot did: 0.3")
    wrong = drives.grade(Script("drive.py", DRIVE.replace("0.2", "0.0")))
    assert wrong.status is Status.WRONG and wrong.text.endswith("It stands still.")
    assert wrong.view is not None
    assert drives.grade(Script("drive.py", "...")).status is Status.NOT_ATTEMPTED
    assert drives.grade(Script("drive.py", "def broken(:")).status is Status.WRONG


def test_a_picture_that_cannot_be_drawn_changes_no_verdict(monkeypatch):
    def fail(*_, **__):
        raise ViewError("matplotlib is missing")

    monkeypatch.setattr(Recording, "show", fail)
    with Trial("room") as trial:
        trial.start(Script("drive.py", DRIVE))
        trial.run(1.0)
        assert trial.view() is None
    with pytest.raises(Wrong, match="too short") as caught, Trial("room") as trial:
        trial.run(1.0)
        raise Wrong("too short")
    assert caught.value.view is None


def test_a_script_drives_in_a_stage_world():
    with StageTrial("position( pose [1 0 0 90] )") as trial:
        trial.start(Script("drive.py", DRIVE))
        trial.run(5.0)
        x, y, _ = trial.stage.truth()
    assert (x, y) == (pytest.approx(1.0), pytest.approx(0.9, abs=0.2))


def test_a_world_that_stage_cannot_read_is_a_wrong_answer():
    with pytest.raises(Wrong, match=r"answer\.world:2: .*ranger"):
        StageTrial("position( )\nrangr( )")
