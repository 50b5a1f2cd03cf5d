import math

import pytest

from rosmini.core.errors import ParameterError
from rosmini.sim.joint_state_publisher import Positions
from rosmini.sim.urdf import load

TEXT = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/>
<joint name="turn" type="continuous"><parent link="a"/><child link="b"/></joint>
<joint name="lift" type="prismatic"><parent link="b"/><child link="c"/>
<limit lower="1" upper="2" effort="1" velocity="1"/></joint>
<joint name="twice" type="continuous"><parent link="c"/><child link="d"/>
<mimic joint="turn" multiplier="2" offset="1"/></joint>
<joint name="thrice" type="continuous"><parent link="d"/><child link="e"/>
<mimic joint="twice" multiplier="3" offset="1"/></joint></robot>"""


def at(positions):
    return {row[0]: row[1] for row in positions.table()}


def test_joints_stand_at_zero_in_the_middle_or_as_they_are_told():
    assert at(Positions(load(TEXT))) == {"turn": 0, "lift": 1.5, "twice": 1, "thrice": 4}
    assert at(Positions(load(TEXT), zeros={"turn": 1, "lift": 2}, use_mimic=False)) == {
        "turn": 1,
        "lift": 2,
        "twice": 0,
        "thrice": 0,
    }
    depends = {"lift": {"parent": "turn", "factor": 0.5, "offset": 1}}
    assert at(Positions(load(TEXT), zeros={"turn": 1}, dependent=depends))["lift"] == 1.5


def test_they_turn_round_at_limits_and_go_round_where_there_are_none():
    positions = Positions(load(TEXT))
    seen = []
    for _ in range(8):
        positions.move(0.2)
        seen.append(round(at(positions)["lift"], 6))
    assert seen == [1.7, 1.9, 2.0, 1.8, 1.6, 1.4, 1.2, 1.0]
    positions.take("turn", 3.1, None, None)
    positions.move(0.2)
    assert at(positions)["turn"] == -math.pi


def test_what_others_say_is_taken_over_of_free_joints():
    positions = Positions(load(TEXT))
    positions.take("turn", 0.5, 2.0, None)
    positions.take("twice", 9.0, None, None)
    positions.take("no_joint", 9.0, None, None)
    assert positions.table()[0] == ("turn", 0.5, 2.0, None)
    assert positions.table()[2] == ("twice", 2.0, 4.0, None)


@pytest.mark.parametrize(
    ("dependent", "message"),
    [
        ({"turn": {"parent": "lift"}, "lift": {"parent": "turn"}}, "joints depend on one another in a circle"),
        ({"turn": {"parent": "lft"}}, ("the joint 'turn' depends on 'lft', which is no joint that moves; did you mean "
                                      "lift?")),
    ],
)  # fmt: skip
def test_joints_that_depend_on_what_cannot_be(dependent, message):
    with pytest.raises(ParameterError) as caught:
        Positions(load(TEXT), dependent=dependent)
    assert message in str(caught.value)
