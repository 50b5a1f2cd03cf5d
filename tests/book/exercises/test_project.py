"""The chapter A project: its nights differ, and its robot reports what the text says."""

from __future__ import annotations

import re

from rosmini.book.exercises.project import DOORS, LIMIT, PATIENCE, PLACES, SEEDS, trouble

from .conftest import printed


def test_the_first_seeds_shut_each_door_once_and_one_for_ever():
    nights = [trouble(seed) for seed in SEEDS]
    assert {night.shut[0][1] for night in nights} == set(DOORS)
    assert sorted(len(night.open_at_the_end) for night in nights) == [len(PLACES) - 1, len(PLACES), len(PLACES)]


def test_the_trouble_of_a_seed_is_always_the_same_and_over_before_patience_ends():
    for seed in range(50):
        night = trouble(seed)
        assert night == trouble(seed)
        assert all(time < PATIENCE < LIMIT for time, _ in night.shut)


def test_the_robot_comes_back_to_the_room_that_was_shut(cells):
    reports = re.findall(r'data: "(.*)"', printed(cells, "%rostopic echo /report"))
    assert reports == ["child: later", "study: reached", "bath: reached", "child: reached", "done"]
    assert "child: missed" in printed(cells, "rosmini.wait(48)")
