import math

import numpy as np
import pytest

from rosmini.core.packages import PackageIndex
from rosmini.sim.urdf import Box, Cylinder, Mesh, Sphere, UrdfError, load
from rosmini.sim.urdf.errors import UnknownJoint

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <material name="blue"><color rgba="0 0 0.8 1"/></material>
  <link name="base"/>
  <link name="upper">
    <inertial><origin xyz="0 0 .5"/><mass value="2"/>
      <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.01"/></inertial>
    <visual name="tube"><origin xyz="0 0 0.5" rpy="0 0 1"/>
      <geometry><cylinder radius="0.1" length="1"/></geometry><material name="blue"/></visual>
    <visual><geometry><box size="1 2 3"/></geometry><material name="red"><color rgba="1 0 0 .5"/></material></visual>
    <collision><geometry><sphere radius="0.2"/></geometry></collision>
  </link>
  <link name="lower"/>
  <link name="slide"/>
  <link name="finger"><visual><geometry><box size="1 1 1"/></geometry><material name="red"/></visual></link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/>
    <origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><axis xyz="0 2 0"/>
    <limit lower="-1" upper="2" effort="5" velocity="3"/><dynamics damping="0.1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/><child link="lower"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <mimic joint="shoulder" multiplier="-2" offset="0.5"/>
  </joint>
  <joint name="lift" type="prismatic">
    <parent link="lower"/><child link="slide"/><axis xyz="0 0 1"/>
    <limit lower="0.2" upper="0.4" effort="1" velocity="1"/>
  </joint>
  <joint name="grip" type="fixed"><parent link="slide"/><child link="finger"/></joint>
  <gazebo reference="upper"><mu1>0.1</mu1></gazebo>
  <gazebo><plugin name="p" filename="libx.so"/></gazebo>
