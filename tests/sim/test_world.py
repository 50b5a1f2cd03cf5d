"""Worlds: what is possible, what is said of what is not, and what has room where."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rosmini.core.errors import RosminiError
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, World, WorldError

FOOTPRINT = ((-0.1, -0.08), (0.04, -0.08), (0.04, 0.08), (-0.1, 0.08))
NAN = math.nan


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"shape": Box(0, 1)}, r"shape\.length is 0"),
        ({"shape": Box(1, -1)}, r"shape\.width is -1"),
        ({"shape": Box(NAN, 1)}, r"shape\.length is nan"),
        ({"shape": Cylinder(0)}, r"shape\.radius is 0"),
        ({"shape": Cylinder("big")}, r"shape\.radius is 'big'"),
        ({"shape": Polygon(((0, 0), (1, 0)))}, r"shape\.corners are 2"),
        ({"shape": Polygon(((0, 0), (0, 1), (1, 0)))}, "clockwise"),
        ({"shape": Polygon(((0, 0), (1, 1), (1, 0), (0, 1)))}, "corner 0 and from corner 2 meet"),
        ({"shape": Polygon(((0, 0), (1, math.inf), (1, 0)))}, r"shape\.corners\[1\]"),
        ({"shape": Polygon(((0, 0), (1, 0, 0), (1, 1)))}, r"shape\.corners\[1\]"),
        ({"shape": [1, 2]}, "it must be a Box"),
        ({"shape": Box([1], 2)}, "finite numbers"),
        ({"shape": Polygon(((0, 0), (1, [0]), (1, 1)))}, "finite numbers"),
        ({"pose": (NAN, 0, 0)}, r"pose is \(nan, 0, 0\)"),
        ({"pose": (0, 0)}, "pose is"),
        ({"height": 0}, "height is 0"),
        ({"mass": -1}, "mass is -1"),
        ({"mass": 0}, "mass is 0"),
        ({"mass": math.inf}, "mass is inf"),
        ({"colour": "gray"}, "did you mean grey"),
        ({"bottom": 1.5, "height": 1.0}, "top must be above the bottom"),
        ({"bottom": NAN}, "bottom is nan"),
        ({"shape": Sphere(0.0)}, "shape.radius is 0.0"),
        ({"shape": Compound(())}, "a compound has one part at least"),
        ({"shape": Compound(((Cylinder(-1.0), (0, 0, 0)),))}, r"shape.parts\[0\]: shape.radius is -1.0"),
        ({"colour": "#gg0000"}, "six digits"),
        ({"restitution": 1.5}, "restitution is 1.5"),
        ({"drag": -0.1}, "drag is -0.1"),
        ({"motion": "walk"}, "it must be a Walk or a Door"),
    ],
)
def test_an_impossible_obstacle_is_refused_by_name_and_field(changes, part):
    with pytest.raises(WorldError, match=part) as caught:
        Obstacle(**({"name": "the thing", "shape": Box(1, 1)} | changes))
    assert "'the thing'" in str(caught.value)
    assert isinstance(caught.value, RosminiError)


@pytest.mark.parametrize("name", ["", "  ", None, 7])
def test_an_obstacle_and_a_world_need_a_name(name):
    with pytest.raises(WorldError, match="name"):
        Obstacle(name, Box(1, 1))
    with pytest.raises(WorldError, match="name"):
        World(name)


BOX = Obstacle("box", Box(1.0, 0.5), (2.0, 0.0, math.pi / 2))


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"obstacles": (BOX, BOX)}, "two obstacles have the name 'box'"),
        ({"obstacles": ("box",)}, "no Obstacle"),
        ({"walls": [(0, 0, 1)]}, r"\(n, 4\)"),
        ({"walls": [(0, 0, 1, 1), (0, 0, NAN, 1)]}, r"walls\[1\]"),
        ({"walls": "wall"}, "walls must be"),
        ({"walls": [(0, 0, 1, 0), (1, 0, 1, 1)], "solid": True}, "not closed"),
        ({"wall_height": 0}, "wall_height"),
        ({"starts": ()}, "starts"),
        ({"starts": ((0, 0, 0), (0, NAN, 0))}, r"starts\[1\]"),
    ],
)
def test_an_impossible_world_is_refused(changes, part):
    with pytest.raises(WorldError, match=part) as caught:
        World("here", **changes)
    assert "'here'" in str(caught.value)


def test_a_world_without_anything_works():
    world = World("void")
    assert "void" in repr(world) and "0 walls, 0 obstacles" in repr(world)
    assert world.bounds == (-5, -5, 5, 5)
    assert world.segments.shape == (0, 4)
    assert world.discs.shape == (0, 3)
    assert world.blocked((1e6, 0, 0), FOOTPRINT) is None
    assert world.free_place((1, 2, 3), FOOTPRINT) == (1, 2, 3)
    assert world.free_place((1e6, 2, 3), FOOTPRINT) == (1e6, 2, 3)
    assert World("lists", walls=[]).walls.shape == (0, 4)
    with pytest.raises(WorldError, match="finite"):
        world.free_place((NAN, 0, 0), FOOTPRINT)


def test_what_a_world_is_made_of():
    crate = Obstacle("crate", Box(0.2, 0.2), mass=0.5)
    world = World("w", (BOX, Obstacle("post", Cylinder(0.5), (0, 3, 0)), crate), [(0, 0, 0, 1)])
    assert "1 wall, 3 obstacles" in repr(world)
    assert len(world.segments) == 5
    assert world.discs.tolist() == [[0, 3, 0.5]]
    assert world.bounds == pytest.approx((-0.5, -0.5, 2.25, 3.5))
    more = world.with_obstacles([replace(crate, name="crate 2")])
    assert len(more.obstacles) == 4
    with pytest.raises(WorldError, match="'crate'"):
        world.with_obstacles([crate])
    with pytest.raises(ValueError, match="read-only"):
        world.walls[0, 0] = 1


@pytest.mark.parametrize("footprint", [FOOTPRINT, np.array(FOOTPRINT), 0.1])
def test_what_is_in_the_way_is_named(footprint):
    ell = Polygon(((0, 0), (2, 0), (2, 0.5), (0.5, 0.5), (0.5, 2), (0, 2)))
    world = World(
        "w",
        (
            BOX,
            Obstacle("post", Cylinder(0.02), (0, 3, 0)),
            Obstacle("ell", ell, (4, 4, 0)),
            Obstacle("crate", Box(1, 1), (-3, -3, 0), mass=1),
        ),
        [(5, 0, 5, 1)],
    )
    assert world.blocked((2, 0.3, 1), footprint) == "the obstacle 'box'"
    assert world.blocked((0, 3, 0), footprint) == "the obstacle 'post'"
    assert world.blocked((-0.07, 3, 0), footprint) is None or isinstance(footprint, float)
    assert world.blocked((4.2, 4.2, 0), footprint) == "the obstacle 'ell'"
    assert world.blocked((5, 5, 0), footprint) is None
    assert world.blocked((-3, -3, 0), footprint) is None
    found = world.blocked((4.98, 0.5, 0), footprint)
    assert "wall" in found and "(5.00, 0.00)" in found and "(5.00, 1.00)" in found
    assert world.blocked((4.8, 0.5, 0), footprint) is None
    with pytest.raises(WorldError, match="finite"):
        world.blocked((NAN, 0, 0), footprint)


@pytest.mark.parametrize("pose", [(0.0, 0.0, 0.0), (0.3, -0.2, 1.0)])
def test_what_has_the_same_centre_is_in_the_way(pose):
    square = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    for shape in (Box(1.0, 1.0), Box(0.2, 0.2), Box(4.0, 4.0), Cylinder(0.1), Cylinder(3.0)):
        world = World("w", (Obstacle("one", shape, pose),))
        assert world.blocked(pose, square) == world.blocked(pose, 0.3) == "the obstacle 'one'"


def test_a_footprint_turns_with_its_pose():
    world = World("w", walls=[(0.06, -1, 0.06, 1)])
    assert world.blocked((0, 0, 0), FOOTPRINT) is None
    assert world.blocked((0, 0, math.pi / 2), FOOTPRINT) is not None
    assert world.blocked((0, 0, math.pi), FOOTPRINT) is not None
    assert world.blocked((0.02, 0, 0), FOOTPRINT) is None, "touching is no overlap"


def test_the_inside_of_solid_walls_is_blocked():
    walls = [(0, 0, 2, 0), (2, 0, 2, 2), (2, 2, 0, 2), (0, 2, 0, 0)]
    assert World("w", walls=walls).blocked((1, 1, 0), FOOTPRINT) is None
    solid = World("w", walls=walls, solid=True)
    assert solid.blocked((1, 1, 0), FOOTPRINT) == "the inside of a wall"
    assert solid.blocked((1, 1, 0), 0.1) == "the inside of a wall"
    assert solid.blocked((3, 1, 0), FOOTPRINT) is None


def test_a_free_place_is_near_or_a_start():
    world = World("w", (BOX,), [(-1, -2, 4, -2), (-1, 2, 4, 2)])
    x, y, theta = world.free_place((2.0, 0.0, 0.5), FOOTPRINT)
    assert theta == 0.5
    assert world.blocked((x, y, theta), FOOTPRINT) is None
    assert math.hypot(x - 2, y) < 0.45
    full = World("w", (Obstacle("block", Box(8, 8)),), starts=((0, 0, 0), (9, 0, 0), (5, 0, 0)))
    assert full.free_place((0, 0, 0), FOOTPRINT) == (5, 0, 0)
    assert replace(full, starts=((0, 0, 0),)).free_place((0, 0, 0), FOOTPRINT) is None
