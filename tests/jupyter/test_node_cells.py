"""``%%node`` in a real kernel: where output appears, who types, and what an interrupt and a restart leave behind."""

from pathlib import Path

TALKER = """\
import rospy
rospy.init_node("talker")
rate = rospy.Rate(1)
n = 0
while not rospy.is_shutdown():
    print("turn", n)
    n += 1
    rate.sleep()
"""

ASK = "%%node ask.py\nprint('hello', input('who? '))"


def folder_of(kernel):
    cell = kernel.ok(
        "from rosmini.notebook.session import session_of\nprint(session_of(get_ipython()).package.workspace)"
    )
    return Path(cell.stdout.strip())


def test_what_a_node_prints_appears_in_the_cell_in_which_time_passes(new_kernel):
    assert new_kernel.ok("%load_ext rosmini").stdout == ""
    assert new_kernel.ok("%roscore").stdout.startswith("ROS_MASTER_URI=")
    started = new_kernel.ok(f"%%node talker.py\n{TALKER}")
    assert started.stdout == "turn 0\n"
    waited = new_kernel.ok("import rosmini\nrosmini.wait(2)")
    assert waited.stdout == "turn 1\nturn 2\n"
    assert started.stdout == "turn 0\n"
    assert new_kernel.ok("import rospy\nrospy.init_node('here')\nrospy.sleep(1)").stdout == "turn 3\n"


