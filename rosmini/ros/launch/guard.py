"""Ends the nodes of a launcher that was killed; a separate program that imports nothing from rosmini.

The launcher writes ``+PID`` and ``-PID`` for each process that starts or ends. When its end of the pipe is
closed for any reason, the remaining processes get SIGINT, SIGTERM and SIGKILL in turn.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from contextlib import suppress

GRACE_S = (5.0, 2.0, 0.0)
"""Waiting time after each of the signals [s]."""


def is_there(group: int) -> bool:
    """Return True if a process of a group is still running."""
    try:
        os.killpg(group, 0)
    except (ProcessLookupError, PermissionError):
        return False
    return True


def end(groups: set[int]) -> None:
    """End process groups."""
    for number, grace in zip((signal.SIGINT, signal.SIGTERM, signal.SIGKILL), GRACE_S, strict=True):
        groups = {group for group in groups if is_there(group)}
        for group in groups:
            with suppress(ProcessLookupError):
                os.killpg(group, number)
        deadline = time.monotonic() + grace
        while time.monotonic() < deadline and any(map(is_there, groups)):
            time.sleep(0.05)


def main() -> None:
    """Read until the launcher has gone, then end the remaining processes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    groups: set[int] = set()
    for line in sys.stdin:
        number = int(line[1:])
        if line[0] == "+":
            groups.add(number)
        else:
            groups.discard(number)
    end(groups)


if __name__ == "__main__":
    main()
