"""Child processes of the tests: each leads a session of its own, and the whole session is gone when the test is.

All of them are gone when the tests' own process is, even one that was killed.
"""

from __future__ import annotations

import atexit
import os
import secrets
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from functools import cache
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

PATIENCE = 300.0
"""How many seconds a test waits for what must come on the slowest machine; usually it comes at once."""

MARK = "ROSMINI_TEST_PROCESS"
"""The environment variable that tells which process of the tests started a program, or what started it."""

GUARD = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_IGN)
sys.stdin.read()
for pid in filter(str.isdigit, os.listdir("/proc")):
    try:
        with open(f"/proc/{pid}/environ", "rb") as file:
            if sys.argv[1].encode() in file.read().split(b"\\0"):
                os.kill(int(pid), signal.SIGKILL)
    except OSError:
        pass
"""
"""What waits for the end of the tests, however they end, and kills what carries their mark (as Linux tells it)."""


@cache
def mark() -> str:
    """Return the mark of this process; on Linux nothing that carries it outlives this process, however it ends."""
    found = f"{os.getpid()}-{time.monotonic_ns()}"
    if sys.platform == "linux":
        words = [sys.executable, "-ISc", GUARD, f"{MARK}={found}"]
        guard = subprocess.Popen(words, stdin=subprocess.PIPE, env={}, start_new_session=True)
        atexit.register(guard.communicate)
    return found


@contextmanager
def start(words: Sequence[object], *, env: Mapping[str, str] | None = None, **options: Any) -> Iterator[Any]:
    """Start a program and yield its `Popen`; in the end it is killed, with all that it started.

    Its streams are text in UTF-8; what it writes is thrown away unless `stdout` and `stderr` say otherwise.
    """
    environment = dict(os.environ if env is None else env)
    environment.setdefault("PYTHONIOENCODING", "utf-8")
    environment.setdefault("BROWSER", "true")  # a node with a window opens none on a developer's screen
    environment[MARK] = mark()
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "encoding": "utf-8"}
    process = subprocess.Popen(
        [str(word) for word in words], env=environment, start_new_session=True, **(quiet | options)
    )
    try:
        yield process
    finally:
        kill(process)
        process.wait()
        for stream in (process.stdin, process.stdout, process.stderr):
            if stream is not None:
                with suppress(BrokenPipeError):  # it ended before it had read all
                    stream.close()


def kill(process: Any) -> None:
    """End a program that `start` started, and all that it started in its session."""
    if sys.platform == "win32":
        process.kill()
    else:
        with suppress(ProcessLookupError, PermissionError):  # all of them have ended
            os.killpg(process.pid, signal.SIGKILL)


def run(
    words: Sequence[object], *, stdin: Any = None, check: bool = False, **options: Any
) -> subprocess.CompletedProcess[Any]:
    """Run a program to its end and return what it wrote; `stdin` is the text it reads."""
    pipes = dict.fromkeys(("stdout", "stderr"), subprocess.PIPE)
    pipes["stdin"] = subprocess.DEVNULL if stdin is None else subprocess.PIPE
    with start(words, **(pipes | options)) as process:
        try:
            out, err = process.communicate(stdin, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            kill(process)
            out, err = process.communicate()
            pytest.fail(f"{words} did not end. It wrote:\n{out}\n{err}")
    assert not check or process.returncode == 0, f"{words} ended with {process.returncode}:\n{out}\n{err}"
    return subprocess.CompletedProcess(words, process.returncode, out, err)


def wait_until(condition: Callable[[], object], what: str, process: Any = None, *, patience: float = PATIENCE) -> None:
    """Wait until a condition holds. Fails if it takes too long, or once the process that should bring it has ended."""
    deadline = time.monotonic() + patience
    while not condition():
        assert process is None or process.poll() is None, f"no {what}: its process ended, {process.returncode}"
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.02)


def free_port() -> int:
    """A port of this machine at which nothing listens at this moment, and that the system gives to no connection."""
    while True:
        port = 12_000 + secrets.randbelow(20_000)  # systems take those from 32,768 or 49,152 on
        with socket.socket() as probe, suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def listens(port: int, address: str = "127.0.0.1") -> bool:
    """Whether something answers at a port of this machine."""
    with socket.socket() as probe:
        return probe.connect_ex((address, port)) == 0
