"""Right answers of other readers than the one who wrote the solution."""

from __future__ import annotations

from typing import Any

import pytest

from rosmini.book.checks import Script, find

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
        ("10.4", ARGUMENTS),
        ("18.1", {1: "C", 2: " a", 3: "mkdir src", 4: "catkin_make"}),
        ("18.4", Script("parrot.py", DICE)),
    ],
)
def test_they_are_right_too(number: str, answer: Any) -> None:
    verdict = find(number).grade(answer)
    assert verdict.text.startswith(f"Exercise {number}: right."), verdict.text
