"""One script, ``tf2_ros_peer.py``, with the real tf2_ros and with ours: registered types, the buffer without a node.

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

PEER = Path(__file__).with_name("tf2_ros_peer.py")


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_ours_does_what_tf2_ros_does(master: dict[str, str], simulated: bool) -> None:
    real = json.loads(run_real(master, [str(PEER)])[0].splitlines()[-1])
    out, _ = run_ours(Graph(simulated=simulated, strict=False), ScriptSpec(str(PEER)))
    assert differences(real, json.loads(out.splitlines()[-1])) == {}
