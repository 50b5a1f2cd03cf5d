"""Scripts with actionlib as students write them, unmodified, in simulated and in wall time."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rosmini.ros.scripts import ScriptSpec

from ...processes import PATIENCE

HERE = Path(__file__).parent / "actionlib"


def said_by(ran, name):
    return [line.removeprefix(f"[{name}] ") for line in ran.lines if line.startswith(f"[{name}] ")]


@pytest.mark.parametrize(("order", "patience", "status"), [(3, 1000, 0), (1000, 2, 3)])
def test_the_tutorials_server_and_client(run, order, patience, status):
    ran = run(
        ScriptSpec(str(HERE / "fibonacci_server.py")),
        ScriptSpec(str(HERE / "fibonacci_client.py"), (str(order), str(patience))),
        until="[fibonacci_client] listed [['/fibonacci_client', '1']]",
        rate=4,
    )
    told = said_by(ran, "fibonacci_client")
    assert told[:2] == ["server True", "active"]
    assert told[-1] == "listed [['/fibonacci_client', '1']]"
    if status == 0:
        assert told[2:-1] == ["done SUCCEEDED (0, 1, 1, 2)", "(0, 1, 1, 2) tuple", "SUCCEEDED"]
        assert said_by(ran, "fibonacci") == ["/fibonacci: order 3 from 0, 1", "/fibonacci: succeeded"]
    else:
        assert told[2:-1] == ["too slow True", "done PREEMPTED ()", "() tuple", "PREEMPTED"]
        assert said_by(ran, "fibonacci") == ["/fibonacci: order 1000 from 0, 1", "/fibonacci: preempted"]
    assert ran.status == status


def test_handles_and_modules_by_their_names(run):
    ran = run(ScriptSpec(str(HERE / "handles.py")), duration=PATIENCE)
    told = said_by(ran, "handles")
    assert "True" in told
    assert told[-3:] == ["3 added 3", "5 negative 0", "DONE DONE"]
    assert any("the action server ~add starts by itself (auto_start=True)" in line for line in told)
    assert any(
        "set_aborted() is for a goal that is ACTIVE or PREEMPTING; this one is SUCCEEDED" in line for line in told
    )
    assert ran.result.reason == "ended"
    assert ran.status == 0


def test_before_init_node(run):
    source = """
        import actionlib, rospy
        from actionlib_tutorials.msg import FibonacciAction
        for make in (actionlib.SimpleActionClient, actionlib.SimpleActionServer, actionlib.ActionClient):
            try:
                make("fibonacci", FibonacciAction)
            except rospy.ROSInitException as error:
                print(str(error).partition(",")[0])
        rospy.init_node("late")
        try:
            actionlib.SimpleActionClient("fibonacci", rospy.Header)
        except actionlib.ActionException as error:
            print(error)
    """
    ran = run(source, prefix=False)
    assert [re.findall("client|server|fibonacci|Header", line) for line in ran.lines] == [
        ["client", "fibonacci"], ["server", "fibonacci"], ["client", "fibonacci"], ["Header"],
    ]  # fmt: skip


def test_no_goal_is_taken_while_a_script_holds_the_servers_lock(run):
    source = """
        import actionlib, rospy
        from actionlib_tutorials.msg import FibonacciAction, FibonacciGoal

        rospy.init_node("locked")
        taken = []
        server = actionlib.SimpleActionServer("work", FibonacciAction, auto_start=False)
        server.register_goal_callback(lambda: taken.append(server.accept_new_goal().order))
        server.start()
        client = actionlib.SimpleActionClient("work", FibonacciAction)
        client.wait_for_server()
        with server.action_server.lock, server.lock:
            client.send_goal(FibonacciGoal(3))
            rospy.sleep(1.0)
            with server.action_server.lock:
                print("held", taken)
        rospy.sleep(0.1)
        print("free", taken)
        with server.execute_condition:
            server.execute_condition.notify_all()
    """
    assert run(source, prefix=False, duration=PATIENCE).lines[-2:] == ["held []", "free [3]"]


def test_a_loop_around_a_wait_for_a_server_ends_with_the_run(run):
    """It does not see the end of its node: every wait is over at once then, and time has to go on around it."""
    text = (
        "import rospy, actionlib\nfrom actionlib_tutorials.msg import FibonacciAction\nrospy.init_node('w')\n"
        "client = actionlib.SimpleActionClient('nobody', FibonacciAction)\n"
        "while not client.wait_for_server(rospy.Duration(1)):\n    rospy.loginfo('waiting')\n"
    )
    assert run(ScriptSpec("w.py", (), text), duration=3, rate=4).result.reason == "time"
