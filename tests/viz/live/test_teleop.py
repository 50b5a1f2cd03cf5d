"""Keys to velocities, without a graph."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.live.key_maps import NAMES, TeleopError, key_map
from rosmini.viz.live.teleop import Limits, Teleop

BURGER = Limits(0.22, 2.84)

presses = st.lists(st.sampled_from([*key_map().keys, None]), max_size=200)


def play(teleop, keys):
    return [teleop.cycle() if key is None else teleop.press(key) for key in keys]


def test_a_key_moves_the_target_a_step_and_the_command_half_a_step():
    teleop = Teleop()
    assert play(teleop, ["w", None, None]) == [(0.005, 0.0), (0.01, 0.0), (0.01, 0.0)]
    assert teleop.target == (0.01, 0.0)
    assert play(teleop, ["a", None, "d", "d", None]) == [
        (0.01, 0.05), (0.01, 0.1), (0.01, 0.05), (0.01, 0.0), (0.01, -0.05),
    ]  # fmt: skip
    assert play(teleop, ["x", "x", None, None]) == [(0.005, -0.1), (0.0, -0.1), (-0.005, -0.1), (-0.01, -0.1)]


@given(presses)
def test_nothing_exceeds_the_limits_or_half_a_step_a_cycle(keys):
    teleop, before = Teleop(BURGER), (0.0, 0.0)
    for key, (v, w) in zip(keys, play(teleop, keys), strict=True):
        assert abs(v) <= 0.22
        assert abs(w) <= 2.84
        if key not in ("s", " "):
            assert abs(v - before[0]) <= 0.005 + 1e-12
            assert abs(w - before[1]) <= 0.05 + 1e-12
        before = (v, w)


@given(presses)
def test_what_is_sent_prints_without_binary_noise(keys):
    for velocity in play(Teleop(), keys):
        for value in velocity:
            assert len(repr(abs(value))) <= 6
            assert math.copysign(1, value) == 1 or value < 0  # no -0.0


@pytest.mark.parametrize(("linear", "angular"), [(0.0, 1.0), (-0.2, 1.0), (math.nan, 1.0), (0.2, math.inf)])
def test_limits_are_positive_numbers(linear, angular):
    with pytest.raises(TeleopError, match="must be a positive number"):
        Limits(linear, angular)


def twist_keyboard(limits=None):
    return Teleop(limits or Limits(100.0, 100.0), key_map("teleop_twist_keyboard"))


def test_a_key_says_where_to_go_and_other_keys_how_fast():
    teleop = twist_keyboard()
    assert play(teleop, ["i", "u", None, ".", "l"]) == [
        (0.5, 0.0), (0.5, 1.0), (0.5, 1.0), (-0.5, 1.0), (0.0, -1.0),
    ]  # fmt: skip
    assert play(teleop, ["o", "q", "w", "c", "k"]) == [
        (0.5, -1.0), (0.55, -1.1), (0.605, -1.1), (0.605, -0.99), (0.0, 0.0),
    ]  # fmt: skip
    assert teleop.speed == (0.605, 0.99)  # a stop keeps the speed


def test_capitals_drive_sideways_and_t_and_b_up_and_down():
    teleop = twist_keyboard()
    for key, velocity, aside in [
        ("O", (0.5, 0.0), (-0.5, 0.0)), ("J", (0.0, 0.0), (0.5, 0.0)), ("b", (0.0, 0.0), (0.0, -0.5)),
        ("k", (0.0, 0.0), (0.0, 0.0)),
    ]:  # fmt: skip
        assert (teleop.press(key), teleop.aside) == (velocity, aside)
    assert teleop.at_rest


def test_limits_hold_for_all_keys():
    teleop = twist_keyboard(Limits(0.22, 2.0))
    assert teleop.speed == (0.22, 1.0)
    play(teleop, ["e"] * 20)
    assert teleop.speed == (0.22, 2.0)
    assert teleop.press(" ") == (0.0, 0.0)


@pytest.mark.parametrize("name", NAMES)
def test_a_gamepad_steers_within_the_limits_until_a_key_comes(name):
    teleop = Teleop(Limits(0.22, 2.84), key_map(name))
    assert teleop.steer(0.15, -9.0)[0] in (0.15, 0.005)
    play(teleop, [None] * 200)
    assert teleop.command == (0.15, -2.84)
    assert teleop.press(" ") == (0.0, 0.0)
    with pytest.raises(TeleopError, match="finite velocities"):
        teleop.steer(math.nan, 0.0)
