"""A bumper tells on which side a robot touches something."""

import math

import pytest

from rosmini.sim.sensors.contact_sensor import KOBUKI_BUMPER, TURTLEBOT3_BUMPER, BumperModel, Sector, bits, pressed


def names(bumper, pose, *contacts):
    return [sector.name for sector in pressed(bumper, pose, contacts)]


@pytest.mark.parametrize(
    ("degrees", "wanted"),
    [(0, ["forward"]), (60, ["forward"]), (120, ["backward"]), (180, ["backward"]), (-100, ["backward"])],
)
def test_turtlebot3_knows_front_and_back(degrees, wanted):
    angle = math.radians(degrees)
    assert names(TURTLEBOT3_BUMPER, (0, 0, 0), ((0.1 * math.cos(angle), 0.1 * math.sin(angle)), 1.0)) == wanted


def test_sides_are_those_of_the_robot_wherever_it_stands():
    behind = ((5.0, 2.8), 1.0)
    assert names(TURTLEBOT3_BUMPER, (5.0, 3.0, math.pi / 2), behind) == ["backward"]
    assert names(TURTLEBOT3_BUMPER, (5.0, 3.0, -math.pi / 2), behind) == ["forward"]


def test_several_may_be_pressed_and_their_bits_add_up():
    sectors = pressed(TURTLEBOT3_BUMPER, (0, 0, 0), [((0.1, 0.0), 1.0), ((-0.1, 0.01), 1.0), ((0.1, 0.05), 1.0)])
    assert bits(sectors) == 3
    assert bits(pressed(TURTLEBOT3_BUMPER, (0, 0, 0), [])) == 0


def test_a_kobuki_does_not_feel_its_back():
    assert names(KOBUKI_BUMPER, (0, 0, 0), ((0.0, 0.2), 1.0)) == ["left"]
    assert names(KOBUKI_BUMPER, (0, 0, 0), ((0.2, 0.0), 1.0)) == ["centre"]
    assert names(KOBUKI_BUMPER, (0, 0, 0), ((-0.2, 0.0), 1.0)) == []


def test_a_light_touch_is_not_felt_by_a_stiff_bumper():
    stiff = BumperModel((Sector("all", -math.pi, math.pi, 1),), force=2.0)
    assert names(stiff, (0, 0, 0), ((0.1, 0.0), 1.9)) == []
    assert names(stiff, (0, 0, 0), ((0.1, 0.0), 2.0)) == ["all"]
