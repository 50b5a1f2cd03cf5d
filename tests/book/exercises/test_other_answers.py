"""Right answers of other readers than the one who wrote the solution."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rosmini.book.checks import Script, Status, find

ARGUMENTS = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator" args="_world:=maze _model:=waffle"/>
</launch>
"""

DICE = """\
import random

import rospy
from std_msgs.msg import String

rospy.init_node(f"parrot{random.randint(0, 1_000_000)}")
echo = rospy.Publisher("echo", String, queue_size=10)
rospy.Subscriber("chatter", String, echo.publish)
rospy.spin()
"""


@pytest.mark.parametrize(
    ("number", "answer"),
    [
        ("launch", ARGUMENTS),
        ("options", {"mode": "all", "hide": "debug", "topics": "/closest,/nearest,/scan"}),
        ("cures", {1: "C", 2: " a", 3: "mkdir src", 4: "catkin_make"}),
        ("parrot", Script("parrot.py", DICE)),
    ],
)
def test_they_are_right_too(number: str, answer: Any) -> None:
    verdict = find(number).grade(answer)
    assert verdict.text.startswith(f"Exercise {number}: right."), verdict.text


@pytest.mark.parametrize("true", [True, np.True_])
def test_a_truth_value_is_no_number(true: Any) -> None:
    """`True == 1`, so a check that compares would let it pass."""
    verdict = find("cures").grade({true: "c", 2: "a", 3: "b", 4: "d"})
    assert verdict.status is Status.WRONG
    assert "True where a number or a string is expected." in verdict.text
