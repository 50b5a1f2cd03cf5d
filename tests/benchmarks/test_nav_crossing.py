"""Robots that cross one another: two exchange places in the house, each with amcl, and nobody touches anybody."""

import pytest
from rosmini_bench.nav_crossing import destinations, run


def test_nobody_is_sent_to_where_it_is():
    for seed in range(20):
        found = destinations(4, seed)
        assert sorted(found) == [0, 1, 2, 3]
        assert all(index != target for index, target in enumerate(found))


@pytest.mark.nightly
def test_two_robots_exchange_places_without_a_contact():
    found = run(2, seed=1)
    assert (found.reached, found.failures, found.charged) == (2, (), ())
