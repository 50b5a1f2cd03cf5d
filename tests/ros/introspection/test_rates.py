"""The sums behind hz, delay and bw."""

from __future__ import annotations

import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.ros.introspection.rates import Arrivals, Sizes, rate_table, rate_text


@given(st.lists(st.integers(1, 10**12), min_size=1, max_size=50), st.integers(-1, 20))
def test_the_sums_are_those_of_the_last_spans(spans: list[int], window: int) -> None:
    arrivals = Arrivals(window)
    now = 1
    arrivals.heard(now)
    for span in spans:
        now += span
        arrivals.heard(now)
    counted = spans if window < 0 else spans[len(spans) - min(max(window - 1, 0), len(spans)) :]
    found = arrivals.statistics()
    if not counted:
        assert found is None
        return
    assert found is not None
    assert found.window == len(counted) + 1
    assert found.mean * 1e9 == pytest.approx(statistics.fmean(counted))
    assert found.deviation * 1e9 == pytest.approx(statistics.pstdev(counted), abs=1e-3)
    assert (found.smallest, found.largest) == (min(counted) / 1e9, max(counted) / 1e9)
    assert arrivals.statistics() is None  # nothing new


def test_time_that_jumps_back_or_has_not_begun_forgets_what_was() -> None:
    arrivals = Arrivals(-1)
    for now in (5, 6, 3):
        arrivals.heard(now * 10**9)
    assert arrivals.statistics() is None
    arrivals.heard(4 * 10**9)
    assert arrivals.statistics() is not None
    arrivals.heard(0)
    arrivals.heard(10**9)
    assert arrivals.statistics() is None


def test_messages_at_one_instant_have_no_rate() -> None:
    arrivals = Arrivals(-1)
    arrivals.heard(5)
    arrivals.heard(5)
    found = arrivals.statistics()
    assert found is not None
    assert found.rate == 0.0
    assert rate_text(found).startswith("average rate: 0.000\n")
    assert rate_table({"/t": found}).splitlines()[2].split()[1] == "0.0"


@pytest.mark.parametrize(("size", "says"), [(10, "15.00B/s"), (5000, "7.50KB/s"), (2_000_000, "3.00MB/s")])
def test_sizes(size: int, says: str) -> None:
    sizes = Sizes(100)
    assert sizes.weight(1.0) is None
    for now in (1.0, 1.5, 2.0):
        sizes.heard(now, size)
    found = sizes.weight(3.0)
    assert str(found).startswith(f"average: {says}")
    assert "window: 3" in str(found)
    assert sizes.weight(1.0) is None
