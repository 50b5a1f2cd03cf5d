"""The command `rosmini`; SIGUSR2 makes it write what its lanes wait for, and where in the code."""

from __future__ import annotations

import gc
import signal
import sys
import traceback
from typing import Any

from greenlet import greenlet

from rosmini.core.graph.scheduler import Scheduler
from rosmini.tools.main import main


def write_lanes(*_: Any) -> None:
    """Write to standard error what waits."""
    for found in gc.get_objects():
        if issubclass(type(found), Scheduler):
            print(*found.waiting(), sep="\n", file=sys.stderr)
        elif issubclass(type(found), greenlet) and found.gr_frame is not None:
            print(found, file=sys.stderr)
            traceback.print_stack(found.gr_frame)
    sys.stderr.flush()


if __name__ == "__main__":
    signal.signal(signal.SIGUSR2, write_lanes)
    sys.exit(main())
