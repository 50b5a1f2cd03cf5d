"""The worlds that rosmini brings, and those that are traced from maps."""

import math

import numpy as np
import pytest
from PIL import Image

from rosmini.core.errors import RosminiError, UnknownPackage
from rosmini.core.maps import MapError
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.world import WorldError
from rosmini.sim.worlds import names, source, world
from rosmini.sim.worlds.files import world_from_map

# The corners of a TurtleBot3 Burger: 138 mm by 178 mm, its axle 32 mm ahead of the middle, and 2 cm more.
BURGER = np.array([(-0.121, -0.109), (0.057, -0.109), (0.057, 0.109), (-0.121, 0.109)])
REACH = 3.5


def scan(here, x, y):
    return raycast(here.segments, here.discs, x, y, 0.0, math.radians(1), 360, REACH, backend="numpy")


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


def test_the_empty_world_is_empty_and_the_arena_is_a_square():
    assert len(world("empty").segments) == len(world("empty").discs) == 0
    ranges = scan(world("arena"), 0.0, 0.0)
    angles = np.radians(np.arange(360))
    assert ranges == pytest.approx(2.0 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles))), abs=1e-9)


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
