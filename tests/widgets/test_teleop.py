"""Keys to velocities, without a graph."""

from __future__ import annotations

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.widgets.teleop import KEYS, Limits, Teleop, TeleopError, key_named, table

BURGER = Limits(0.22, 2.84)

presses = st.lists(st.sampled_from([*KEYS, None]), max_size=200)


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


@pytest.mark.parametrize(
    ("name", "key"),
    [("w", "w"), ("W", "w"), ("space", " "), (" ", " "), ("up", "ArrowUp"), ("ArrowLeft", "ArrowLeft")],
)
def test_keys_have_several_names(name, key):
    assert key_named(name) == key


def test_an_unknown_key_is_refused_with_the_nearest():
    with pytest.raises(TeleopError, match=r"no key 'rigth'.*right"):
        key_named("rigth")
    with pytest.raises(TeleopError, match="no key 'q'; it has w, x, a, d, s, space"):
        key_named("q")


@pytest.mark.parametrize(("linear", "angular"), [(0.0, 1.0), (-0.2, 1.0), (math.nan, 1.0), (0.2, math.inf)])
def test_limits_are_positive_numbers(linear, angular):
    with pytest.raises(TeleopError, match="must be a positive number"):
        Limits(linear, angular)


def test_the_table_is_json_and_complete():
    told = json.loads(json.dumps(table(Limits(0.26, 1.82))))
    assert told["linear"] == {"step": 0.01, "max": 0.26}
    assert told["angular"] == {"step": 0.1, "max": 1.82}
    assert (told["slope"], told["period"]) == (0.5, 0.1)
    assert told["keys"] == {key: list(steps) for key, steps in KEYS.items()}
