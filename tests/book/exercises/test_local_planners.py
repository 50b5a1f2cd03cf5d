"""The chapter Local planners: its cells show what its text says of them."""

from __future__ import annotations

import re

import pytest

from rosmini.book.checks import Status, find

from .conftest import printed


def test_only_the_true_acceleration_predicts_the_drive(cells):
    found = dict(re.findall(r"^(\S+).*: (\d) cm too far$", printed(cells, "guesses ="), re.MULTILINE))
    assert found == {"infinite": "2", "2.5": "2", "1.0": "0"}


def test_the_choice_by_hand_is_the_planners(cells):
    theirs, ours = re.findall(r"\d+", printed(cells, "def choose"))
    assert theirs == ours


def test_without_the_plan_it_gets_stuck_and_the_obstacle_critic_says_so(cells, figures):
    assert "'obstacle'" in printed(cells, "print(planner.samples.counts())")
    assert "rejected by obstacle" in figures[6]


def test_slower_turns_end_the_dance(cells):
    assert int(printed(cells, "degrees off").split()[0]) <= 3


@pytest.mark.parametrize("answer", [{"min_vel_theta": 0.3}, {"max_vel_theta": 0.5, "min_vel_theta": 0.5}])
def test_more_than_one_cure_is_right(answer):
    assert find("changes").grade(answer).status is Status.RIGHT
