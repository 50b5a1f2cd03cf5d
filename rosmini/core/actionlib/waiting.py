"""Timeouts on a node's clock, as in rospy's actions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.core.errors import ROSInterruptException
from rosmini.core.time import Duration

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node, Waiter

__all__ = ["Timeout", "seconds_of", "wait_on"]

Timeout = float | Duration | None
"""Seconds; None and zero (rospy's default) mean no limit."""

AFTER_NS = 10_000_000
"""Duration of a wait on a node that has been shut down [ns]."""


def seconds_of(timeout: Timeout) -> float | None:
    """Return a timeout in seconds, or None for no limit."""
    seconds = timeout.to_sec() if isinstance(timeout, Duration) else timeout
    return seconds or None


def wait_on(node: Node, waiter: Waiter, timeout: Timeout, holds: Callable[[], bool]) -> bool:
    """Block until ``waiter`` is woken, for at most ``timeout`` of the node's time; return ``holds()``.

    If the node shuts down meanwhile, the wait ends, as in rospy, and returns ``holds()``. A wait that begins after
    the shutdown lasts ``AFTER_NS``: a loop around it (``while not client.wait_for_server(timeout)``) does not see the
    shutdown of its node, and the thread that ends the loop needs a turn.
    """
    is_over = node.is_shutdown()
    seconds = seconds_of(timeout)
    cancel = None
    if seconds is not None:
        when = node.clock.now_ns() + max(int(seconds * 1e9), 0)
        cancel = node.scheduler.on_hub(lambda: node.clock.call_at(when, waiter.wake))
    try:
        if not holds():
            node.wait(waiter)
    except ROSInterruptException:
        if is_over:
            node.scheduler.waiter(f"the end of {node.name}").wait(AFTER_NS)
        return holds()
    finally:
        if cancel is not None:
            cancel()
    return holds()
