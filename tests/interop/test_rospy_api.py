"""Scripts run by real rospy and by ours: names, signatures, results, errors, receipt types, connections.

Skipped where there is no rospy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from typing import Any

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.ros import rospy
from rosmini.ros.scripts import ScriptSpec, run_scripts

from ..conftest import nightly
from ..processes import run
from .conftest import SYSTEM_PYTHON

PEERS = [Path(__file__).with_name(name) for name in ("rospy_peer.py", "connections_peer.py")]
ARGUMENTS = ("chatter:=/news", "_started:=[1, x]")

DIFFERENT = {
    # rospy applies remappings to resolve_name() only once there is a node; ours are never forgotten.
    ("early", "remapped"): (["/chatter", "/news", "other"], ["/news", "/news", "other"])
}
"""What differs on purpose: (real, ours)."""


@pytest.fixture(scope="module", params=PEERS, ids=lambda peer: peer.stem)
def real(master: dict[str, str], request: pytest.FixtureRequest) -> tuple[Path, dict[str, Any]]:
    """A script, and what real rospy does in it. It waits for its Master by itself."""
    peer: Path = request.param
    return peer, plain(json.loads(run_real(master, [str(peer), *ARGUMENTS])[0].splitlines()[-1]))


def run_real(master: dict[str, str], arguments: list[str]) -> tuple[str, str]:
    done = run([SYSTEM_PYTHON, *arguments], env=master, check=True)
    return done.stdout, done.stderr


def run_ours(graph: Graph, script: ScriptSpec) -> tuple[str, str]:
    out, err = io.StringIO(), io.StringIO()
    graph.notebook = False  # nbval has imported ipykernel into this process
    result = run_scripts([script], graph=graph, stdout=out, stderr=err, prefix=False, modules=rospy.modules())
    graph.shutdown("the test is over")
    assert result.status == 0, err.getvalue()
    return out.getvalue(), err.getvalue()


def plain(value: Any) -> Any:
    """Python 3 made `b'...'` of a text that rospy forgot to decode: take the marks off."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    if isinstance(value, str) and ": b'" in value:
        return value.replace(": b'", ": ").removesuffix("'")
    return value


def differences(one: Any, other: Any, path: tuple[str, ...] = ()) -> dict[tuple[str, ...], tuple[Any, Any]]:
    if isinstance(one, dict) and isinstance(other, dict):
        found: dict[tuple[str, ...], tuple[Any, Any]] = {}
        for key in [*one, *(key for key in other if key not in one)]:
            found.update(differences(one.get(key), other.get(key), (*path, key)))
        return found
    return {} if one == other else {path: (one, other)}


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)], ids=["simulated", "wall"])
def test_ours_does_what_rospy_does(real: tuple[Path, dict[str, Any]], simulated: bool) -> None:
    peer, theirs = real
    assert len(theirs) > 10
    out, _ = run_ours(Graph(simulated=simulated, strict=False), ScriptSpec(str(peer), ARGUMENTS))
    expected = {path: pair for path, pair in DIFFERENT.items() if path[0] in theirs}
    assert differences(theirs, plain(json.loads(out.splitlines()[-1]))) == expected


LOGS = """
import rospy
from rosgraph_msgs.msg import Clock
rospy.loginfo("before: hidden")
rospy.logwarn("before %s", "init_node")
sim = {sim}
rospy.set_param("/use_sim_time", sim)
rospy.init_node("logs")
if sim:
    clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
    clock.publish(rospy.Time(42, 500000000))
    while rospy.get_time() == 0:
        rospy.rostime.wallsleep(0.01)
rospy.logdebug("hidden")
rospy.loginfo("an info %d%%", 1)
rospy.loginfo("100%")
rospy.loginfo("%(key)s", {{"key": "by name"}})
rospy.logwarn("a warning", logger_name="mine")
for count in range(4):
    rospy.logerr_once("once")
    rospy.logerr_throttle(100, "throttled")
    rospy.logerr_throttle_identical(100, "identical %d" % (count // 2))
try:
    1 / 0
except ZeroDivisionError as error:
    rospy.logfatal(error, exc_info=False)
rospy.set_param("/use_sim_time", False)
"""


@pytest.mark.ros
@pytest.mark.parametrize("sim", [False, True])
def test_log_lines_are_those_of_rospy(master: dict[str, str], sim: bool) -> None:
    source = LOGS.format(sim=sim)
    theirs = [re.sub(r"\[\d{4,}\.\d{6}", "[WALL", text) for text in run_real(master, ["-c", source])]
    script = ScriptSpec("logs", source=source)
    for simulated in (True, False):
        texts = run_ours(Graph(simulated=simulated, strict=False), script)
        assert [re.sub(r"\[\d{4,}\.\d{6}", "[WALL", text) for text in texts] == theirs
    first = theirs[0].splitlines()[0]
    assert first == ("[INFO] [WALL, 42.500000]: an info 1%" if sim else "[INFO] [WALL]: an info 1%")
