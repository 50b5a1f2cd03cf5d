import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.tf.rigid import matrix
from rosmini.sim.robot_state_publisher.chain import Chain, joint_transform
from rosmini.sim.urdf import Joint, load
from rosmini.sim.urdf.model import Origin

numbers = st.floats(-5, 5)
vectors = st.tuples(numbers, numbers, numbers)


@given(vectors, vectors, vectors.filter(lambda v: np.linalg.norm(v) > 0.1), st.floats(-100, 100),
    st.sampled_from(["continuous", "prismatic", "fixed"]))  # fmt: skip
def test_seven_numbers_say_what_the_matrices_of_urdf_say(xyz, rpy, axis, position, kind):
    unit = tuple(np.array(axis) / np.linalg.norm(axis))
    joint = Joint("j", kind, "a", "b", Origin(xyz, rpy), unit)
    found = joint_transform(joint, position)
    assert np.allclose(matrix(found), joint.transform(position), atol=1e-9)
    assert math.hypot(*found[3:]) == pytest.approx(1, abs=1e-12)


TEXT = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<link name="d"/><link name="e"/><link name="f"/>
<joint name="z" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
<joint name="m2" type="continuous"><parent link="b"/><child link="c"/>
<mimic joint="m1" multiplier="2" offset="1"/></joint>
<joint name="m1" type="continuous"><parent link="b"/><child link="d"/><mimic joint="z" multiplier="-1"/></joint>
<joint name="p" type="planar"><parent link="b"/><child link="e"/><origin xyz="1 0 0"/></joint>
<joint name="fl" type="floating"><parent link="b"/><child link="f"/></joint></robot>"""


def test_what_is_sent_of_a_robot():
    chain = Chain(load(TEXT))
    assert [each[:2] for each in chain.fixed] == [("b", "e")]
    assert chain.floating == ["fl"]
    sent = {child: transform for _, child, transform in chain.transforms({"z": 0.5, "no_joint": 1})}
    assert list(sent) == ["d", "c", "b"]  # by the names of the joints: m1, m2, z
    assert 2 * math.asin(sent["b"][5]) == pytest.approx(0.5)
    assert 2 * math.asin(sent["d"][3]) == pytest.approx(-0.5)
    assert 2 * math.asin(sent["c"][3]) == pytest.approx(0.0)
    # One that mimics and is told of itself stands where it is told; nothing is said of what is not known.
    assert 2 * math.asin({c: t for _, c, t in chain.transforms({"z": 0.5, "m1": 0.2})}["d"][3]) == pytest.approx(0.2)
    assert chain.transforms({}) == []
