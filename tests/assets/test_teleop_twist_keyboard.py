"""The program teleop_twist_keyboard.py, driven by keys in simulated time."""

from __future__ import annotations

import io

import pytest

from rosmini import Graph
from rosmini.core.packages import PackageIndex
from rosmini.msgs.geometry_msgs.msg import Twist, TwistStamped
from rosmini.ros.scripts import ScriptSpec, run_scripts

END = "\x03"


def drive(keys, *arguments, kind=Twist):
    """What is sent: seconds, then linear x, y, z and angular z; and what is printed."""
    found, said = [], io.StringIO()
    path = PackageIndex().find_executable("teleop_twist_keyboard", "teleop_twist_keyboard.py").path
    with Graph() as graph:
        start = graph.now()

        def hear(message):
            twist = getattr(message, "twist", message)
            seconds = round((graph.now() - start).to_sec(), 3)
            found.append(
                (seconds, *(round(v, 6) for v in (twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z)))
            )

        graph.node("robot").subscriber("cmd_vel", kind, hear)
        run_scripts([ScriptSpec(str(path), arguments)], graph=graph, stdin=keys, stdout=said)
    return found, said.getvalue()


def test_each_key_is_one_message_and_the_end_is_a_stop():
    sent, said = drive([(1, "i"), (2, "q"), (3, "U"), (4, "b"), (5, "?"), (6, "o"), (6.5, "w"), (7, END)])
    assert [entry[1:] for entry in sent] == [
        (0.5, 0, 0, 0), (0.55, 0, 0, 0), (0.55, 0.55, 0, 0), (0, 0, -0.55, 0), (0, 0, 0, 0),
        (0.55, 0, 0, -1.1), (0.605, 0, 0, -1.1), (0, 0, 0, 0),
    ]  # fmt: skip
    assert "currently:\tspeed 0.5\tturn 1.0 \n" in said
    assert "currently:\tspeed 0.55\tturn 1.1 \n" in said


def test_repeats_time_out_and_limits_are_parameters():
    sent, _ = drive(
        [(1, "j"), (1.95, "q" * 9), (4, END)],
        "_repeat_rate:=10",
        "_key_timeout:=0.5",
        "_turn_limit:=1.2",
        "_speed:=0.2",
    )
    turning = [seconds for seconds, *_, turn in sent if turn]
    assert turning[0] == pytest.approx(1.0, abs=0.01)
    assert turning[1] - turning[0] == pytest.approx(0.1, abs=0.001)
    assert 1.4 <= turning[-1] <= 1.55  # and what only changes the speed does not set off a robot that stands
    sent, _ = drive([(1, "q" * 9 + "l"), (2, END)], "_turn_limit:=1.2")
    assert max(abs(turn) for *_, turn in sent) == 1.2


def test_stamped_messages_have_a_frame():
    sent, _ = drive([(1, "i"), (2, END)], "_stamped:=true", "_frame_id:=base_link", kind=TwistStamped)
    assert [entry[1] for entry in sent] == [0.5, 0]
