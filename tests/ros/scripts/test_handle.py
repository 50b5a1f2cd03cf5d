"""Handles: scripts and nodes that go on with the graph, how they end, and that nothing of them is left."""

import io
import os
import signal

import pytest

from rosmini import Graph, default_graph, rosrun
from rosmini.core.errors import GraphEnded, ScriptError
from rosmini.core.packages import Executable
from rosmini.msgs.std_msgs.msg import Int32
from rosmini.ros.scripts import Console, NodeHandle, NodeSpec, ScriptHandle, ScriptSpec, StillRunning
from rosmini.ros.scripts.handle import shell_status

from ...processes import PATIENCE, run
from .conftest import nothing_left


class Runs:
    """Starts texts as scripts, and classes as nodes, in a graph that is not the default one."""

    def __init__(self, graph):
        self.graph = graph
        self.out = io.StringIO()

    def console(self):
        return Console(self.graph.scheduler, stdin="", stdout=self.out, stderr=self.out)

    def script(self, source, *args, name="script"):
        handle = ScriptHandle(self.graph, ScriptSpec(name, args, source), self.console)
        handle.start()
        return handle

    def node(self, entry, *args, name="built_in", environ=()):
        class Loaded(Executable):
            def load(self):
                return entry

        handle = NodeHandle(self.graph, NodeSpec(Loaded("here", name), args, environ), self.console)
        handle.start()
        return handle

    @property
    def said(self):
        return self.out.getvalue().splitlines()

    def run(self, seconds):
        self.graph.run(seconds)


@pytest.fixture
def runs(simulated):
    default = default_graph()
    with nothing_left(), Graph(simulated=simulated, strict=False, rate=1.0 if simulated else 20.0) as graph:
        yield Runs(graph)
        assert registrations(graph) == set()
    assert default_graph() is default
    assert default.nodes.keys() <= {"/rosout"}


@pytest.fixture
def simulated_runs():
    with nothing_left(), Graph(strict=False) as graph:
        yield Runs(graph)
        assert registrations(graph) == set()


def registrations(graph):
    """The nodes that the Master knows, beside rosout."""
    state = graph.master.getSystemState("/me")[2]
    return {name for part in state for _, names in part for name in names} - {"/rosout"}


NODE = "import rospy\nrospy.init_node('worker')\nrospy.on_shutdown(lambda: print('bye'))\n"


@pytest.mark.parametrize(
    ("source", "returncode", "said"),
    [
        ("1 / 0", 1, ["[script] ZeroDivisionError: division by zero"]),
        (NODE + "rospy.signal_shutdown('enough')\nrospy.spin()", 0, ["[worker] bye"]),
        (NODE + "rospy.sleep(0.1)", 0, ["[worker] bye"]),
    ],
)
def test_a_script_goes_on_with_the_graph_and_has_an_exit_status(runs, source, returncode, said):
    handle = runs.script(source)
    assert (handle.poll(), runs.said) == (None, [])
    assert handle.wait() == returncode
    assert (handle.poll(), handle.returncode) == (returncode, returncode)
    assert runs.said[-1:] == said
    assert handle.wait(timeout=0) == returncode


def test_waiting_has_a_timeout_in_graph_time(simulated_runs):
    graph = simulated_runs.graph
    handle = simulated_runs.script("import time\ntime.sleep(5)")
    began = graph.now()
    with pytest.raises(StillRunning, match=r"script has not ended within 2 s"):
        handle.wait(timeout=2)
    assert (graph.now() - began).to_sec() == pytest.approx(2.0)
    assert issubclass(StillRunning, TimeoutError)
    assert handle.wait() == 0
    assert (graph.now() - began).to_sec() == pytest.approx(5.0)


def test_waiting_for_what_nothing_can_end(simulated_runs):
    handle = simulated_runs.script("import threading\nthreading.Event().wait()")
    with pytest.raises(GraphEnded, match="an event to be set"):
        handle.wait()
    handle.kill()
    assert handle.wait() == -9


LOOPS = {
    "polling": "while True: pass",
    "sleeping": "import time\nwhile True: time.sleep(0.001)",
    "deaf": "import time\nwhile True:\n    try:\n        time.sleep(1)\n    except BaseException:\n        pass",
    "in a callback": NODE + "def loop(e):\n    while True: pass\nrospy.Timer(rospy.Duration(0.01), loop)\nrospy.spin()",
    "after the shutdown": NODE + "while True:\n    pass",
    "in the hook": NODE + "def stay():\n    while True: pass\nrospy.on_shutdown(stay)\nrospy.spin()",
    "in a thread": "import threading\ndef loop():\n    while True: pass\nthreading.Thread(target=loop).start()",
    "at its exit": "import atexit\ndef loop():\n    while True: pass\natexit.register(loop)",
}


@pytest.mark.parametrize("source", LOOPS.values(), ids=LOOPS)
def test_kill_ends_a_script_that_never_ends(runs, source):
    handle = runs.script(source)
    runs.run(0.05)
    assert handle.poll() is None
    handle.kill()
    assert handle.wait(timeout=PATIENCE) == -9
    assert runs.said == []


