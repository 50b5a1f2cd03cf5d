"""One script, ``interactive_markers_peer.py``, with the real package and with ours: markers, callbacks, menus.

Skipped where there is no rospy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from rosmini.core.graph.graph import Graph
from rosmini.ros.scripts import ScriptSpec

from .conftest import need_ros
from .test_rospy_api import run_ours, run_real

PEER = Path(__file__).with_name("interactive_markers_peer.py")


@pytest.mark.ros
def test_ours_does_what_interactive_markers_does(master: dict[str, str]) -> None:
    need_ros(modules="interactive_markers.interactive_marker_server")
    real: dict[str, Any] = json.loads(run_real(master, [str(PEER)])[0].splitlines()[-1])
    out, _ = run_ours(Graph(strict=False), ScriptSpec(str(PEER)))
    ours = json.loads(out.splitlines()[-1])
    assert ours["handles"] == real["handles"]
    for step, expected in zip(ours["story"], real["story"], strict=True):
        assert step == expected
    told = [one for step in real["story"] for one in step["told"][0]]
    assert len(told) > 50
