"""Handling of signals that end command-line programs."""

from __future__ import annotations

import signal
import threading


def end_as_ctrl_c() -> None:
    """Make SIGTERM, by which roslaunch and process managers end a program, act like Ctrl-C.

    As with ROS's nodes, Ctrl-C works even if a shell started the program in the background with SIGINT ignored.
    Has no effect outside the main thread.
    """
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, lambda _number, _frame: signal.raise_signal(signal.SIGINT))
