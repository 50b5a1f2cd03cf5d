"""What tests start ends with them, and a Ctrl-C means the same wherever the suite was started."""

from __future__ import annotations

import ast
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from ..processes import run, start, wait_until

ROOT = Path(__file__).resolve().parents[2]
TESTS = ROOT / "tests"
NOT_TESTS = {TESTS / "ros" / "scripts", TESTS / "benchmarks"}
"""In folders below them are scripts as the public writes them, and the programs of `rosmini bench`."""

posix = pytest.mark.skipif(sys.platform == "win32", reason="sessions and signals as POSIX has them")


def test_all_children_are_started_through_one_door():
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in sorted(TESTS.rglob("*.py"))
        if NOT_TESTS.isdisjoint(path.parent.parents) and path != TESTS / "processes.py"
        if re.search(r"subprocess|os\.system", text := path.read_text(encoding="utf-8"))
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and ast.unparse(node.func) in {"subprocess.run", "subprocess.Popen", "os.system"}
    ]
    assert found == [], "start it with `run` or `start` of tests/processes.py"


FAMILY = """
import subprocess, sys
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"])
print(child.pid, flush=True)
child.wait()
"""


BACKGROUND = """
import os, signal, subprocess, sys

import pytest

CODE = "import signal; print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)"

def test():
    assert subprocess.check_output([sys.executable, "-c", CODE]) == b"True\\n"
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)
"""


def is_running(pid: int) -> bool:
    """Whether there is such a process that did not end, as /proc says."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(") ")[2][0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_a_failing_test_leaves_no_grandchild():
    command = [sys.executable, "-c", FAMILY]
    with pytest.raises(ZeroDivisionError), start(command, stdout=subprocess.PIPE) as process:
        pid = int(process.stdout.readline())
        assert is_running(pid)
        1 / 0
    wait_until(lambda: not is_running(pid), "the end of the grandchild")


@posix
def test_an_ignored_sigint_means_something_again(tmp_path):
    """As behind `nohup setsid pytest &` of a shell without job control."""
    for name in ("conftest.py", "processes.py"):
        (tmp_path / name).write_bytes((TESTS / name).read_bytes())
    (tmp_path / "test_it.py").write_text(BACKGROUND, encoding="utf-8")
    code = (
        "import signal, os, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); os.execv(sys.executable, sys.argv[1:])"
    )
    tests = ["-m", "pytest", "-q", "-n1", "-c", os.devnull, f"--rootdir={tmp_path}", tmp_path]
    done = run([sys.executable, "-c", code, sys.executable, *tests])
    assert "1 passed" in done.stdout, done.stdout + done.stderr
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


ORPHANS = """
import sys
sys.path.insert(0, {root!r})
from tests.processes import start

PARENT = '''
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"], start_new_session=True)
print(child.pid, flush=True)
time.sleep(1000)
'''
with start([sys.executable, "-c", PARENT], stdout=None) as process:
    print(process.pid, flush=True)
    process.wait()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_nothing_outlives_tests_that_are_killed():
    """Neither what they started nor what that started in a session of its own."""
    command = [sys.executable, "-c", ORPHANS.format(root=str(ROOT))]
    with start(command, stdout=subprocess.PIPE) as process:
        pids = [int(process.stdout.readline()) for _ in range(2)]
        process.kill()  # alone: as the system does that is out of memory
        process.wait()
        for pid in pids:
            wait_until(lambda pid=pid: not is_running(pid), f"the end of {pid}")