</robot>
"""


def test_links_joints_and_materials():
    arm = load(ARM)
    assert repr(arm) == "Robot('arm', 5 links, 4 joints)"
    assert arm.root == "base"
    assert [joint.name for joint in arm.order] == ["shoulder", "elbow", "lift", "grip"]
    upper = arm.link("upper")
    assert upper.inertial.mass == arm.mass == 2.0
    assert upper.inertial.origin.xyz == (0, 0, 0.5)
    assert np.array_equal(upper.inertial.matrix, np.diag([0.2, 0.2, 0.01]))
    assert [visual.geometry for visual in upper.visuals] == [Cylinder(0.1, 1.0), Box((1, 2, 3))]
    assert upper.visuals[0].material.colour == (0, 0, 0.8, 1)
    assert (upper.visuals[0].name, upper.visuals[0].origin.rpy) == ("tube", (0, 0, 1))
    assert upper.collisions[0].geometry == Sphere(0.2)
    assert arm.link("finger").visuals[0].material.colour == (1, 0, 0, 0.5)  # as the earlier link called it
    shoulder = arm.joint("shoulder")
    assert shoulder.axis == (0, 1, 0)
    assert (shoulder.limit.lower, shoulder.limit.upper) == (-1, 2)
    assert shoulder.dynamics.damping == 0.1
    assert arm.children("upper") == ["lower"]
    assert [each.reference for each in arm.extensions] == ["upper", ""]
    assert arm.extensions[1].element.need("plugin").get("filename") == "libx.so"
    assert arm.notes == ()


def test_transforms_by_hand():
    arm = load(ARM)
    at = arm.transforms({"shoulder": 0.25})
    # A quarter turn about z, then 0.25 about the new y; mimicking takes the elbow back by -2 * 0.25 + 0.5 = 0.
    assert at["upper"][:3, 3] == pytest.approx([0, 0, 1])
    assert at["lower"][:3, 3] == pytest.approx([0, math.sin(0.25), 1 + math.cos(0.25)])
    assert at["lower"][:3, :3] == pytest.approx(at["upper"][:3, :3])
    # 0 is below the limits of the lift, which then stands in their middle.
    along = at["lower"][:3, 2] * 0.3
    assert at["slide"][:3, 3] - at["lower"][:3, 3] == pytest.approx(along)
    assert at["finger"] == pytest.approx(at["slide"])
    assert arm.positions() == {"shoulder": 0.0, "elbow": 0.5, "lift": pytest.approx(0.3)}
    assert arm.positions({"elbow": 9, "shoulder": 1})["elbow"] == -1.5  # a mimic follows, whatever it is told


UPSIDE_DOWN = '<limit lower="2" upper="1" effort="1" velocity="1"/>'


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        ({"sholder": 1}, "the robot 'arm' has no joint 'sholder'; did you mean shoulder?"),
        ({"grip": 1}, "the joint 'grip' of 'arm' is fixed: no number moves it"),
    ],
)
def test_joints_that_there_are_not(joints, message):
    with pytest.raises(UnknownJoint) as caught:
        load(ARM).transforms(joints)
    assert str(caught.value) == message


def robot(inside, name="r"):
    return f'<robot name="{name}">\n{inside}\n</robot>'


def joint(name, parent, child, kind="fixed", more=""):
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{more}</joint>'


def body(inside):
    return robot(f'<link name="a">\n{inside}\n</link>')


A, B, C = ('<link name="a"/>', '<link name="b"/>', '<link name="c"/>')


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<robot>\n<link name='a'/></robot>", 'f:1: name="..." is missing in <robot>'),
        ("<sdf/>", "f:1: a URDF file begins with <robot>, this one with <sdf>"),
        ("<robot name='r'>", "f:1: the file ends, but <robot> of line 1 is still open"),
        (robot(""), "f:1: the robot 'r' has no <link>"),
        (robot(f"{A}\n{B}"), "f:1: the robot has 2 roots, links that are no joint's child: 'a' (line 2), 'b' (line 3)"),
        (
            robot(f"{A}\n{joint('j', 'a', 'aa')}"),
            "f:3: the child of the joint 'j' is not a link: 'aa'; the links are: a",
        ),
        (robot(f"{A}\n{joint('j', 'x', 'a')}"), "f:3: the parent of the joint 'j' is not a link: 'x'"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b')}\n{joint('k', 'a', 'b')}"),
         "f:4: the link 'b' is the child of two joints: of 'k' and, in line 3, of 'j'"),
        (robot(f"{A}{B}{C}\n{joint('j', 'b', 'c')}\n{joint('k', 'c', 'b')}"),
         "f:1: joints form a circle: 'k' (line 4), 'j' (line 3)"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b')}\n{joint('k', 'b', 'a')}"), "f:1: joints form a circle"),
        (robot(f"{A}\n{joint('j', 'a', 'a')}"), "f:3: the joint 'j' connects the link 'a' to itself"),
        (robot(f"{A}\n{A}"), "f:3: there are two links 'a': the other one is in line 2"),
        (robot(f"{A}{B}{C}\n{joint('j', 'a', 'b')}\n{joint('j', 'b', 'c')}"), "f:4: there are two joints 'j'"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'hinge')}"),
         "f:3: the joint 'j' has an unknown type 'hinge'; there are revolute"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'revolut')}"),
         "f:3: the joint 'j' has an unknown type 'revolut'; did you mean revolute?"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'revolute')}"), "f:3: the revolute joint 'j' needs <limit"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'fixed', '<origin xyz=' + chr(34) + '0 0' + chr(34) + '/>')}"),
         "f:3: xyz takes 3 numbers, not 2: '0 0'"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'fixed', '<origin rpy=' + chr(34) + '0 0 q' + chr(34) + '/>')}"),
         "f:3: 'q' in rpy of <origin> is not a number"),
        (robot('<joint name="j" type="fixed">\n<child link="a"/></joint>'), "f:1: the robot 'r' has no <link>"),
        (robot(f'{A}\n<joint name="j" type="fixed"><child link="a"/></joint>'), "f:3: <joint> has no <parent>"),
        (robot('<xacro:macro name="m"/>'), "f:2: <xacro:macro> is a macro of xacro: expand the file first"),
    ],
)  # fmt: skip
def test_errors_name_file_line_and_element(text, message):
    with pytest.raises(UrdfError) as caught:
        load(text, path="f")
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    ("text", "note"),
    [
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'revolute', UPSIDE_DOWN)}"),
         "f:3: the lower limit of the joint 'j' is above the upper one: 2 > 1"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'continuous', '<axis xyz=' + chr(34) + '0 0 0' + chr(34) + '/>')}"),
         "f:3: the axis of the joint 'j' has no direction"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'continuous', '<mimic joint=' + chr(34) + 'k' + chr(34) + '/>')}"),
         "f:3: the joint 'j' mimics 'k', which is not a joint"),
        (robot(f"{A}{B}\n{joint('j', 'a', 'b', 'continuous', '<mimic joint=' + chr(34) + 'j' + chr(34) + '/>')}"),
         "f:3: joints mimic one another in a circle: j -> j"),
        (body("<visual>\n<geometry/></visual>"), "f:4: <geometry> holds one shape"),
        (body("<visual/>"), "f:3: <visual> has no <geometry>"),
        (body("<visual><geometry>\n<ball/></geometry></visual>"), "f:4: <ball> is not a shape"),
        (body('<visual><geometry>\n<box size="1 1"/></geometry></visual>'), "f:4: size takes 3 numbers, not 2"),
        (body('<visual><geometry>\n<box size="1 1 -1"/></geometry></visual>'),
         "f:4: size of <box> takes numbers above 0"),
        (body('<visual><geometry>\n<sphere radius="0"/></geometry></visual>'), "f:4: radius of <sphere> is above 0"),
        (body('<visual><geometry>\n<cylinder radius="1"/></geometry></visual>'),
         'f:4: length="..." is missing in <cylinder>'),
        (body('<visual><geometry><mesh\n filename="package://no_such_package/a.stl"/></geometry></visual>'),
         "f:3: the mesh is missing: there is no package 'no_such_package'"),
        (body('<visual><geometry><mesh filename="a.stl"/></geometry></visual>'),
         "f:3: the mesh is missing: there is no file a.stl"),
        (body('<visual><geometry><mesh filename="http://x/a.stl"/></geometry></visual>'),
         "f:3: the mesh 'http://x/a.stl' is neither"),
        (body('<visual><geometry><sphere radius="1"/></geometry>\n<material name="bleu"/></visual>'),
         "f:4: the material 'bleu' has neither <color> nor <texture>"),
        (
            body(
                '<visual><geometry><sphere radius="1"/></geometry>\n'
                '<material name="b"><color rgba="0 0 255 1"/></material></visual>'
            ),
            "f:4: the parts of a colour are from 0 to 1",
        ),
        (body('<inertial>\n<mass value="-1"/><inertia/></inertial>'), "f:4: a mass is negative: -1 kg"),
        (body('<inertial>\n<mass value="1"/></inertial>'), "f:3: <inertial> has no <inertia>"),
        (body('<inertial><mass value="1"/>\n<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0"/></inertial>'),
         'f:4: izz="..." is missing in <inertia>'),
        (body('<inertial>\n<mass value="nan"/></inertial>'), "f:4: 'nan' in value of <mass> is not finite"),
    ],
)  # fmt: skip
def test_what_ros_accepts_is_read_with_a_note(text, note):
    found = load(text, path="f")
    assert [each for each in found.notes if each.startswith(note)]
    (link,) = [each for name, each in found.links.items() if name == "a"]
    assert link.inertial is None
    assert all(not isinstance(each.geometry, Mesh) for each in link.visuals)


def test_a_missing_mesh_leaves_the_rest_of_its_link():
    shapes = "".join(
        f"<{tag}><geometry>{shape}</geometry></{tag}>"
        for tag in ("visual", "collision")
        for shape in ('<mesh filename="package://nowhere/a.dae"/>', '<box size="1 1 1"/>')
    )
    found = load(body(inertia(1, 1, 1) + shapes))
    link = found.link("a")
    assert [each.geometry for each in (*link.visuals, *link.collisions)] == [Box((1, 1, 1)), Box((1, 1, 1))]
    assert link.inertial is not None
    assert {kind: len(notes) for kind, notes in found.left_out.items()} == {"a visual": 1, "a collision": 1}
    assert "there is no package 'nowhere'" in found.left_out["a visual"][0]


def inertia(ixx, iyy, izz, ixy=0.0):
    inertia = f'<inertia ixx="{ixx}" ixy="{ixy}" ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/>'
    return f'<inertial><mass value="1"/>{inertia}</inertial>'


@pytest.mark.parametrize(
    ("text", "notes"),
    [
        (inertia(1, 1, 1), []),
        (inertia(1, 1, 2), []),  # a flat disc: as large as it can be
        (inertia(1, 1, 2.1), ["the largest is more than the other two together"]),
        (inertia(1, 1, -1), ["are not all above 0"]),
        (inertia(1, 1, 1, ixy=2), ["are not all above 0"]),
    ],
)
def test_inertias_of_no_body_are_noted(text, notes):
    found = load(robot(f'<link name="r"/><link name="a">{text}</link>{joint("j", "r", "a")}')).notes
    assert len(found) == len(notes)
    assert all(part in note for part, note in zip(notes, found, strict=True))


def test_doubtful_things_are_noted():
    text = robot(f'<link name="a">{inertia(1, 1, 1)}</link>\n<gazebo reference="aa"/>\n<lnk/>')
    notes = load(text, path="f").notes
    assert [note.split(":")[1] for note in notes] == ["4", "3", "1"]
    assert "did you mean link?" in notes[0]
    assert "there is no such link or joint" in notes[1]
    assert "the root link 'a' has an inertia" in notes[2]


def test_files_and_meshes(tmp_path):
    package = tmp_path / "my_robot"
    (package / "meshes").mkdir(parents=True)
    (package / "meshes" / "a.stl").write_bytes(b"")
    (package / "package.xml").write_text("<package format='2'><name>my_robot</name></package>", encoding="utf-8")
    path = package / "r.urdf"
    path.write_text(
        body(
            '<visual><geometry><mesh filename="package://my_robot/meshes/a.stl" scale="2 2 2"/></geometry></visual>'
            '<visual><geometry><mesh filename="meshes/a.stl"/></geometry></visual>'
        ),
        encoding="utf-8",
    )
    index = PackageIndex([tmp_path])
    stl = package / "meshes" / "a.stl"
    for source in (path, str(path), "package://my_robot/r.urdf"):
        visuals = load(source, packages=index).link("a").visuals
        assert [each.geometry.path for each in visuals] == [stl, stl]
        assert visuals[0].geometry.scale == (2, 2, 2)
    assert load(path, meshes=False).link("a").visuals[0].geometry == Mesh("package://my_robot/meshes/a.stl", (2, 2, 2))
    with pytest.raises(UrdfError, match=r"none.urdf: cannot be read"):
        load(tmp_path / "none.urdf")
    with pytest.raises(UrdfError, match="did you mean my_robot"):
        load("package://my_robt/r.urdf", packages=index)
