"""Standard input: lines, keys, a terminal that is none, and other scripts that go on meanwhile."""

import io
import os

import pytest

from rosmini.ros.scripts import ScriptSpec, run_scripts


def test_input_and_readline(run):
    ran = run(
        """
        import sys
        name = input("Name: ")
        print("hello", name)
        print(repr(sys.stdin.readline()), repr(sys.stdin.read(2)), [line for line in sys.stdin])
        try:
            input()
        except EOFError as error:
            print("EOFError", error)
        """,
        stdin="Ada\ntwo\nabcd\nlast",
    )
    assert ran.lines == [
        "[script] Name: hello Ada",
        "[script] 'two\\n' 'ab' ['cd\\n', 'last']",
        "[script] EOFError EOF when reading a line",
    ]


def test_timed_input_leaves_the_others_running(sim):
    ran = sim(
        sim.text("ask", "print('got', input('? '))"),
        sim.text("tick", "import time\nfor i in range(2):\n    time.sleep(0.004)\n    print(i)"),
        stdin=[(0.006, "yes\n")],
    )
    assert [line for line in ran.lines if line.startswith("[tick]")] == ["[tick] 0", "[tick] 1"]
    assert ran.lines.index("[tick] 0") < ran.lines.index("[ask] got yes") < ran.lines.index("[tick] 1")


KEYS = """
import sys, select, termios, tty
settings = termios.tcgetattr(sys.stdin)
def get_key(timeout):
    tty.setraw(sys.stdin.fileno())
    ready, _, _ = select.select([sys.stdin], [], [], timeout)
    key = sys.stdin.read(1) if ready else ''
    termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)
    return key
keys = []
while True:
    key = get_key(0.001)
    if key == 'q' : break
    if key: keys.append(key)
    else: keys.append('.') if not keys or keys[-1] != '.' else None
print(''.join(keys))
"""


def test_keyboard_script_with_supplied_keys(run):
    (line,) = run(KEYS, stdin=[(0, "ii"), (0.03, ","), (0.06, "q")]).lines
    # On a slow wall all keys may be there before the first time-out.
    assert line == "[script] ii.,." if run.simulated else line.replace(".", "") == "[script] ii,"


def test_select_for_time_only(sim):
    ran = sim("import select, time\nprint(select.select([], [], [], 2.5), time.monotonic())")
    assert ran.lines == ["[script] ([], [], []) 2.5"]


@pytest.mark.skipif(os.name == "nt", reason="select() on Windows takes sockets only")
def test_select_on_a_pipe(run):
    ran = run(
        """
        import os, select, threading
        r, w = os.pipe()
        print(select.select([r], [], [], 0.001)[0] == [])
        threading.Timer(0.002, os.write, (w, b"x")).start()
        while not select.select([r], [], [], 0.01)[0]: pass
        print(os.read(r, 1)); os.close(r); os.close(w)
        """
    )
    assert ran.lines == ["[script] True", "[script] b'x'"]


@pytest.mark.skipif(os.name == "nt", reason="pipes cannot be waited for on Windows")
def test_a_real_pipe_parks_only_the_reader(run):
    read, write = os.pipe()
    with os.fdopen(read, encoding="utf-8") as stream:
        ran = (
            run(
                run.text("ask", "print('got', input())\nprint(repr(input()))"),
                run.text(
                    "tell",
                    f"import os, time\ntime.sleep(0.02)\nprint('tell')\nos.write({write}, "
                    f"b'one\\n\\xc3\\xa4\\n')\nos.close({write})",
                ),
                run.text("late", "import time\ntime.sleep(0.001)\nprint('late')"),
                stdin=stream,
            )
            if not run.simulated
            else None
        )
    if ran is None:
        os.close(write)
        return
    assert ran.lines == ["[late] late", "[tell] tell", "[ask] got one", "[ask] 'ä'"]


def test_a_line_longer_than_a_read_arrives_whole(run):
    read, write = os.pipe()
    os.write(write, b"x" * 9000 + b"\nshort\n")
    os.close(write)
    with os.fdopen(read, encoding="utf-8") as stream:
        ran = run("print(len(input()), input())", stdin=stream)
    assert ran.lines == ["[script] 9000 short"]


@pytest.mark.skipif(os.name == "nt", reason="pipes cannot be waited for on Windows")
def test_a_reader_that_gets_nothing_is_ended(run):
    read, write = os.pipe()
    with os.fdopen(read, encoding="utf-8") as stream:
        if run.simulated:  # time stands still while a person types, so nothing would end it but Ctrl-C
            os.close(write)
            assert "EOFError" in run("input()", stdin=stream).text
            return
        ran = run("input()", stdin=stream, duration=0.005, grace=0.005)
        os.close(write)
    assert ran.result.reason == "time"
    assert ran.status == 0


def test_input_from_a_file(run):
    source = "import sys\nprint([line.strip() for line in sys.stdin])"
    assert run(source, stdin=io.StringIO("x\ny\n")).lines == ["[script] ['x', 'y']"]


def test_two_scripts_share_what_is_typed():
    out = io.StringIO()
    ask = "print(input())"
    run_scripts([ScriptSpec("a", source=ask), ScriptSpec("b", source=ask)], stdin="one\ntwo\n", stdout=out)
    assert out.getvalue().splitlines() == ["[a] one", "[b] two"]


TELEOP = """
import select, sys, rospy
from std_msgs.msg import Int32
rospy.init_node("teleop")
pub = rospy.Publisher("count", Int32, queue_size=1)
turns = 0
while not rospy.is_shutdown():
    if select.select([sys.stdin], [], [], 0.1)[0]:
        sys.stdin.read(1)
    turns += 1
    pub.publish(turns)
"""


@pytest.mark.parametrize("source", ["text", "file"])
def test_input_at_its_end_costs_select_its_time_out(sim, source, tmp_path):
    """As a key-driven teleoperation with ``</dev/null``: graph time goes on, ten turns a second."""
    (tmp_path / "empty").write_text("", encoding="utf-8")
    with (tmp_path / "empty").open(encoding="utf-8") as empty:
        ran = sim(sim.text("teleop", TELEOP + "print(turns)"), stdin="" if source == "text" else empty, duration=2.05)
    assert (ran.result.reason, ran.result.status) == ("time", 0)
    turns = int(ran.lines[-1].removeprefix("[teleop] "))
    assert 19 <= turns <= 22
