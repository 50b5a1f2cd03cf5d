"""The chapter Topics and messages: what its boxes and its table say of ROS is what there is."""

from __future__ import annotations

import re

import rosmini.ros.rospy
from rosmini.msgs import message_class


def tree(cls, indent=""):
    for field in cls._spec.fields:
        yield f"{indent}{field.type} {field.name}"
        if not field.builtin:
            yield from tree(message_class(field.base), indent + "  ")


def test_the_answers_of_rosmsg_are_true(prose):
    box = re.search(r"\$ rosmsg show (\S+)\n(.*?)\n(?:> )?\$ rosmsg md5 (\S+)\n(?:> )?(\w+)", prose, re.DOTALL)
    shown, lines, fingerprinted, md5 = box.groups()
    assert [line.removeprefix("> ") for line in lines.splitlines()] == list(tree(message_class(shown)))
    assert message_class(fingerprinted)._md5sum == md5


def test_rospy_has_what_the_table_names(prose):
    names = set(re.findall(r"`[^`]*?rospy\.(\w+)", prose))
    assert {"Publisher", "Subscriber", "Time", "Duration"} <= names
    assert all(hasattr(rosmini.ros.rospy, name) for name in names)
    assert "`publisher.get_num_connections()`" in prose
    assert hasattr(rosmini.ros.rospy.Publisher, "get_num_connections")
