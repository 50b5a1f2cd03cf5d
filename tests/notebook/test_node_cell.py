"""``%%node``: a cell is a script, and runs as a node."""

import os

import pytest

TALKER = """\
import rospy
from std_msgs.msg import String

rospy.init_node("talker")
pub = rospy.Publisher("chatter", String, queue_size=10, latch=True)
rate = rospy.Rate(1)
while not rospy.is_shutdown():
    pub.publish("hello")
    print("said hello at", rospy.get_time())
    rate.sleep()
"""

LISTENER = """\
import rospy
from std_msgs.msg import String

def hear(message):
    print("heard", message.data)

rospy.init_node("listener")
rospy.Subscriber("chatter", String, hear)
rospy.spin()
"""


def test_a_cell_runs_to_where_it_blocks_and_no_time_passes(notebook):
    before = notebook.session.graph.now()
    assert notebook.ok(f"%%node talker.py\n{TALKER}") == "said hello at 1000.0\n"
    assert notebook.session.graph.now() == before
    assert notebook.ok("import rosmini; rosmini.wait(2)") == "said hello at 1001.0\nsaid hello at 1002.0\n"


def test_names_stand_before_the_lines_when_several_run(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    assert notebook.ok(f"%%node listener.py\n{LISTENER}") == "[listener] heard hello\n"
    assert notebook.ok("import rosmini; rosmini.wait(1)") == "[talker] said hello at 1001.0\n[listener] heard hello\n"


def test_the_file_is_a_script_of_the_notebooks_package(notebook):
    notebook.ok("word = 'two words'")
    written = notebook.ok("%%node where.py one $word _rate:=5\nimport sys, rospkg\nprint(sys.argv[1:])")
    assert written == "['one', 'two words', '_rate:=5']\n"
    path = notebook.session.package.file("scripts", "where.py")
    assert path.read_text(encoding="utf-8").startswith("#!/usr/bin/env python3\nimport sys")
    assert os.access(path, os.X_OK)
    assert notebook.ok("%rosrun notebook where.py") == "[]\n"


def test_the_lines_of_an_error_are_the_cells(notebook):
    written = notebook.ok("%%node bad.py\nimport rospy\n\nprint(1 / 0)")
    assert 'bad.py", line 4, in <module>\n    print(1 / 0)' in written
    assert "bad.py has ended with exit status 1." in written
    assert notebook.ok("%rosnode list") == "/rosout\n"


def test_a_syntax_error_is_the_cells_and_ends_nothing(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    written = notebook.fails("%%node talker.py\nimport rospy\nx = = 3")
    assert "talker.py:3" in written and "SyntaxError" in written and "x = = 3" in written
    assert "/talker" in notebook.ok("%rosnode list")
    assert notebook.ok("import rosmini; rosmini.wait(1)") == "said hello at 1001.0\n"
    assert "print(...)" in notebook.fails("%%node old.py\nprint 3")


def test_running_the_cell_again_restarts_it(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    assert notebook.ok(f"%%node talker.py\n{TALKER.replace('hello', 'hi')}") == "said hi at 1000.0\n"
    assert notebook.ok("import rosmini; rosmini.wait(1)") == "said hi at 1001.0\n"
    assert notebook.ok("%rosnode list") == "/rosout\n/talker\n"


def test_what_the_earlier_run_cannot_do_any_more_is_not_told(notebook):
    waiting = (
        "import rospy\nfrom std_msgs.msg import String\nrospy.init_node('a')\n"
        "rospy.spin()\nrospy.Subscriber('t', String, print)\n"
    )
    notebook.ok(f"%%node a.py\n{waiting}")
    assert notebook.ok(f"%%node a.py\n{waiting}") == ""


def test_what_does_not_end_is_killed_after_three_seconds(notebook):
    stubborn = (
        "import time\nprint('up')\nwhile True:\n    try:\n        time.sleep(1)\n"
        "    except BaseException:\n        pass\n"
    )
    notebook.ok(f"%%node stubborn.py\n{stubborn}")
    before = notebook.session.graph.now().to_sec()
    written = notebook.ok(f"%%node stubborn.py\n{stubborn}")
    assert written.startswith("stubborn.py ") and " 3 s " in written and written.endswith("killed.\nup\n")
    assert notebook.session.graph.now().to_sec() == before + 3


def test_a_node_that_sleeps_on_after_its_end_is_killed_too_and_soon(notebook):
    deaf = (
        "import rospy\nrospy.init_node('deaf')\ntries = 0\nwhile True:\n    try:\n        rospy.sleep(1)\n"
        "    except rospy.ROSInterruptException:\n        tries += 1\n        assert tries < 100_000\n"
    )
    notebook.ok(f"%%node deaf.py\n{deaf}")
    written = notebook.ok(f"%%node deaf.py\n{deaf}")
    assert written.startswith("deaf.py ") and " 3 s " in written and written.endswith("killed.\n")


def test_an_interrupt_while_the_earlier_run_ends_kills_it(notebook, monkeypatch):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    run = next(iter(notebook.session.runs._runs.values()))

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(run.handle, "send_signal", lambda _: None)  # it does not listen
    monkeypatch.setattr(run.handle, "wait", interrupted)
    notebook.run(f"%%node talker.py\n{TALKER}")
    assert notebook.ok("import rosmini; rosmini.wait(2)") == ""
    assert not run.is_running


def test_of_two_scripts_with_one_node_name_the_older_ends_and_both_are_named(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    written = notebook.ok("%%node other.py\nimport rospy\nrospy.init_node('talker')\nrospy.spin()")
    assert "other.py and talker.py both call their node /talker" in written
    assert notebook.ok("%rosnode list") == "/rosout\n/talker\n"


def test_a_failing_callback_is_logged_and_no_command_fails(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    notebook.ok(f"%%node listener.py\n{LISTENER.replace('message.data', '1 / 0')}")
    written = notebook.ok("import rosmini; rosmini.wait(1)")
    assert "ZeroDivisionError" in written and "listener.py, line 6, in hear" in written
    assert "/listener" in notebook.ok("%rosnode list")


def test_an_error_shows_the_line_of_the_script_as_it_is_now(notebook):
    notebook.ok(f"%%node talker.py\n{TALKER}")
    for fault in ("1 / 0", "int('one')"):
        notebook.ok(f"%%node listener.py\n{LISTENER.replace('message.data', fault)}")
        assert f'in hear: print("heard", {fault})' in notebook.ok("import rosmini; rosmini.wait(1)")


def test_a_node_that_ends_at_once_is_told(notebook):
    written = notebook.ok("%%node short.py\nimport rospy\nrospy.init_node('short')")
    assert "short.py has ended" in written and " /short " in written and "rospy.spin()" in written
    assert notebook.ok("%%node hello.py\nprint('hello')") == "hello\n"
    assert "has ended" in notebook.ok("%rosrun notebook short.py")
    assert "has ended" not in notebook.ok("%rosrun --quiet notebook short.py")
    assert "has ended" not in notebook.ok("%rosrun dynamic_reconfigure dynparam list")


def test_a_script_that_never_blocks_lets_time_pass(notebook):
    notebook.ok("%%node busy.py\nimport rospy\nrospy.init_node('busy')\nn = 0\nwhile True:\n    n += 1")
    assert "/busy" in notebook.ok("%rosnode list")
    notebook.ok("import rosmini; rosmini.wait(0.1)")


def test_input_comes_from_the_line(notebook):
    ask = "print('hello', input('who? '), input())"
    assert notebook.ok(f"%%node ask.py --stdin 'Ada\\nBob'\n{ask}") == "who? hello Ada Bob\n"
    assert notebook.ok("%rosrun notebook ask.py --stdin 'A\\nB'") == "who? hello A B\n"
    assert "EOFError" in notebook.ok("%rosrun notebook ask.py --stdin A")


def test_input_comes_from_the_reader_while_time_stands_still(notebook, monkeypatch):
    answers = iter(["Ada", "Bob"])
    monkeypatch.setattr("builtins.input", lambda *_: next(answers))
    notebook.ok(
        "%%node tick.py\nimport rospy\nrospy.init_node('tick')\nrospy.Timer(rospy.Duration(1), print)\nrospy.spin()"
    )
    before = notebook.session.graph.now()
    written = notebook.ok("%%node ask.py\nprint('hello', input('who? '), input())")
    assert "hello Ada Bob" in written
    assert notebook.session.graph.now() == before


def test_where_nobody_can_type_the_script_fails_and_says_what_to_do(notebook, monkeypatch):
    def refuse(*_):
        raise NotImplementedError("no frontend")

    monkeypatch.setattr("builtins.input", refuse)
    assert "add --stdin TEXT" in notebook.ok("%%node ask.py\ninput('who? ')")


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("", "usage: %%node NAME.py [ARGS]"),
        ("--fast talker.py", "unknown option '--fast'"),
        ("talker", "call it talker.py"),
        ("talker.sh", "call it talker.py"),
        ("../talker.py", "is not a file name"),
        (".talker.py", "is not a file name"),
        ("talker.py --stdin", "takes the text to type"),
        ("talker.py a:=b:=c", "one ':=' is enough"),
        ("talker.py | head", "runs no shell"),
        ("$nope.py", "no variable nope"),
    ],
)
def test_a_line_that_makes_no_sense(notebook, line, said):
    assert said in notebook.fails(f"%%node {line}\npass")
    assert not (notebook.session.package.folder / "scripts").is_dir() or "a:=b" in line


def test_a_launch_file_starts_its_nodes_and_starts_them_again(notebook):
    notebook.session.package.write("scripts", "talker.py", f"#!/usr/bin/env python3\n{TALKER}", may_run=True)
    notebook.session.package.write(
        "launch", "two.launch",
        '<launch><node pkg="notebook" type="talker.py" name="one" output="screen"/>'
        '<node pkg="notebook" type="talker.py" name="two" output="screen"/></launch>',
    )  # fmt: skip
    written = notebook.ok("_ = %roslaunch notebook two.launch")
    assert written.startswith("process[one-1]: started\nprocess[two-2]: started\n")
    assert written.endswith("[one] said hello at 1000.0\n[two] said hello at 1000.0\n")
    assert notebook.ok("%rosnode list") == "/one\n/rosout\n/two\n"
    assert "[two-2] killing on exit" in notebook.ok("_ = %roslaunch notebook two.launch")
    assert notebook.ok("%rosnode list") == "/one\n/rosout\n/two\n"
    assert "roslaunch" in notebook.ok("%roslaunch -h")


def test_a_plain_cell_does_not_spin(notebook):
    written = notebook.fails("import rospy\nrospy.init_node('here')\nrospy.spin()")
    assert "%%node NAME.py" in written
    assert notebook.ok("%rosnode list") == "/here\n/rosout\n"


def test_who_speaks_unexpectedly_is_named(notebook):
    notebook.ok("%%node helper.py\ndef tell():\n    print('psst')")
    notebook.ok(
        "%%node quiet.py\nimport rospy, helper\nrospy.init_node('quiet')\n"
        "rospy.Timer(rospy.Duration(1), lambda _: helper.tell())\nrospy.spin()"
    )
    assert notebook.ok("import rosmini; rosmini.wait(1)") == "psst\n"
    notebook.ok(f"%%node talker.py\n{TALKER}")
    assert "[quiet] psst\n" in notebook.ok("rosmini.wait(1)")


def test_a_loop_without_a_pause_does_not_drown_the_notebook(notebook):
    written = notebook.ok("%%node flood.py\nwhile True:\n    print('x')")
    assert "and more" not in written  # it is stopped after a thousand turns at one instant
    written = notebook.ok("import rosmini; rosmini.wait(0.2)")
    assert written.count("x\n") == 2000
    assert "Does flood print in a loop without a rospy.sleep()" in written
    assert notebook.ok("rosmini.wait(0.001)").startswith("x\n")