def test_it_appears_in_a_terminal_cell_too(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore")
    started = shared_kernel.ok(f"%%node talker.py\n{TALKER}")
    assert shared_kernel.ok("%%terminal\nsleep 2").stdout == "$ sleep 2\nturn 1\nturn 2\n"
    assert started.stdout == "turn 0\n"


def test_an_interrupt_ends_the_cell_and_the_nodes_go_on(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    shared_kernel.ok(f"%%node talker.py\n{TALKER}")
    waiting = shared_kernel.send("rosmini.wait(10_000_000)")
    shared_kernel.until(lambda: "turn 10" in waiting.stdout, "some turns")
    shared_kernel.interrupt()
    shared_kernel.until(lambda: waiting.idle, "the end of the cell")
    assert waiting.errors == ["KeyboardInterrupt"]
    assert "site-packages" not in waiting.tracebacks[0]
    assert shared_kernel.ok("rosmini.wait(1)").stdout.startswith("turn ")
    assert shared_kernel.ok("%rosnode list").stdout == "/rosout\n/talker\n"


def test_the_start_of_a_script_that_never_comes_back_can_be_interrupted(new_kernel):
    new_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    # no loop of its own, in which others would get their turn; one line, since the interrupt comes at any moment
    endless = "print('up', flush=True); sum(1 for _ in iter(int, 1))"
    cell = new_kernel.send(f"%%node endless.py\n{endless}")
    new_kernel.until(lambda: "up" in cell.stdout, "the script")
    new_kernel.interrupt()
    new_kernel.until(lambda: "Press Ctrl-C again" in cell.stderr, "what is waited for")
    assert "endless.py, line 2" in cell.stderr
    new_kernel.interrupt()
    new_kernel.until(lambda: cell.idle, "the end of the cell")
    assert new_kernel.ok("rosmini.wait(1)\nprint('on')").stdout == "on\n"
    assert new_kernel.ok(f"%%node talker.py\n{TALKER}").stdout == "turn 0\n"


def ask(kernel, code):
    """Send a cell of a reader who can type."""
    kernel.client.allow_stdin = True
    return kernel._cell(kernel.client.execute(code, allow_stdin=True))


def test_the_reader_types_below_the_cell_in_which_time_passes(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    cell = ask(shared_kernel, ASK)
    request = shared_kernel.client.get_stdin_msg(timeout=300)
    assert request["parent_header"]["msg_id"] == cell.id
    shared_kernel.client.input("Ada")
    shared_kernel.until(lambda: cell.idle, "the end of the cell")
    assert cell.stdout == "who? hello Ada\n"
    assert cell.errors == []

    # a question that comes later belongs to the later cell
    shared_kernel.ok("%%node later.py\nimport time\ntime.sleep(1)\nprint('hello', input('who? '))")
    cell = ask(shared_kernel, "rosmini.wait(2)")
    request = shared_kernel.client.get_stdin_msg(timeout=300)
    assert request["parent_header"]["msg_id"] == cell.id
    shared_kernel.client.input("Bob")
    shared_kernel.until(lambda: cell.idle, "the end of the cell")
    assert cell.stdout == "who? hello Bob\n"


def test_an_interrupt_while_the_reader_types_ends_the_cell(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    cell = ask(shared_kernel, ASK)
    shared_kernel.client.get_stdin_msg(timeout=300)
    shared_kernel.interrupt()
    shared_kernel.until(lambda: cell.idle, "the end of the cell")
    assert cell.errors == ["KeyboardInterrupt"]
    cell = ask(shared_kernel, "rosmini.wait(1)")
    shared_kernel.client.get_stdin_msg(timeout=300)
    shared_kernel.client.input("Ada")
    shared_kernel.until(lambda: cell.idle, "the end of the cell")
    assert "hello Ada" in cell.stdout


def test_where_nobody_can_type_the_script_says_what_to_do(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore")
    assert "add --stdin TEXT" in shared_kernel.ok(ASK).stderr
    assert shared_kernel.ok(ASK.replace("ask.py", "ask.py --stdin Ada")).stdout == "who? hello Ada\n"


def test_a_restart_while_nodes_run_leaves_no_folder(new_kernel):
    new_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    new_kernel.ok(f"%%node talker.py\n{TALKER}")
    folder = folder_of(new_kernel)
    assert folder.is_dir()
    new_kernel.restart()
    assert not folder.exists()
    new_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    assert new_kernel.ok(f"%%node talker.py\n{TALKER}").stdout == "turn 0\n"


def test_a_script_that_forks_is_one_script_here(new_kernel):
    new_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    forks = "import os, time\nchild = os.fork()\nif not child:\n    time.sleep(1)\nprint(os.waitpid(child, 0)[1])"
    assert new_kernel.ok(f"%%node forks.py\n{forks}").stdout == "0\n"
    ends = "import os\nchild = os.fork()\nif child:\n    print(os.waitpid(child, 0)[1])"
    assert new_kernel.ok(f"%%node ends.py\n{ends}").stdout == "0\n"
    assert new_kernel.ok("rosmini.wait(2)\nprint('on')").stdout == "on\n"


def test_two_notebooks_have_nothing_in_common(new_kernel, shared_kernel):
    for kernel in (new_kernel, shared_kernel):
        kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    shared_kernel.ok(f"%%node talker.py\n{TALKER}")
    assert new_kernel.ok("%rosnode list").stdout == "/rosout\n"
    assert "no executable" in new_kernel.run("%rosrun notebook talker.py").tracebacks[0]
    assert folder_of(new_kernel) != folder_of(shared_kernel)


HANGS = """\
import rospy
from pathlib import Path

def hang():
    Path({begun!r}).touch()
    sum(1 for _ in iter(int, 1))  # no loop of its own, in which others would get their turn

rospy.init_node("hangs")
rospy.on_shutdown(hang)
rospy.spin()
"""


def test_a_roscore_that_is_interrupted_begins_anew_nevertheless(shared_kernel, tmp_path):
    shared_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    begun = tmp_path / "begun"
    shared_kernel.ok(f"%%node hangs.py\n{HANGS.format(begun=str(begun))}")
    cell = shared_kernel.send("%roscore")
    shared_kernel.until(begun.exists, "the hook of the old graph")
    shared_kernel.interrupt()  # no drive notes it: the hook is called by the cell itself
    shared_kernel.until(lambda: cell.idle, "the end of the cell")
    assert shared_kernel.ok("%rosnode list").stdout == "/rosout\n"
    assert shared_kernel.ok(f"%%node talker.py\n{TALKER}").stdout == "turn 0\n"


def test_a_subshell_lets_time_pass_and_starts_nothing(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore\nimport rosmini")
    shared_kernel.ok(f"%%node talker.py\n{TALKER}")
    subshell = shared_kernel.subshell()
    for code in ("%%node other.py\npass", "%roscore", "%rosrun notebook talker.py"):
        refused = shared_kernel.run(code, subshell=subshell)
        assert "not in a subshell" in refused.tracebacks[0]
    assert shared_kernel.run("rosmini.wait(1)\n%rosnode list", subshell=subshell).errors == []
    assert shared_kernel.ok("%rosnode list").stdout == "/rosout\n/talker\n"
    assert shared_kernel.ok("rosmini.wait(1)").stdout == "turn 2\n"


def test_a_script_with_asyncio_is_told_why_it_cannot_run_here(shared_kernel):
    shared_kernel.ok("%load_ext rosmini\n%roscore")
    cell = "%%node a.py\nimport asyncio\nasync def main():\n    await asyncio.sleep(0.1)\nasyncio.run(main())\n"
    ended = shared_kernel.ok(cell)
    assert "RuntimeError: asyncio.run() cannot be called from a running event loop" in ended.stderr
    assert "a notebook's kernel runs an event loop of its own in this thread" in ended.stderr
