"""`rosmini run` as a process of its own: a real terminal, Ctrl-C, SIGTERM."""

from __future__ import annotations

import os
import select
import signal
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from ....processes import PATIENCE, start

if sys.platform == "win32":
    pytest.skip("needs a POSIX terminal", allow_module_level=True)

import pty

HERE = Path(__file__).parents[1] / "rospy"


class Terminal:
    """A `rosmini run` on a pseudo-terminal."""

    def __init__(self, *words: str) -> None:
        self.master, slave = pty.openpty()
        command = [sys.executable, "-m", "rosmini", "run", *words]
        self.end_of_it = ExitStack()
        self.process = self.end_of_it.enter_context(start(command, stdin=slave, stdout=slave, stderr=slave))
        os.close(slave)
        self.text = ""

    def expect(self, wanted: str) -> None:
        deadline = time.monotonic() + PATIENCE
        while wanted not in self.text:
            assert time.monotonic() < deadline, f"{wanted!r} did not come; there was:\n{self.text}"
            if not self._read():
                break
        assert wanted in self.text

    def _read(self, seconds: float = 1) -> bool:
        if not select.select([self.master], [], [], seconds)[0]:
            return True
        try:
            data = os.read(self.master, 4096)
        except OSError:  # Linux: the other end is closed
            return False
        self.text += data.decode().replace("\r\n", "\n")
        return bool(data)

    def type(self, keys: str) -> None:
        os.write(self.master, keys.encode())

    def press(self, key: str, wanted: str) -> None:
        """Type `key` until `wanted` is there: setting the terminal to raw mode throws away what was typed before."""
        deadline = time.monotonic() + PATIENCE
        while wanted not in self.text and self.process.poll() is None and time.monotonic() < deadline:
            self.type(key)
            self._read(0.05)
        self.expect(wanted)

    def end(self, key: str = "") -> int:
        deadline = time.monotonic() + PATIENCE
        while self._read(0.05 if key else 1) and time.monotonic() < deadline:
            if key and self.process.poll() is None:
                self.type(key)
        return self.process.wait(PATIENCE)

    def close(self) -> None:
        self.end_of_it.close()
        os.close(self.master)


@pytest.fixture
def rosmini_run():
    started = []

    def start_one(*words):
        started.append(Terminal(*words))
        return started[-1]

    yield start_one
    for terminal in started:
        terminal.close()


def test_answers_typed_at_a_terminal(rosmini_run):
    terminal = rosmini_run(str(HERE / "ask.py"))
    terminal.expect("x? ")
    terminal.type("1.5\n")
    terminal.expect("y? ")
    terminal.type("2\n")
    terminal.expect("3.5 m [] /asker /goal")
    assert terminal.end() == 0


def test_keys_typed_at_a_terminal(rosmini_run):
    terminal = rosmini_run(str(HERE / "teleop.py"), "+", str(HERE / "robot.py"))
    for key, said in (("i", "[robot] 1 0"), (",", "[robot] -1 0"), ("k", "[robot] 0 0")):
        terminal.press(key, said)
    assert terminal.end("\x03") == 0  # in raw mode a key like any other


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_run_the_shutdown_hooks(rosmini_run, number):
    terminal = rosmini_run(str(HERE / "shutdown_hook.py"))
    terminal.expect("[hooked]")
    terminal.process.send_signal(number)
    terminal.expect("[hooked] stopping the robot")
    assert terminal.end() == 0
