"""What a camera gets of shapes: faces that look outwards, tops that cover what they should."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry import polygons
from rosmini.sim.models import BURGER
from rosmini.sim.sensors.scene import PAINT, Scene, parts_of, placed, rgb, trapezia
from rosmini.sim.shapes import COLOURS, Box, Compound, Cylinder, Part, Polygon, Sphere
from rosmini.sim.world import Obstacle, World


def area(faces):
    """The area [m2] of level faces (n, 4, 3)."""
    return sum(polygons.area(face[:, :2]) for face in faces)


def star(radii):
    angles = np.arange(len(radii)) * 2 * math.pi / len(radii)
    return np.column_stack([np.cos(angles), np.sin(angles)]) * np.array(radii)[:, None]


@given(st.lists(st.floats(0.2, 3.0), min_size=3, max_size=12), st.floats(-3, 3))
def test_trapezia_cover_a_polygon_however_it_turns_in(radii, turn):
    outline = star(radii) @ np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    faces = trapezia(polygons.sides_of(outline), 0.7)
    assert area(faces) == pytest.approx(polygons.area(outline), rel=1e-9)
    assert (faces[:, :, 2] == 0.7).all()


def test_a_ring_has_a_hole():
    outer, inner = star([3.0] * 4), star([1.0] * 4)[::-1]
    sides = np.vstack([polygons.sides_of(outer), polygons.sides_of(inner)])
    assert area(trapezia(sides, 0.0)) == pytest.approx(18.0 - 2.0)


@pytest.mark.parametrize("shape", [Box(2.0, 1.0), Polygon(((0, 0), (2, 0), (2, 2), (1, 0.5), (0, 2)))])
def test_faces_look_outwards_and_close_the_solid(shape):
    scene = Scene.of([Part(shape, (1.0, 2.0, 0.7), 0.5, 1.5)])
    corners = scene.faces
    # the volume by the divergence theorem: each face in two triangles
    fan = [(corners[:, 0], corners[:, 1], corners[:, 2]), (corners[:, 0], corners[:, 2], corners[:, 3])]
    volume = sum(float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6 for a, b, c in fan)
    assert volume == pytest.approx(polygons.area(shape.outline) * 1.0)


def test_what_stands_on_the_ground_has_no_bottom():
    on, above = (Scene.of([Part(Box(1, 1), (0, 0, 0), bottom, 1.0)]) for bottom in (0.0, 0.2))
    assert (len(on.faces), len(above.faces)) == (5, 6)
    assert above.normals[-1] == pytest.approx((0, 0, -1))


def test_parts_of_a_compound_are_placed_and_keep_their_colour():
    shape = Compound(((Cylinder(0.1), (1.0, 0.0, 0.0)), (Sphere(0.2), (0.0, 1.0, 0.0))))
    scene = Scene.of([Part(shape, (0.0, 0.0, math.pi / 2), 0.3, 0.7, "#ff8000")])
    np.testing.assert_allclose(scene.rods, [(0.0, 1.0, 0.1, 0.3, 0.7)], atol=1e-12)
    np.testing.assert_allclose(scene.balls, [(-1.0, 0.0, 0.5, 0.2)], atol=1e-12)
    np.testing.assert_allclose(scene.ball_paints, [(1.0, 128 / 255, 0.0)])


def test_scenes_add_up():
    one = Scene.of_world(World("w", [Obstacle("box", Box(1, 1))], walls=[(2, 0, 2, 1), (3, 3, 3, 3)]))
    both = one + Scene.of([Part(Cylinder(0.2), (0, 0, 0), 0.0, 1.0)])
    assert (len(one.faces), len(both.faces), len(both.rods)) == (6, 6, 1)  # a wall of no length has no face
    assert both.thin.tolist() == [True] + [False] * 5


def test_a_robot_is_where_it_stands():
    [base, *_] = BURGER.parts
    [moved, *_] = placed(BURGER.parts, (1.0, 2.0, math.pi / 2))
    assert moved.pose == pytest.approx((1.0 - base.pose[1], 2.0 + base.pose[0], base.pose[2] + math.pi / 2))
    assert parts_of([Obstacle("o", Box(1, 1), (1, 1, 0), 0.4, "blue")])[0].top == 0.4


def test_each_named_colour_has_a_paint():
    assert set(PAINT) == set(COLOURS)
    assert rgb("#336699") == (0x33 / 255, 0x66 / 255, 0x99 / 255)
    assert all(0.0 <= part <= 1.0 for name in COLOURS for part in rgb(name))
