"""The worlds that rosmini brings, and those that are traced from maps."""

from __future__ import annotations

import math
import os
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from assets.generate.worlds import floor
from rosmini.core.errors import RosminiError, UnknownPackage
from rosmini.core.geometry import polygons
from rosmini.core.maps import MapError, load_map
from rosmini.sim.geometry.contours import edge_loops
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.world import Cylinder, WorldError, edges
from rosmini.sim.worlds import names, source, world, world_from_map

# The corners of a TurtleBot3 Burger: 138 mm by 178 mm, its axle 32 mm ahead of the middle, and 2 cm more.
BURGER = np.array([(-0.121, -0.109), (0.057, -0.109), (0.057, 0.109), (-0.121, 0.109)])
REACH = 3.5


def scan(here, x, y):
    return raycast(here.segments, here.discs, x, y, 0.0, math.radians(1), 360, REACH, backend="numpy")


def free_places(here, spacing):
    x0, y0, x1, y1 = here.bounds
    for x in np.arange(x0 + 0.1, x1, spacing):
        for y in np.arange(y0 + 0.1, y1, spacing):
            if here.blocked((x, y, 0.0), 0.12) is None:
                yield float(x), float(y)


@pytest.mark.parametrize("name", names())
def test_every_start_is_free_and_apart_from_the_others(name):
    here = world(name)
    assert here.name == name
    assert here.title
    for i, start in enumerate(here.starts):
        assert here.blocked(start, BURGER) is None, start
        assert all(math.dist(start[:2], other[:2]) > 0.5 for other in here.starts[:i])
        for thing in here.obstacles:
            if thing.movable:
                assert math.dist(start[:2], thing.pose[:2]) > 0.4


def test_the_names_are_sorted_and_each_call_makes_a_new_world():
    assert names() == ["arena", "empty", "floor", "house", "maze", "office", "pillars", "room"]
    assert world("room") is not world("room")


def test_the_empty_world_is_empty_and_the_arena_is_a_square():
    assert len(world("empty").segments) == len(world("empty").discs) == 0
    ranges = scan(world("arena"), 0.0, 0.0)
    angles = np.radians(np.arange(360))
    assert ranges == pytest.approx(2.0 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles))), abs=1e-9)


def test_the_room_has_walls_shapes_of_each_kind_and_something_to_push():
    room = world("room")
    assert {type(thing.shape).__name__ for thing in room.obstacles} == {"Box", "Cylinder", "Polygon"}
    assert sum(thing.movable for thing in room.obstacles) == 1
    assert len({thing.colour for thing in room.obstacles}) >= 5
    x0, y0, x1, y1 = room.bounds
    assert (x1 - x0, y1 - y0) == pytest.approx((4.16, 3.66))


def test_a_laser_sees_something_everywhere_in_the_room_and_no_way_leads_out():
    room = world("room")
    for x, y in free_places(room, 0.2):
        ranges = scan(room, x, y)
        assert np.isfinite(ranges).sum() >= 240
        left, bottom, right, top = room.bounds
        assert left < x < right
        assert bottom < y < top


def test_the_room_can_be_driven_as_its_docstring_says():
    room = world("room")
    for distance in np.arange(0.0, 3.0, 0.05):
        assert room.blocked((distance, 0.0, 0.0), BURGER) is None
    for side in np.arange(0.0, 1.01, 0.05):
        for pose in ((side, 0, 0), (1, side, math.pi / 2), (1 - side, 1, math.pi), (0, 1 - side, -math.pi / 2)):
            assert room.blocked(pose, 0.12) is None
    loop = [(2.0, 0.0), (2.9, 0.3), (2.9, 2.4), (2.0, 2.2), (2.07, 1.2), (2.0, 0.0)]
    for (xa, ya), (xb, yb) in pairwise(loop):
        for t in np.linspace(0, 1, 30):
            assert room.blocked((xa + t * (xb - xa), ya + t * (yb - ya), 0.0), 0.12) is None


@pytest.mark.parametrize(
    ("name", "part"),
    [
        ("rooom", "did you mean room"),
        ("", "there are arena, empty, floor, house, maze, office, pillars, room"),
        (None, "neither"),
        (7, "neither"),
    ],
)
def test_an_unknown_world_is_refused_with_the_names_there_are(name, part):
    with pytest.raises(WorldError, match=part):
        world(name)


def test_a_path_or_an_address_that_leads_nowhere_is_refused(tmp_path):
    with pytest.raises(MapError, match=r"no map .*house\.yaml"):
        world(str(tmp_path / "house.yaml"))
    with pytest.raises(MapError, match="no map"):
        world(tmp_path / "house")
    with pytest.raises(UnknownPackage):
        world("package://rosmini_simm/maps/floor.yaml")
    with pytest.raises(RosminiError, match=r"floor\.yaml"):
        world("package://rosmini_sim/maps/flor.yaml")


# ---- maps ----


def boundary(thing, count=60):
    """Points along the outline of a thing."""
    if isinstance(thing.shape, Cylinder):
        angles = np.linspace(0, math.tau, 4 * count, endpoint=False)
        return np.array(thing.pose[:2]) + thing.shape.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    sides, t = edges(thing.outline()), np.linspace(0, 1, count)[:, None, None]
    return (sides[:, :2] * (1 - t) + sides[:, 2:] * t).reshape(-1, 2)


