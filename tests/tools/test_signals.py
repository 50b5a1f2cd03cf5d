"""SIGTERM does what Ctrl-C does, also where a shell wants Ctrl-C ignored."""

from __future__ import annotations

import signal
import sys
import threading

import pytest

from rosmini.tools.signals import end_as_ctrl_c

from ..processes import PATIENCE, start

PROGRAM = """
import time
from rosmini.tools.signals import end_as_ctrl_c
end_as_ctrl_c()
try:
    print("ready", flush=True)
    while True:
        time.sleep(1)
except KeyboardInterrupt:
    print("interrupted")
"""


@pytest.mark.processes
@pytest.mark.parametrize("sign", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
def test_both_interrupt_a_program_that_was_to_ignore_ctrl_c(sign: signal.Signals) -> None:
    words = ["sh", "-c", 'trap "" INT; exec "$@"', "sh", sys.executable, "-c", PROGRAM]
    with start(words, stdout=-1) as process:
        assert process.stdout.readline() == "ready\n"
        process.send_signal(sign)
        assert process.wait(PATIENCE) == 0
        assert process.stdout.read() == "interrupted\n"


def test_another_thread_leaves_signals_alone() -> None:
    before = signal.getsignal(signal.SIGTERM)
    thread = threading.Thread(target=end_as_ctrl_c)
    thread.start()
    thread.join()
    assert signal.getsignal(signal.SIGTERM) is before
