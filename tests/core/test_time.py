"""Time and Duration alone; tests/interop/test_genpy_time.py compares them with the real genpy."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.time import Duration, Time

SECOND = 1_000_000_000
durations = st.builds(Duration, st.integers(-(2**31), 2**31 - 1), st.integers(0, SECOND - 1))
times = st.builds(Time, st.integers(0, 2**32 - 1), st.integers(0, SECOND - 1))


def test_fields_are_mutable_and_canon_repairs_them() -> None:
    stamp = Time(1, 5)
    stamp.secs = 3
    stamp.nsecs = 2 * SECOND + 7
    stamp.canon()
    assert (stamp.secs, stamp.nsecs) == (5, 7)
    assert (stamp.sec, stamp.nanosec) == (5, 7)
    with pytest.raises(AttributeError):
        stamp.sec = 1  # type: ignore[misc]
    with pytest.raises(AttributeError):
        stamp.other = 1  # type: ignore[attr-defined]


def test_results_keep_the_subclass() -> None:
    class Stamp(Time):
        __slots__ = ()

    assert type(Stamp(1) + Duration(1)) is Stamp
    assert type(Stamp.from_nsec(5)) is Stamp
    assert type(Stamp(2) - Stamp(1)) is Duration


@given(durations)
def test_nanoseconds_are_exact_both_ways(value: Duration) -> None:
    assert Duration.from_nsec(value.to_nsec()) == value
    assert bool(value) is not value.is_zero()


@given(times, durations)
def test_a_time_moves_by_a_duration(time: Time, step: Duration) -> None:
    if time.to_nsec() + step.to_nsec() >= 0:
        assert (time + step) - time == step
    else:
        with pytest.raises(TypeError):
            time + step
