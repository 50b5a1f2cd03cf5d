"""The keys of ROS's programs: what they are called, and that the terminals' programs have the same."""

import pytest

from rosmini.viz.live.key_maps import NAMES, TeleopError, key_map


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("w", "w"), ("W", "w"), ("space", " "), (" ", " "), ("up", "ArrowUp"), ("ArrowLeft", "ArrowLeft"),
        ("arrowleft", "ArrowLeft"),
    ],
)  # fmt: skip
def test_keys_have_several_names(name, key):
    assert key_map().named(name) == key


def test_an_unknown_key_is_refused_with_the_nearest():
    with pytest.raises(TeleopError, match=r"no key 'rigth'.*right"):
        key_map().named("rigth")
    with pytest.raises(TeleopError, match="no key 'q'; it has w, x, a, d, up, down, left, right, s, space"):
        key_map().named("q")


def test_an_unknown_program_is_refused_with_the_nearest():
    with pytest.raises(TeleopError, match=r"teleop_twist_keybord.*teleop_twist_keyboard"):
        key_map("teleop_twist_keybord")
    with pytest.raises(TeleopError, match="the programs are turtlebot3_teleop_key"):
        key_map("rviz")


def test_the_steps_and_speeds_are_those_of_the_programs():
    burger, twist = key_map(), key_map("teleop_twist_keyboard")
    assert (burger.linear, burger.angular, burger.adds) == (0.01, 0.1, True)
    assert (twist.linear, twist.angular, twist.adds) == (0.5, 1.0, False)
    turtle = key_map("turtle_teleop_key")
    assert (turtle.linear, turtle.angular, turtle.holds) == (2.0, 2.0, 1.0)
    assert [turtle.moves[turtle.named(key)] for key in ("up", "down", "left", "right")] == [
        (1, 0, 0, 0), (-1, 0, 0, 0), (0, 0, 0, 1), (0, 0, 0, -1),
    ]  # fmt: skip
    assert (burger.moves["a"], twist.moves["m"], twist.factors["w"]) == ((0, 0, 0, 1), (-1, 0, 0, -1), (1.1, 1))


@pytest.mark.parametrize("name", NAMES)
def test_buttons_are_keys_and_the_stop_is_in_the_middle(name):
    keys = key_map(name)
    assert len(keys.buttons) == 9
    assert set(keys.buttons) - {""} <= set(keys.keys)
    assert keys.buttons[4] in keys.stops
    assert " " in keys.stops
