"""The filter: when a scan is taken in, how particles are weighed and chosen, and how good its maps are."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np
import pytest

from rosmini.core.geometry.poses import compose, inverse
from rosmini.navigation.gmapping.matching import Matcher
from rosmini.navigation.gmapping.slam import GridSlam, Settings

from .test_matching import BEARINGS, square

DEFAULT = Path(__file__).resolve().parents[4] / "shared" / "data"
LOG = Path(os.environ.get("ROSMINI_SHARED_DATA", DEFAULT)) / "log_house.npz"


def a_slam(seed=1, **changes):
    return GridSlam(Settings(**{"particles": 8, **changes}), random=np.random.default_rng(seed))


def test_a_scan_is_taken_in_after_a_motion_or_a_time():
    slam = a_slam(temporal_update=3.0)

    def at(x, turn, time):
        return slam.process(square(x, 0.0, turn), BEARINGS, (x, 0.0, turn), time) is not None

    assert at(0.0, 0.0, 0.0)
    assert not at(0.6, 0.0, 1.0)
    assert at(1.0, 0.0, 2.0), "a metre in all"
    assert not at(1.0, 0.4, 3.0)
    assert at(1.0, 0.5, 3.5)
    assert not at(1.0, 0.5, 6.0)
    assert at(1.0, 0.5, 6.6)
    assert at(1.0, 0.5, 1.0), "time has gone back"
    assert [round(node.time, 1) for node in slam.path()] == [0.0, 2.0, 3.5, 6.6, 1.0]


def test_motion_has_the_spread_of_the_model():
    slam = a_slam(particles=50_000, srr=0.1, srt=0.2, str_=0.3, stt=0.4)
    slam.move((0.0, 0.0, 0.0))
    slam.move((1.0, 0.0, 0.5))
    turned, across = 0.4 * 0.5 + 0.2 * 1.0, 0.3 * 0.1
    assert np.std(slam.poses, axis=0) == pytest.approx([0.1 + 0.3 * 0.5, 0.3 * 0.5 + across, turned], rel=0.03)
    assert np.mean(slam.poses, axis=0) == pytest.approx([1.0, 0.0, 0.5], abs=0.01)


def test_weights_entropy_and_choice():
    slam = a_slam(particles=4, ogain=1.0)
    assert slam.entropy == pytest.approx(math.log(4))
    slam.paths = [None] * 4
    slam.poses[:, 0] = [0.0, 1.0, 2.0, 3.0]
    slam.log_weights = np.array([0.0, 0.0, 0.0, 400.0])
    slam.sums = slam.log_weights.copy()
    assert slam.weights[3] == pytest.approx(1.0)
    effective, resampled = slam._select()
    assert (round(effective, 6), resampled) == (1.0, True)
    assert slam.poses[:, 0].tolist() == [3.0] * 4
    assert (slam.log_weights == 0.0).all()
    assert slam._select() == (pytest.approx(4.0), False)


def test_choosing_is_unbiased():
    """Low-variance: each particle comes as often as its weight says, up to one."""
    weights = np.array([0.5, 0.25, 0.15, 0.1] + [0.0] * 96)
    counts = np.zeros(100)
    for seed in range(200):
        slam = a_slam(seed, particles=100, ogain=0.01)
        slam.poses[:, 0] = np.arange(100)
        with np.errstate(divide="ignore"):
            slam.log_weights = np.where(weights > 0, np.log(np.maximum(weights, 1e-30)), -1e6)
        slam._select()
        found = np.bincount(slam.poses[:, 0].astype(int), minlength=100)
        assert (abs(found - 100 * weights) <= 1 + 1e-9).all()
        counts += found
    assert counts / 200 == pytest.approx(100 * weights, abs=0.15)


def test_a_match_that_scores_too_little_is_not_taken():
    slam = a_slam(particles=3, matcher=Matcher(minimum_score=1e6), srr=0.0, srt=0.0, str_=0.0, stt=0.0)
    slam.process(square(0.0, 0.0, 0.0), BEARINGS, (0.0, 0.0, 0.0), 0.0)
    report = slam.process(square(1.0, 0.05, 0.0), BEARINGS, (1.0, 0.0, 0.0), 1.0)
    assert report.unmatched == 3
    assert slam.poses[:, :2] == pytest.approx(np.tile((1.0, 0.0), (3, 1)))


def test_an_odometry_that_jumps():
    slam = a_slam()
    assert not slam.jumps_to((50.0, 0.0, 0.0)), "the first may be anywhere"
    slam.move((50.0, 0.0, 0.0))
    assert not slam.jumps_to((50.0, 19.0, 0.0))
    assert slam.jumps_to((50.0, 21.0, 0.0))


@pytest.mark.nightly
@pytest.mark.skipif(not LOG.is_file(), reason="the log of a drive through the house is not there")
def test_a_house_is_mapped_as_well_as_by_the_original():
    """openslam's gmapping, with the same parameters: 0.103 to 0.109 m RMS, aligned at the start."""
    log = np.load(LOG)
    ranges = log["ranges_mm"] / 1000.0
    ranges[log["ranges_mm"] == 0] = math.inf
    ranges[log["ranges_mm"] == 65535] = 0.0
    bearings = float(log["angle_min"]) + float(log["angle_increment"]) * np.arange(ranges.shape[1])
    reach = float(log["range_max"]) - 0.01
    slam = GridSlam(
        Settings(max_range=reach, max_urange=reach),
        laser=tuple(log["laser_in_base"].tolist()),
        start=tuple(log["odom"][0].tolist()),
        random=np.random.default_rng(0),
    )
    taken = []
    for index, odometry in enumerate(log["odom"].tolist()):
        if slam.process(ranges[index], bearings, tuple(odometry), float(log["t"][index])) is not None:
            taken.append(index)
    path = np.array([node.pose for node in slam.path()])
    truth = log["truth"][taken]
    assert len(path) == len(taken)
    aligned = compose(compose(tuple(truth[0].tolist()), inverse(tuple(path[0].tolist()))), path)
    error = math.sqrt(np.mean(np.sum((aligned - truth)[:, :2] ** 2, axis=1)))
    alone = compose(compose(tuple(truth[0].tolist()), inverse(tuple(log["odom"][0].tolist()))), log["odom"][taken])
    drift = math.sqrt(np.mean(np.sum((alone - truth)[:, :2] ** 2, axis=1)))
    assert error < 0.109
    assert error < drift / 4
