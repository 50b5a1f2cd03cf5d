"""Action classes from a text at hand are those of a file with this text."""

from __future__ import annotations

import pytest

from rosmini.core.errors import DefinitionError
from rosmini.msgs import message_class
from rosmini.msgs.registry import define_action

FIBONACCI = (
    "#goal definition\nint32 order\n---\n#result definition\nint32[] sequence\n---\n#feedback\nint32[] sequence\n"
)


def test_the_classes_are_those_of_the_file():
    action, goal, result, feedback = define_action("actionlib_tutorials/Fibonacci", FIBONACCI)
    for mine, suffix in ((action, "Action"), (goal, "Goal"), (result, "Result"), (feedback, "Feedback")):
        theirs = message_class(f"actionlib_tutorials/Fibonacci{suffix}")
        assert mine is not theirs
        assert (mine._type, mine._md5sum) == (theirs._type, theirs._md5sum)
    assert type(action().action_goal.goal) is goal
    assert goal(order=3).order == 3
    assert action()._md5sum == "f59df5767bf7634684781c92598b2406"  # real ROS


def test_it_may_nest_what_has_files_and_names_the_line_that_is_wrong():
    action, goal, _, _ = define_action("mine/Go", "geometry_msgs/Point to\n---\n---\nfloat64 left")
    assert goal().to.x == 0.0
    assert action().action_feedback.feedback.left == 0.0
    with pytest.raises(DefinitionError, match="two lines '---'"):
        define_action("mine/Go", "int32 a\n---\nint32 b")
    with pytest.raises(DefinitionError, match="flaot64"):
        define_action("mine/Go", "---\n---\nflaot64 left")
