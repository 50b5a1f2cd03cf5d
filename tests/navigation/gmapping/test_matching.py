"""Scores by hand on a map by hand, and that a search finds the pose."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.navigation.gmapping.maps import SharedMaps
from rosmini.navigation.gmapping.matching import Matcher, aim, fit, grids_of, match

BEARINGS = np.arange(180) * math.tau / 180


def square(x, y, heading, half=2.0):
    """Ranges to the walls of a square room around the origin."""
    c, s = np.cos(heading + BEARINGS), np.sin(heading + BEARINGS)
    with np.errstate(divide="ignore"):
        to_x = np.where(c > 0, half - x, -half - x) / c
        to_y = np.where(s > 0, half - y, -half - y) / s
    return np.minimum(np.where(np.isfinite(to_x), to_x, 99.0), np.where(np.isfinite(to_y), to_y, 99.0))


@pytest.fixture
def maps():
    found = SharedMaps(1, 0.05)
    for pose in ((0.3, 0.2, 0.0), (0.3, 0.2, 0.0), (-0.4, 0.1, 0.7)):
        found.register(np.array([pose]), square(*pose), BEARINGS, 10.0)
    return found


def scored(maps, end, **changes):
    """What a beam from the origin with this end gets."""
    matcher = Matcher(iterations=0, lstep=0.0, astep=0.0, **changes)
    found = matcher.match(
        maps, np.zeros((1, 3)), np.array([math.hypot(*end)]), np.array([math.atan2(end[1], end[0])]), 10.0
    )
    return float(found.scores[0]), float(found.log_likelihoods[0])


def test_score_and_likelihood_of_one_beam():
    """A wall whose mean end is known exactly: exp(-d2 / sigma), and -d2 / lsigma."""
    maps = SharedMaps(1, 0.05)
    maps.register(np.array([(0.0, 0.0, 0.0)]), np.array([1.03]), np.zeros(1), 10.0)
    for off in (0.0, 0.03, -0.04):
        score, likelihood = scored(maps, (1.03 + off, 0.0))
        assert score == pytest.approx(math.exp(-(off**2) / 0.05), abs=1e-9)
        assert likelihood == pytest.approx(-(off**2) / 0.075, abs=1e-9)
    assert scored(maps, (1.03, 0.2)) == (0.0, pytest.approx(-0.5 / 0.075)), "nothing is near"
    assert scored(maps, (1.12, 0.0)) == (0.0, pytest.approx(-0.5 / 0.075)), "two cells away, with kernelSize 1"
    assert scored(maps, (1.12, 0.0), kernel_size=2)[0] == pytest.approx(math.exp(-(0.09**2) / 0.05))


def test_a_full_cell_counts_only_where_the_way_to_it_is_free():
    maps = SharedMaps(1, 0.05)
    for length in (1.03, 1.03, 1.08):
        maps.register(np.array([(0.0, 0.0, 0.0)]), np.array([length]), np.zeros(1), 10.0)
    behind, _ = scored(maps, (1.08, 0.0), kernel_size=0)
    front, _ = scored(maps, (1.03, 0.0), kernel_size=0)
    assert front == pytest.approx(1.0)
    assert behind == 0.0, "the cell before it is full"


@pytest.mark.parametrize("off", [(0.06, -0.05, 0.04), (-0.08, 0.03, -0.05), (0.0, 0.0, 0.0)])
def test_a_search_finds_the_pose(maps, off):
    truth = np.array([(0.1, 0.3, 0.2)])
    ranges = square(*truth[0])
    found = Matcher().match(maps, truth + np.array(off), ranges, BEARINGS, 10.0)
    assert math.dist(found.poses[0, :2], truth[0, :2]) < 0.015
    assert abs(found.poses[0, 2] - truth[0, 2]) < 0.015
    start = Matcher(iterations=0, lstep=0.0, astep=0.0).match(maps, truth + np.array(off), ranges, BEARINGS, 10.0)
    assert found.scores[0] >= start.scores[0]


def test_giving_up_early_changes_no_result(maps):
    """A pose that cannot beat `least` may be left: what it has then is no more than `least`."""
    ranges = square(0.1, 0.3, 0.2)
    matcher = Matcher()
    grids, beams, rule = grids_of(maps), matcher.beams(ranges, BEARINGS, 10.0), matcher.rule
    for x, y, heading in ((0.1, 0.3, 0.2), (0.3, 0.3, 0.2), (0.1, 0.3, 0.5)):
        aim(heading, beams)
        whole, likelihood = fit(0, x, y, grids, beams, rule, -1.0)
        assert fit(0, x, y, grids, beams, rule, whole - 0.5) == (whole, likelihood)
        assert fit(0, x, y, grids, beams, rule, whole + 0.5)[0] <= whole + 0.5


def test_machine_code_finds_what_python_finds(maps):
    ranges = square(0.1, 0.3, 0.2)[::6]
    poses, result = np.array([(0.15, 0.25, 0.22)]), np.zeros((1, 2))
    found = Matcher(kernel_size=2).match(maps, poses, ranges, BEARINGS[::6], 10.0)
    matcher = Matcher(kernel_size=2)
    match(grids_of(maps), matcher.beams(ranges, BEARINGS[::6], 10.0), matcher.rule, -1.0, poses, result)
    assert found.poses == pytest.approx(poses, abs=1e-9)
    assert (found.scores[0], found.log_likelihoods[0]) == pytest.approx(tuple(result[0]), abs=1e-9)


def test_a_pose_that_scores_too_little_is_weighed_where_it_was(maps):
    """As in the original: a match that is not taken does not make its particle more likely, either."""
    ranges, start = square(0.1, 0.3, 0.2), np.array([(0.3, 0.25, 0.25)])
    kept = Matcher(minimum_score=1e6).match(maps, start, ranges, BEARINGS, 10.0)
    still = Matcher().score(maps, start, ranges, BEARINGS, 10.0)
    better = Matcher().match(maps, start, ranges, BEARINGS, 10.0)
    assert kept.poses == pytest.approx(start)
    assert kept.log_likelihoods[0] == still.log_likelihoods[0] < better.log_likelihoods[0]
    assert kept.scores[0] == better.scores[0], "the score is the match's"
