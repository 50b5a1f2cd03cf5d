"""The drawings that chapters show: what they say is true, and the alt text says it too."""

from __future__ import annotations

from collections import Counter
from xml.etree import ElementTree as ET

import pytest

from assets.generate.drawings.gazebo_parts import NEEDS
from assets.generate.drawings.stacks import NAVIGATION
from rosmini.book import drawing
from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex
from rosmini.sim.gazebo.topics import TOPICS

NOT_IN_ROSMINI = {"voxel_grid"}
"""Obstacles in three dimensions."""


def words_of(picture):
    return [node.text for node in ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}text")]


def test_each_package_of_the_stack_is_drawn_and_exists():
    picture, index = drawing("stacks_and_packages"), PackageIndex()
    for package in NAVIGATION:
        assert words_of(picture).count(package) == 1
        assert package in picture.alt
        assert (package in index) != (package in NOT_IN_ROSMINI)


def test_publishers_and_subscribers_call_only_the_service():
    words = Counter(words_of(drawing("publish_subscribe")))
    assert words["Publisher"] == words["publish()"] == 2
    assert words["Subscriber"] == words["subscribe()"] == words["notify()"] == 2


def test_six_parts_of_rviz_are_numbered():
    picture = drawing("rviz_window")
    assert [each for each in words_of(picture) if each.isdigit()] == ["1", "2", "3", "4", "5", "6"]
    assert all(f" {number}: " in picture.alt for number in range(1, 7))


def test_the_topics_between_server_and_client_exist():
    words = ", ".join(each for each in words_of(drawing("gazebo_processes")) if each.startswith("~"))
    named = {each.removeprefix("~/") for each in words.split(", ")}
    assert len(named) == 4
    assert named <= set(TOPICS)


def test_each_program_and_library_is_drawn_once():
    words = words_of(drawing("gazebo_libraries"))
    assert sorted(words) == sorted({*NEEDS, *(each for needs in NEEDS.values() for each in needs)})


def test_every_frame_is_named_and_described():
    picture = drawing("frames_on_rough_ground")
    for frame in ("map", "odom", "base_footprint", "base_stabilized", "base_link", "base_scan"):
        assert frame in words_of(picture)
        assert frame in picture.alt


def test_an_unknown_drawing_names_those_there_are():
    with pytest.raises(RosminiError, match=r"no drawing 'rviz'.* rviz_window"):
        drawing("rviz")
