"""RobotModel: links where tf says that they are, and robots that cannot be read."""

import numpy as np
import pytest

URDF = """<robot name="two">
  <link name="base"><visual><geometry><box size="1 1 1"/></geometry>
    <material name="r"><color rgba="1 0 0 1"/></material></visual></link>
  <link name="arm"><visual><geometry><sphere radius="0.5"/></geometry></visual>
    <collision><geometry><box size="2 2 2"/></geometry></collision></link>
  <link name="empty"/>
  <joint name="j" type="fixed"><parent link="base"/><child link="arm"/></joint>
  <joint name="k" type="fixed"><parent link="base"/><child link="empty"/></joint>
</robot>"""


@pytest.fixture
def robot(stage):
    stage.node.set_param("/robot_description", URDF)
    scene = stage.scene()
    display = scene.add("RobotModel")
    stage.place("map", "base", (1.0, 0.0, 0.0))
    stage.place("base", "arm", (0.0, 2.0, 0.0))
    stage.graph.run(0.1)
    return scene, display


def test_links_are_where_tf_says(robot, statuses):
    scene, display = robot
    base, arm = scene.update()[0].primitives
    assert base.placed.min(axis=0) == pytest.approx([0.5, -0.5, -0.5])
    assert base.colours.tolist() == [1, 0, 0, 1]
    assert arm.placed.mean(axis=0) == pytest.approx([1.0, 2.0, 0.0], abs=0.05)
    assert statuses(display) == {
        "URDF": ("Ok", "URDF parsed OK"), "base": ("Ok", "Transform OK"), "arm": ("Ok", "Transform OK"),
    }  # fmt: skip


def test_alpha_collisions_and_single_links(robot):
    scene, display = robot
    display["Alpha"] = 0.5
    display["Links"] = {"All Links Enabled": True, "base": {"Value": False}, "arm": {"Alpha": 0.5}}
    (arm,) = scene.update()[0].primitives
    assert arm.colours[3] == 0.25
    display["Visual Enabled"], display["Collision Enabled"] = False, True
    (arm,) = scene.update()[0].primitives
    assert np.ptp(arm.vertices, axis=0) == pytest.approx([2, 2, 2])


def test_a_link_without_a_transform_is_named(stage, statuses):
    stage.node.set_param("/robot_description", URDF)
    scene = stage.scene()
    display = scene.add("RobotModel")
    stage.place("map", "base")
    stage.graph.run(0.1)
    assert len(scene.update()[0].primitives) == 1
    assert statuses(display)["arm"] == ("Error", "No transform from [arm] to [map]")


def test_without_a_description_or_with_a_wrong_one(stage, statuses):
    scene = stage.scene()
    display = scene.add("RobotModel")
    assert scene.update()[0].primitives == ()
    said = "Parameter [robot_description] does not exist, and was not found by searchParam()"
    assert statuses(display)["URDF"] == ("Error", said)
    stage.node.set_param("/robot_description", "<robot name='x'><link/></robot>")
    scene.update()
    assert statuses(display)["URDF"][0] == "Error"
    stage.node.set_param("/robot_description", URDF)
    stage.place("map", "base")
    stage.graph.run(0.1)
    assert len(scene.update()[0].primitives) == 1  # it is read again by itself


def test_a_mesh_that_is_missing_leaves_the_rest_of_the_robot(stage, statuses):
    broken = URDF.replace('<sphere radius="0.5"/>', '<mesh filename="package://nowhere/arm.stl"/>')
    stage.node.set_param("/robot_description", broken)
    scene = stage.scene()
    display = scene.add("RobotModel")
    stage.place("map", "base")
    stage.place("base", "arm")
    stage.graph.run(0.1)
    assert len(scene.update()[0].primitives) == 1
    assert statuses(display)["URDF"][0] == "Error"
    assert "nowhere" in statuses(display)["URDF"][1]
