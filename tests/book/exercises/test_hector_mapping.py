"""The chapter Hector mapping: what the text says of its experiments is what its cells print."""

from __future__ import annotations

import re

from .conftest import printed


def test_the_node_hears_no_odometry(cells):
    said = printed(cells, "node.subscriptions")
    assert "/scan" in said
    assert "/odom" not in said


def test_a_step_by_hand_climbs(cells):
    rows = re.findall(r"\d: (\d+) cm, lacking (\d\.\d+)", printed(cells, "delta, lack = step"))
    assert [int(rows[0][0]), int(rows[-1][0]) > 5] == [0, True]
    assert float(rows[-1][1]) < 0.7 * float(rows[0][1])


def test_the_mappers_fail_where_the_text_says(cells):
    said = printed(cells, "slams = {")
    off = {name.strip(): float(number) for name, number in re.findall(r"(.*?) off by ([\d.]+) m", said)}
    assert off["hector, no odometry"] > 1.0
    assert off["hector, odometry as start"] <= 0.1
    assert off["gmapping, odometry"] <= 0.2
    assert off["gmapping, swapped sensors"] > 0.5


def test_beams_that_count(cells):
    counts = [int(n) for n in re.findall(r": (\d+) beams", printed(cells, "def seen(pitch)"))]
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] < counts[0] / 2
