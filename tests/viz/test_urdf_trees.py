import xml.etree.ElementTree as ET

import pytest

from rosmini.sim.urdf import load
from rosmini.viz.urdf_trees import urdf_tree

ARM = """<robot name="arm &amp; co"><link name="base"/><link name="upper"><inertial><mass value="2"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><link name="lower"/><link name="lid"/>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 1" rpy="0 0 .5"/>
<limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><mimic joint="shoulder"/></joint>
<joint name="slide" type="prismatic"><parent link="lower"/><child link="lid"/>
<limit lower="0" upper=".1" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture(scope="module")
def picture():
    return urdf_tree(load(ARM), title="An arm")


def test_the_text_says_what_hangs_where(picture):
    assert picture.text.splitlines() == [
        "An arm: 4 links, 3 joints, 3 of them move; 2.000 kg",
        "base -> upper: shoulder, revolute, -1.00 to 2.00 rad, at (0.000, 0.000, 1.000) m, rpy (0.000, 0.000, 0.500)",
        "upper -> lower: elbow, continuous, mimics shoulder, at (0.000, 0.000, 0.000) m",
        "lower -> lid: slide, prismatic, 0.00 to 0.10 m, at (0.000, 0.000, 0.000) m",
    ]
    assert (
        picture.alt == "Tree of the 4 links of arm & co, with 3 moving joints: "
        "upper under base; lower under upper; lid under lower."
    )


def test_the_picture_has_every_link_and_joint_and_is_the_same_each_time(picture):
    svg = picture.svg
    root = ET.fromstring(svg)
    words = {each.text for each in root.iter() if each.tag.endswith("text")}
    assert {"base", "upper", "lower", "lid", "shoulder", "elbow", "slide", "revolute", "mimics shoulder"} <= words
    kinds = [each.get("class") for each in root.iter() if each.get("class", "").startswith("urdf-")]
    assert sorted(kinds) == ["urdf-body", "urdf-frame", "urdf-frame", *["urdf-joint"] * 3, "urdf-root"]
    assert urdf_tree(load(ARM), title="An arm").svg == svg
