"""One script, ``dynamic_reconfigure_peer.py``, with the real package and with ours, and a module of a .cfg file.

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

PEER = Path(__file__).with_name("dynamic_reconfigure_peer.py")
GENERATED = Path("/usr/lib/python3/dist-packages/dynamic_reconfigure/cfg/TestConfig.py")


@pytest.fixture(scope="module")
def real(master: dict[str, str]) -> dict[str, Any]:
    need_ros(modules="dynamic_reconfigure")
    return dict(json.loads(run_real(master, [str(PEER), str(GENERATED)])[0].splitlines()[-1]))


@pytest.mark.ros
@pytest.mark.parametrize("simulated", [True, *nightly(False)])
def test_ours_does_what_dynamic_reconfigure_does(real: dict[str, Any], simulated: bool) -> None:
    assert len(real["changes"]) == 10
    script = ScriptSpec(str(PEER), (str(GENERATED),))
    out, _ = run_ours(Graph(simulated=simulated, strict=False), script)
    assert differences(real, json.loads(out.splitlines()[-1])) == {}
