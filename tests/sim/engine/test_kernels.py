"""How two outlines overlap, how a body is brought out of another, and how far apart they are."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rosmini.sim.geometry import outlines

pymunk = pytest.importorskip("pymunk")

from rosmini.sim.models import BURGER, WAFFLE


def piece_of(shape):
    """The outline of one of pymunk's shapes in its body's frame."""
    if isinstance(shape, pymunk.Circle):
        return np.array([shape.offset]), shape.radius
    if isinstance(shape, pymunk.Segment):
        return np.array([shape.a, shape.b]), shape.radius
    return np.array(shape.get_vertices()), shape.radius


def put(body, pose):
    body.angle = pose[2]
    body.position = pose[:2]


def depths_of(contacts):
    """How deep two shapes overlap at each point of their contact; pymunk's own `distance` has either sign."""
    nx, ny = contacts.normal
    pairs = ((point.point_a, point.point_b) for point in contacts.points)
    return [(a[0] - b[0]) * nx + (a[1] - b[1]) * ny for a, b in pairs]


KINDS = ("disc", "robot", "triangle", "wall")


def shape_of(kind):
    """Something that a robot can bump into; its body goes with it, for a shape alone keeps none."""
    body = pymunk.Body(1.0, 1.0)
    if kind == "disc":
        return body, pymunk.Circle(body, 0.08, (0.02, 0.0))
    if kind == "wall":
        return body, pymunk.Segment(body, (-0.3, 0.0), (0.5, 0.0), 0.0)
    triangle = [(-0.1, -0.1), (0.2, -0.05), (0.0, 0.2)]
    outlines = {"burger": BURGER.footprint, "robot": WAFFLE.footprint, "triangle": triangle}
    return body, pymunk.Poly(body, outlines[kind])


places = st.floats(-0.4, 0.4)
headings = st.floats(-math.pi, math.pi)


def placed(shape, pose):
    """The outline of a shape there."""
    outline, radius = piece_of(shape)
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return outline @ np.array([[c, s], [-s, c]]) + pose[:2], radius


@given(st.sampled_from(KINDS), places, places, headings, headings)
def test_two_outlines_overlap_where_and_as_deep_as_pymunk_says(kind, x, y, theta, other_theta):
    own, burger = shape_of("burger")
    body, shape = shape_of(kind)
    put(own, (0.0, 0.0, theta))
    put(body, (x, y, other_theta))
    space = pymunk.Space()
    space.add(body, shape)
    hits = [hit.contact_point_set for hit in space.shape_query(burger)]
    depth = max((depth for hit in hits for depth in depths_of(hit)), default=0.0)
    a, _ = placed(burger, (0.0, 0.0, theta))
    b, radius = placed(shape, (x, y, other_theta))
    found = outlines.contact(a, 0, len(a), 0.0, b, 0, len(b), radius, 1e-9)
    assert max(found[3], found[6]) == pytest.approx(depth, abs=1e-8)
    assert bool(found[0]) == (depth > 1e-9) or depth < 2e-8
    expected = hits[0] if hits else pymunk.ContactPointSet(pymunk.Vec2d(0.0, 0.0), ())
    if found[0] and found[1] * expected.normal.x + found[2] * expected.normal.y > 1 - 1e-6:
        # of equal ways out either may be taken; if it is the same one, the points are the same
        assume(len(expected.points) == found[0])
        assert sorted([found[3], found[6]][: found[0]]) == pytest.approx(sorted(depths_of(expected)), abs=1e-6)
        mine = [found[4:6], found[7:9]][: found[0]]
        its = [tuple(point.point_a) for point in expected.points]
        if math.dist(mine[0], its[0]) > math.dist(mine[0], its[-1]):
            its.reverse()
        for one, other in zip(mine, its, strict=True):
            assert one == pytest.approx(other, abs=1e-5)
