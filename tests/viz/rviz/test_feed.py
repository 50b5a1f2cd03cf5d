"""What a page is told of a scene that goes on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import umsgpack

from rosmini.viz.rviz.feed import Feed
from rosmini.viz.rviz.primitives import Lines, Mesh, Points, Text, Texture

RED = np.array([1.0, 0.0, 0.0, 1.0])
TRIANGLE = Mesh(np.eye(3), np.array([(0, 1, 2)]), RED, np.eye(4))
CLOUD = Points(np.eye(3), RED)
MAP = Texture(np.full((2, 3, 4), 255, np.uint8), (3.0, 2.0), np.eye(4))


def said(commands):
    found = [umsgpack.unpackb(each) for each in commands]
    return [(each["type"], each["path"].removeprefix("/meshcat/")) for each in found]


@pytest.fixture
def feed():
    made = Feed()
    made.news([], whole=True)
    return made


def test_a_new_page_is_told_everything_lights_too(feed):
    whole = said(feed.news([("rviz/3", [TRIANGLE, CLOUD])], whole=True))
    assert ("set_object", "rviz/3/0") in whole
    assert ("set_object", "rviz/3/1") in whole
    assert any("Lights" in path for _, path in whole)
    assert not any("Cameras" in path for _, path in whole)
    assert feed.news([("rviz/3", [TRIANGLE, CLOUD])]) == []


def test_what_only_moved_is_not_sent_again(feed):
    feed.news([("rviz/0", [MAP, TRIANGLE])])
    moved = np.eye(4)
    moved[0, 3] = 0.5
    shown = [("rviz/0", [replace(MAP, pose=moved), replace(TRIANGLE, pose=moved)])]
    assert said(feed.news(shown)) == [("set_transform", "rviz/0/0"), ("set_transform", "rviz/0/1")]
    assert feed.news(shown) == []


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (CLOUD, replace(CLOUD, points=np.eye(3)[:2])),
        (CLOUD, Lines(np.eye(3), RED)),
        (TRIANGLE, replace(TRIANGLE, colours=RED / 2)),
        (MAP, replace(MAP, pixels=np.full((2, 3, 4), 90, np.uint8))),
        (Lines(np.eye(3), RED), Lines(np.eye(3), RED, strip=True, width=0.1)),
    ],
)
def test_what_has_changed_takes_the_place_of_what_was_there(feed, before, after):
    feed.news([("rviz/0", [before])])
    assert ("set_object", "rviz/0/0") in said(feed.news([("rviz/0", [after])]))


def test_what_is_gone_or_empty_is_taken_away(feed):
    feed.news([("rviz/0", [CLOUD, TRIANGLE]), ("rviz/1", [CLOUD])])
    empty = Points(np.empty((0, 3)), RED)
    told = feed.news([("rviz/0", [empty, Text("words", np.zeros(3), 0.1, RED), TRIANGLE])])
    assert sorted(said(told)) == [("delete", "rviz/0/0"), ("delete", "rviz/1/0")]