def test_rosnode_kill_ends_a_loop_as_in_rospy(runs, simulated):
    """Whose sleep raises in simulated time only."""
    loop = "rate = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n    rate.sleep()"
    handle = runs.script(NODE + loop)
    runs.run(0.5)
    runs.graph.nodes["/worker"].shutdown_requested("/rosnode", "user request")
    assert handle.wait(timeout=5) == (1 if simulated else 0)
    assert [line.partition(":")[0] for line in runs.said if "shutdown request" not in line][:1] == ["[worker] bye"]
    assert any("ROSInterruptException" in line for line in runs.said) == simulated


@pytest.mark.parametrize("name", ["deaf", "after the shutdown", "in the hook"])
def test_terminate_gets_harder(simulated_runs, name):
    graph = simulated_runs.graph
    handle = simulated_runs.script(LOOPS[name])
    graph.run(1.0)
    began = graph.now()
    handle.terminate(sigint_timeout=3.0, sigterm_timeout=1.0)
    handle.terminate()
    assert handle.wait() == (-15 if name == "deaf" else -9)
    passed = (graph.now() - began).to_sec()
    assert passed == pytest.approx(3.0 if name == "deaf" else 4.0, abs=0.01)


@pytest.mark.parametrize(
    ("source", "returncode", "said"),
    [
        ("try:\n    while True: pass\nexcept KeyboardInterrupt:\n    print('stopped')", 0, ["[script] stopped"]),
        ("import time, atexit\natexit.register(print, 'over')\ntime.sleep(99)", -2, ["[script] over"]),
        (NODE + "rospy.spin()\nprint(rospy.is_shutdown())", 0, ["[worker] bye", "[worker] True"]),
        (NODE + "rospy.sleep(99)", 0, ["[worker] bye"]),
        ("import signal, time, sys\nsignal.signal(2, lambda n, f: sys.exit(n + 5))\ntime.sleep(99)", 7, []),
    ],
)
def test_terminate_is_an_interrupt_first(runs, source, returncode, said):
    handle = runs.script(source)
    runs.run(0.5)
    handle.terminate()
    assert handle.poll() is None
    assert handle.wait(timeout=PATIENCE) == returncode
    assert runs.said == said
    handle.terminate()
    handle.kill()
    assert handle.returncode == returncode


@pytest.mark.parametrize(
    ("source", "signum", "returncode", "said"),
    [
        ("import time\ntry:\n    time.sleep(9)\nfinally:\n    print('not seen')", 15, -15, []),
        (
            "import signal, time\nsignal.signal(15, lambda n, f: print('got', n))\ntime.sleep(1)",
            15,
            0,
            ["[script] got 15"],
        ),
        ("import signal, time\nsignal.signal(15, signal.SIG_IGN)\ntime.sleep(1)", 15, 0, []),
        (NODE + "rospy.spin()", 15, 0, ["[worker] bye"]),
        ("import time\ntime.sleep(1)", getattr(signal, "SIGHUP", 15), -getattr(signal, "SIGHUP", 15), []),
        ("import time\ntime.sleep(1)", getattr(signal, "SIGCHLD", None), 0, []),
    ],
)
def test_signals(simulated_runs, source, signum, returncode, said):
    if signum is None:
        pytest.skip("this system has no such signal")
    handle = simulated_runs.script(source)
    simulated_runs.run(0.1)
    handle.send_signal(signum)
    assert handle.wait() == returncode
    assert [line for line in simulated_runs.said if "not seen" not in line] == said
    assert shell_status(returncode) == (returncode if returncode >= 0 else 128 + signum)


def test_respawn_starts_anew_with_the_same_arguments(simulated_runs, tmp_path):
    graph = simulated_runs.graph
    path = tmp_path / "worker.py"
    path.write_text(
        "import sys, rospy\nrospy.init_node('w')\nprint(sys.argv[1:], len(vars()) > 0)\nn = 1\nsys.exit(4)\n",
        encoding="utf-8",
    )
    handle = ScriptHandle(graph, ScriptSpec(str(path), ("a", "_x:=1")), simulated_runs.console)
    with pytest.raises(ScriptError, match="was not started"):
        handle.wait()
    handle.start()
    with pytest.raises(ScriptError, match="runs already"):
        handle.start()
    with pytest.raises(ScriptError, match="runs already"):
        handle.respawn()
    assert handle.wait() == 4
    began = graph.now()
    handle.respawn(delay=2.5)
    assert handle.poll() is None
    graph.run(2.4)
    assert len(simulated_runs.said) == 1
    assert handle.wait() == 4
    assert (graph.now() - began).to_sec() == pytest.approx(2.5, abs=0.01)
    assert simulated_runs.said == ["[w] ['a', '_x:=1'] True"] * 2
    path.write_text("raise SystemExit(6)", encoding="utf-8")
    handle.respawn()
    assert handle.wait() == 6
    path.unlink()
    handle.respawn()
    assert handle.wait() == 1
    assert "worker.py is not there" in simulated_runs.said[-1]


