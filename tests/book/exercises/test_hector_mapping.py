"""The chapter Hector mapping: what the text says of its experiments is what its cells print."""

from __future__ import annotations

import math
import re

from .conftest import printed


def poses(text: str) -> list[tuple[float, float]]:
    """The places that a cell has printed: pairs of the mapper's and the true one."""
    return [(float(x), float(y)) for x, y in re.findall(r"x (-?[\d.]+) m, y (-?[\d.]+) m", text)]


def test_the_node_subscribes_to_no_odometry(cells):
    _, _, heard = printed(cells, "%rosnode info").partition("Subscriptions")
    assert "/scan" in heard
    assert "/odom" not in heard


def test_a_scan_climbs_step_by_step(cells):
    rows = re.findall(r"([-\d.]+) cm .*lacking before: ([\d.]+)", printed(cells, "pose, path ="))
    assert abs(float(rows[-1][0]) - 12) < 1
    assert float(rows[-1][1]) < 0.5 * float(rows[0][1])


def test_only_coarse_maps_find_a_scan_that_is_far_away(cells):
    one, two, three = (int(n) for n in re.findall(r": (-?\d+) cm", printed(cells, "levels = {")))
    assert one < 5
    assert two == three == 20


def test_the_mapper_is_lost_where_the_text_says(cells):
    for marker, off in (
        ("def report", False),
        ("map_size:=200", True),
        ("with_odometry.launch\n%rosrun notebook square.py _turn", False),
    ):
        found, truth = poses(printed(cells, marker))
        assert (math.dist(found, truth) > 1) == off


def test_in_a_corridor_the_distance_is_lost(cells):
    said = printed(cells, "_side:=20")
    (found, _), (truth, _) = poses(said)
    x, y = (float(n) for n in re.findall(r"to ([\d.]+) m", said))
    assert found < 0.5 * truth
    assert (truth - found) / x > 100, "as the text says"
    assert 0.05 > x > y


def test_beams_that_count(cells):
    counts = [int(n) for n in re.findall(r": (\d+) beams", printed(cells, "for pitch in"))]
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] < counts[0] / 2
