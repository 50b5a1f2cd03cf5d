"""Scripts as students write them for rospy, unmodified, several at once, in simulated and in wall time."""

import random
import re
import textwrap
from pathlib import Path

import pytest

from rosmini.ros.scripts import ScriptSpec

from ...processes import PATIENCE

HERE = Path(__file__).parent / "rospy"


def spec(name, *args):
    return ScriptSpec(str(HERE / name), args)


@pytest.fixture
def start(run):
    """Run scripts by name; in wall time for at most `PATIENCE`, which no test needs."""

    def start(*specs, **options):
        wanted = [item if isinstance(item, ScriptSpec) else spec(item) for item in specs]
        return run(*wanted, **{"duration": PATIENCE, **options})

    return start


def said_by(ran, name):
    return [line.removeprefix(f"[{name}] ") for line in ran.lines if line.startswith(f"[{name}] ")]


def test_remapping_and_private_parameters(start):
    ran = start(
        spec("talker.py", "chatter:=/news", "__name:=reporter", "_rate:=200"),
        spec("listener.py", "chatter:=news", "__ns:=/"),
        spec("listener.py", "__name:=deaf", "chatter:=/elsewhere"),
        until="[listener] done",
    )
    assert said_by(ran, "listener")[-1] == "done"
    assert said_by(ran, "deaf") == ["done"]
    assert ran.result.reason == "interrupted"
    assert ran.status == 0


def test_message_filters_bring_two_topics_together(start):
    ran = start("fuse.py")
    pairs = [f"together {number} {number} close" for number in (0, 2, 4)]
    assert said_by(ran, "fuse") == [*pairs, "cached 3 4"]
    assert ran.status == 0


def test_a_node_is_reconfigured_while_it_runs(start):
    ran = start(spec("tuned.py", "_speed:=0.5"), "tune.py", until="[tune] is 2.0")
    assert said_by(ran, "tuned") == ["level -1 speed 0.5 True", "level 1 speed 2.0 True"]
    assert said_by(ran, "tune") == ["was 0.5", "is 2.0"]
    assert ran.status == 0


def test_add_two_ints(start):
    ran = start(
        "add_two_ints_server.py", spec("add_two_ints_client.py", "40", "2"), until="[add_two_ints_client] 40 + 2 = 42"
    )
    assert said_by(ran, "add_two_ints_server") == ["Returning [40 + 2 = 42]"]
    assert said_by(ran, "add_two_ints_client") == ["40 + 2 = 42"]
    assert ran.status == 0


def test_input_and_arguments(start):
    ran = start(
        spec("ask.py", "--unit", "cm", "word", "goal:=/target"),
        "talker.py",
        "listener.py",
        stdin=[(0.05, "1.5\n"), (0.1, "2\n")],
    )
    assert any(line.endswith("3.5 cm ['word'] /asker /target") for line in ran.lines)
    assert said_by(ran, "listener")[-1] == "done"
    assert ran.result.reason == "ended"


MOVES = {"i": "1 0", ",": "-1 0", "j": "0 1", "k": "0 0"}


def test_keyboard_teleoperation(start, simulated):
    if simulated:
        keys = [(0.1 + 0.05 * number, key) for number, key in enumerate("i,jk\x03")]
        ran = start("teleop.py", "robot.py", stdin=keys)
    else:
        ran = _typed_as_the_robot_moves(start)
    assert said_by(ran, "robot") == list(MOVES.values())
    assert ran.status == 0
    assert ran.result.reason == "ended"


def _typed_as_the_robot_moves(start):
    """Press each key once the robot does what the last one asked for: however busy the machine is, none is missed."""
    import io
    import os
    from types import ModuleType

    import rosmini.ros.rospy

    out, host = io.StringIO(), ModuleType("host")
    read, write = os.pipe()
    vars(host).update(
        moves=MOVES, said=lambda move: f"[robot] {move}\n" in out.getvalue(), press=lambda key: os.write(write, key)
    )
    source = """
        import host, time
        for key, move in host.moves.items():
            host.press(key.encode())
            while not host.said(move):
                time.sleep(0.005)
        host.press(b"\\x03")
    """
    finger = ScriptSpec("finger", (), source=textwrap.dedent(source))
    modules = {**rosmini.ros.rospy.modules(), "host": host}
    try:
        with os.fdopen(read, encoding="utf-8") as stdin:
            return start("teleop.py", "robot.py", finger, stdin=stdin, out=out, modules=modules)
    finally:
        os.close(write)


