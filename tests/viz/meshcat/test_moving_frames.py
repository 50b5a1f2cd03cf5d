"""The axes of frames in a replay in three dimensions: where they are, and how they move."""

from __future__ import annotations

import math

import numpy as np
import pytest

pytest.importorskip("meshcat")

from rosmini import Graph
from rosmini.core.tf import StaticTransformBroadcaster, TransformBroadcaster
from rosmini.core.tf.rigid import from_rpy, from_yaw
from rosmini.sim.recorder import Recorder
from rosmini.sim.simulator import Simulator
from rosmini.viz.meshcat.moving_frames import MovingFrames
from rosmini.viz.meshcat.runs import replay_3d


@pytest.fixture(scope="module")
def recording():
    """A robot that stands at (1, 2) and faces y; a mast leans forward on it, and a flag turns on the mast."""
    with Graph() as graph:
        graph.node("owner").set_param("/simulator", {"x": 1.0, "y": 2.0, "yaw": math.pi / 2})
        simulator = Simulator(graph.node("simulator"), world="empty")
        recorder = Recorder(graph, simulator, layers=True)
        mast = StaticTransformBroadcaster(graph.node("mast"))
        mast.send_rigid("base_footprint", "mast", from_rpy((0.1, 0.0, 0.3), 0.0, 0.5, 0.0))
        flag = TransformBroadcaster(graph.node("flag"))

        def turn(_event):
            now = graph.now()
            flag.send_rigid("mast", "flag", from_yaw(0.0, 0.0, now.to_sec()), now)

        flag.node.timer(0.1, turn)
        graph.run(5.0)
        return recorder.recording()


def test_frames_are_where_the_robot_carries_them(recording):
    frames = MovingFrames(recording)
    assert {"odom", "base_footprint", "mast", "flag"} <= frames.poses.keys()
    x, y, z, *turn = frames.poses["mast"][-1]
    assert (x, y, z) == pytest.approx((1.0, 2.1, 0.3), abs=0.01)
    leans = from_rpy((0, 0, 0), 0.0, 0.5, math.pi / 2)[3:]
    assert abs(float(np.dot(turn, leans))) == pytest.approx(1.0, abs=1e-3)


def test_only_the_topic_tf_shows_axes(recording):
    view = replay_3d(recording, topics=["/tf"])
    assert "frames: base_footprint, flag, mast, odom" in view.text
    turned = [motion for motion in view.scene.motions if motion.path.endswith("frames/flag")]
    assert [motion.name for motion in turned] == ["position", "quaternion"]
    steps = np.diff(turned[1].values, axis=0)
    assert np.abs(steps).max() < 0.5, "the sign of a quaternion changes"
    assert "frames:" not in replay_3d(recording).text
