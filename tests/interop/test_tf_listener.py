"""The first API of transforms: one script, run by real tf and by ours."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from rosmini.core.graph import Graph
from rosmini.ros.scripts import ScriptSpec, run_scripts

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

PEER = Path(__file__).with_name("tf_listener_peer.py")

DIFFERENT = {
    # tf 1.13 turns the velocity, which is in the frame of the observer already, once more by where the tracked frame
    # is.
    "twist": ([[1.805165, -0.041149, 0.0], [0.0, 0.0, 0.5]], [[2.0, 0.0, 0.0], [0.0, 0.0, 0.5]]),
    # Two causes at once, a time that is too late and frames that are not connected: tf2 names the first, ours the
    # second.
    "unconnected": ("ExtrapolationException", "ConnectivityException"),
}
"""What differs on purpose, or is known to: (real, ours)."""


@pytest.mark.ros
def test_ours_answers_as_real_tf() -> None:
    need_ros(modules="tf, rospy, sensor_msgs.msg")
    real = json.loads(run([SYSTEM_PYTHON, str(PEER)], check=True).stdout.splitlines()[-1])
    out = io.StringIO()
    with Graph() as graph:
        result = run_scripts([ScriptSpec(str(PEER))], graph=graph, stdin="", stdout=out, stderr=out, prefix=False)
    assert result.status == 0, out.getvalue()
    ours = json.loads(out.getvalue().splitlines()[-1])
    differing = {name: (real[name], answer) for name, answer in ours.items() if answer != real[name]}
    assert differing == DIFFERENT
    assert len(real) == len(ours) > 20
