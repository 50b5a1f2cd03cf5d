"""The chapter amcl: its robot is found, lost and found as the text says."""

from __future__ import annotations

import pytest

from .conftest import printed


def test_amcl_finds_the_robot_and_so_does_the_filter_by_hand(cells, figures):
    _, base, truth = printed(cells, "listener = TransformListener()").splitlines()
    found, wanted = ([float(v) for v in line.partition(":")[2].split()] for line in (base, truth))
    assert found == pytest.approx(wanted, abs=0.4)
    assert float(figures[3].rpartition("mean ")[2].split()[0]) < 0.4


def test_a_kidnapped_robot_stays_lost_until_somebody_helps(cells):
    lost = [float(v) for v in printed(cells, "robot.place((-6.5").split()]
    assert min(lost) > 2.0
    helped = printed(cells, 'tools["2D Pose Estimate"]').splitlines()[-1].split()
    assert max(map(float, helped)) < 0.5
