"""The drawings of Gazebo's processes and libraries."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from rosmini.sim.gazebo.topics import TOPICS
from rosmini.viz.gazebo_drawing import NEEDS, gazebo_libraries, gazebo_processes


def words_of(picture):
    return [node.text for node in ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}text")]


def test_the_topics_between_server_and_client_exist():
    words = ", ".join(each for each in words_of(gazebo_processes()) if each.startswith("~"))
    named = {each.removeprefix("~/") for each in words.split(", ")}
    assert len(named) == 4
    assert named <= set(TOPICS)


def test_each_program_and_library_is_drawn_once():
    words = words_of(gazebo_libraries())
    assert sorted(words) == sorted({*NEEDS, *(each for needs in NEEDS.values() for each in needs)})
