"""The chapter Local planners: its cells show what its text says of them."""

from __future__ import annotations

import re

from rosmini.book.checks import Status, find

from .conftest import printed


def test_only_the_prediction_with_acceleration_is_right(cells):
    found = dict(re.findall(r"^(.+): +(\S+) cm too far$", printed(cells, "at_once ="), re.MULTILINE))
    assert float(found["at once"]) > 2
    assert abs(float(found["accelerating"])) < 0.5


def test_the_choice_by_hand_is_almost_the_planners(cells):
    found = re.findall(r": +(\S+) m/s, +(\S+) rad/s", printed(cells, "def choose"))
    (v, w), (sent_v, sent_w) = [tuple(map(float, each)) for each in found]
    assert abs(v - sent_v) < 0.05
    assert abs(w - sent_w) < 0.1


def test_the_counts_by_hand_are_those_of_the_log(cells):
    logged = printed(cells, "rosmini.wait(8)")
    sampled, slow, rejected, left = re.findall(r"\d+", printed(cells, "fast = ["))
    assert f"of {sampled} sampled velocities, obstacle rejected {rejected}, {slow} are slower" in logged
    assert left == "0"


def test_another_time_is_right_too():
    assert find("past_the_crate").grade("DWAPlannerROS: {sim_time: 1.2}").status is Status.RIGHT
