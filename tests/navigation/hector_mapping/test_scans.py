"""Which beams are looked at, and where they end when the laser leans."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.tf.rigid import IDENTITY, from_rpy
from rosmini.navigation.hector_mapping.scans import Limits, ends_in_laser_frame, scan_ends


def test_ranges_that_are_looked_at():
    ranges = np.array([math.nan, math.inf, -1.0, 0.0, 0.3, 0.5, 3.4, 3.5, 31.0])
    ends = scan_ends(ranges, np.zeros(9), (0.12, 3.5), IDENTITY, Limits())
    assert ends.tolist() == [[0.5, 0.0], [3.4, 0.0]]
    assert scan_ends(ranges, np.zeros(9), (0.12, 99.0), IDENTITY, Limits(0.0, 99.0))[-1, 0] == 3.5, "30 m"
    assert ends_in_laser_frame(ranges, np.zeros(9), (0.12, 3.5))[:, 0].tolist() == [0.3, 0.5]


def test_what_is_near_behind_is_the_robot_itself():
    bearings = np.array([math.pi, math.pi, 0.0])
    ends = scan_ends(np.array([0.6, 0.8, 0.6]), bearings, (0.12, 3.5), IDENTITY, Limits())
    assert ends[:, 0] == pytest.approx([-0.8, 0.6])


def test_a_laser_that_leans_sees_the_floor():
    """Pitched down by 0.2 rad, a beam of 3 m is 0.6 m lower at its end, and shorter from above."""
    mount = from_rpy((0.1, 0.0, 0.5), 0.0, 0.2, 0.0)
    bearings = np.array([0.0, math.pi / 2, math.pi])
    ends = scan_ends(np.full(3, 3.0), bearings, (0.12, 3.5), mount, Limits())
    assert ends[0] == pytest.approx([0.1 + 3 * math.cos(0.2), 0.0])
    assert ends[1] == pytest.approx([0.1, 3.0])
    level = scan_ends(np.full(3, 3.0), bearings, (0.12, 3.5), mount, Limits(lowest=-0.3, highest=0.3))
    assert level == pytest.approx(np.array([[0.1, 3.0]])), "the floor, and the ceiling behind, are left out"
