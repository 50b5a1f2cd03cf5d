"""One script, ``point_cloud2_peer.py``, run by the real sensor_msgs.point_cloud2 and by ours.

Skipped where there is no rospy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.ros.scripts import ScriptSpec

from .test_rospy_api import differences, run_ours, run_real

PEER = Path(__file__).with_name("point_cloud2_peer.py")


@pytest.mark.ros
def test_ours_reads_and_makes_clouds_as_ros_does(master: dict[str, str]) -> None:
    real = json.loads(run_real(master, [str(PEER)])[0].splitlines()[-1])
    assert len(real["read"]) == 60
    out, _ = run_ours(Graph(strict=False), ScriptSpec(str(PEER)))
    assert differences(real, json.loads(out.splitlines()[-1])) == {}
