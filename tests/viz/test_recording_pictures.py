"""A recorded run, from above and over time."""

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rosmini.core.geometry.poses import arc, compose
from rosmini.sim.models import BURGER, model
from rosmini.sim.recording import Moved, Recording
from rosmini.sim.worlds import world
from rosmini.viz import ViewError, style
from rosmini.viz.recording_pictures import recording_picture

from ..recordings import part

TIMES = np.linspace(0, 10, 301)


def run(noise=0.0):
    """Ten seconds on an arc, of which odometry gets the turn wrong by 2 per cent."""
    truth = arc((0.0, 0.0, 0.0), 0.15, 0.2, TIMES) + noise
    odom = compose((5.0, 5.0, 1.0), arc((0.0, 0.0, 0.0), 0.15, 0.204, TIMES))
    return Recording(
        world("room"),
        BURGER,
        times=TIMES,
        truth=truth,
        odom=odom * (1 + noise),
        commands=np.array([(0.0, 0.15, 0.2)]),
        scan_times=np.array([5.0]),
        scans=np.full((1, 360), 0.5),
    )


def test_the_picture_says_where_from_where_to_and_how_far_odometry_is_off():
    recording = run()
    view = recording_picture(recording, title="Round the pillar")
    end = recording.truth[-1]
    off = math.dist(recording.odom_in_map()[-1, :2], end[:2])
    off_by = f"{off:.3f} m and 2.3 deg off"
    ends = f"(0.00, 0.00, 0.0 deg), end ({end[0]:.2f}, {end[1]:.2f}, 114.6 deg)"
    for said in ("Round the pillar: 1.50 m in 10.0 s", ends, off_by, "301 poses, 1 scan, 1 command"):
        assert said in view.text
    for said in ("a solid line from (0.00, 0.00, 0.0 deg)", "1.50 m long", "dashed line", off_by):
        assert said in view.alt
    orange = style.LIGHT["orange"]
    assert sum("dasharray" in p for p in re.findall(rf'<path[^>]*"{orange}"[^>]*>', view.svg)) >= 3  # way, ghost


def test_the_last_scan_is_drawn_from_where_it_was_taken():
    view = recording_picture(run(), scan=True)
    last = view.text.splitlines()[-1]
    assert "360 of 360 beams" in last and "0.50 m ahead (0 deg)" in last
    assert "In its last scan, 360 of 360 laser beams" in view.alt
    dots = np.array(re.findall(r"M(\S+) (\S+?)h0", view.svg), dtype=float)
    ring = re.search(r"M(\S+) (\S+)C", view.svg)
    assert len(dots) == 360
    assert ring
    later = recording_picture(replace(run(), scan_times=np.array([6.0])), scan=True)
    assert np.abs(np.array(re.findall(r"M(\S+) (\S+?)h0", later.svg), dtype=float) - dots).max() > 5


def test_a_run_of_a_moment_has_a_picture():
    moment = part(run(), 0.0, 0.0)
    assert "0.00 m in 0.0 s" in recording_picture(moment).text


def test_a_robot_that_stands_still_has_a_picture():
    still = replace(run(), truth=np.zeros((301, 3)), odom=np.zeros((301, 3)))
    assert "odometry: 0.000 m and 0.0 deg off" in recording_picture(still).text


def test_what_is_no_recording_is_refused():
    with pytest.raises(ViewError, match=r"not from a SimpleNamespace: call its recording\(\) first"):
        recording_picture(SimpleNamespace(recording=run))


def test_a_scan_that_was_not_recorded_cannot_be_drawn():
    blind = replace(run(), scan_times=np.empty(0), scans=np.empty((0, 360)))
    with pytest.raises(ViewError, match="no scan was recorded"):
        recording_picture(blind, scan=True)


def together():
    """Two robots more, and a crate that was pushed by a metre."""
    own = run()
    crate = next(o for o in own.world.obstacles if o.movable)
    x, y, theta = crate.pose
    moved = Moved(crate, np.array([0.0, 4.0, 6.0]), np.array([(x, y, theta), (x, y, theta), (x + 1.0, y, theta)]))
    others = [
        replace(own, truth=own.truth + (0.0, 0.4 * i, 0.0), name=name, model=model(name))
        for i, name in enumerate(("waffle", "waffle_pi"), 1)
    ]
    return replace(own, name="first", others=tuple(others), things=(moved,))


def test_each_robot_has_its_colour_its_name_and_its_way():
    view = recording_picture(together())
    words = [node.text for node in ET.fromstring(view.svg).iter("{http://www.w3.org/2000/svg}text")]
    assert {"first", "waffle", "waffle_pi"} <= set(words)
    for name in ("green", "purple"):
        assert f'stroke="{style.LIGHT[name]}"' in view.svg and f'fill="{style.LIGHT[name]}"' in view.svg
    end = together().others[0].truth[-1]
    assert f"waffle (waffle): 1.50 m, start (0.00, 0.40, 0.0 deg), end ({end[0]:.2f}, {end[1]:.2f}" in view.text
    assert "Beside it waffle drove 1.50 m, waffle_pi drove 1.50 m." in view.alt


def test_what_was_moved_stands_where_it_was_at_the_end_with_an_outline_where_it_began():
    view, before = recording_picture(together()), recording_picture(run())
    assert view.text.splitlines()[-1] == "crate: moved 1.00 m"
    assert "a dashed outline where it stood at first: crate" in view.alt
    assert view.svg.count("stroke-dasharray") > before.svg.count("stroke-dasharray")
