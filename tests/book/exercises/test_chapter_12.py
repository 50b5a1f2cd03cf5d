"""Chapter 12: its figures are numbered, and what its boxes and its table say of ROS is what there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import rosmini.ros.rospy
from book.tools import notebooks
from rosmini.msgs import message_class

from .conftest import figure_numbers, prose_of

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "12_topics_and_messages.ipynb"


@pytest.fixture(scope="module")
def prose():
    return prose_of(CHAPTER.stem)


@pytest.fixture(scope="module")
def code():
    return [cell.source for cell in notebooks.read(CHAPTER).cells if cell.cell_type == "code"]


def tree(cls, indent=""):
    for field in cls._spec.fields:
        yield f"{indent}{field.type} {field.name}"
        if not field.builtin:
            yield from tree(message_class(field.base), indent + "  ")


def test_every_figure_is_numbered_in_order(code):
    numbers = figure_numbers(CHAPTER.stem)
    assert numbers == list(range(1, len(numbers) + 1))
    assert (
        sum(bool(re.search(r"^(rqt_graph|plot)\(", source, re.MULTILINE)) for source in code)
        == len(numbers)
        > 0
    )


def test_the_answers_of_rosmsg_are_true(prose):
    box = re.search(
        r"\$ rosmsg show (\S+)\n(.*?)\n(?:> )?\$ rosmsg md5 (\S+)\n(?:> )?(\w+)", prose, re.DOTALL
    )
    shown, lines, fingerprinted, md5 = box.groups()
    assert [line.removeprefix("> ") for line in lines.splitlines()] == list(tree(message_class(shown)))
    assert message_class(fingerprinted)._md5sum == md5


def test_rospy_has_what_the_table_names(prose):
    names = set(re.findall(r"`[^`]*?rospy\.(\w+)", prose))
    assert {"Publisher", "Subscriber", "Time", "Duration"} <= names
    assert all(hasattr(rosmini.ros.rospy, name) for name in names)
    assert "`publisher.get_num_connections()`" in prose
    assert hasattr(rosmini.ros.rospy.Publisher, "get_num_connections")
