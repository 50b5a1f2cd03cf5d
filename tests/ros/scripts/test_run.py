"""Runs: several scripts at once, their ends and statuses, their output and errors."""

import builtins
import io
import os
import re
import signal

import pytest

from rosmini.core.errors import ScriptError
from rosmini.core.graph import Graph
from rosmini.ros import rospy
from rosmini.ros.scripts import ScriptSpec, current_script, run_scripts, run_source

from ...conftest import nightly


def test_lines_have_the_name_before_them_and_are_in_order(run):
    ran = run(
        run.text("a", "import time\nfor i in range(2):\n    print('x', i)\n    time.sleep(0.2)\n"),
        run.text("b", "import time, sys\ntime.sleep(0.001)\nsys.stderr.write('one\\ntwo\\n')\n"),
    )
    assert ran.lines == ["[a] x 0", "[b] one", "[b] two", "[a] x 1"]
    assert ran.status == 0
    assert ran.result.reason == "ended"


def test_unfinished_lines(sim):
    ran = sim(
        sim.text("a", "import time\nprint('a', end='', flush=True)\ntime.sleep(1)\nprint('b')\nprint('end', end='')\n"),
        sim.text("b", "import time\ntime.sleep(0.5)\nprint('middle')\n"),
    )
    assert ran.lines == ["[a] a", "[b] middle", "[a] b", "[a] end"]


def test_a_flushed_line_goes_on(sim):
    assert sim("print('a', end='', flush=True)\nprint('b')\nimport sys\nsys.stdout.buffer.write(b'raw\\n')").lines == [
        "[script] ab",
        "[script] raw",
    ]


def test_arguments_and_main(run, tmp_path):
    spec = run.file(
        tmp_path,
        "node.py",
        """
        #!/usr/bin/env python
        \"\"\"Doc.\"\"\"
        import argparse, sys, __main__, os
        parser = argparse.ArgumentParser()
        parser.add_argument("--rate", type=int)
        parser.add_argument("rest", nargs="*")
        args = parser.parse_args()
        print(args.rate, args.rest, os.path.basename(sys.argv[0]), sys.argv[1:])
        print(__name__, __main__.args is args, os.path.basename(__file__), sys.modules[__name__] is __main__)
        """,
        "--rate",
        "3",
        "chatter:=/news",
        "__name:=n",
    )
    assert run(spec).lines == [
        "[node] 3 ['chatter:=/news', '__name:=n'] node.py ['--rate', '3', 'chatter:=/news', '__name:=n']",
        "[node] __main__ True node.py True",
    ]


@pytest.mark.parametrize(
    ("end", "status", "said"),
    [
        ("sys.exit()", 0, ""), ("sys.exit(0)", 0, ""), ("sys.exit(3)", 3, ""), ("exit(4)", 4, ""),
        ("sys.exit('no robot')", 1, "no robot"), ("raise SystemExit(5)", 5, ""), ("1 / 0", 1, "ZeroDivisionError"),
    ],
)  # fmt: skip
def test_exit_status(run, end, status, said):
    ran = run(run.text("bad", f"import sys\n{end}\nprint('not here')"), run.text("good", "print('fine')"))
    assert ran.result.statuses == (status, 0)
    assert ran.status == status
    assert said in ran.text
    assert "[good] fine" in ran.text
    assert "not here" not in ran.text


@pytest.mark.parametrize(("end", "status"), [("exit()", 0), ("exit(2)", 2), ("quit(3)", 3)])
def test_exit_and_quit_are_there_while_ipython_hides_them(run, monkeypatch, end, status):
    for name in ("exit", "quit"):
        monkeypatch.delattr(builtins, name, raising=False)
    assert run(f"print('before')\n{end}\nprint('after')").status == status


def test_argparse_error_ends_the_script_only(run):
    ran = run("import argparse\nargparse.ArgumentParser().parse_args()", args=("--nope",))
    assert ran.status == 2
    assert "unrecognized arguments: --nope" in ran.text


def test_traceback_has_the_users_frames_only(run, tmp_path):
    run.file(
        tmp_path, "helper.py", "def work(n):\n    while True:\n        n += 1\n        raise KeyError(n)  # here\n"
    )
    spec = run.file(tmp_path, "node.py", "import helper\n\ndef main():\n    helper.work(1)\n\nmain()\n")
    ran = run(spec, prefix=False)
    shown = [re.sub(r'".*[/\\]', '"', line) for line in ran.lines if line.strip(" ^~")]
    assert shown == [
        "Traceback (most recent call last):",
        '  File "node.py", line 6, in <module>',
        "    main()",
        '  File "node.py", line 4, in main',
        "    helper.work(1)",
        '  File "helper.py", line 4, in work',
        "    raise KeyError(n)  # here",
        "KeyError: 2",
    ]
    assert ran.status == 1


