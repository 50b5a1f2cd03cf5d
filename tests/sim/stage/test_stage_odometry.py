"""Stage's odometry, against its equation and its distribution."""

import math

import numpy as np
import pytest

from rosmini.sim.stage.odometry import StageOdometry, draw_errors
from rosmini.sim.stage.world_file import load


@pytest.fixture
def robot(tmp_path):
    def make(text=""):
        path = tmp_path / "a.world"
        path.write_text(f"position( {text} )", encoding="utf-8")
        return load(path).robots[0]

    return make


class Fixed:
    """A generator that is wrong by a quarter of the largest error, or by another part."""

    def __init__(self, part=0.25):
        self.part = part

    def uniform(self, low, high, size):
        assert low <= self.part <= high
        return np.full(size, self.part)


@pytest.mark.parametrize(
    ("said", "errors"),
    [
        ("odom_error [0.1 0.2 0 36]", (0.1, 0.2, math.pi / 5)),
        ("odom_error [0.1 0.2]", (0.1, 0.2, 0.0125)),
        ("odom_error [0 0 0 0]", (0.0, 0.0, 0.0)),
        ("", (0.0075, 0.0075, 0.0125)),
    ],
)
def test_what_a_file_says_are_the_errors_themselves_and_the_others_are_drawn(robot, said, errors):
    base = robot(f'localization "odom" {said}')
    assert StageOdometry(base, Fixed()).errors == pytest.approx(errors)


def test_errors_that_are_drawn_are_even_between_minus_and_plus_half(robot):
    base = robot('localization "odom"')
    errors = np.array([draw_errors(base, np.random.default_rng(seed)) for seed in range(4000)])
    for column, largest in zip(errors.T, (0.03, 0.03, 0.05), strict=True):
        assert -largest / 2 <= column.min() < -0.499 * largest
        assert 0.499 * largest < column.max() <= largest / 2
        # Kolmogorov and Smirnov: the distance from the even distribution, at a level of 0.001
        ranks = np.sort(column) / largest + 0.5
        distance = np.abs(ranks - np.arange(1, 4001) / 4000).max()
        assert distance < 1.95 / math.sqrt(4000)
    assert abs(np.corrcoef(errors.T) - np.eye(3)).max() < 0.06


def test_a_wrong_turn_makes_another_circle(robot):
    base = robot('localization "odom" odom_error [0.05 0 0 5.729577951308232]')
    odometry = StageOdometry(base, Fixed())
    odometry.set_velocity((0.5, 0.0, 0.3), 1.0)
    odometry.advance(3.0)
    odometry.set_velocity((0.0, 0.0, 0.0), 6.0)
    v, w = 0.5 * 1.05, 0.3 * 1.1
    turned = w * 5
    assert odometry.belief == pytest.approx((v / w * math.sin(turned), v / w * (1 - math.cos(turned)), turned))
    odometry.advance(100.0)
    assert odometry.belief[2] == pytest.approx(turned)


def test_a_way_to_the_left_is_one_to_the_left(robot):
    odometry = StageOdometry(robot('drive "omni" localization "odom" odom_error [0 0.1 0 0]'), Fixed())
    odometry.set_velocity((0.0, 0.5, 0.0), 0.0)
    odometry.advance(2.0)
    assert odometry.belief == pytest.approx((0.0, 1.1, 0.0))


def test_how_often_one_asks_does_not_matter(robot):
    base = robot('drive "omni" localization "odom"')
    seldom, often = StageOdometry(base, Fixed()), StageOdometry(base, Fixed())
    for each in (seldom, often):
        each.set_velocity((0.5, -0.2, 0.7), 0.0)
    seldom.advance(4.0)
    for now in np.linspace(0.0, 4.0, 1000):
        often.advance(float(now))
    assert often.belief == pytest.approx(seldom.belief, abs=1e-12)


def test_the_origin_of_the_odometry(robot):
    started = StageOdometry(robot('pose [1 2 0 90] localization "odom"'), Fixed())
    assert started.pose((1.0, 2.0, math.pi / 2)) == pytest.approx((0, 0, 0))
    elsewhere = StageOdometry(robot('pose [1 2 0 90] localization "odom" localization_origin [1 0 0 0]'), Fixed())
    assert elsewhere.belief == pytest.approx((0, 2, math.pi / 2))
    gps = StageOdometry(robot("pose [1 2 0 90]"), Fixed())
    assert gps.pose((4.0, 5.0, 6.0)) == (4, 5, 6)
