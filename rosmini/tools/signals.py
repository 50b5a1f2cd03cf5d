"""How the programs of the command line are ended."""

from __future__ import annotations

import signal
import threading


def end_as_ctrl_c() -> None:
    """Let SIGTERM, by which roslaunch and process managers end a program, do what Ctrl-C does.

    Ctrl-C works also where the shell that started the program in the background wants it ignored, as with ROS's nodes.
    Does nothing outside the main thread.
    """
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, lambda _number, _frame: signal.raise_signal(signal.SIGINT))