def test_a_respawn_can_be_called_off(simulated_runs):
    handle = simulated_runs.script("print('once')")
    handle.wait()
    handle.respawn(delay=1.0)
    handle.terminate()
    assert handle.wait() == -9
    simulated_runs.run(2.0)
    assert simulated_runs.said == ["[script] once"]


class Counter:
    """A built-in node that counts, and ends with a status of its own."""

    exit_status = 0

    def __init__(self, node, limit="1000"):
        self.node, self.value, self.limit = node, 0, int(limit)
        self.publisher = node.publisher("count", Int32, queue_size=9)
        node.timer(0.1, self.tick)

    def tick(self, _event):
        self.value += 1
        self.publisher.publish(self.value)
        if self.value == self.limit:
            self.exit_status = 5
            self.node.spawn("end", lambda: self.node.shutdown("counted"))


def test_a_node_ends_with_the_status_of_its_object_and_starts_anew(simulated_runs):
    handle = simulated_runs.node(Counter, "3", "__name:=sheep")
    before = handle.instance()
    assert handle.node.name == "/sheep"
    assert handle.wait() == 5
    handle.respawn(delay=1.0)
    simulated_runs.run(1.15)
    assert (handle.poll(), handle.instance().value) == (None, 1)
    assert handle.instance() is not before
    handle.kill()
    assert handle.wait() == -9


def test_a_node_that_waits_for_ever_is_ended(simulated_runs):
    def patient(node):
        node.wait_for_message("never", Int32)

    for end in ("terminate", "kill"):
        handle = simulated_runs.node(patient)
        simulated_runs.run(1.0)
        getattr(handle, end)()
        assert handle.wait() == (0 if end == "terminate" else -9)
    assert simulated_runs.said == []


def test_kill_waits_for_no_shutdown_hook(simulated_runs):
    def stubborn(node):
        node.on_shutdown(lambda: node.graph.scheduler.waiter("ever").wait())

    handle = simulated_runs.node(stubborn)
    handle.instance()
    handle.terminate(sigint_timeout=2.0, sigterm_timeout=1.0)
    began = simulated_runs.graph.now()
    assert handle.wait() == -9
    assert (simulated_runs.graph.now() - began).to_sec() == pytest.approx(3.0)


def test_what_a_node_raises_is_printed_unless_somebody_asks_for_its_object(simulated_runs):
    def broken(_node):
        raise ValueError("no such thing")

    handle = simulated_runs.node(broken)
    assert handle.wait() == 1
    assert simulated_runs.said[-1] == "[built_in] ValueError: no such thing"
    with pytest.raises(ValueError, match="no such thing"):
        handle.instance()
    count = len(simulated_runs.said)
    with pytest.raises(ValueError, match="no such thing"):
        simulated_runs.node(broken).instance()
    assert len(simulated_runs.said) == count


def test_a_node_that_waits_for_ever_is_not_waited_for_so_long(simulated_runs):
    """`rosrun costmap_2d costmap_2d_node` with a frame that never comes once held up whoever asked for its object."""
    came = []

    def patient(node):
        while not came:
            node.sleep(1.0)
        return "set up"

    handle = simulated_runs.node(patient)
    with pytest.raises(ScriptError, match=r"still being set up after 60 s"):
        handle.instance()
    assert handle.poll() is None
    came.append("the frame")
    assert handle.instance() == "set up"
    handle.kill()


def test_a_script_waits_for_what_it_started(simulated_runs, tmp_path, monkeypatch):
    package = tmp_path / "talk"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>talk</name><version>1.0.0</version><description>d</description>"
        "<maintainer email='a@b.cd'>a</maintainer><license>Apache-2.0</license></package>",
        encoding="utf-8",
    )
    child = package / "scripts" / "child.py"
    child.write_text("import time\nprint('child')\ntime.sleep(2)\nraise SystemExit(8)\n", encoding="utf-8")
    child.chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    parent = simulated_runs.script(
        "import rosmini\nchild = rosmini.rosrun('talk', 'child.py', stdin='', capture_output=True)\n"
        "try:\n    child.wait(1)\nexcept TimeoutError as error:\n    print(error)\n"
        "print(child.wait(), child.output)\n"
    )
    assert parent.wait() == 0
    late, ended, _ = simulated_runs.said
    assert late.startswith("[script] child ") and " 1 s" in late and ended == "[script] 8 [child] child"
    again = rosrun("talk", "child.py", graph=simulated_runs.graph, stdin="", capture_output=True, prefix=False)
    with pytest.raises(ScriptError, match="no such object"):
        again.instance()
    assert (again.wait(), again.output) == (8, "child\n")


def test_a_built_in_node_has_an_environment_of_its_own(runs):
    """At its start, and in its callbacks; the host's is as it was."""
    seen = []

    def entry(node):
        seen.append(os.environ.get("LEVEL"))
        node.timer(0.1, lambda _: seen.append(os.environ.get("LEVEL")), oneshot=True)

    handle = runs.node(entry, name="seeing", environ=(("LEVEL", "3"),))
    runs.run(0.5)
    assert seen == ["3", "3"]
    assert "LEVEL" not in os.environ
    handle.terminate()
    runs.run(0.5)
    assert run(["printenv", "LEVEL"], text=True).stdout == ""
