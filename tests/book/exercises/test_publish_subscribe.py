"""The chapter Publish and subscribe: what its cells print is what the text says."""

from __future__ import annotations

from .conftest import printed


def test_a_publisher_goes_on_and_a_caller_waits(cells):
    sent = [line for line in printed(cells, "rosmini.wait(5)").splitlines() if "publish took" in line]
    assert len(sent) == 3
    assert all(line.endswith("0.0 s") for line in sent)
    assert printed(cells, "deliver()") == 3 * "delivered after 1.0 s\n"


def test_the_memory_sends_both_orders(cells):
    said = printed(cells, "order:=old_order")
    assert "order: 0.4 m" in said
    assert "order: 0.6 m" in said