def test_a_cause_is_shown(sim):
    text = sim("try:\n    1 / 0\nexcept ZeroDivisionError as e:\n    raise ValueError('x') from e\n").text
    assert "direct cause" in text
    assert "rosmini" not in text


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("raw_input('?')", "in Python 3 it is input"),
        ("for i in xrange(3): pass", "in Python 3 it is range"),
        ("import Queue", "in Python 3 it is queue"),
    ],
)
def test_python_2_names_at_run_time(sim, source, said):
    assert said in sim(source).text


def test_excepthook_of_the_script(run):
    ran = run("import sys\nsys.excepthook = lambda t, e, tb: print('mine', t.__name__)\n1 / 0")
    assert ran.lines == ["[script] mine ZeroDivisionError"]
    assert ran.status == 1


def test_polling_loops_go_on_and_end(run):
    ran = run(
        run.text(
            "a",
            "got = []\nimport threading\nthreading.Timer(0.01, lambda: got.append(1)).start()\nwhile not got:\n    "
            "pass\nprint('got')",
        ),
        run.text("b", "import time\nt = time.time()\nwhile time.time() - t < 0.005: pass\nprint('over')"),
    )
    assert sorted(ran.lines) == ["[a] got", "[b] over"]


POLLING = {
    "publish and print": "while True:\n    pub.publish(Twist())\n    print(len(turns))\n    turns.append(1)",
    "publish": "while not rospy.is_shutdown():\n    pub.publish(Twist())\n    turns.append(1)",
    "connections": "while other.get_num_connections() < 1:\n    pass",
    "lookup": "while True:\n    turns.append(1)\n    try:\n        listener.lookupTransform('a', 'b', rospy.Time(0))\n"
    "    except tf.LookupException:\n        continue",
    "parameter": "while rospy.get_param('/go', 0) == 0:\n    turns.append(1)",
    "attribute": "while not got:\n    pass",
    "attribute and break": "while True:\n    if got:\n        break",
    "log": "while True:\n    rospy.loginfo('still here')\n    turns.append(1)",
}
"""Loops that never sleep, each from its line 10 on; ``turns`` counts."""

BEFORE = """import atexit, rospy, tf
from geometry_msgs.msg import Twist
rospy.init_node("poller")
turns, got = [], []
rospy.Subscriber("never", Twist, got.append)
pub = rospy.Publisher("cmd_vel", Twist, queue_size=10)
other = rospy.Publisher("nobody", Twist, queue_size=10)
listener = tf.TransformListener()
atexit.register(lambda: print("turns", len(turns)))
"""


EACH_COMMIT = ("publish", "lookup", "attribute")
"""A call that acts, one that raises, and no call at all."""


@pytest.mark.parametrize("kind", [*EACH_COMMIT, *nightly(*(kind for kind in POLLING if kind not in EACH_COMMIT))])
def test_a_loop_that_never_sleeps_uses_graph_time_and_is_warned_of_once(sim, kind):
    ran = sim(sim.text("poller", BEFORE + POLLING[kind]), duration=4.0, grace=0.0)
    warnings = [line for line in ran.lines if "rate.sleep()" in line]
    assert len(warnings) == 1
    assert re.search(r"poller>?, line 1\d", warnings[0])
    turns = [int(line.split()[-1]) for line in ran.lines if line.startswith("[poller] turns ")]
    assert max(turns, default=0) < 4 * 25_000


def test_a_loop_that_sleeps_or_computes_is_not_warned_of(sim):
    ran = sim(
        sim.text("sleeps", BEFORE + "for i in range(2000):\n    pub.publish(Twist())\n    rospy.sleep(0.002)"),
        sim.text("computes", "total = 0\nfor i in range(300_000):\n    total += i\nprint(total)"),
    )
    assert "rate.sleep()" not in ran.text
    assert "[computes] 44999850000" in ran.lines


def test_a_hundred_turns_cost_no_time(sim):
    loop = "start = rospy.get_time()\nfor i in range({}):\n    pub.publish(Twist())\nprint(rospy.get_time() - start)"
    short, long = (sim(sim.text("poller", BEFORE + loop.format(count))) for count in (100, 1000))
    assert "[poller] 0.0" in short.lines
    spent = [float(line.split()[1]) for line in long.lines if re.fullmatch(r"\[poller\] [\d.]+", line)]
    assert 0.03 < spent[0] < 0.1


