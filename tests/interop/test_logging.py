"""One script, ``logging_peer.py``, run by real ROS and by ours: loggers, levels set by service, the log file, the console."""

from __future__ import annotations

import io
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rosmini import rospy
from rosmini.graph.graph import Graph
from rosmini.scripts import ScriptSpec, run_scripts

if TYPE_CHECKING:
    from collections.abc import Iterator

PEER = Path(__file__).with_name("logging_peer.py")
SYSTEM_PYTHON = "/usr/bin/python3"


@pytest.fixture(scope="module")
def real(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str, str]]:
    """What real rospy writes: standard output, standard error, log file."""
    missing = [what for what in ("rosmaster", SYSTEM_PYTHON) if shutil.which(what) is None]
    if missing:
        if os.environ.get("ROSMINI_REQUIRE_ROS"):
            pytest.fail(f"ROSMINI_REQUIRE_ROS is set, but there is no {missing[0]}")
        pytest.skip(f"there is no {missing[0]}: real ROS 1 is not installed")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    home = tmp_path_factory.mktemp("ros")
    found = {
        "PATH": os.environ["PATH"],
        "HOME": str(home),
        "ROS_LOG_DIR": str(home / "logs"),
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "PYTHONIOENCODING": "utf-8",
        "LANG": "C.UTF-8",
    }
    process = subprocess.Popen(
        ["rosmaster", "--core", "-p", str(port)],
        env=found,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        wait_for(port)  # rospy waits for its Master by itself, but says so
        done = subprocess.run(
            [SYSTEM_PYTHON, str(PEER)], env=found, capture_output=True, text=True, check=False, timeout=60
        )
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(10)
    assert done.returncode == 0, done.stderr
    return done.stdout, done.stderr, (home / "logs" / "peer.log").read_text(encoding="utf-8")


def wait_for(port: int) -> None:
    """Block until somebody answers at a port."""
    deadline = time.monotonic() + 60
    while True:
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return
        assert time.monotonic() < deadline, "rosmaster does not answer"
        time.sleep(0.05)


def users_lines(text: str) -> list[str]:
    """The lines of a log file that the script's own calls made, without their times."""
    entries = re.split(r"^(?=\[[a-z.]+\]\[[A-Z]+\] )", text, flags=re.MULTILINE)
    kept = [entry for entry in entries if entry.startswith(("[rosout", "[rospy.internal]"))]
    return [re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d,\d{3}", "TIME", entry) for entry in kept]


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, False], ids=["simulated", "wall"])
def test_loggers_levels_and_files(real: tuple[str, str, str], simulated: bool, tmp_path: Path) -> None:
    graph = Graph(simulated=simulated, strict=False, log_dir=tmp_path)
    graph.notebook = False  # nbval has imported ipykernel into this process
    out, err = io.StringIO(), io.StringIO()
    result = run_scripts(
        [ScriptSpec(str(PEER), ())],
        graph=graph,
        stdout=out,
        stderr=err,
        prefix=False,
        modules=rospy.modules(),
    )
    graph.shutdown("the test is over")
    assert result.status == 0, err.getvalue()
    stdout, stderr, file = real
    assert json.loads(out.getvalue().splitlines()[-1]) == json.loads(stdout.splitlines()[-1])
    (ours,) = tmp_path.glob("*/peer-*.log")
    expected = users_lines(file)
    assert len(expected) > 10
    assert users_lines(ours.read_text(encoding="utf-8")) == expected
    for mine, theirs in ((out.getvalue(), stdout), (err.getvalue(), stderr)):
        assert re.sub(r"\[\d{4,}\.\d{6}\]", "[T]", mine) == re.sub(r"\[\d{4,}\.\d{6}\]", "[T]", theirs)
