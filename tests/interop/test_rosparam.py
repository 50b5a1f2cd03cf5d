"""One script, ``rosparam_peer.py``, run by real ROS and by ours: YAML, merging, listing, deleting, dumping, printing."""

from __future__ import annotations

import io
import json
import os
import shutil
import signal
import socket
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rosmini import rospy
from rosmini.graph.graph import Graph
from rosmini.rosparam import ParamClient
from rosmini.scripts import ScriptSpec, run_scripts

if TYPE_CHECKING:
    from collections.abc import Iterator

PEER = Path(__file__).with_name("rosparam_peer.py")
SYSTEM_PYTHON = "/usr/bin/python3"


@pytest.fixture(scope="module")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The environment of a real Master on a free port."""
    missing = [what for what in ("rosmaster", "rosparam", SYSTEM_PYTHON) if shutil.which(what) is None]
    if missing:
        if os.environ.get("ROSMINI_REQUIRE_ROS"):
            pytest.fail(f"ROSMINI_REQUIRE_ROS is set, but there is no {missing[0]}")
        pytest.skip(f"there is no {missing[0]}: real ROS 1 is not installed")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    found = {
        "PATH": os.environ["PATH"],
        "HOME": str(tmp_path_factory.mktemp("ros")),
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
    }
    process = subprocess.Popen(
        ["rosmaster", "--core", "-p", str(port)],
        env=found,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        run(found, SYSTEM_PYTHON, "-c", "import rospy; rospy.init_node('probe')")  # it waits for its Master
        yield found
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(10)


def run(environment: dict[str, str], *command: str) -> str:
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.ros
def test_files_go_in_and_come_out_as_with_the_real_tool(master: dict[str, str], tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(
        "a: 1\nb: [1, 2.5, three]\nc: {d: true, e: str, f: rad(pi)}\ntext: |\n  x\n  y\n---\n_ns: sub\nz: -1\n"
    )
    with Graph() as graph:
        params = ParamClient(graph)
        params.load(path, "/loaded")
        params.set("/loaded/c", "{g: 1e5, h: 1.0e-7, i: ''}")
        run(master, "rosparam", "load", str(path), "/loaded")
        run(master, "rosparam", "set", "/loaded/c", "{g: 1e5, h: 1.0e-7, i: ''}")
        assert "\n".join(params.list_params("/loaded")) + "\n" == run(master, "rosparam", "list", "/loaded")
        run(master, "rosparam", "dump", str(tmp_path / "real.yaml"), "/loaded")
        assert params.dumps("/loaded") == (tmp_path / "real.yaml").read_text()
        for name in ("/loaded/b", "/loaded/c", "/loaded/c/f", "/loaded/text", "/loaded/sub/z"):
            # The tool ends its output with one more line end than the YAML needs.
            assert params.dumps(name).rstrip("\n") == run(master, "rosparam", "get", name).rstrip("\n")
    run(master, "rosparam", "delete", "/loaded")


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, False], ids=["simulated", "wall"])
def test_the_module_does_what_the_real_one_does(master: dict[str, str], simulated: bool) -> None:
    real = json.loads(run(master, SYSTEM_PYTHON, str(PEER)).splitlines()[-1])
    graph = Graph(simulated=simulated, strict=False)
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
    ours = json.loads(out.getvalue().splitlines()[-1])
    assert len(real) > 25
    assert ours == real
