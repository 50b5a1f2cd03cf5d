"""`rosmini roscore` as a program: what it prints, whom it serves, how it ends."""

from __future__ import annotations

import os
import signal
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xmlrpc.client import ServerProxy

import pytest

from ..conftest import nightly
from ..processes import PATIENCE, free_port, listens, run, start, wait_until

pytestmark = pytest.mark.processes

ROSCORE = [sys.executable, "-m", "rosmini", "roscore"]


def environment(**variables: str) -> dict[str, str]:
    """The tests' environment, without what it says of a Master."""
    kept = {name: text for name, text in os.environ.items() if not name.startswith("ROS_")}
    return {**kept, "PYTHONUNBUFFERED": "1", **variables}


@contextmanager
def roscore(port: int, *words: str, output: Path, **variables: str) -> Iterator[Any]:
    """A roscore that answers at `port`; what it prints goes to a file."""
    with output.open("w", encoding="utf-8") as file:
        options = {"stdout": file, "stderr": file, "env": environment(**variables)}
        with start([*ROSCORE, "-p", port, *words], **options) as process:
            wait_until(lambda: "NODES" in output.read_text(encoding="utf-8"), "roscore", process)
            yield process


def ask(port: int, method: str, *arguments: Any, host: str = "127.0.0.1") -> Any:
    with ServerProxy(f"http://{host}:{port}") as proxy:
        return getattr(proxy, method)("/test", *arguments)


@pytest.fixture
def port() -> int:
    """A port that nobody uses."""
    return free_port()


@pytest.mark.parametrize("ending", [signal.SIGINT, *nightly(signal.SIGTERM)])
def test_it_prints_what_roscore_prints_and_ends_in_order(port: int, tmp_path: Path, ending: signal.Signals) -> None:
    output = tmp_path / "output"
    with roscore(port, output=output) as process:
        wait_until(lambda: "where it is to be found" in output.read_text(encoding="utf-8"), "/rosout", process)
        run_id = ask(port, "getParam", "/run_id")[2]
        assert ask(port, "getSystemState")[2][0] == [["/rosout_agg", ["/rosout"]]]
        assert ask(port, "getUri")[2] == f"http://localhost:{port}/"
        process.send_signal(ending)
        assert process.wait(PATIENCE) == 0
        assert not listens(port)
    pid = process.pid
    assert output.read_text(encoding="utf-8").splitlines() == [
        "Press Ctrl-C to interrupt",
        "ros_comm version 1.16.0",
        "",
        "",
        "SUMMARY",
        "========",
        "",
        "PARAMETERS",
        " * /rosdistro: noetic",
        " * /rosversion: 1.16.0",
        "",
        "NODES",
        "",
        "auto-starting new master",
        f"process[master]: started with pid [{pid}]",
        f"ROS_MASTER_URI=http://localhost:{port}/",
        "",
        f"setting /run_id to {run_id}",
        f"process[rosout-1]: started with pid [{pid}]",
        "started core service [/rosout]",
        (
            f"rosmini: ROS_MASTER_URI is http://localhost:11311, but this Master is at port {port}: set "
            f"ROS_MASTER_URI=http://localhost:{port}/ where it is to be found"
        ),
        "[rosout-1] killing on exit",
        "[master] killing on exit",
        "shutting down processing monitor...",
        "... shutting down processing monitor complete",
        "done",
    ]


def test_the_port_is_that_of_the_master_s_address(port: int, tmp_path: Path) -> None:
    uri = f"http://127.0.0.1:{port}"
    with start([*ROSCORE, "--core"], env=environment(ROS_MASTER_URI=uri, ROS_LOG_DIR=str(tmp_path))) as process:
        wait_until(lambda: listens(port), "roscore", process)
        assert ask(port, "getSystemState")[2] == [[], [], []]
        run_id = ask(port, "getParam", "/run_id")[2]
        assert (tmp_path / run_id).is_dir()


def test_a_second_one_is_refused_with_the_address_of_the_first(port: int, tmp_path: Path) -> None:
    with roscore(port, output=tmp_path / "first"):
        second = run([*ROSCORE, "-p", port], env=environment())
        assert second.returncode == 1
        assert second.stdout == ""
        assert "roscore cannot run as another roscore/master is already running." in second.stderr
        assert f"The ROS_MASTER_URI is http://localhost:{port}/" in second.stderr
        assert ask(port, "getPid")[0] == 1


