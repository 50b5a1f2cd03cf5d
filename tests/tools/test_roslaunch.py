"""`rosmini roslaunch`: what it answers, one process, and processes under a Master."""

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

from rosmini import Graph
from rosmini.tools.main import main
from rosmini.tools.roslaunch import TOOL

from ..processes import free_port, listens, run, start, wait_until
from ..ros.launch.workspace import make

ROSMINI = [sys.executable, "-m", "rosmini"]

DEMO = """
<arg name="rate" default="10"/>
<param name="robot_name" value="tb3"/>
<param name="int_p" value="7"/>
<rosparam>
gains: {p: 1.5, i: 0.1, d: 0.0}
waypoints: [[0, 1], [2, 3]]
</rosparam>
<group ns="robot1">
  <remap from="in" to="chatter"/>
  <param name="nested" value="6"/>
  <node pkg="speaking" type="talker.py" name="pub1" args="-r $(arg rate)"/>
  <node pkg="topic_tools" type="relay" name="relay1" args="chatter chatter_relay"/>
</group>
<node pkg="tf2_ros" type="static_transform_publisher" name="stp" args="1 0 0 0 0 0 map odom"/>
"""


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the package `speaking`, which has launch files."""
    folder = make(
        tmp_path,
        demo=DEMO,
        bad='<node pkg="rospy" name="n"/>',
        incomplete='<node pkg="speaking" type="tlaker.py" name="a"/>\n<node pkg="nowhere" type="x" name="b"/>',
    )
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder))
    monkeypatch.delenv("ROS_NAMESPACE", raising=False)
    return folder


@pytest.mark.usefixtures("source")
class TestAnswers:
    """What is printed is what ROS's tool prints."""

    def said(self, capsys: Any, *words: str) -> tuple[int, str, str]:
        status = main(["roslaunch", *words])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    def test_args(self, capsys: Any) -> None:
        status, out, _ = self.said(capsys, "--args", "/robot1/pub1", "speaking", "demo.launch", "rate:=20")
        assert status == 0
        assert out == (
            f'ROS_NAMESPACE="/robot1" {sys.executable} -m rosmini rosrun speaking talker.py '
            "-r 20 in:=chatter __name:=pub1\n"
        )
        status, _, err = self.said(capsys, "--args", "pub1", "speaking", "demo.launch")
        assert status == 1
        assert "Cannot find node named [/pub1]" in err
        assert "did you mean /robot1/pub1?" in err

    def test_files(self, capsys: Any, source: Path) -> None:
        file = source / "speaking" / "launch" / "demo.launch"
        assert self.said(capsys, "--files", os.path.relpath(file))[1] == f"{file}\n"
        twice = source / "twice.launch"
        twice.write_text(
            "".join(["<launch>", *(f'<include file="{file}" ns="{name}"/>' for name in "ab"), "</launch>"]),
            encoding="utf-8",
        )
        assert self.said(capsys, "--files", str(twice))[1] == f"{twice}\n{file}\n"

    def test_check_names_all_that_is_missing(self, capsys: Any) -> None:
        status, out, _ = self.said(capsys, "--check", "speaking", "incomplete.launch")
        assert status == 1
        assert "2 things are missing:" in out
        assert re.search(r"executable:\n    speaking/tlaker.py  \(.*incomplete.launch:2\)\n", out)
        assert re.search(r"package:\n    nowhere  \(.*incomplete.launch:3\)\n", out)

    def test_an_error_has_its_file_and_line(self, capsys: Any) -> None:
        status, _, err = self.said(capsys, "speaking", "bad.launch")
        assert status == 1
        assert re.fullmatch(
            r"RLException: .*bad.launch:2: <node> tag is missing required attribute: 'type'\. "
            r'The tag is <node pkg="rospy" name="n"/>\n',
            err,
        )

    @pytest.mark.parametrize(
        ("words", "said"),
        [
            ([], "you must specify at least one input file"),
            (["--nodes", "--ros-args", "speaking", "demo.launch"], "only one of [--nodes"),
            (["--duration", "5", "speaking", "demo.launch"], "need --one-process"),
            (["speaking", "demo.launch", "--nodse"], "no such option"),
        ],
    )
    def test_a_command_line_that_makes_no_sense(self, capsys: Any, words: list[str], said: str) -> None:
        status, _, err = self.said(capsys, *words)
        assert status
        assert said in err

    def test_standard_input(self, capsys: Any, monkeypatch: pytest.MonkeyPatch) -> None:
        import io

        monkeypatch.setattr(sys, "stdin", io.StringIO('<launch><node pkg="a" type="b" name="c"/></launch>'))
        assert self.said(capsys, "--nodes", "-")[1] == "/c\n"


