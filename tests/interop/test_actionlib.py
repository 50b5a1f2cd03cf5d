"""One script, ``actionlib_peer.py``, with real actionlib and with ours: both machines and the simple ones.

Skipped where there is no rospy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.ros.scripts import ScriptSpec

from ..conftest import nightly
from .test_rospy_api import differences, run_ours, run_real

PEER = Path(__file__).with_name("actionlib_peer.py")


@pytest.fixture(scope="module")
def real(master: dict[str, str]) -> dict[str, Any]:
    return dict(json.loads(run_real(master, [str(PEER)])[0].splitlines()[-1]))


DIFFERENT: dict[tuple[str, ...], tuple[Any, Any]] = {}
"""What differs on purpose: (real, ours)."""


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_ours_does_what_actionlib_does(real: dict[str, Any], simulated: bool) -> None:
    assert len(real["client"]) == 72
    assert len(real["server"]) == 54
    out, _ = run_ours(Graph(simulated=simulated, strict=False), ScriptSpec(str(PEER)))
    assert differences(real, json.loads(out.splitlines()[-1])) == DIFFERENT


SERVER_PEER = Path(__file__).with_name("actionlib_server_peer.py")


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_cancellations_and_the_list_of_goals_are_those_of_actionlib(master: dict[str, str], simulated: bool) -> None:
    real = json.loads(run_real(master, [str(SERVER_PEER)])[0].splitlines()[-1])
    assert len([name for name in real if name.startswith("cancel ")]) == 25
    out, _ = run_ours(Graph(simulated=simulated, strict=False), ScriptSpec(str(SERVER_PEER)))
    assert differences(real, json.loads(out.splitlines()[-1])) == {}
