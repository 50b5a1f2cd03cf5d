"""Pads for chosen robots of the three simulators."""

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.sim.engine import RobotGone
from rosmini.sim.gazebo.errors import UnknownEntity
from rosmini.viz.live.key_maps import TeleopError
from rosmini.viz.live.live import Link
from rosmini.viz.live.page import pad_data
from rosmini.viz.live.teleop import Limits

CAR = (
    '<sdf version="1.6"><model name="{name}"><link name="link"><inertial><mass>1</mass></inertial>'
    '<collision name="c"><geometry>'
    "<box><size>0.4 0.4 0.4</size></box></geometry></collision></link>"
    '<plugin name="drive" filename="libgazebo_ros_planar_move.so">'
    "<robotNamespace>{name}</robotNamespace></plugin></model></sdf>"
)


@pytest.fixture
def four(graph):
    return rosrun(
        "stage_ros", "stageros", "package://stage_ros/world/willow-four-erratics.world", graph=graph
    ).instance()


def test_a_chosen_robot_of_stage_is_driven_and_seen(four, graph):
    pad = four.pad("robot_1")
    assert (pad.topic, pad.node.name) == ("/robot_1/cmd_vel", "/robot_1/teleop_pad")
    before = four.truth("robot_1")
    pad.press("w", times=20)
    graph.run(4.0)
    assert four.truth("robot_1")[0] > before[0] + 0.4
    assert four.truth("robot_0") == (0.0, 0.0, 0.0)
    assert "era2 at (2." in pad.text
    assert pad.text.endswith("beams hit")
    pad.reset()
    graph.run(0.5)
    assert four.truth("robot_1") == pytest.approx(before)


def test_the_page_knows_the_fan_of_the_laser_and_the_other_robots(four):
    pad = four.pad("robot_1")
    data = pad_data(pad)
    laser, model = data["scene"]["robot"]["lidar"], four.robot("robot_1").model.laser
    assert laser["start"] == pytest.approx(model.angle_min)
    assert laser["start"] + laser["step"] * (laser["beams"] - 1) == pytest.approx(model.angle_max, abs=1e-4)
    assert len(data["scene"]["shapes"]) >= 3
    assert data["pose"] == [2.0, 0.0, 0.0]


def test_the_live_page_of_a_chosen_robot_gets_its_scans(four, graph):
    pad = four.pad("robot_2")
    sent = []
    link = Link(pad, clock=lambda: 0.0)
    link.widget.send = lambda content, buffers=None: sent.append((content, buffers or []))
    link._begin()
    graph.run(0.35)
    link._show(1.0)
    scans = [buffers[1] for content, buffers in sent if content.get("scan")]
    beams = four.robot("robot_2").model.laser.beams
    last = np.frombuffer(scans[-1], dtype=np.float32)
    assert last[:beams] == pytest.approx(np.asarray(four.last_scan("robot_2").ranges, dtype=np.float32))
    assert last[beams:].reshape(beams, 3) == pytest.approx(np.tile(four.truth("robot_2"), (beams, 1)))


def test_what_is_no_robot_is_said(four, graph):
    with pytest.raises(RobotGone, match="no robot 'robot_9'"):
        four.pad("robot_9")
    server = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
    with pytest.raises(TeleopError, match="subscribes to velocities; robots that can: none"):
        server.pad()


def test_a_model_of_gazebo_is_driven(graph):
    server = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
    server.spawn(CAR.format(name="a"), "a", (0.0, 0.0, 0.0))
    server.spawn(CAR.format(name="b"), "b", (0.0, 2.0, 0.0))
    pad = server.pad("b")
    assert pad.topic == "/b/cmd_vel"
    assert pad.teleop.limits == Limits()
    pad.press("w", times=10)
    graph.run(2.0)
    assert server.truth("b")[0] > 0.1
    assert server.truth("a") == (0.0, 0.0, 0.0)
    assert server.pad().topic == "/a/cmd_vel"
    with pytest.raises(UnknownEntity, match="no model 'c'"):
        server.pad("c")


def test_what_is_not_on_two_wheels_does_not_move_by_itself_in_the_book(graph, monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    omni = rosrun("stage_ros", "stageros", "package://stage_ros/world/omni.world", graph=graph).instance()
    assert "rosminiPad" not in omni.pad().html
    wheels = rosrun("stage_ros", "stageros", "package://stage_ros/world/boxes.world", graph=graph).instance()
    assert "rosminiPad" in wheels.pad().html