def test_shutdown_hook_at_ctrl_c(start, run):
    import signal

    import rosmini.ros.rospy

    ctrl_c = run.text(
        "ctrl_c", "import host_signal, time\ntime.sleep(0.02)\nhost_signal.raise_signal(host_signal.SIGINT)"
    )
    modules = {**rosmini.ros.rospy.modules(), "host_signal": signal}
    ran = start("shutdown_hook.py", "listener.py", ctrl_c, modules=modules)
    assert ran.result.reason == "interrupted"
    assert said_by(ran, "hooked")[-1] == "stopping the robot"
    assert said_by(ran, "listener") == ["done"]
    assert ran.status == 0


def test_sys_exit_runs_the_hooks(start):
    ran = start("exits.py", "calls_itself.py")
    text = said_by(ran, "exits")
    assert "no map" in text[0]
    assert text[1:] == ["hook"]
    assert ran.result.statuses == (3, 0)
    assert said_by(ran, "self_caller") == ["outer got inner"]


def test_threads_log_under_their_own_name(start, run):
    source = """
    import rospy, threading
    rospy.init_node("threaded")
    def work():
        rospy.sleep(0.005)
        rospy.logwarn("from a thread of " + rospy.get_name())
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    """
    ran = start(run.text("a", source, "__name:=one"), run.text("b", source, "__name:=two"))
    for name in ("one", "two"):
        assert said_by(ran, name)[0].endswith(f"from a thread of /{name}")


def test_a_wrong_message_shows_the_users_line_only(start, run):
    source = """
    import rospy
    from std_msgs.msg import String
    rospy.init_node("wrong")
    publisher = rospy.Publisher("chatter", String, queue_size=1, latch=True)
    publisher.publish(3)
    """
    ran = start(run.text("a", source))
    text = [line for line in said_by(ran, "wrong") if line.strip(" ^~")]
    assert text[0] == "Traceback (most recent call last):"
    assert text[1:3] == ['  File "<a>", line 6, in <module>', "    publisher.publish(3)"]
    assert "field data must be of type str, not 3" in text[3]
    assert len(text) == 4
    assert ran.status == 1


def test_all_at_once(start):
    """Every script that ends by itself, in one process and one graph: each does what it does alone."""
    ran = start(
        spec("talker.py", "_listeners:=4"),
        "listener.py",
        "wait_for_got.py",
        "never_again.py",
        "spin_thread.py",
        "straight_line.py",
        "motor.py",
        "calls_itself.py",
        "service_in_callback.py",
        "left/left.py",
        "right/right.py",
        "laser.py",
        spec("vandal.py", "one"),
        spec("vandal.py", "two"),
    )
    assert ran.result.reason == "ended"
    assert ran.status == 0
    # On a busy machine more than one has come before its next turn.
    assert re.fullmatch(r"got hello [012]", *said_by(ran, "waiter"))
    assert any("arrived True" in line for line in ran.lines)
    said = {
        "listener": ["heard hello 0", "heard hello 1", "heard hello 2", "done"],
        "busy": ["three messages came in between"],
        "spinner": ["['hello 0', 'hello 1', 'hello 2']", "spin has returned"],
        "motor": ["stopped"],
        "self_caller": ["outer got inner"],
        "relay": ["a True 1", "b True 2"],
        "one": ["[1.0, 2.0, 3.5] base_scan"],
        "two": ["[1.0, 2.0, 3.5] base_scan"],
        "laser": ["[7.0, 2.0, 3.5] base_scan 0.0"],
    }
    for side, seed in (("left", 1), ("right", 2)):
        own = random.Random(seed)
        said[f"node_{side}"] = [f"{side} {[own.randint(0, 999) for _ in range(3)]}"]
    assert {name: said_by(ran, name) for name in said} == said