def test_a_port_that_something_else_uses_is_refused_with_advice() -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        port = other.getsockname()[1]  # it does not listen: nobody answers there
        refused = run([*ROSCORE, "-p", port], env=environment())
    assert refused.returncode == 1
    assert f"port {port} of 127.0.0.1 is in use" in refused.stderr
    assert f"rosmini roscore -p {port + 1}" in refused.stderr


def test_somebody_shuts_the_master_down(port: int, tmp_path: Path) -> None:
    output = tmp_path / "output"
    with roscore(port, output=output) as process:
        wait_until(lambda: listens(port), "roscore", process)
        assert ask(port, "shutdown", "enough for today") == [1, "shutdown", 0]
        assert process.wait(PATIENCE) == 0
    assert "external shutdown request from [/test]: enough for today" in output.read_text(encoding="utf-8")


SHUT_DOWN_WHILE_IT_PRINTS = """
import sys
from rosmini.tools.main import main
from rosmini.tools import roscore

def introduce(graph, where, server, *, with_rosout):
    from xmlrpc.client import ServerProxy
    with ServerProxy(f"http://127.0.0.1:{server.port}") as master:
        master.shutdown("/test", "before it runs")

roscore.introduce = introduce
sys.exit(main(["roscore", *sys.argv[1:]]))
"""


def test_it_is_shut_down_before_it_runs(port: int) -> None:
    ended = run([sys.executable, "-c", SHUT_DOWN_WHILE_IT_PRINTS, "-p", str(port)], env=environment())
    assert ended.returncode == 0, ended.stderr
    assert "external shutdown request from [/test]: before it runs" in ended.stdout


def test_with_v_it_shows_what_is_registered_and_set(port: int, tmp_path: Path) -> None:
    output = tmp_path / "output"
    with roscore(port, "-v", output=output) as process:
        wait_until(lambda: listens(port), "roscore", process)
        ask(port, "registerPublisher", "/chatter", "std_msgs/String", "http://127.0.0.1:1/")
        ask(port, "registerService", "/go", "rosrpc://127.0.0.1:2", "http://127.0.0.1:1/")
        ask(port, "setParam", "/rate", 5)
        ask(port, "subscribeParam", "http://127.0.0.1:1/", "/rate")
        ask(port, "lookupNode", "/test")
        ask(port, "setParam", "", 5)
        ask(port, "unregisterPublisher", "/chatter", "http://127.0.0.1:1/")
        shown = [line for line in output.read_text(encoding="utf-8").splitlines() if line[:1] in "+-" and line]
        assert shown == [
            "+PUB [/chatter] /test http://127.0.0.1:1/",
            "+SERVICE [/go] /test http://127.0.0.1:1/",
            "+PARAM [/rate] /test",
            "+CACHEDPARAM [/rate] /test",
            "-PUB [/chatter] /test http://127.0.0.1:1/",
        ]


def test_it_is_reached_at_the_address_that_was_given(port: int, tmp_path: Path) -> None:
    output = tmp_path / "output"
    with roscore(port, "--core", "__ip:=127.0.0.2", output=output) as process:
        wait_until(lambda: listens(port, "127.0.0.2"), "roscore", process)
        assert ask(port, "getUri", host="127.0.0.2")[2] == f"http://127.0.0.2:{port}/"
        assert not listens(port)


@pytest.mark.parametrize(
    ("words", "variables", "says"),
    [
        (["-p", "0"], {}, "not the number of a port"),
        (["chatter"], {}, "roscore takes no argument 'chatter'"),
        ([], {"ROS_MASTER_URI": "localhost"}, "ROS_MASTER_URI is 'localhost', which is not the address of a Master"),
    ],
)
def test_what_makes_no_sense_is_refused(words: list[str], variables: dict[str, str], says: str) -> None:
    refused = run([*ROSCORE, *words], env=environment(**variables))
    assert refused.returncode in (1, 2)
    assert says in refused.stderr
