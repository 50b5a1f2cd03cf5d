"""One script, ``rosparam_peer.py``, with real ROS and with ours: YAML, merging, listing, deleting, dumping."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.core.rosparam import ParamClient
from rosmini.ros import rospy
from rosmini.ros.scripts import ScriptSpec, run_scripts

from ..conftest import nightly
from ..processes import run
from .conftest import SYSTEM_PYTHON

PEER = Path(__file__).with_name("rosparam_peer.py")


def real(environment: dict[str, str], *command: str) -> str:
    return str(run(command, env=environment, check=True).stdout)


@pytest.mark.ros
def test_files_go_in_and_come_out_as_with_the_real_tool(master: dict[str, str], tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(
        "a: 1\nb: [1, 2.5, three]\nc: {d: true, e: str, f: rad(pi)}\ntext: |\n  x\n  y\n---\n_ns: sub\nz: -1\n",
        encoding="utf-8",
    )
    with Graph() as graph:
        params = ParamClient(graph)
        params.load(path, "/loaded")
        params.set("/loaded/c", "{g: 1e5, h: 1.0e-7, i: ''}")
        real(master, "rosparam", "load", str(path), "/loaded")
        real(master, "rosparam", "set", "/loaded/c", "{g: 1e5, h: 1.0e-7, i: ''}")
        assert "\n".join(params.list_params("/loaded")) + "\n" == real(master, "rosparam", "list", "/loaded")
        real(master, "rosparam", "dump", str(tmp_path / "real.yaml"), "/loaded")
        assert params.dumps("/loaded") == (tmp_path / "real.yaml").read_text(encoding="utf-8")
        for name in ("/loaded/b", "/loaded/c", "/loaded/c/f", "/loaded/text", "/loaded/sub/z"):
            # The tool ends its output with one more line end than the YAML needs.
            assert params.dumps(name).rstrip("\n") == real(master, "rosparam", "get", name).rstrip("\n")
    real(master, "rosparam", "delete", "/loaded")


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_the_module_does_what_the_real_one_does(master: dict[str, str], simulated: bool) -> None:
    theirs = json.loads(real(master, SYSTEM_PYTHON, str(PEER)).splitlines()[-1])
    graph = Graph(simulated=simulated, strict=False)
    graph.notebook = False  # nbval has imported ipykernel into this process
    out, err = io.StringIO(), io.StringIO()
    result = run_scripts(
        [ScriptSpec(str(PEER), ())], graph=graph, stdout=out, stderr=err, prefix=False, modules=rospy.modules()
    )
    graph.shutdown("the test is over")
    assert result.status == 0, err.getvalue()
    ours = json.loads(out.getvalue().splitlines()[-1])
    assert len(theirs) > 25
    assert ours == theirs
