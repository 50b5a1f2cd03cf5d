"""The pieces of contact: how a body is brought out of another, and how far it is from others."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rosmini.sim.engine.bodies import VIEW, correction
from rosmini.sim.engine.physics import Contacts
from rosmini.sim.models import BURGER
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World

depths = st.floats(1e-6, 1e-2)
levers = st.floats(-0.2, 0.2)


@given(depths, levers)
def test_one_point_of_contact_just_touches_afterwards(depth, lever):
    along, turn = correction([depth], [lever], 1.0, 0.0025)
    assert along + turn * lever == pytest.approx(depth, abs=1e-12)
    assert along > 0
    assert turn * lever >= 0


@given(depths, depths, levers, levers)
def test_of_two_points_one_just_touches_afterwards_and_none_is_deeper_than_before(first, second, r, q):
    assume(abs(r - q) > 1e-3)
    along, turn = correction([first, second], [r, q], 1.0, 0.0025)
    left = [first - along - turn * r, second - along - turn * q]
    assert min(abs(left[0]), abs(left[1])) < 1e-9
    assert max(left) < max(first, second)
    if r * q < 0 and first == second:  # the points are on both sides, so both can just touch
        assert left == pytest.approx([0.0, 0.0], abs=1e-9)


def test_flat_against_a_wall_a_body_does_not_turn():
    assert correction([0.001, 0.001], [0.105, -0.105], 1.0, 0.0025) == pytest.approx((0.001, 0.0))


def contacts(*obstacles: Obstacle, walls: tuple = ()) -> Contacts:
    return Contacts(World("test", obstacles, np.array(walls, dtype=float).reshape(-1, 4)))


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (contacts(walls=((0.3, -1.0, 0.3, 1.0),)), 0.3 - 0.041),
        (contacts(Obstacle("disc", Cylinder(0.1), (0.4, 0.0, 0.0))), 0.3 - 0.041),
        (contacts(Obstacle("box", Box(0.2, 0.2), (0.4, 0.0, 0.0))), 0.3 - 0.041),
        (contacts(Obstacle("crate", Box(0.2, 0.2), (0.4, 0.0, 0.0), mass=1.0)), 0.3 - 0.041),
        (contacts(Obstacle("turned", Box(0.2, 0.2), (0.4, 0.0, math.pi / 4))), 0.4 - 0.1 * 2**0.5 - 0.041),
        (contacts(walls=((0.341, 0.405, 9.0, 9.0),)), 0.3 * 2**0.5),
        (contacts(walls=((9.0, -1.0, 9.0, 1.0),)), VIEW),
        (contacts(), VIEW),
    ],
)
def test_the_room_around_a_robot_is_its_distance_from_what_is_nearest(made, expected):
    made.add("burger", BURGER, (0.0, 0.0, 0.0))
    assert made.room("burger") == pytest.approx(expected, abs=1e-6)


def test_of_the_room_between_two_robots_each_has_half():
    made = contacts()
    made.add("one", BURGER, (0.0, 0.0, 0.0))
    made.add("two", BURGER, (0.4, 0.0, math.pi))
    for name in ("one", "two"):
        assert made.room(name) == pytest.approx((0.4 - 0.082) / 2, abs=1e-6)


def test_an_outline_with_an_inner_corner_keeps_its_shape_and_its_mass():
    outline = ((0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4))
    made = contacts(Obstacle("angle", Polygon(outline), (1.0, 1.0, math.pi / 2), mass=2.0))
    (crate,) = made._crates
    assert crate.body.mass == pytest.approx(2.0)
    assert sum(shape.area for shape in crate.shapes) == pytest.approx(0.07)
    assert made.hindrance(BURGER, (0.8, 1.25, 0.0)) is None  # in the open corner
    assert made.hindrance(BURGER, (0.95, 1.05, 0.0)) == "the obstacle 'angle'"
    assert made.obstacles()[0].pose == pytest.approx((1.0, 1.0, math.pi / 2))


def test_a_thing_without_symmetry_slides_and_turns_about_its_centre_of_mass():
    outline = ((0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4))
    made = contacts(Obstacle("angle", Polygon(outline), (1.0, 1.0, 0.0), mass=2.0))
    (crate,) = made._crates
    body = crate.body
    middle = body.local_to_world(body.center_of_gravity)
    body.velocity, body.angular_velocity = (0.5, 0.0), 3.0
    made.add("far away", BURGER, (-5.0, 0.0, 0.0))
    here = (-5.0, 0.0, 0.0)
    for _ in range(200):
        made.step({"far away": (here, here)}, 0.005)
    assert not made.moving
    # a mass that slides to rest with friction 0.5 goes v^2 / 2 mu g
    way = body.local_to_world(body.center_of_gravity) - middle
    assert (way.x, way.y) == pytest.approx((0.5**2 / 2 / 0.5 / 9.80665, 0.0), abs=2e-3)
    assert made.obstacles()[0].pose[2] > 0.1


def test_a_removed_robot_is_in_nobodys_way():
    made = contacts()
    made.add("one", BURGER, (0.0, 0.0, 0.0))
    assert made.hindrance(BURGER, (0.0, 0.0, 0.0)) == "the robot 'one'"
    assert made.hindrance(BURGER, (0.0, 0.0, 0.0), ignoring="one") is None
    made.remove("one")
    assert made.hindrance(BURGER, (0.0, 0.0, 0.0)) is None