@pytest.mark.processes
def test_one_process_ends_with_the_scripts_after_the_plus(source: Path, tmp_path: Path) -> None:
    listener = tmp_path / "listener.py"
    listener.write_text(
        "import rospy\nfrom std_msgs.msg import String\nrospy.init_node('listener')\n"
        "print('heard', rospy.wait_for_message('/robot1/chatter', String).data)\n",
        encoding="utf-8",
    )
    launch = source / "speaking" / "launch" / "one.launch"
    launch.write_text(
        '<launch><group ns="robot1"><node pkg="speaking" type="talker.py" name="talker"/></group></launch>',
        encoding="utf-8",
    )
    words = ["roslaunch", "speaking", "one.launch", "+", listener, "--one-process", "--sim-time"]
    done = run([*ROSMINI, *words], check=True)
    assert "heard hello" in done.stdout
    assert "[robot1/talker-1] killing on exit" in done.stdout
    assert "shut down" in done.stdout


class Session:
    """Programs, each with what it prints in a file."""

    def __init__(self, folder: Path, stack: ExitStack) -> None:
        self.port = free_port()
        self.folder = folder
        self._stack = stack
        kept = {name: text for name, text in os.environ.items() if not name.startswith("ROS_")}
        self.env = {
            **kept,
            "PYTHONUNBUFFERED": "1",
            "ROS_PACKAGE_PATH": str(folder / "src"),
            "ROS_HOME": str(folder / "home"),
            "ROS_MASTER_URI": f"http://localhost:{self.port}",
        }

    def launch(self, inside: str, *words: str) -> Any:
        """Start roslaunch for a file with this inside."""
        make(self.folder, here=inside)
        file = self._stack.enter_context((self.folder / "said").open("w", encoding="utf-8"))
        command = [*ROSMINI, "roslaunch", "speaking", "here.launch", *words]
        return self._stack.enter_context(start(command, stdout=file, stderr=file, env=self.env))

    def said(self) -> str:
        """What roslaunch and the nodes with output="screen" have printed so far."""
        return (self.folder / "said").read_text(encoding="utf-8")

    def until_said(self, text: str, process: Any) -> None:
        """Wait until that is printed."""
        wait_until(lambda: text in self.said(), f"{text!r} in what was printed:\n{self.said()}", process)

    def pids(self) -> list[int]:
        """The numbers of all processes that were started."""
        return [int(found) for found in re.findall(r"started with pid \[(\d+)\]", self.said())]


@pytest.fixture
def session(tmp_path: Path) -> Iterator[Session]:
    """Programs that end with the test."""
    with ExitStack() as stack:
        yield Session(tmp_path, stack)


def runs(pid: int) -> bool:
    """Whether a process runs (one that has ended and that nobody has asked about does not)."""
    try:
        os.kill(pid, 0)
        state = Path(f"/proc/{pid}/stat")
        return not state.exists() or state.read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False


