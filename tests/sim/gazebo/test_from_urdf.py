"""A URDF becomes the SDF model that Gazebo makes of it."""

from pathlib import PurePosixPath, PureWindowsPath

import pytest

from rosmini.core.markup import parse
from rosmini.sim import sdf
from rosmini.sim import urdf as urdf_package
from rosmini.sim.gazebo.body import Body
from rosmini.sim.gazebo.from_urdf import from_urdf
from rosmini.sim.gazebo.to_sdf import to_sdf
from rosmini.sim.sdf.document import ORIGIN, SdfGeometry, SdfLink, SdfModel, SdfVisual

from .conftest import urdf


def converted(text):
    return from_urdf(urdf_package.load(text))


def test_fixed_joints_are_lumped():
    found = converted(urdf())
    model = found.model
    assert [link.name for link in model.links] == ["base_footprint", "left", "right"]
    assert [joint.name for joint in model.joints] == ["left_wheel", "right_wheel"]
    assert found.frames["laser"] == ("base_footprint", pytest.approx((0, 0, 0.2, 0, 0, 0)))
    base = model.links[0]
    assert base.collisions[0].name == "base_footprint_fixed_joint_lump__base_link_collision"
    assert base.inertial.mass == 2.0
    assert base.inertial.inertia[:3] == pytest.approx((0.01, 0.01, 0.02))
    assert base.sensors[0].pose == pytest.approx((0, 0, 0.2, 0, 0, 0))


def test_a_fixed_joint_can_be_kept():
    kept = urdf('<gazebo reference="base_joint"><preserveFixedJoint>true</preserveFixedJoint></gazebo>')
    assert [link.name for link in converted(kept).model.links] == ["base_footprint", "base_link", "left", "right"]


def test_masses_that_are_lumped_obey_the_theorem_of_parallel_axes():
    link = """<link name="{}"><inertial><mass value="1"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
    text = f"""<robot name="r">{link.format("a")}{link.format("b")}
      <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="2 0 0"/></joint></robot>"""
    inertial = converted(text).model.links[0].inertial
    assert inertial.mass == 2.0
    assert inertial.pose[:3] == pytest.approx((1, 0, 0))
    assert inertial.inertia[:3] == pytest.approx((0.2, 2.2, 2.2))


def test_an_sdf_text_of_it_reads_back_the_same():
    model = converted(urdf()).model
    again = sdf.load(to_sdf(model)).models[0]
    assert [link.name for link in again.links] == [link.name for link in model.links]
    for one, other in zip(again.links, model.links, strict=True):
        assert one.pose == pytest.approx(other.pose, abs=1e-8)
        assert one.inertial.mass == pytest.approx(other.inertial.mass)
        assert [each.name for each in one.collisions] == [each.name for each in other.collisions]
        assert [each.pose for each in one.sensors] == [pytest.approx(each.pose) for each in other.sensors]
    assert [plugin.filename for plugin in again.plugins] == ["libgazebo_ros_diff_drive.so"]
    assert [joint.type for joint in again.joints] == ["revolute", "revolute"]


def test_the_engine_learns_wheels_mass_and_outline():
    body = Body(converted(urdf(axle=0.1)).model)
    body.set_wheels("left_wheel", "right_wheel", 0.3, 0.05)
    robot = body.robot_model()
    assert body.axle == pytest.approx((0.1, 0, 0))
    assert robot.mass == pytest.approx(2.2)
    # the box about its own axis and 0.1 m behind the axle; the wheels 0.15 m aside, whose axis lies
    assert robot.inertia == pytest.approx(0.02 + 2.0 * 0.01 + 2 * (1e-4 + 0.1 * 0.15**2))
    xs, ys = zip(*robot.footprint, strict=True)
    assert (min(xs), max(xs)) == pytest.approx((-0.25, 0.05))
    assert (min(ys), max(ys)) == pytest.approx((-0.16, 0.16))
    assert robot.height == pytest.approx(0.15)
    assert not body.notes


def test_wheels_that_are_elsewhere_than_the_plugin_says_are_noted():
    body = Body(converted(urdf()).model)
    body.set_wheels("left_wheel", "right_wheel", 0.4, 0.05)
    assert "0.300 m apart, but its plugin says 0.4 m" in body.notes[0]


@pytest.mark.parametrize(
    ("mesh", "uri"),
    [
        (None, ""),
        (PurePosixPath("/meshes/a b.dae"), "file:///meshes/a b.dae"),
        (PureWindowsPath("C:/a.dae"), "file:///C:/a.dae"),
    ],
)
def test_the_address_of_a_mesh_in_sdf(mesh, uri):
    visual = SdfVisual("v", ORIGIN, SdfGeometry("mesh", mesh=mesh))
    root = parse(to_sdf(SdfModel("m", links=(SdfLink("l", visuals=(visual,)),))))
    found = [each.text for each in root.walk() if each.tag == "uri"]
    assert found == ([uri] if uri else [])