def test_duration_ends_what_never_ends(run):
    ran = run(
        run.text("poll", "import atexit\natexit.register(print, 'bye')\nwhile True: pass"),
        run.text("sleep", "import time, atexit\natexit.register(print, 'bye')\nwhile True:\n    time.sleep(0.005)"),
        run.text("stubborn", "import time\nwhile True:\n    try:\n        time.sleep(1)\n    except:\n        pass"),
        run.text("thread", "import threading\nthreading.Thread(target=threading.Event().wait).start()"),
        duration=0.02,
        grace=0.01 if run.simulated else 0.5,
    )
    assert ran.result.reason == "time"
    assert ran.status == 0
    assert sorted(ran.lines) == ["[poll] bye", "[sleep] bye"]


def test_nothing_left_to_happen(sim):
    ran = sim("import threading\nthreading.Event().wait()")
    assert ran.result.reason == "drained"
    (waiting,) = map(str, ran.result.report.waiting)
    assert waiting.startswith("script ") and "event" in waiting


def test_the_same_on_each_run(sim):
    source = """
    import random, threading, time, numpy as np
    def work(name):
        for _ in range(3):
            time.sleep(random.random())
            drawn = random.random(), np.random.rand(), np.random.default_rng().integers(1000)
            print(name, round(time.time(), 6), *drawn)
    for name in "abc":
        threading.Thread(target=work, args=(name,)).start()
    print(random.Random().random(), {threading.current_thread().name, threading.get_ident()} and 1)
    """
    first = sim(source, source).text
    assert first == sim(source, source).text
    assert first != sim(source, source, seed=1).text
    head = [line for line in first.splitlines() if "0." in line][:2]
    assert head[0] != head[1]


def test_a_missing_script_stops_before_anything_runs(sim, tmp_path):
    with pytest.raises(ScriptError, match="is not there"):
        sim(sim.text("a", "raise SystemExit(9)"), ScriptSpec(str(tmp_path / "b.py")))
    with pytest.raises(ScriptError, match="no script was given"):
        run_scripts([])


def test_a_graph_can_be_given(sim):
    graph = Graph(rosout=False)
    before = graph.scheduler.now_ns()
    out = io.StringIO()
    assert run_source("import time\ntime.sleep(2)", graph=graph, stdout=out, stdin="").status == 0
    assert graph.scheduler.now_ns() - before == 2_000_000_000
    assert current_script(graph.scheduler) is None
    graph.shutdown()


def test_interrupt(run):
    """Ctrl-C: KeyboardInterrupt where there is no handler, the handler where there is one."""
    keep = "import time\nwhile True:\n    time.sleep(%s)\n" % ("0.001" if not run.simulated else "1e-6")
    ran = run(
        run.text("caught", "try:\n    while True: pass\nexcept KeyboardInterrupt:\n    print('stopped')"),
        run.text(
            "handler",
            "import signal, sys\ndef stop(n, f):\n    print('handler', n)\n    "
            "sys.exit(7)\nsignal.signal(signal.SIGINT, stop)\n" + keep,
        ),
        run.text("plain", keep),
        run.text(
            "queue", "import queue\ntry:\n    queue.Queue().get()\nexcept KeyboardInterrupt:\n    print('no more')"
        ),
        run.text("ctrl_c", "import host_signal, time\ntime.sleep(0.01)\nhost_signal.raise_signal(host_signal.SIGINT)"),
        modules={"host_signal": signal},
    )
    assert ran.result.reason == "interrupted"
    assert sorted(ran.lines) == ["[caught] stopped", "[handler] handler 2", "[queue] no more"]
    assert ran.result.statuses == (0, 7, 130, 0, 0)


IN_A_CALLBACK = """
import host_signal, rospy
rospy.init_node("node")
def tick(event):
    for _ in range(2):
        host_signal.raise_signal(host_signal.SIGINT)
    print("not reached")
rospy.Timer(rospy.Duration(1), tick)
rospy.spin()
"""
A_HANDLER_THAT_STAYS = """
import host_signal, signal, time
signal.signal(signal.SIGINT, lambda number, frame: time.sleep(1e3))
host_signal.raise_signal(host_signal.SIGINT)
time.sleep(1e3)
"""
A_SCRIPT_THAT_GOES_ON = """
import host_signal, time
host_signal.raise_signal(host_signal.SIGINT)
for _ in range(9):
    try:
        time.sleep(1e3)
    except KeyboardInterrupt:
        pass
"""


@pytest.mark.parametrize("source", [IN_A_CALLBACK, A_HANDLER_THAT_STAYS, A_SCRIPT_THAT_GOES_ON])
def test_a_script_that_has_to_be_ended_by_force_fails(sim, source):
    ran = sim(source, modules={**rospy.modules(), "host_signal": signal})
    assert (ran.result.reason, ran.lines) == ("interrupted", [])
    assert ran.result.statuses == (130,)
    assert ran.result.status == 130


def test_the_working_folder_comes_back(sim, tmp_path):
    before = os.getcwd()
    sim("import os, sys\nos.chdir(sys.argv[1])", args=(str(tmp_path),))
    assert os.getcwd() == before
