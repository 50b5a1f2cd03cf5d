"""Time and Duration alone; tests/interop/test_genpy_time.py compares them with the real genpy."""

import copy
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.time import Duration, Time, TVal

SECOND = 1_000_000_000
durations = st.builds(Duration, st.integers(-(2**31), 2**31 - 1), st.integers(0, SECOND - 1))
times = st.builds(Time, st.integers(0, 2**32 - 1), st.integers(0, SECOND - 1))


def test_canonical_form() -> None:
    half_back = Duration(-0.5)
    assert (half_back.secs, half_back.nsecs) == (-1, 500_000_000)
    carried = Time(1, 2_500_000_000)
    assert (carried.secs, carried.nsecs) == (3, 500_000_000)
    assert Time(3, -1) == Time(2, 999_999_999)


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


def test_time_is_never_negative() -> None:
    for make in (lambda: Time(-1), lambda: Time(0, -1), lambda: Time(1) - Duration(2), lambda: Time.from_sec(-0.1)):
        with pytest.raises(TypeError, match="time values must be positive"):
            make()


def test_fractional_seconds_exclude_nanoseconds() -> None:
    with pytest.raises(ValueError, match="beside whole seconds"):
        Time(1.5, 3)


def test_arithmetic_table() -> None:
    assert Time(5) + Duration(2) == Duration(2) + Time(5) == Time(7)
    assert Time(5) - Time(7) == Duration(-2)
    assert Time(5) - Duration(2) == Time(3)
    assert Duration(4) * 0.5 == 0.5 * Duration(4) == Duration(2)
    assert Duration(7) / Duration(2) == 3.5
    assert Duration(7) // Duration(2) == 3
    assert Duration(7) % Duration(2) == Duration(1)
    assert divmod(Duration(7), Duration(2)) == (3, Duration(1))
    assert -Duration(1.5) == Duration(-1.5)
    assert abs(Duration(-2)) == Duration(2)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: Time(1) + Time(1),
        lambda: Time(1) + 1,
        lambda: 1 - Time(1),
        lambda: Time(1) * 2,
        lambda: Duration(1) - Time(1),
        lambda: Duration(1) + 1.0,
        lambda: Duration(1) % 2,
        lambda: Duration(1) * "2",
        lambda: Duration(1) / None,
        lambda: Time(1) < Duration(1),
        lambda: Duration(1) >= 1,
        lambda: Time(1).__cmp__(Duration(1)),
        lambda: Time("now"[:0] or []),
    ],
)
def test_what_cannot_be_combined_is_a_type_error(wrong) -> None:
    with pytest.raises(TypeError):
        wrong()


def test_a_time_equals_no_duration_and_no_number() -> None:
    assert Time(1) != Duration(1)
    assert Time(1) != 1
    assert len({Time(1), Time(1), Duration(1)}) == 2


def test_texts() -> None:
    assert str(Time(1, 5)) == "1000000005"
    assert repr(Time(1, 5)) == "genpy.Time[1000000005]"
    assert repr(Duration(-0.5)) == "genpy.Duration[-500000000]"
    assert repr(TVal(1)) == "genpy.TVal[1000000000]"


def test_results_keep_the_subclass() -> None:
    class Stamp(Time):
        __slots__ = ()

    assert type(Stamp(1) + Duration(1)) is Stamp
    assert type(Stamp.from_nsec(5)) is Stamp
    assert type(Stamp(2) - Stamp(1)) is Duration


@given(times | durations)
def test_copies_are_equal_and_apart(value: TVal) -> None:
    for made in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
        assert made == value
        assert type(made) is type(value)
        assert hash(made) == hash(value)
        made.secs += 1
        assert made != value


@given(durations)
def test_nanoseconds_are_exact_both_ways(value: Duration) -> None:
    assert Duration.from_nsec(value.to_nsec()) == value
    assert bool(value) is not value.is_zero()


@given(durations, durations)
def test_order_and_sums_are_those_of_nanoseconds(a: Duration, b: Duration) -> None:
    assert (a < b) == (a.to_nsec() < b.to_nsec())
    assert (a >= b) == (a.to_nsec() >= b.to_nsec())
    assert a.__cmp__(b) == (a > b) - (a < b)
    total = a + b
    assert total.to_nsec() == a.to_nsec() + b.to_nsec()
    assert 0 <= total.nsecs < SECOND
    assert total - b == a


@given(times, durations)
def test_a_time_moves_by_a_duration(time: Time, step: Duration) -> None:
    if time.to_nsec() + step.to_nsec() >= 0:
        assert (time + step) - time == step
    else:
        with pytest.raises(TypeError):
            time + step
