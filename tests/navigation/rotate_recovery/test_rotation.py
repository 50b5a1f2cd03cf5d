import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.rotate_recovery.rotation import FullTurn, first_collision, turn_speed


@given(st.floats(-10, 10), st.floats(0.01, 0.15))
def test_a_turn_is_done_when_the_robot_has_turned_once_around(start, step):
    turn = FullTurn(start, 0.1)
    turned = 0.0
    while not turn.is_done:
        remaining = turn.update(start + turned)
        assert remaining == pytest.approx(2 * math.pi - turned, abs=0.15 + 1e-9) or turned < math.pi
        turned += step
        assert turned < 2 * math.pi + 1
    assert turned - step == pytest.approx(2 * math.pi, abs=0.1 + 1e-9)


def test_a_free_turn_and_one_that_is_not():
    assert first_collision(0.5, 2 * math.pi, 0.017, lambda _: 0.0) is None
    at, cost = first_collision(0.5, 2 * math.pi, 0.017, lambda at: -1.0 if at > 1.5 else 12.0)
    assert 1.5 < at < 1.517 + 1e-9
    assert cost == -1.0


@pytest.mark.parametrize(("remaining", "speed"), [(2 * math.pi, 1.0), (0.1, 0.8), (0.001, 0.4)])
def test_speed(remaining, speed):
    assert turn_speed(remaining, 3.2, 0.4, 1.0) == pytest.approx(speed)
