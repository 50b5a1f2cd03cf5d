"""`rosmini rosrun` as programs: nodes in processes of their own under `rosmini roscore`."""

from __future__ import annotations

import os
import re
import signal
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from xmlrpc.client import ServerProxy

import pytest

from ..processes import PATIENCE, free_port, run, start, wait_until

pytestmark = pytest.mark.processes

ROSMINI = [sys.executable, "-m", "rosmini"]

TALKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
rospy.on_shutdown(lambda: print("the talker ends", flush=True))
publisher = rospy.Publisher("chatter", String, queue_size=10, latch=True)
publisher.publish("hello from " + rospy.get_name() + " " + str(rospy.get_param("~greeting", "")))
rospy.loginfo("said it")
rospy.spin()
"""

LISTENER = """#!/usr/bin/env python3
import sys
import rospy
from std_msgs.msg import String
rospy.init_node("listener", anonymous=len(sys.argv) > 1)
rospy.Subscriber("chatter", String, lambda message: rospy.loginfo("heard %s", message.data))
rospy.spin()
"""

FAILING = """#!/usr/bin/env python3
import sys
print(sys.argv[1:])
sys.exit(7)
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A folder with the package `speaking`."""
    package = tmp_path / "src" / "speaking"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>speaking</name><version>1.0.0</version><description>-</description>"
        "<maintainer email='a@b.c'>-</maintainer><license>BSD</license></package>",
        encoding="utf-8",
    )
    for name, text in (("talker.py", TALKER), ("listener.py", LISTENER), ("failing.py", FAILING)):
        path = package / "scripts" / name
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)
    return tmp_path


class Session:
    """Programs on one Master, each with what it prints in a file."""

    def __init__(self, workspace: Path, stack: ExitStack) -> None:
        self.port = free_port()
        self.folder = workspace
        self._stack = stack
        kept = {name: text for name, text in os.environ.items() if not name.startswith("ROS_")}
        self.env = {
            **kept,
            "PYTHONUNBUFFERED": "1",
            "ROS_PACKAGE_PATH": str(workspace / "src"),
            "ROS_MASTER_URI": f"http://localhost:{self.port}",
        }

    def start(self, name: str, *words: str, **variables: str) -> Any:
        """Start a program; what it prints goes to the file `name`."""
        file = self._stack.enter_context((self.folder / name).open("w", encoding="utf-8"))
        return self._stack.enter_context(start([*ROSMINI, *words], stdout=file, stderr=file, env=self.env | variables))

    def core(self, name: str = "core") -> Any:
        """Start a roscore, and wait until it answers."""
        process = self.start(name, "roscore")
        wait_until(lambda: "started core service" in self.said(name), "roscore", process)
        return process

    def said(self, name: str) -> str:
        """What a program has printed so far."""
        return (self.folder / name).read_text(encoding="utf-8")

    def until_said(self, name: str, text: str, process: Any = None) -> None:
        """Wait until a program has printed a text."""
        wait_until(lambda: text in self.said(name), f"{text!r} of {name}", process)

    def ask(self, method: str, *arguments: Any) -> Any:
        """Ask the Master."""
        with ServerProxy(self.env["ROS_MASTER_URI"]) as proxy:
            answer: Any = getattr(proxy, method)("/test", *arguments)
        return answer

    def nodes(self) -> set[str]:
        """The nodes that the Master knows."""
        return {name for part in self.ask("getSystemState")[2] for _, names in part for name in names}


@pytest.fixture
def session(workspace: Path) -> Iterator[Session]:
    """Programs that end with the test."""
    with ExitStack() as stack:
        yield Session(workspace, stack)


def test_without_a_master_a_node_says_so_once_and_waits_for_it(session: Session) -> None:
    listener = session.start("listener", "rosrun", "speaking", "listener.py")
    complaint = (
        f"Unable to register with master node [http://localhost:{session.port}]: master may not be running yet. "
        "Will keep trying."
    )
    session.until_said("listener", complaint, listener)
    session.core()
    session.start("talker", "rosrun", "speaking", "talker.py")
    session.until_said("listener", "heard hello from /talker", listener)
    assert session.said("listener").count("Unable to register") == 1
    assert re.match(r"\[ERROR\] \[\d+\.\d{6}\]: Unable", session.said("listener"))


def test_each_process_has_its_own_anonymous_names_and_log_files(session: Session) -> None:
    session.core()
    logs = session.folder / "logs"
    for name in ("one", "two"):
        session.start(
            name, "rosrun", "speaking", "listener.py", "any", ROS_LOG_DIR=str(logs / name), ROS_NAMESPACE="deep"
        )
    wait_until(lambda: len(session.nodes()) == 3, "two listeners")
    assert sum(name.startswith("/deep/listener_") for name in session.nodes()) == 2
    for name in ("one", "two"):
        wait_until(lambda name=name: list((logs / name).glob("deep_listener_*.log")), "the log file")


def test_the_exit_status_is_the_script_s(session: Session) -> None:
    ended = run([*ROSMINI, "rosrun", "speaking", "failing.py", "a", "b:=c"], env=session.env)
    assert ended.returncode == 7
    assert ended.stdout == "['a', 'b:=c']\n"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["nowhere", "x"], "nowhere"),
        (["speaking", "talke.py"], "talker.py"),
        (["speaking", "talker.py", "__master:=robot"], "__master:= is 'robot', which is not the address of a Master"),
        (["speaking", "talker.py", "__ip:=0.0.0.0"], "__ip:= is 0.0.0.0, which no other computer can connect to"),
    ],
)
def test_what_makes_no_sense_is_refused(session: Session, words: list[str], says: str) -> None:
    ended = run([*ROSMINI, "rosrun", *words], env=session.env)
    assert ended.returncode == 1
    assert says in ended.stderr


def test_a_host_that_does_not_resolve_and_one_that_cannot_reach_back_are_told(session: Session) -> None:
    uri = "http://no-such-host.invalid:11311"
    listener = session.start("listener", "rosrun", "speaking", "listener.py", f"__master:={uri}")
    session.until_said("listener", "Unable to register", listener)
    said = session.said("listener")
    assert "the Master is at no-such-host.invalid, but other machines cannot reach this process" in said
    assert "Set ROS_IP" in said
    assert "'no-such-host.invalid' does not resolve" in said
    listener.send_signal(signal.SIGINT)
    assert listener.wait(PATIENCE) in (0, 1, 130, -signal.SIGINT)


@pytest.mark.skipif(os.name == "nt", reason="a POSIX program")
def test_what_a_build_made_is_found_and_a_program_is_run_as_itself(workspace: Path) -> None:
    """`devel/lib/PACKAGE`, where C++ nodes are that catkin has compiled, and scripts that CMakeLists.txt installs."""
    made = workspace / "devel" / "lib" / "speaking"
    made.mkdir(parents=True)
    (workspace / "devel" / ".catkin").write_text(str(workspace / "src"), encoding="utf-8")
    (made / "compiled").write_text('#!/bin/sh\necho "$0 $*"\nexit 3\n', encoding="utf-8")
    (made / "script.py").write_text(FAILING, encoding="utf-8")
    for path in made.iterdir():
        path.chmod(0o755)
    kept = {name: text for name, text in os.environ.items() if not name.startswith(("ROS_", "CMAKE_"))}
    env = {**kept, "ROS_PACKAGE_PATH": str(workspace / "src")}
    done = run([*ROSMINI, "rosrun", "speaking", "compiled", "__name:=x", "-v"], env=env)
    assert (done.returncode, done.stdout) == (3, f"{made / 'compiled'} __name:=x -v\n")
    asked = run([*ROSMINI, "rosrun", "speaking", "compild"], env=env)
    assert "did you mean compiled?" in asked.stderr
    nodes = '<node pkg="speaking" type="compiled" name="a"/><node pkg="speaking" type="script.py" name="b"/>'
    (workspace / "a.launch").write_text(f"<launch>{nodes}</launch>", encoding="utf-8")
    shown = run([*ROSMINI, "roslaunch", "--args", "/a", str(workspace / "a.launch")], env=env)
    assert shown.stdout == f"{made / 'compiled'} __name:=a\n"
    checked = run([*ROSMINI, "roslaunch", "--check", str(workspace / "a.launch")], env=env)
    assert "all is there" in checked.stdout


def test_a_prefix_is_put_before_the_command(session: Session) -> None:
    words = ("speaking", "failing.py", "-x", "a:=b")
    done = run([*ROSMINI, "rosrun", "--prefix", "env A=1", "-d", *words], env=session.env)
    assert (done.returncode, done.stdout) == (7, "['-x', 'a:=b']\n")
    assert "[rosrun] speaking/failing.py is run by rosmini itself" in done.stderr
    done = run([*ROSMINI, "rosrun", "--prefix=valgrind5 -q", *words], env=session.env)
    assert done.returncode == 1
    assert "there is no program 'valgrind5' on PATH" in done.stderr
