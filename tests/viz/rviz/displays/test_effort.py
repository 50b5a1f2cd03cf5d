"""Effort: circles around joints, by their efforts and limits."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class

JointState = message_class("sensor_msgs/JointState")
URDF = """<robot name="r"><link name="base"/><link name="arm"/><link name="lift"/>
<joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="base"/><child link="lift"/>
<limit lower="-1" upper="1" effort="10" velocity="1"/></joint></robot>"""


@pytest.fixture
def drawn(stage, statuses):
    stage.node.set_param("/robot_description", URDF)
    scene, display = stage.display("Effort", "/joint_states")
    stage.place("map", "arm", (3.0, 0.0, 1.0))
    stage.graph.run(0.1)

    def draw(efforts, names=("elbow", "slide")):
        stage.publish("/joint_states", JointState(name=names, effort=efforts))
        return scene.update()[0].primitives, statuses(display)

    draw.display, draw.stage = display, stage
    return draw


def test_a_circle_around_the_axis_is_wider_the_nearer_the_limit(drawn):
    (circle, head), said = drawn([5.0, 5.0])
    radii = np.linalg.norm(circle.points[:, :2] - (3.0, 0.0), axis=1)
    assert radii == pytest.approx(np.full(30, 0.05 + 0.5 * 0.55))
    assert circle.points[:, 2] == pytest.approx(np.ones(30))
    assert head.colours == pytest.approx(circle.colours)
    assert said["elbow"] == ("Ok", "5 N m of 10")
    assert said["URDF"] == ("Ok", "URDF parsed OK")
    (wide, _), _ = drawn([-99.0, 0.0])
    assert np.linalg.norm(wide.points[0, :2] - (3.0, 0.0)) == pytest.approx(0.05 + 0.5 * 1.05)
    assert wide.colours[:3] == pytest.approx(np.array((1.0, 0.0, 0.0)))


def test_the_direction_is_that_of_the_effort(drawn):
    (left, _), _ = drawn([5.0, 0.0])
    (right, _), _ = drawn([-5.0, 0.0])
    turns = [np.cross(each.points[0] - (3, 0, 1), each.points[1] - (3, 0, 1))[2] for each in (left, right)]
    assert turns[0] * turns[1] < 0


def test_joints_can_be_hidden_and_are_unknown_quietly(drawn):
    assert not drawn([1.0], ["knee"])[0]
    drawn.display["Joints"] = {"elbow": False}
    assert not drawn([5.0, 5.0])[0]


def test_what_is_wrong_is_said(drawn):
    assert "different joint names and efforts size" in drawn([1.0])[1]["Topic"][1]
    assert "nans or infs" in drawn([math.nan, 1.0])[1]["Topic"][1]
    drawn.stage.node.set_param("/robot_description", "/etc/hostname")
    found, said = drawn([1.0, 1.0])
    assert (len(found), said["URDF"][0]) == (0, "Error")
    drawn.stage.node.delete_param("/robot_description")
    assert "does not exist, and was not found by searchParam()" in drawn([1.0, 1.0])[1]["URDF"][1]
