"""The messages of actionlib_tutorials, actionlib and turtle_actionlib, with the md5 sums of real ROS."""

from __future__ import annotations

import json

import pytest

from rosmini.core.actionlib.spec import ActionTypes
from rosmini.msgs import action_class, message_class

ACTIONS = [
    "actionlib_tutorials/Fibonacci",
    "actionlib_tutorials/Averaging",
    "actionlib/TwoInts",
    "actionlib/Test",
    "actionlib/TestRequest",
    "turtle_actionlib/Shape",
    "move_base_msgs/MoveBase",
]
SUFFIXES = ["Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback"]


@pytest.fixture(scope="module")
def real(root):
    found = {}
    for name in ("ros_md5.json", "ros_md5_more.json"):
        found.update(flat(json.loads((root / "tests" / "data" / name).read_text(encoding="utf-8"))))
    return found


def flat(tree):
    """Types and their sums, however the file groups them."""
    found = {}
    for key, value in tree.items():
        if isinstance(value, dict):
            found.update(flat(value))
        elif "/" in key:
            found[key] = value
    return found


@pytest.mark.parametrize("action", ACTIONS)
def test_md5_sums(real, action):
    known = [f"{action}{suffix}" for suffix in SUFFIXES if f"{action}{suffix}" in real]
    assert known, f"no real sum of {action} is known"
    for name in known:
        assert message_class(name)._md5sum == real[name], name


def test_the_types_of_an_action():
    types = ActionTypes.of(action_class("actionlib_tutorials/Fibonacci"))
    assert [one._type.removeprefix("actionlib_tutorials/Fibonacci") for one in types] == [
        "ActionGoal",
        "ActionResult",
        "ActionFeedback",
        "Goal",
        "Result",
        "Feedback",
    ]
