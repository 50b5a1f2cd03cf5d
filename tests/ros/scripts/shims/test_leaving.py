"""``os`` of a script: what ends a process ends the script that calls it, and nothing else."""

import os
import signal

import pytest

from rosmini.core.graph import Graph
from rosmini.ros.scripts import Console, ScriptHandle, ScriptSpec

OTHER = "import time\nfor _ in range(3):\n    time.sleep(0.1)\nprint('other goes on')"


@pytest.mark.parametrize(
    ("call", "status"),
    [
        ("os._exit(3)", 3),
        ("os._exit(0)", 0),
        ("os.kill(os.getpid(), signal.SIGTERM)", -signal.SIGTERM),
        ("os.kill(0, 9)", -9),
        ("os.killpg(os.getpgrp(), signal.SIGTERM)", -signal.SIGTERM),
        ("os.abort()", -signal.SIGABRT),
        ("signal.raise_signal(signal.SIGTERM)", -signal.SIGTERM),
        ("signal.alarm(1); time.sleep(9)", -14),
        ("t = threading.Thread(target=lambda: os._exit(4)); t.start(); t.join()", 4),
        ("from os import _exit as away; away(5)", 5),
    ],
)
@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="Windows has fewer signals")
def test_what_ends_a_process_ends_the_script_alone(call, status):
    graph = Graph(strict=False)
    console = Console(graph.scheduler, prefix=False, capture_output=True)
    text = f"import atexit, os, signal, threading, time\natexit.register(print, 'never')\n{call}\nprint('never')"
    script = ScriptHandle(graph, ScriptSpec("script", source=text), lambda: console, owns_console=False)
    other = ScriptHandle(graph, ScriptSpec("other", source=OTHER), lambda: console, owns_console=False)
    other.start()
    script.start()
    graph.run(2)
    assert (script.poll(), other.poll()) == (status, 0)
    assert console.captured == "other goes on\n"
    assert script.ended_itself
    graph.shutdown()


def test_signals_that_have_a_handler_or_no_effect(run):
    ran = run(
        """
        import os, signal
        signal.signal(signal.SIGTERM, lambda number, frame: print("got", number))
        os.kill(os.getpid(), signal.SIGTERM)
        os.kill(os.getpid(), 0)
        try:
            os.kill(os.getpid(), signal.SIGINT)
        except KeyboardInterrupt:
            print("interrupted")
        print("after", os.path.join("a", "b"), os.fspath("c"))
        """
    )
    assert ran.lines == [
        "[script] got 15",
        "[script] interrupted",
        f"[script] after {os.path.join('a', 'b')} c",
    ]
    assert ran.status == 0


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_child_and_another_process_are_no_scripts(run):
    ran = run(
        """
        import os, signal, subprocess, sys
        child = os.fork()
        if not child:
            os._exit(6)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
        other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
        os.kill(other.pid, signal.SIGTERM)
        print(other.wait())
        """
    )
    assert ran.lines == ["[script] 6", f"[script] {-signal.SIGTERM}"]


def test_the_environment_is_the_scripts(run):
    ran = run("import os\nos.environ['OWN'] = 'mine'\nprint(os.getenv('OWN'), os.environ['OWN'])")
    assert ran.lines == ["[script] mine mine"]
    assert "OWN" not in os.environ
