"""Headings of a plan."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.navigation.global_planner.orientations import orient

# East, then north, and the goal looks west.
PATH = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [2, 2, 0], [2, 3, math.pi]], float)
QUARTER = math.pi / 2


@pytest.mark.parametrize(
    ("mode", "headings"),
    [
        (0, [0, 0, 0, 0, 0]),
        (1, [0, 0, QUARTER / 2, QUARTER, QUARTER]),
        (4, [math.pi, math.pi, -1.5 * QUARTER, -QUARTER, -QUARTER]),
        (5, [-QUARTER, -QUARTER, -QUARTER / 2, 0, 0]),
        (6, [QUARTER, QUARTER, 1.5 * QUARTER, math.pi, math.pi]),
    ],
)
def test_headings_follow_the_path(mode, headings):
    turned = orient(PATH, mode, 0.3)
    assert turned[:-1, 2] == pytest.approx(headings)
    assert turned[-1, 2] == math.pi
    assert np.array_equal(turned[:, :2], PATH[:, :2])


def test_headings_are_blended_from_start_to_goal():
    assert orient(PATH, 2, 0.0)[:, 2] == pytest.approx(np.linspace(0, math.pi, 6))


def test_headings_are_blended_on_the_last_straight_stretch():
    turned = orient(PATH, 3, -1.0)[:, 2]
    assert turned == pytest.approx([-1.0, 0, QUARTER / 2, QUARTER, 1.5 * QUARTER, math.pi])


def test_a_window_smooths():
    assert orient(PATH, 1, 0.0, window=2)[2, 2] == pytest.approx(math.atan2(2, 2))


def test_a_plan_of_one_pose_stays():
    assert orient(PATH[:1], 1, 0.3).tolist() == PATH[:1].tolist()