def test_tracing_the_floor_gives_back_the_walls_it_was_drawn_from():
    drawn = np.vstack(
        [edges(boundary(t, 30)) if isinstance(t.shape, Cylinder) else edges(t.outline()) for t in floor.things()]
    )
    walls = world("floor").walls
    t = np.linspace(0, 1, 25)[:, None, None]
    traced = (walls[:, :2] * (1 - t) + walls[:, 2:] * t).reshape(-1, 2)
    half = floor.RESOLUTION / 2
    # Of what is slanted or round the cells themselves show the border only to half of their diagonal.
    assert polygons.distances(traced, drawn).max() <= math.sqrt(2) * half + 1e-9
    for thing in floor.things():
        points = boundary(thing)
        bare = np.ones(len(points), dtype=bool)  # not inside of another thing
        for other in floor.things():
            if other is thing:
                continue
            if isinstance(other.shape, Cylinder):
                bare &= np.linalg.norm(points - other.pose[:2], axis=1) > other.shape.radius + half
            else:
                sides = edges(other.outline())
                bare &= ~polygons.inside(points, sides) & (polygons.distances(points, sides) > half)
        if bare.any():
            straight = isinstance(thing.shape, Cylinder) is False and thing.pose[2] == 0
            limit = 0 if straight else math.sqrt(2) * half
            assert polygons.distances(points[bare], walls).max() <= limit + 1e-9, thing.name


def test_the_floor_is_found_by_name_by_address_and_by_path(monkeypatch):
    by_name, by_address = world("floor"), world("package://rosmini_sim/maps/floor.yaml")
    monkeypatch.chdir(source("floor").parent)
    by_path = world("floor.yaml")
    for other in (by_address, by_path):
        assert (other.walls == by_name.walls).all()
        assert other.starts[0] == by_name.starts[0] == (0.0, 0.0, 0.0)
        assert other.name == "floor"
    assert by_name.solid
    assert len(by_name.walls) < 200
    assert by_name.blocked((-1.0 + 0.65, -4.0 + 6.85, 0.0), BURGER) == "the inside of a wall", "in the bed"


def test_a_map_without_walls_is_a_world(tmp_path):
    Image.new("L", (20, 10), 254).save(tmp_path / "plain.png")
    path = tmp_path / "plain.yaml"
    path.write_text(
        "image: plain.png\nresolution: 0.1\norigin: [3.0, 4.0, 0]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n",
        encoding="utf-8",
    )
    here = world(str(path))
    assert here.walls.shape == (0, 4)
    x, y, theta = here.starts[0]
    assert (3 < x < 5, 4 < y < 5, theta) == (True, True, 0)


def test_a_start_is_where_there_is_room(tmp_path):
    pixels = np.full((60, 100), 254, np.uint8)
    pixels[:, 40:42] = 0
    pixels[28:32, :40] = 0
    Image.fromarray(pixels).save(tmp_path / "two.png")
    path = tmp_path / "two.yaml"
    text = (
        "image: two.png\nresolution: 0.1\norigin: [-2.0, -3.0, {}]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n"
    )
    path.write_text(text.format("0"), encoding="utf-8")
    here = world(str(path))
    assert here.starts != ((0.0, 0.0, 0.0),), "the origin is in a wall"
    assert here.blocked(here.starts[0], 0.9) is None
    assert world_from_map(path, starts=((4.0, 0.0, 1.0),), title="mine").starts == ((4.0, 0.0, 1.0),)
    path.write_text(text.format("3.14159265358979"), encoding="utf-8")
    turned = world(path)
    assert turned.bounds == pytest.approx((-6.2, -9.0, -2.0, -3.0))
    assert turned.blocked(turned.starts[0], 0.9) is None


def test_a_real_map_becomes_a_world():
    default = Path(__file__).resolve().parents[4] / "shared" / "data"
    path = Path(os.environ.get("ROSMINI_SHARED_DATA", default)) / "depot.yaml"
    if not path.is_file():
        pytest.skip(f"{path} is not there")
    depot = world(path)
    cells = sum(int(np.abs(np.roll(loop, -1, axis=0) - loop).sum()) for loop in edge_loops(load_map(path).occupied))
    assert len(depot.walls) < cells / 3
    assert depot.bounds == pytest.approx((-7.14, -7.83, 23.06, 7.52), abs=0.3)
    assert depot.blocked(depot.starts[0], BURGER) is None
    for x, y in ((0.0, 2.0), (10.0, -3.5), (20.0, 6.0)):
        assert np.isfinite(raycast(depot.segments, depot.discs, x, y, 0.0, 0.01, 629, 60.0, backend="numpy")).all()


def test_one_warning_lists_all_that_is_wrong_with_a_world(tmp_path):
    path = tmp_path / "w.world"
    path.write_text(
        "<sdf version='1.6'><world name='w'>\n<include><uri>model://none</uri></include>\n"
        "<model name='m'><link name='l'>"
        "<inertial><mass>-1</mass></inertial>"
        "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>"
        "</link></model></world></sdf>",
        encoding="utf-8",
    )
    with pytest.warns(
        UserWarning,
        match=r"(?s)the world 'w' is incomplete:\n.*w.world:2: this model is left out.*\n.*w.world:3: a mass is more",
    ):
        made = world(path)
    assert [each.name for each in made.obstacles] == ["m"]
