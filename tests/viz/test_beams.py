"""The beams of a scan, for pictures."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.viz import ViewError
from rosmini.viz.beams import beams_of, direction

LaserScan = message_class("sensor_msgs/LaserScan")
STEP = 2 * math.pi / 360


def message(ranges, **changes):
    scan = LaserScan(angle_min=0.0, angle_max=359 * STEP, angle_increment=STEP, range_min=0.12, range_max=3.5)
    scan.header.frame_id = "base_scan"
    scan.ranges = list(ranges)
    for name, value in changes.items():
        setattr(scan, name, value)
    return scan


def wall_on_the_left():
    """A wall 1 m to the left, as far as the laser reaches."""
    angles = np.arange(360) * STEP
    with np.errstate(divide="ignore"):
        distance = np.where(np.sin(angles) > 1e-9, 1.0 / np.sin(angles), np.inf)
    return np.where(distance <= 3.5, distance, np.inf)


def test_the_text_and_the_clause_say_what_is_nearest():
    ranges = wall_on_the_left()
    beams = beams_of(message(ranges))
    hits = int(np.isfinite(ranges).sum())
    assert f"{hits} of 360 beams" in beams.text() and "1.00 m on the left (90 deg)" in beams.text()
    assert f"{hits} of 360 laser beams" in beams.clause() and "1.00 m away on the left" in beams.clause()


def test_nothing_within_reach_is_said_too():
    beams = beams_of(message([math.inf] * 360))
    assert "0 of 360 beams" in beams.text() and "3.50 m" in beams.text()
    assert "none of 360 laser beams" in beams.clause()


def test_the_angle_max_of_a_driver_may_be_one_beam_off():
    assert len(beams_of(message([1.0] * 360, angle_max=2 * math.pi)).ranges) == 360


@pytest.mark.parametrize(
    ("scan", "text"),
    [
        (message([]), "a scan has 0 ranges"),
        (
            message([1.0] * 200),
            r"200 ranges, but its angles from 0.0000 to 6.2657 rad by 0.017453 rad are those of 360 beams",
        ),
        (message([1.0] * 360, angle_increment=0.0), "angle_increment 0.0 rad"),
        (message([1.0] * 360, angle_min=math.nan), "angle_min is nan"),
        (np.ones((2, 2)), r"array \(n,\), not \(2, 2\)"),
        (np.empty(0), r"not \(0,\)"),
        ({"ranges": 1}, "not a dict"),
        (None, "not a NoneType"),
    ],
)  # fmt: skip
def test_what_is_no_scan_is_refused(scan, text):
    with pytest.raises(ViewError, match=text):
        beams_of(scan)


@pytest.mark.parametrize(
    ("angle", "words"),
    [(0, "ahead"), (22, "ahead"), (23, "ahead on the left"), (90, "on the left"), (180, "behind"), (-180, "behind"),
     (200, "behind"), (-22, "ahead"), (-23, "ahead on the right"),
     (-135, "behind on the right"), (270, "on the right")],
)  # fmt: skip
def test_directions_in_words(angle, words):
    assert direction(math.radians(angle)) == words


@pytest.mark.parametrize(
    ("first", "step", "last"), [(0.0, 0.0, 0.0), (-0.13, math.inf, 0.13)], ids=["ours", "of stageros"]
)
def test_a_single_beam_needs_no_increment(first, step, last):
    beams = beams_of(message([2.7], angle_min=first, angle_increment=step, angle_max=last))
    assert "1 of 1 beams" in beams.text() and "2.70 m ahead (0 deg)" in beams.text()
