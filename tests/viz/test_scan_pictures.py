"""One scan, as the robot sees it."""

import math
import re
import warnings
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.viz import ViewError, scan_picture, style
from rosmini.viz.beams import beams_of, direction
from rosmini.viz.world_drawing import ONE_BEAM

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


def test_the_text_and_the_alt_text_say_what_is_where():
    ranges = wall_on_the_left()
    view = scan_picture(message(ranges), title="A wall")
    hits = int(np.isfinite(ranges).sum())
    assert view.text.splitlines() == [
        f"A wall: {hits} of 360 beams hit, nearest 1.00 m on the left (90 deg)",
        "beams ahead nothing, on the left 1.00 m, behind nothing, on the right nothing",
    ]
    assert view.alt == (
        f"A laser scan around the robot: {hits} of 360 laser beams hit something, the nearest 1.00 m away on the left. "
        "Ahead nothing, on the left 1.00 m, behind nothing, on the right nothing."
    )
    assert scan_picture(message(ranges)).text.startswith("scan in base_scan: ")
    assert "<figcaption>A wall</figcaption>" in view.html


def test_left_is_on_the_left_and_ahead_is_up():
    ranges = np.full(360, np.inf)
    ranges[0], ranges[90] = 1.0, 2.0
    svg = scan_picture(message(ranges)).svg
    around, over = re.findall(r'd="((?:M\S+ \S+h0)+)"', svg)
    (ahead_x, ahead_y), (left_x, left_y) = (tuple(map(float, spot)) for spot in re.findall(r"M(\S+) (\S+)h0", around))
    centre = (40 + 264 / 2, 24 + 264 / 2)
    scale = 264 / 7
    assert (ahead_x, ahead_y) == pytest.approx((centre[0], centre[1] - scale), abs=0.05)
    assert (left_x, left_y) == pytest.approx((centre[0] - 2 * scale, centre[1]), abs=0.05)
    (x0, _), (x90, _) = (tuple(map(float, spot)) for spot in re.findall(r"M(\S+) (\S+)h0", over))
    assert x90 < x0


def test_a_laser_that_looks_ahead_only_is_drawn_as_such():
    scan = message([2.0] * 101, angle_min=-0.5, angle_max=0.5, angle_increment=0.01)
    view = scan_picture(scan)
    assert view.text.splitlines()[1] == "beams ahead 2.00 m"
    words = [node.text for node in ET.fromstring(view.svg).iter("{http://www.w3.org/2000/svg}text")]
    assert "15°" in words
    assert "180°" not in words


def test_nothing_anywhere_is_a_picture_too():
    view = scan_picture(message([math.inf] * 360))
    assert view.text.splitlines()[0] == "scan in base_scan: 0 of 360 beams hit, nothing within 3.50 m"
    assert "none of 360 laser beams" in view.alt
    assert "h0" not in view.svg
    assert style.LIGHT["muted"] in view.svg


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
        scan_picture(scan)


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
def test_a_single_beam_is_drawn_as_a_line(first, step, last):
    angles = {"angle_min": first, "angle_increment": step, "angle_max": last}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        view, missed = (scan_picture(message([r], **angles)) for r in (2.7, math.inf))
    assert view.text.splitlines() == [
        "scan in base_scan: 1 of 1 beams hit, nearest 2.70 m ahead (0 deg)",
        "beams ahead 2.70 m",
    ]
    assert "0 of 1 beams hit" in missed.text
    assert view.alt.endswith("the nearest 2.70 m away ahead. Ahead 2.70 m.")
    for each in (view, missed):
        assert len(re.findall(rf'<path d="M\S+ \S+L\S+ \S+"[^>]*stroke-opacity="{ONE_BEAM}"', each.svg)) == 1
