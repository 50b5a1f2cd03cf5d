"""Keys to velocities, without a graph."""

from __future__ import annotations

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.live.key_maps import NAMES
from rosmini.viz.live.teleop import Limits, Teleop, TeleopError, key_map, table

BURGER = Limits(0.22, 2.84)

presses = st.lists(st.sampled_from([*key_map().keys, None]), max_size=200)


def play(teleop: Teleop, keys) -> list[tuple[float, float]]:
    return [teleop.cycle() if key is None else teleop.press(key) for key in keys]


def test_a_key_moves_the_target_a_step_and_the_command_half_a_step():
    teleop = Teleop()
    assert play(teleop, ["w", None, None]) == [(0.005, 0.0), (0.01, 0.0), (0.01, 0.0)]
    assert teleop.target == (0.01, 0.0)
    assert play(teleop, ["a", None, "d", "d", None]) == [
        (0.01, 0.05), (0.01, 0.1), (0.01, 0.05), (0.01, 0.0), (0.01, -0.05),
    ]  # fmt: skip
    assert play(teleop, ["x", "x", None, None]) == [(0.005, -0.1), (0.0, -0.1), (-0.005, -0.1), (-0.01, -0.1)]


@pytest.mark.parametrize("key", ["s", " "])
def test_the_stop_is_at_once(key):
    teleop = Teleop()
    play(teleop, ["w"] * 10 + ["a"] * 10 + [None] * 30)
    assert teleop.command == (0.1, 1.0)
    assert teleop.press(key) == (0.0, 0.0)
    assert teleop.at_rest


def test_the_limits_are_those_of_the_burger():
    teleop = Teleop()
    play(teleop, ["w"] * 40 + ["d"] * 40 + [None] * 100)
    assert teleop.target == teleop.command == (0.22, -2.84)
    assert teleop.press("a") == (0.22, -2.79)
    assert teleop.target == (0.22, -2.74)


def test_arrows_do_as_their_letters():
    for arrow, letter in [("ArrowUp", "w"), ("ArrowDown", "x"), ("ArrowLeft", "a"), ("ArrowRight", "d")]:
        one, other = Teleop(), Teleop()
        assert one.press(arrow) == other.press(letter) != (0.0, 0.0)


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
def test_the_command_gets_to_the_target_and_stays(keys):
    teleop = Teleop(BURGER)
    play(teleop, keys)
    play(teleop, [None] * 60)
    assert teleop.command == teleop.target


@given(presses)
def test_left_and_right_are_mirrored(keys):
    mirror = {"a": "d", "d": "a", "ArrowLeft": "ArrowRight", "ArrowRight": "ArrowLeft"}
    one = play(Teleop(), keys)
    other = play(Teleop(), [mirror.get(key, key) for key in keys])
    assert one == [(v, -w + 0.0) for v, w in other]


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


def test_accelerations_are_positive():
    assert Limits(0.22, 2.84, 0.5, 3.0).linear_acceleration == 0.5
    with pytest.raises(TeleopError, match="the linear acceleration of a pad must be positive"):
        Limits(0.22, 2.84, 0.0)
    with pytest.raises(TeleopError, match="the angular acceleration"):
        Limits(0.22, 2.84, 1.0, math.nan)


def test_the_table_is_json_and_complete():
    told = json.loads(json.dumps(table(Limits(0.26, 1.82))))
    assert told["linear"] == {"step": 0.01, "max": 0.26, "slope": 0.005}
    assert told["angular"] == {"step": 0.1, "max": 1.82, "slope": 0.05}
    assert (told["adds"], told["period"], told["holds"]) == (True, 0.1, None)
    assert told["moves"] == {key: list(move) for key, move in key_map().moves.items()}
    other = json.loads(json.dumps(table(Limits(), key_map("teleop_twist_keyboard"))))
    assert other["linear"] == {"step": 0.5, "max": 0.22, "slope": None}


# -- the keys of teleop_twist_keyboard --


def twist_keyboard(limits=None) -> Teleop:
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


def test_limits_and_ramps_hold_for_all_keys():
    teleop = twist_keyboard(Limits(0.22, 2.0, 0.5, 4.0))
    assert teleop.speed == (0.22, 1.0)
    assert play(teleop, ["u", None, None, None, None, None]) == [
        (0.05, 0.4), (0.1, 0.8), (0.15, 1.0), (0.2, 1.0), (0.22, 1.0), (0.22, 1.0),
    ]  # fmt: skip
    play(teleop, ["e"] * 20)
    assert teleop.speed == (0.22, 2.0)
    assert teleop.press(" ") == (0.0, 0.0)  # the stop is no ramp


@pytest.mark.parametrize("name", NAMES)
def test_a_gamepad_steers_within_the_limits_until_a_key_comes(name):
    teleop = Teleop(Limits(0.22, 2.84, 1.0), key_map(name))
    assert teleop.steer(0.15, -9.0)[0] in (0.1, 0.005)
    play(teleop, [None] * 200)
    assert teleop.command == (0.15, -2.84)
    assert teleop.press(" ") == (0.0, 0.0)
    with pytest.raises(TeleopError, match="finite velocities"):
        teleop.steer(math.nan, 0.0)
