"""One script, ``fill_peer.py``, with real genpy and with ours: messages filled, checked, printed, published.

Skipped where there is no rospy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.ros.scripts import ScriptSpec

from ..conftest import nightly
from .test_rospy_api import differences, run_ours, run_real

PEER = Path(__file__).with_name("fill_peer.py")


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_ours_does_what_genpy_does(master: dict[str, str], simulated: bool) -> None:
    real = json.loads(run_real(master, [str(PEER)])[0].splitlines()[-1])
    out, _ = run_ours(Graph(simulated=simulated, strict=False), ScriptSpec(str(PEER)))
    ours = json.loads(out.splitlines()[-1])
    assert differences(real, ours) == {}
