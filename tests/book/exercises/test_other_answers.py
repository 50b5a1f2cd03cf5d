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


CAUTIOUS = {
    "gain_scale": 1,
    "potential_scale": 20.0,
    "min_frontier_size": 0.6,
    "progress_timeout": 15.0,
    "return_to_init": True,
}


@pytest.mark.parametrize(
    ("number", "answer"),
    [
        ("10.4", ARGUMENTS),
        ("22.1", {"mode": "all", "hide": "debug", "topics": "/closest,/nearest,/scan"}),
        ("30.1", np.int64(1)),
        ("72.3", CAUTIOUS),
        ("18.1", {1: "C", 2: " a", 3: "mkdir src", 4: "catkin_make"}),
        ("18.4", Script("parrot.py", DICE)),
    ],
)
def test_they_are_right_too(number: str, answer: Any) -> None:
    verdict = find(number).grade(answer)
    assert verdict.text.startswith(f"Exercise {number}: right."), verdict.text


@pytest.mark.parametrize("true", [True, np.True_])
@pytest.mark.parametrize(
    ("number", "answer"),
    [
        ("15.1", lambda true: lambda _: {"/chatter": 5, "/news": true}),
        ("18.1", lambda true: {true: "c", 2: "a", 3: "b", 4: "d"}),
        ("30.1", lambda true: true),
        ("37.3", lambda true: lambda *_: [0, true, true, 3, 3]),
        ("72.3", lambda true: {**CAUTIOUS, "gain_scale": true}),
    ],
)
def test_a_truth_value_is_no_number(number: str, answer: Any, true: Any) -> None:
    """`check("30.1", True)` was right, since True == 1."""
    verdict = find(number).grade(answer(true))
    assert verdict.status is Status.WRONG
    assert "True where a number or a string is expected." in verdict.text
