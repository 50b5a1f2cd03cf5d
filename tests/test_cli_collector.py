"""In a process of ours the collector of garbage looks more seldom, and afterwards as before."""

from __future__ import annotations

import gc

import pytest

from rosmini.cli.collector import seldom


def test_the_collector_looks_more_seldom_and_then_as_before() -> None:
    before = gc.get_threshold()
    with seldom():
        assert gc.get_threshold()[0] > before[0]
        assert gc.isenabled()
    with pytest.raises(RuntimeError), seldom():
        raise RuntimeError
    assert gc.get_threshold() == before