@pytest.mark.processes
def test_processes_under_a_master_of_its_own_end_with_ctrl_c(session: Session) -> None:
    process = session.launch(
        """<group ns="robot1"><node pkg="speaking" type="talker.py" name="talker" output="screen">
             <env name="NUMBER" value="5"/></node></group>
           <node pkg="speaking" type="ending.py" name="short" args="0 3" respawn="false"/>
           <node pkg="tf" type="tf_monitor" name="monitor"/>
           <node pkg="nowhere" type="x" name="lost"/>"""
    )
    session.until_said("/robot1/talker 5 /robot1/chatter", process)
    session.until_said("process has died", process)
    with ServerProxy(session.env["ROS_MASTER_URI"]) as master:
        state: Any = master.getSystemState("/test")
    assert "/robot1/talker" in {name for part in state[2] for _, names in part for name in names}
    process.send_signal(signal.SIGINT)
    assert process.wait() == 0
    said = session.said()
    assert re.search(r"auto-starting new master\nprocess\[master\]: started with pid \[\d+\]\n", said)
    assert re.search(r"process\[robot1/talker-2\]: started with pid \[\d+\]\n", said)
    assert re.search(
        r"\[short-3\] process has died \[pid \d+, exit code 3, cmd .*\]\.\nlog file: .*short-3\*\.log", said
    )
    assert "ERROR: cannot launch node of type [nowhere/x]" in said
    assert said.index("[monitor-4] killing on exit") < said.index("[robot1/talker-2] killing on exit")
    assert "shut down\n" in said  # the node's own, in good order
    assert said.endswith(
        "[rosout-1] killing on exit\n[master] killing on exit\nshutting down processing monitor...\n"
        "... shutting down processing monitor complete\ndone\n"
    )
    assert not any(map(runs, session.pids()))
    assert not listens(session.port)


@pytest.mark.processes
def test_a_required_node_ends_the_launch_and_stubborn_ones_are_killed(session: Session) -> None:
    process = session.launch(
        '<node pkg="speaking" type="ending.py" name="boss" args="2 0" required="true"/>\n'
        '<node pkg="speaking" type="stubborn.py" name="stubborn" output="screen"/>',
        "--sigint-timeout=0.2",
        "--sigterm-timeout=0.2",
    )
    assert process.wait() == 0
    said = session.said()
    assert "REQUIRED process [boss-2] has died!" in said
    assert "[stubborn-3] killing on exit" in said
    assert not any(map(runs, session.pids()))


@pytest.mark.processes
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX groups of processes")
def test_nodes_die_with_a_launcher_that_is_killed(session: Session) -> None:
    process = session.launch('<node pkg="speaking" type="talker.py" name="talker" output="screen"/>')
    session.until_said("/talker None /chatter", process)
    pids = session.pids()
    assert len(pids) == 3  # the Master, /rosout in the same process, the node
    process.kill()
    process.wait()
    wait_until(lambda: not any(map(runs, pids)), "end of all nodes")


def test_in_a_notebook_the_nodes_run_in_its_graph(source: Path, capsys: Any) -> None:
    (source / "speaking" / "launch" / "one.launch").write_text(
        '<launch><node pkg="speaking" type="talker.py" name="talker"/></launch>', encoding="utf-8"
    )
    with Graph(strict=False) as graph:
        found: Any = TOOL.run("--nodes", "speaking", "one.launch", graph=graph)
        assert str(found) == "/talker"
        result: Any = TOOL.run("speaking", "one.launch", "--duration", "2", graph=graph)
        assert result.launch["talker"].poll() is None
        assert "/chatter" in dict(graph.ask_as("/x").ask("getTopicTypes"))
        result.launch.stop()
    assert "[talker] /talker None /chatter" in capsys.readouterr().out


def test_with_log_the_nodes_of_a_notebook_show_only_warnings(source: Path, capsys: Any) -> None:
    (source / "speaking" / "scripts" / "worried.py").write_text(
        "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('worried')\nprint('printed')\n"
        "rospy.loginfo('usual')\nrospy.logwarn('odd')\nrospy.spin()\n",
        encoding="utf-8",
    )
    (source / "speaking" / "scripts" / "worried.py").chmod(0o755)
    launch = source / "speaking" / "launch" / "worried.launch"
    launch.write_text('<launch><node pkg="speaking" type="worried.py" name="worried"/></launch>', encoding="utf-8")
    with Graph(strict=False) as graph:
        result: Any = TOOL.run("--log", "speaking", "worried.launch", "--duration", "1", graph=graph)
        result.launch.stop()
    said = capsys.readouterr()
    assert "odd" in said.err
    assert not {"usual", "printed"} & set((said.out + said.err).split())
