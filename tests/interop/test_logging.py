"""One script, ``logging_peer.py``, with real ROS and with ours: loggers, levels, the log file, the console."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.ros import rospy
from rosmini.ros.scripts import ScriptSpec, run_scripts

from ..conftest import nightly
from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros, rosmaster

if TYPE_CHECKING:
    from collections.abc import Iterator

PEER = Path(__file__).with_name("logging_peer.py")


@pytest.fixture(scope="module")
def real(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str, str]]:
    """What real rospy writes: standard output, standard error, log file."""
    need_ros("rosmaster", modules="rospy")
    home = tmp_path_factory.mktemp("ros")
    with rosmaster(home) as found:  # rospy waits for its Master by itself, but says so
        found = {**found, "ROS_LOG_DIR": str(home / "logs"), "LANG": "C.UTF-8"}
        done = run([SYSTEM_PYTHON, PEER], env=found)
    assert done.returncode == 0, done.stderr
    return done.stdout, done.stderr, (home / "logs" / "peer.log").read_text(encoding="utf-8")


def users_lines(text: str) -> list[str]:
    """The lines of a log file that the script's own calls made, without their times."""
    entries = re.split(r"^(?=\[[a-z.]+\]\[[A-Z]+\] )", text, flags=re.MULTILINE)
    kept = [entry for entry in entries if entry.startswith(("[rosout", "[rospy.internal]"))]
    return [re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d,\d{3}", "TIME", entry) for entry in kept]


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_loggers_levels_and_files(real: tuple[str, str, str], simulated: bool, tmp_path: Path) -> None:
    graph = Graph(simulated=simulated, strict=False, log_dir=tmp_path)
    graph.notebook = False  # nbval has imported ipykernel into this process
    out, err = io.StringIO(), io.StringIO()
    result = run_scripts(
        [ScriptSpec(str(PEER), ())], graph=graph, stdout=out, stderr=err, prefix=False, modules=rospy.modules()
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
