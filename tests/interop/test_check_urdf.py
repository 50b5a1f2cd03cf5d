"""Debian's `check_urdf` (liburdfdom-tools) as a second opinion: what is a robot, and what hangs where."""

from __future__ import annotations

import re

import pytest

from rosmini.sim.urdf import UrdfError, load
from rosmini.sim.urdf.xacro import expand

from ..processes import run
from .conftest import need_ros

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module", autouse=True)
def _real():
    need_ros("check_urdf")


A, B, C = ('<link name="a"/>', '<link name="b"/>', '<link name="c"/>')


def joint(name, parent, child, kind="fixed", more=""):
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{more}</joint>'


LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
CASES = {
    "one link": A,
    "a chain": A + B + C + joint("j", "a", "b") + joint("k", "b", "c", "revolute", LIMIT),
    "a branch, written backwards": joint("k", "a", "c") + joint("j", "a", "b", "continuous") + C + B + A,
    "two roots": A + B,
    "a circle": A + B + joint("j", "a", "b") + joint("k", "b", "a"),
    "no such parent": A + joint("j", "x", "a"),
    "no such child": A + joint("j", "a", "x"),
    "two of a name": A + A,
    "an unknown type": A + B + joint("j", "a", "b", "hinge"),
    "no limit": A + B + joint("j", "a", "b", "revolute"),
    "a number that is none": A + B + joint("j", "a", "b", more='<origin xyz="0 0 q"/>'),
    "too few numbers": A + B + joint("j", "a", "b", more='<origin xyz="0 0"/>'),
}

LENIENT = {
    "no shape": '<link name="a"><visual><geometry/></visual></link>',
    "a mass without inertia": '<link name="a"><inertial><mass value="1"/></inertial></link>',
}
"""What check_urdf refuses; here the wrong part of the link is left out, with a note."""


def theirs(text, tmp_path):
    """What hangs on what, or None if they call something in it an error (and, now and then, go on without it)."""
    path = tmp_path / "r.urdf"
    path.write_text(text, encoding="utf-8")
    done = run(["check_urdf", path])
    said = done.stdout + done.stderr
    if done.returncode or "Error:" in said or "Successfully Parsed XML" not in said:
        return None
    root = re.search(r"root Link: (\S+) has", done.stdout)
    above = [root[1]]
    tree = {}
    for blanks, name in re.findall(r"^( +)child\(\d+\):\s+(\S+)", done.stdout, re.MULTILINE):
        depth = len(blanks) // 4
        above[depth:] = [name]
        tree[name] = above[depth - 1]
    return root[1], tree


def ours(text):
    try:
        robot = load(text, meshes=False)
    except UrdfError:
        return None
    return robot.root, {child: each.parent for child, each in robot.above.items()}


@pytest.mark.parametrize("case", sorted(CASES))
def test_the_same_are_robots(case, tmp_path):
    text = f'<robot name="r">{CASES[case]}</robot>'
    assert ours(text) == theirs(text, tmp_path)


@pytest.mark.parametrize("case", LENIENT)
def test_a_wrong_part_of_a_link_is_left_out_where_check_urdf_refuses_the_robot(case, tmp_path):
    text = f'<robot name="r">{LENIENT[case]}</robot>'
    assert theirs(text, tmp_path) is None
    assert ours(text) == ("a", {})


@pytest.mark.parametrize("name", ["burger", "waffle", "waffle_pi"])
def test_turtlebot3(name, tmp_path):
    text = expand(f"package://turtlebot3_description/urdf/turtlebot3_{name}.urdf.xacro")
    found = theirs(text, tmp_path)
    assert found is not None
    assert found == ours(text)
