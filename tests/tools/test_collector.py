"""In a process of ours the collector of garbage looks more seldom, and afterwards as before."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest

from rosmini.tools.collector import seldom


@pytest.fixture(autouse=True)
def _threshold() -> Iterator[None]:
    """Leave the collector as other tests have it."""
    before = gc.get_threshold()
    yield
    gc.set_threshold(*before)


def test_the_collector_looks_more_seldom_and_then_as_before() -> None:
    gc.set_threshold(700, 10, 10)
    with seldom():
        assert gc.get_threshold()[0] > 700
        assert gc.isenabled()
    with pytest.raises(RuntimeError), seldom():
        raise RuntimeError
    assert gc.get_threshold() == (700, 10, 10)


def test_a_collector_that_looks_even_more_seldom_is_left_alone() -> None:
    gc.set_threshold(200_000, 30, 30)  # mypy, when a process runs it, leaves it so
    with seldom():
        assert gc.get_threshold() == (200_000, 30, 30)
    assert gc.get_threshold() == (200_000, 30, 30)
