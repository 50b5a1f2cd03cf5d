"""Numbers whose last bit must not show."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.rounding import fixed, points_to_keep

NOISE = st.floats(-1e-12, 1e-12)


@given(st.integers(-10_000, 10_000), st.sampled_from([1, 2, 3]), NOISE)
def test_a_last_bit_never_changes_a_text_even_on_the_boundary(thousandths, digits, noise):
    value = thousandths / 1000 + 0.5 * 10**-digits
    assert fixed(value, digits) == fixed(value + noise, digits)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.125, 2, "0.13"), (-0.125, 2, "-0.13"), (2.5, 0, "3"),
        (-0.004, 2, "0.00"), (1e6, 1, "1000000.0"), (9.999, 2, "10.00"),
    ],
)  # fmt: skip
def test_half_goes_away_from_zero_and_zero_has_no_sign(value, digits, text):
    assert fixed(value, digits) == text


def test_a_line_keeps_its_ends_and_its_corners_and_little_else():
    x = np.linspace(0, 1, 101)
    up = np.column_stack([np.concatenate([x, np.ones(100)]), np.concatenate([np.zeros(101), x[1:]])])
    assert points_to_keep(up, 0.01) == [0, 100, 200]
    assert points_to_keep(np.array([[1.0, 2.0]]), 0.01) == [0]
    back = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 0.0)])
    assert points_to_keep(back, 0.01) == list(range(len(back)))


@pytest.mark.parametrize("seed", range(5))
def test_a_last_bit_never_changes_which_points_of_an_arc_are_kept(seed):
    angles = np.linspace(0.0, 2.0, 40)
    arc = np.column_stack([np.cos(angles), np.sin(angles)])
    noise = np.random.default_rng(seed).uniform(-1e-13, 1e-13, arc.shape)
    assert points_to_keep(arc + noise, 0.01) == points_to_keep(arc, 0.01)
