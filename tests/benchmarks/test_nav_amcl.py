"""The study of amcl runs, on a drive that is short, and knows a robot that is found from one that is not."""

import math

import numpy as np
import pytest
from rosmini_bench import nav_amcl
from rosmini_bench.nav_amcl import Track
from rosmini_bench.nav_drives import accompanied, drive, kidnapped


@pytest.fixture(scope="module")
def short():
    return drive("room", 1, 12.0)


def test_a_drive_is_the_same_again_and_moves(short):
    assert (drive("room", 1, 12.0).ranges == short.ranges).all()
    assert len(short.times) > 50
    assert np.hypot(*np.diff(short.truth[:, :2], axis=0).T).sum() > 0.5


def test_a_filter_follows_a_drive(short):
    track = nav_amcl.follow(short, nav_amcl.ours(), 1)
    assert np.median(track.off) < 0.3
    assert track.inside
    assert nav_amcl.ours().max_particles == 3000


def test_what_was_found():
    times = np.arange(0.0, 160.0)
    rest = (np.zeros(160), np.zeros(160, dtype=bool), (), np.zeros(160), 0.0)
    found = Track(times, np.where(times < 50, 2.0, 0.1), *rest)
    assert found.found() == 50.0
    assert found.found(after=20.0) == 30.0
    assert math.isinf(Track(times, np.where(times % 20 < 2, 2.0, 0.1), *rest).found())
    assert math.isinf(Track(times, np.where(times < 125, 2.0, 0.1), *rest).found())


def test_somebody_who_is_carried_away_does_not_notice(short):
    one = kidnapped(short, short, 5.0)
    step = np.hypot(*np.diff(one.odometry[:, :2], axis=0).T)
    assert step.max() < 0.1
    assert (one.truth[-1] == short.truth[-1]).all()


def test_people_stop_beams(short):
    one, share = accompanied(short, 3, 1)
    assert 0.05 < share < 0.3
    assert (one.ranges <= short.ranges).all()
    assert one.ranges[one.ranges < short.ranges].min() > 0.5


def test_an_update_costs_something():
    assert nav_amcl.update_cost(100, 20, times=1) > 0
    assert nav_amcl.map_memory(50) > 0
