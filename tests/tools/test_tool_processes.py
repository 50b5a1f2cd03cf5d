"""The tools as processes: output that nobody reads, Ctrl-C, and what they leave behind: nothing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xmlrpc.client import ServerProxy

import pytest

from rosmini import Graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Trigger

from ..processes import PATIENCE, free_port, listens, run, start, wait_until

ROSMINI = [sys.executable, "-m", "rosmini"]
posix = pytest.mark.skipif(sys.platform == "win32", reason="signals and pipes of POSIX")


@pytest.fixture(scope="module")
def env(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The environment of a Master of ours with a node that publishes, listens and answers."""
    port, home = free_port(), tmp_path_factory.mktemp("home")
    found = {
        **os.environ, "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "HOME": str(home), "ROS_HOME": str(home / "ros"),
    }  # fmt: skip
    found.pop("ROS_IP", None)
    found.pop("ROS_HOSTNAME", None)
    with start([*ROSMINI, "roscore", "-p", str(port)], env=found) as process:
        wait_until(lambda: listens(port), "roscore", process)
        yield found


def ask(env: dict[str, str], line: str) -> Any:
    return run([*ROSMINI, *line.split()], env=env)


def known(env: dict[str, str]) -> str:
    """What the Master knows: publishers, subscribers, services, and names of parameters."""
    with ServerProxy(env["ROS_MASTER_URI"]) as proxy:
        return f"{proxy.getSystemState('/test')}{proxy.getParamNames('/test')}"


@posix
@pytest.mark.parametrize(
    ("line", "buffered"), [("rosmsg list", ""), ("rosmsg list", "1"), ("rosnode list", ""), ("rosnode bogus", "1")]
)
def test_nobody_reads_the_output(env: dict[str, str], line: str, buffered: str) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    try:
        with start(
            [*ROSMINI, *line.split()], env={**env, "PYTHONUNBUFFERED": buffered}, stdout=writer, stderr=subprocess.PIPE
        ) as process:
            _, said = process.communicate(timeout=PATIENCE)
    finally:
        os.close(writer)
    assert "Traceback" not in said
    assert "BrokenPipe" not in said
    assert process.returncode == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full disk")
def test_the_disk_is_full(env: dict[str, str]) -> None:
    with (
        open("/dev/full", "w", encoding="utf-8") as full,
        start([*ROSMINI, "rosmsg", "list"], env=env, stdout=full, stderr=subprocess.PIPE) as process,
    ):
        _, said = process.communicate(timeout=PATIENCE)
    assert said.startswith("rosmini rosmsg: ") and said.endswith(": No space left on device\n")
    assert process.returncode == 1


@posix
def test_ctrl_c_while_a_service_is_waited_for(env: dict[str, str]) -> None:
    with start([*ROSMINI, "rosservice", "call", "--wait", "/never"], env=env, stderr=subprocess.PIPE) as process:
        wait_until(lambda: "/rosservice_" in known(env), "the tool's node", process)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
    assert "Traceback" not in said
    assert "/rosservice_" not in known(env)


LINES = [
    "rosnode ping -c 1 /rosout", "rostopic list", "rostopic pub --duration 0 /x std_msgs/String hi",
    "rosservice call /rosout/get_loggers", "rosparam set /left 1", "rosparam delete /left", "rosservice call /nope",
]  # fmt: skip


def test_tools_leave_nothing(env: dict[str, str], tmp_path: Path) -> None:
    """No node, no parameter, no file in the folder or at home."""

    def state() -> tuple[str, list[Path]]:
        return known(env), sorted(Path(env["HOME"]).rglob("*"))

    before = state()
    for line in LINES:
        run([*ROSMINI, *line.split()], env=env, cwd=tmp_path)
    assert state() == before
    assert list(tmp_path.iterdir()) == []


def test_questions_start_no_thread_and_no_process() -> None:
    """They are asked from the one thread that there is, over plain sockets."""
    program = (
        "import sys, threading\n"
        "def told(event, args):\n"
        "    assert event not in ('subprocess.Popen', 'os.fork', 'os.posix_spawn', 'os.system'), event\n"
        "sys.addaudithook(told)\n"
        "from rosmini.tools.main import main\n"
        "for line in ('rosmsg show std_msgs/String', 'rosnode list', 'rosparam list', 'rosservice list'):\n"
        "    main(line.split())\n"
        "assert threading.active_count() == 1\n"
    )
    env = {**os.environ, "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"}
    done = run([sys.executable, "-c", program], env=env)
    assert done.returncode == 0, done.stderr


def test_a_result_in_python_holds_no_node() -> None:
    from rosmini.tools.rosservice import TOOL

    with Graph() as graph:
        graph.node("server").service("/trigger", Trigger, lambda _: (True, ""))
        graph.nodes["/server"].publisher("/chatter", String)
        before = set(graph.nodes)
        for words in (("call", "/trigger"), ("info", "/trigger"), ("call", "-v", "/trigger")):
            TOOL.run(*words, graph=graph, say=lambda _: None)
        assert set(graph.nodes) == before


@pytest.mark.nightly
def test_gz_acts_on_a_server_in_another_process(env: dict[str, str], tmp_path: Path) -> None:
    box = tmp_path / "box.sdf"
    box.write_text(
        '<sdf version="1.6"><model name="box"><static>1</static><link name="l"><collision name="c"><geometry>'
        "<box><size>1 1 1</size></box></geometry></collision></link></model></sdf>",
        encoding="utf-8",
    )
    missing = ask(env, "gz model -m box -p")
    assert (missing.returncode, "not running" in missing.stderr) == (1, True)
    with start([*ROSMINI, "rosrun", "gazebo_ros", "gzserver"], env=env) as process:
        wait_until(lambda: "/gazebo/get_world_properties" in known(env), "gzserver", process)
        assert ask(env, f"gz model -f {box} -m crate -x 2").returncode == 0
        assert ask(env, "gz model -m crate -p").stdout == "2.000000 0.000000 0.000000 0.000000 0.000000 0.000000\n"
        assert ask(env, "gz world -p 1").returncode == 0
        assert "Paused[T]" in ask(env, "gz stats").stdout
        stepped = ask(env, "gz world -s")  # gazebo_ros has no service for a step
        assert (stepped.returncode, "after a +" in stepped.stderr) == (1, True)
