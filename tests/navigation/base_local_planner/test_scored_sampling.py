"""Which velocities are tried."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.base_local_planner.scored_sampling import velocity_samples

NUMBERS = st.floats(-5, 5, allow_subnormal=False).map(lambda value: round(value, 3))


def test_the_values_of_the_originals_tests():
    """From base_local_planner's own tests of its iterator."""
    assert velocity_samples(0.0, 0.0, 1).tolist() == [0.0]
    assert velocity_samples(-2.0, 2.0, 2).tolist() == [-2.0, 0.0, 2.0]
    assert velocity_samples(-2.0, 2.0, 3).tolist() == [-2.0, 0.0, 2.0]
    assert velocity_samples(-2.0, 2.0, 4).tolist() == [-2.0, -2.0 + 4 / 3, 0.0, -2.0 + 8 / 3, 2.0]
    assert velocity_samples(1.0, 2.0, 1).tolist() == [1.0, 2.0]


@given(NUMBERS, NUMBERS, st.integers(0, 30))
def test_ends_and_zero_are_always_tried(one, other, count):
    low, high = sorted((one, other))
    values = velocity_samples(low, high, count)
    assert (values[0], values[-1]) == (low, high)
    assert np.all(np.diff(values) > 0)
    assert 0.0 in values or not low < 0 < high
    assert len(values) <= max(2, count) + 1
