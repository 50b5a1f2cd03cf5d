"""One script, ``message_filters_peer.py``, with the real package and with ours: filters, caches, clocks that jump.

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
from .conftest import need_ros
from .test_rospy_api import differences, run_ours, run_real

PEER = Path(__file__).with_name("message_filters_peer.py")


@pytest.fixture(scope="module")
def real(master: dict[str, str]) -> dict[str, Any]:
    need_ros(modules="message_filters")
    return dict(json.loads(run_real(master, [str(PEER)])[0].splitlines()[-1]))


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_ours_does_what_message_filters_does(real: dict[str, Any], simulated: bool) -> None:
    assert min(real["sets"]) > 500
    assert all(real["jumps"].values())
    out, _ = run_ours(Graph(simulated=simulated, strict=False), ScriptSpec(str(PEER)))
    assert differences(real, json.loads(out.splitlines()[-1])) == {}
